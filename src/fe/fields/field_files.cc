// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/field_files.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/system/disk_reserve.h"
#include "base/text.h"
#include "results/hdf5.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>

namespace sprag
{
  namespace
  {
    // HDF5's own entries, and the index, which is rewritten.
    constexpr std::size_t field_file_overhead = 512 * 1024;

    std::size_t count_bytes(const std::vector<Field> &fields)
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

    /// A group of datasets that are created, with what is to be written there.
    struct NewGroup
    {
      const hdf5::Handle group;
      const std::string place; ///< path of the group in the file
      std::vector<DatasetRows> &rows;

      template <class Number>
      hdf5::Handle add(const std::string &name, const std::vector<Number> &values, const std::size_t width)
      {
        rows.push_back({ place + "/" + name, values.size() / width, width * sizeof(Number), values.data() });
        return hdf5::create_rows<Number>(group, name, values.size() / width, width);
      }

      void add(const Field &field)
      {
        describe(add(field.name, field.values, field.components), field.unit, field.description);
      }
    };

    std::string item(const std::string &place, const std::size_t rows, const std::size_t width, const std::string &type,
                     const unsigned int precision)
    {
      return "<DataItem Dimensions=\"" + std::to_string(rows) + (width > 1 ? " " + std::to_string(width) : "") +
             "\" NumberType=\"" + type + "\" Precision=\"" + std::to_string(precision) + "\" Format=\"HDF\">" + place +
             "</DataItem>\n";
    }

    std::string labelled(const std::string &name, const std::string &unit)
    {
      return unit == "1" ? name : name + " [" + unit + "]";
    }

    std::string attribute(const Field &field, const std::string &group, const std::size_t n_nodes)
    {
      const std::string type = field.components == 1 ? "Scalar" : field.components == 3 ? "Vector" : "Tensor";
      return "        <Attribute Name=\"" + labelled(field.name, field.unit) + "\" AttributeType=\"" + type +
             "\" Center=\"Node\">" + item(group + "/" + field.name, n_nodes, field.components, "Float", 4) +
             "        </Attribute>\n";
    }

    const std::string moving = "displacement"; ///< name of the field that says where the nodes are

    /// Returns where the nodes are in a frame that has their displacement; none in another.
    std::optional<Field> position(const FieldMesh &mesh, const std::vector<Field> &fields)
    {
      if (const auto *const displacement = find_by(fields, &Field::name, moving))
      {
        Field result{ "position", "mm", "of the nodes: nodes and displacement", 3, displacement->values };
        for (std::size_t i = 0; i < result.values.size(); ++i)
          result.values[i] = static_cast<float>(mesh.nodes[i] + displacement->values[i]);
        return result;
      }
      return {};
    }

    std::string topology(const unsigned int nodes_per_cell)
    {
      if (nodes_per_cell == 2)
        return "Polyline\" NodesPerElement=\"2";
      return nodes_per_cell == 4 ? "Quadrilateral" : "Hexahedron";
    }

    std::string number(const double value)
    {
      return formatted("%.17g", value); // reads back as the same number
    }

    void check(const std::ios &stream, const std::string &path)
    {
      if (!stream)
        throw AnalysisError(path + ": cannot be written");
    }

    /// Behind the last grid.
    void append_grid(const std::string &path, const std::string &grid)
    {
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(-static_cast<std::streamoff>(closing.size()), std::ios::end);
      file << grid << closing << std::flush;
      check(file, path);
    }

    void write_index(const std::string &path, const std::map<double, std::string> &grids)
    {
      std::ofstream file(path, std::ios::binary | std::ios::trunc);
      file << opening;
      for (const auto &[time, grid] : grids)
        file << grid;
      file << closing << std::flush;
      check(file, path);
    }
  } // namespace

  FieldFiles::FieldFiles(std::string folder_, std::string name_, std::vector<FieldMesh> meshes, const FrameStorage kept,
                         Writers together)
      : folder(std::move(folder_))
      , name(std::move(name_))
      , storage(kept)
      , writers(std::move(together))
  {
    for (auto &mesh : meshes)
      indices.push_back({ folder + "/" + mesh.name + ".xdmf", std::move(mesh) });
    std::size_t bytes = field_file_overhead;
    for (const auto &[path, mesh, grids] : indices)
      bytes += 8 * (mesh.nodes.size() + mesh.cells.size() + mesh.rigid_cells.size()) + count_bytes(mesh.fixed);
    require_space(folder + "/" + mesh_file(), bytes);
    auto file = hdf5::create_file(folder + "/" + mesh_file());
    std::vector<DatasetRows> rows;
    for (const auto &[path, mesh, grids] : indices)
    {
      NewGroup group{ hdf5::create_group(file, mesh.name), "/" + mesh.name, rows };
      describe(group.add("nodes", mesh.nodes, 3), "mm",
               "positions at rest: x along the cylinder's path towards the pivot, y up, z across");
      group.add("cells", mesh.cells, mesh.nodes_per_cell);
      if (!mesh.rigid_cells.empty())
        group.add("rigid_cells", mesh.rigid_cells, mesh.nodes_per_cell);
      for (const auto &field : mesh.fixed)
        group.add(field);
    }
    file.close();
    write_rows(folder + "/" + mesh_file(), rows, writers);
    for (const auto &index : indices)
      write_index(index.path, index.grids);
  }

  std::string FieldFiles::mesh_file() const
  {
    return name + (storage == FrameStorage::files ? "-mesh.h5" : ".h5");
  }

  std::string FieldFiles::frame_file(const unsigned int frame) const
  {
    return name + formatted("-%04u.h5", frame);
  }

