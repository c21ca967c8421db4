#include "results/field_files.h"

#include "base/errors.h"
#include "results/disk_reserve.h"
#include "results/hdf5.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <regex>
#include <sstream>

namespace sprag
{
  namespace
  {
    // HDF5's own entries, and the index, which is rewritten.
    constexpr std::size_t overhead = 512 * 1024;

    std::size_t bytes_of(const std::vector<Field> &fields)
    {
      std::size_t bytes = 0;
      for (const auto &field : fields)
        bytes += 8 * field.values.size();
      return bytes;
    }

    const std::string opening =
        "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
        "    <Grid Name=\"frames\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    const std::string closing = "    </Grid>\n  </Domain>\n</Xdmf>\n";

    /// Two numbers a node become the three that ParaView's vectors and points have.
    std::vector<double> in_space(const std::vector<double> &plane)
    {
      std::vector<double> result;
      result.reserve(plane.size() / 2 * 3);
      for (std::size_t i = 0; i + 1 < plane.size(); i += 2)
        result.insert(result.end(), { plane[i], plane[i + 1], 0. });
      return result;
    }

    void write_field(const hdf5::Handle &group, const Field &field)
    {
      const auto dataset = hdf5::write_rows(group, field.name, field.values, field.components);
      hdf5::write_attribute(dataset, "unit", field.unit);
      hdf5::write_attribute(dataset, "description", field.description);
    }

    std::string item(const std::string &place, const std::size_t rows, const std::size_t width, const std::string &type,
                     const unsigned int precision)
    {
      std::ostringstream text;
      text << "<DataItem Dimensions=\"" << rows;
      if (width > 1)
        text << ' ' << width;
      text << "\" NumberType=\"" << type << "\" Precision=\"" << precision << "\" Format=\"HDF\">" << place << "</DataItem>\n";
      return text.str();
    }

    std::string shown_name(const std::string &name, const std::string &unit)
    {
      return unit == "1" ? name : name + " [" + unit + "]";
    }

    std::string attribute(const Field &field, const std::string &group, const std::size_t n_nodes)
    {
      const std::string type = field.components == 1 ? "Scalar" : field.components == 3 ? "Vector" : "Tensor";
      return "        <Attribute Name=\"" + shown_name(field.name, field.unit) + "\" AttributeType=\"" + type +
             "\" Center=\"Node\">" + item(group + "/" + field.name, n_nodes, field.components, "Float", 4) +
             "        </Attribute>\n";
    }

    std::string number(const double value)
    {
      std::ostringstream text;
      text.precision(std::numeric_limits<double>::max_digits10);
      text << value;
      return text.str();
    }

    void check(const std::ios &stream, const std::string &path)
    {
      if (!stream)
        throw AnalysisError(path + ": cannot be written");
    }

    /// Behind the last one.
    void append(const std::string &path, const std::string &text)
    {
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(-static_cast<std::streamoff>(closing.size()), std::ios::end);
      file << text << closing << std::flush;
      check(file, path);
    }

    /// Before the first one that is later.
    void insert(const std::string &path, const double time, const std::string &text)
    {
      const std::string first = "      <Grid ", begin = "<Time Value=\"";
      std::ifstream input(path, std::ios::binary);
      std::string whole{ std::istreambuf_iterator<char>(input), {} };
      std::size_t place = whole.find(first);
      while (place != std::string::npos && std::stod(whole.substr(whole.find(begin, place) + begin.size(), 32)) < time)
        place = whole.find(first, place + 1);
      whole.insert(place == std::string::npos ? whole.size() - closing.size() : place, text);
      std::ofstream output(path, std::ios::binary | std::ios::trunc);
      output << whole << std::flush;
      check(output, path);
    }
  } // namespace

  FieldFiles::FieldFiles(std::string folder_, std::string name_, std::vector<FieldMesh> meshes, const FrameStorage kept)
      : folder(std::move(folder_))
      , name(std::move(name_))
      , storage(kept)
  {
    write_mesh_file(meshes);
    for (auto &mesh : meshes)
    {
      indices.push_back({ {},
                          mesh.n_nodes(),
                          mesh.cells.size() / mesh.nodes_per_cell,
                          folder + "/" + mesh.name + ".xdmf",
                          -std::numeric_limits<double>::infinity() });
      indices.back().mesh.name           = mesh.name;
      indices.back().mesh.nodes_per_cell = mesh.nodes_per_cell;
      for (auto &field : mesh.fixed)
        indices.back().mesh.fixed.push_back({ field.name, field.unit, field.description, field.components, {} });
      std::ofstream file(indices.back().path, std::ios::binary | std::ios::trunc);
      file << opening << closing << std::flush;
      check(file, indices.back().path);
    }
  }

  std::string FieldFiles::mesh_file() const
  {
    return name + (storage == FrameStorage::files ? "-mesh.h5" : ".h5");
  }