  void FieldFiles::serialise_progress(Archive &archive)
  {
    archive(n_frames);
    for (auto &index : indices)
      archive(index.grids);
    if (!archive.reads())
      return;
    for (unsigned int frame = 0; frame < n_frames; ++frame)
      if (const auto path = folder + "/" + frame_file(frame); !std::filesystem::is_regular_file(path))
        throw AnalysisError(path + " is gone, a frame of the run that was to go on: begin it anew by --overwrite");
    for (unsigned int frame = n_frames; std::filesystem::remove(folder + "/" + frame_file(frame)); ++frame)
      ;
    for (const auto &index : indices)
      write_index(index.path, index.grids);
  }

  void FieldFiles::write(const double time, const std::vector<std::vector<Field>> &fields, const std::vector<FrameFact> &facts)
  {
    const unsigned int frame     = n_frames++;
    const bool own_file          = storage == FrameStorage::files;
    const std::string file_name  = own_file ? frame_file(frame) : mesh_file();
    const std::string frame_name = own_file ? "" : formatted("frame-%04u", frame);
    const auto group_path = [&](const Index &index) { return (own_file ? "/" : "/" + frame_name + "/") + index.mesh.name; };
    std::vector<DatasetRows> rows;
    std::vector<std::optional<Field>> positions;
    std::size_t bytes = field_file_overhead;
    for (std::size_t i = 0; i < indices.size(); ++i)
    {
      positions.push_back(position(indices[i].mesh, fields.at(i)));
      bytes += count_bytes(fields[i]) + (positions.back() ? count_bytes({ *positions.back() }) : 0);
    }
    if (own_file)
      require_space(folder + "/" + file_name, bytes);
    else
      DiskReserve(folder + "/" + file_name).cover(bytes);
    auto file = own_file ? hdf5::create_file(folder + "/" + file_name) : hdf5::open_file(folder + "/" + file_name);
    {
      std::optional<hdf5::Handle> frame_group;
      if (!own_file)
        frame_group.emplace(hdf5::create_group(file, frame_name));
      const auto &place = frame_group ? *frame_group : file;
      hdf5::write_attribute(place, "time", time);
      for (const auto &fact : facts)
        hdf5::write_attribute(place, labelled(fact.name, fact.unit), fact.value);
      for (std::size_t i = 0; i < indices.size(); ++i)
      {
        NewGroup group{ hdf5::create_group(place, indices[i].mesh.name), group_path(indices[i]), rows };
        for (const auto &field : fields[i])
          group.add(field);
        if (positions[i])
          group.add(*positions[i]);
      }
    }
    file.close();
    write_rows(folder + "/" + file_name, rows, writers);
    for (std::size_t i = 0; i < indices.size(); ++i)
    {
      auto &index        = indices[i];
      const bool is_last = index.grids.empty() || time > index.grids.rbegin()->first;
      const auto &text = index.grids[time] = grid(index, time, file_name + ":" + group_path(index), fields[i], facts);
      if (is_last)
        append_grid(index.path, text);
      else
        write_index(index.path, index.grids);
    }
  }

  std::string FieldFiles::grid(const Index &index, const double time, const std::string &place, const std::vector<Field> &fields,
                               const std::vector<FrameFact> &facts) const
  {
    const auto &mesh       = index.mesh;
    const std::string when = "        <Time Value=\"" + number(time) + "\"/>\n";
    if (mesh.rigid_cells.empty())
      return block(mesh, false, when, place, fields, facts);
    return "      <Grid Name=\"" + mesh.name + "\" GridType=\"Collection\" CollectionType=\"Spatial\">\n" + when +
           block(mesh, true, "", place, fields, {}) + block(mesh, false, "", place, fields, facts) + "      </Grid>\n";
  }

  /// Makes a grid of the rigid cells, or of the others.
  std::string FieldFiles::block(const FieldMesh &mesh, const bool rigid, const std::string &time, const std::string &place,
                                const std::vector<Field> &fields, const std::vector<FrameFact> &facts) const
  {
    const bool moves              = find_by(fields, &Field::name, moving) != nullptr;
    const std::size_t n_cells     = (rigid ? mesh.rigid_cells : mesh.cells).size() / mesh.nodes_per_cell;
    const std::string mesh_path   = mesh_file() + ":/" + mesh.name;
    const std::string cells       = mesh_path + (rigid ? "/rigid_cells" : "/cells");
    const std::string element_set = topology(mesh.nodes_per_cell);
    std::string text              = "      <Grid Name=\"" + (rigid ? "rigid" : mesh.name) + "\" GridType=\"Uniform\">\n" + time +
                       "        <Topology TopologyType=\"" + element_set + "\" NumberOfElements=\"" + std::to_string(n_cells) +
                       "\">" + item(cells, n_cells, mesh.nodes_per_cell, "UInt", 4) +
                       "        </Topology>\n        <Geometry GeometryType=\"XYZ\">" +
                       (moves ? item(place + "/position", mesh.n_nodes(), 3, "Float", 4)
                              : item(mesh_path + "/nodes", mesh.n_nodes(), 3, "Float", 8)) +
                       "        </Geometry>\n";
    const auto add = [&](const std::vector<Field> &some, const std::string &where)
    {
      for (const auto &field : some)
        if (!rigid || field.components == 3)
          text += attribute(field, where, mesh.n_nodes());
    };
    add(fields, place);
    add(mesh.fixed, mesh_path);
    for (const auto &fact : facts)
      text += "        <Attribute Name=\"" + labelled(fact.name, fact.unit) +
              "\" AttributeType=\"Scalar\" Center=\"Grid\"><DataItem Dimensions=\"1\" NumberType=\"Float\" Precision=\"8\" "
              "Format=\"XML\">" +
              number(fact.value) + "</DataItem></Attribute>\n";
    return text + "      </Grid>\n";
  }
} // namespace sprag