  void FieldFiles::write_mesh_file(const std::vector<FieldMesh> &meshes) const
  {
    std::size_t bytes = overhead;
    for (const auto &mesh : meshes)
      bytes += 3 * 8 * mesh.nodes.size() + 8 * mesh.cells.size() + bytes_of(mesh.fixed);
    require_space(folder + "/" + mesh_file(), bytes);
    auto file = hdf5::create_file(folder + "/" + mesh_file());
    for (const auto &mesh : meshes)
    {
      const auto group = hdf5::create_group(file, mesh.name);
      const auto nodes = hdf5::write_rows(group, "nodes", in_space(mesh.nodes), 3);
      hdf5::write_attribute(nodes, "unit", "mm");
      hdf5::write_attribute(nodes, "description", "positions at rest: x along the cylinder's path towards the pivot, y up");
      hdf5::write_rows(group, "cells", mesh.cells, mesh.nodes_per_cell);
      for (const auto &field : mesh.fixed)
        write_field(group, field);
    }
    file.close();
  }

  void FieldFiles::write(const double time, const std::vector<std::vector<Field>> &fields, const std::vector<FrameFact> &facts)
  {
    char number_text[16];
    std::snprintf(number_text, sizeof(number_text), "%04u", n_frames++);
    const bool own_file         = storage == FrameStorage::files;
    const std::string file_name = own_file ? name + "-" + number_text + ".h5" : mesh_file();
    const std::string of_frame  = own_file ? "" : std::string("frame-") + number_text;
    std::size_t bytes           = overhead;
    for (const auto &of_mesh : fields)
      bytes += bytes_of(of_mesh);
    if (own_file)
      require_space(folder + "/" + file_name, bytes);
    else
      DiskReserve(folder + "/" + file_name).cover(bytes);
    auto file = own_file ? hdf5::create_file(folder + "/" + file_name) : hdf5::open_file(folder + "/" + file_name);
    {
      std::optional<hdf5::Handle> frame;
      if (!own_file)
        frame.emplace(hdf5::create_group(file, of_frame));
      const auto &place = frame ? *frame : file;
      hdf5::write_attribute(place, "time", time);
      for (const auto &fact : facts)
        hdf5::write_attribute(place, shown_name(fact.name, fact.unit), fact.value);
      for (std::size_t i = 0; i < indices.size(); ++i)
      {
        const auto group = hdf5::create_group(place, indices[i].mesh.name);
        for (const auto &field : fields.at(i))
          write_field(group, field);
      }
    }
    file.close();
    for (std::size_t i = 0; i < indices.size(); ++i)
    {
      auto &index = indices[i];
      const auto text =
          grid(index, time, file_name + ":/" + (own_file ? "" : of_frame + "/") + index.mesh.name, fields[i], facts);
      if (time > index.last_time)
        append(index.path, text);
      else
        insert(index.path, time, text);
      index.last_time = std::max(index.last_time, time);
    }
  }

  std::string FieldFiles::grid(const Index &index, const double time, const std::string &place, const std::vector<Field> &fields,
                               const std::vector<FrameFact> &facts) const
  {
    const auto &mesh              = index.mesh;
    const std::string of_mesh     = mesh_file() + ":/" + mesh.name;
    const std::string element_set = mesh.nodes_per_cell == 2 ? "Polyline\" NodesPerElement=\"2" : "Quadrilateral";
    std::string text = "      <Grid Name=\"" + mesh.name + "\" GridType=\"Uniform\">\n        <Time Value=\"" + number(time) +
                       "\"/>\n        <Topology TopologyType=\"" + element_set + "\" NumberOfElements=\"" +
                       std::to_string(index.n_cells) + "\">" +
                       item(of_mesh + "/cells", index.n_cells, mesh.nodes_per_cell, "UInt", 4) +
                       "        </Topology>\n        <Geometry GeometryType=\"XYZ\">" +
                       item(of_mesh + "/nodes", index.n_nodes, 3, "Float", 8) + "        </Geometry>\n";
    for (const auto &field : fields)
      text += attribute(field, place, index.n_nodes);
    for (const auto &field : mesh.fixed)
      text += attribute(field, of_mesh, index.n_nodes);
    for (const auto &fact : facts)
      text += "        <Attribute Name=\"" + shown_name(fact.name, fact.unit) +
              "\" AttributeType=\"Scalar\" Center=\"Grid\"><DataItem Dimensions=\"1\" NumberType=\"Float\" Precision=\"8\" "
              "Format=\"XML\">" +
              number(fact.value) + "</DataItem></Attribute>\n";
    return text + "      </Grid>\n";
  }

  void remove_field_files(const std::string &folder)
  {
    const std::regex earlier(R"((fields|face|leaf|mode-\d+)(-\d+\.h5|-mesh\.h5|\.h5|\.xdmf))");
    std::vector<std::filesystem::path> found;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      if (std::regex_match(entry.path().filename().string(), earlier))
        found.push_back(entry.path());
    for (const auto &path : found)
      std::filesystem::remove(path);
  }
} // namespace sprag
