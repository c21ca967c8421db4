// SPDX-License-Identifier: GPL-3.0-only
#include "base/table_hdf5.h"

#include "base/archive.h"
#include "base/errors.h"
#include "base/hdf5_handle.h"
#include "base/system/child_process.h"
#include "base/system/confinement.h"
#include "base/system/file_content.h"

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <numeric>

namespace sprag
{
  SPRAG_SERIALISE(UnitRemark, place, likely_units)
  SPRAG_SERIALISE(NamedColumn, name, unit, values, remarks)
  SPRAG_SERIALISE(TableContent, columns, chosen, mistakes)

  namespace
  {
    using hdf5::Handle;

    bool holds_numbers(const Handle &dataset)
    {
      const Handle type(H5Dget_type(dataset.id()), H5Tclose);
      const auto kind = type.id() >= 0 ? H5Tget_class(type.id()) : H5T_NO_CLASS;
      return kind == H5T_FLOAT || kind == H5T_INTEGER;
    }

    /// Vectors of MATLAB have two dimensions, one of which is 1. None where more are above that.
    std::optional<std::size_t> dataset_length(const Handle &dataset)
    {
      const Handle space(H5Dget_space(dataset.id()), H5Sclose);
      const int dimensions = H5Sget_simple_extent_ndims(space.id());
      if (dimensions < 1)
        return std::nullopt;
      std::vector<hsize_t> extents(dimensions);
      H5Sget_simple_extent_dims(space.id(), extents.data(), nullptr);
      if (std::count_if(extents.begin(), extents.end(), [](const hsize_t extent) { return extent > 1; }) > 1)
        return std::nullopt;
      return std::accumulate(extents.begin(), extents.end(), std::size_t{ 1 }, std::multiplies<>());
    }

    void read_dataset(const Handle &group, const std::string &path, NamedColumn &column)
    {
      const std::string what = path + ": dataset '" + column.name + "': ";
      const Handle dataset(H5Dopen2(group.id(), column.name.c_str(), H5P_DEFAULT), H5Dclose);
      if (dataset.id() < 0)
        throw InputError(what + "is none");
      const auto rows = dataset_length(dataset);
      if (!rows)
        throw InputError(what + "must have one dimension, or one above 1");
      const Handle storage(H5Dget_create_plist(dataset.id()), H5Pclose);
      if (H5Pget_layout(storage.id()) == H5D_VIRTUAL || H5Pget_external_count(storage.id()) > 0)
        throw InputError(what + "must lie in this file, not in another");
      if (!holds_numbers(dataset))
        throw InputError(what + "must hold numbers");
      if (*rows > most_table_rows)
        throw InputError(what + "has " + std::to_string(*rows) + " numbers: must have at most " +
                         std::to_string(most_table_rows));
      column.values.resize(*rows);
      if (*rows > 0 && H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()) < 0)
        throw InputError(what + "cannot be read");
      for (const auto &attribute : hdf5::attribute_names(dataset))
        if (boost::iequals(attribute, "unit") || boost::iequals(attribute, "units"))
        {
          const auto unit = hdf5::text_attribute(dataset, attribute);
          if (!unit)
            throw InputError(what + "its attribute '" + attribute + "' must be a text");
          column.unit = column.unit.empty() ? *unit : column.unit;
        }
    }

    TableContent read_open_hdf5(const std::string &path, const ChooseColumns &choose)
    {
      hdf5::silence();
      const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      // Disks that are read-only or without locks are as good as others.
      H5Pset_file_locking(access.id(), false, true);
      const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
      if (file.id() < 0)
        return { {}, {}, { path + ": cannot be read as HDF5" } };
      H5O_info_t info;
      const bool grouped = H5Lexists(file.id(), "table", H5P_DEFAULT) > 0 &&
                           H5Oget_info_by_name(file.id(), "table", &info, H5P_DEFAULT) >= 0 && info.type == H5O_TYPE_GROUP;
      const Handle table(H5Gopen2(file.id(), grouped ? "table" : "/", H5P_DEFAULT), H5Gclose);
      TableContent content;
      auto &[columns, chosen, mistakes] = content;
      for (const auto &name : hdf5::names_in(table))
        columns.push_back({ name, "", {} });
      try
      {
        chosen = choose(columns);
      }
      catch (const InputError &error)
      {
        for (const auto &message : error.messages)
          mistakes.push_back(path + ": " + message);
      }
      const NamedColumn *first = nullptr;
      for (const auto &index : chosen)
        try
        {
          if (!index)
            continue;
          NamedColumn &column = columns[*index];
          read_dataset(table, path, column);
          if (first != nullptr && column.values.size() != first->values.size())
            throw InputError(path + ": dataset '" + column.name + "': must be as long as '" + first->name + "'");
          first = &column;
        }
        catch (const InputError &error)
        {
          mistakes.push_back(error.what());
        }
      return content;
    }

    /// Limits of time [s] and memory [bytes] for HDF5, which may never end on a damaged file.
    constexpr double file_timeout     = 20.;
    constexpr std::size_t file_memory = std::size_t(1) << 30;
  } // namespace

  TableContent read_hdf5_table(const std::string &path, const ChooseColumns &choose)
  {
    if (const auto reason = reason_unreadable(path, largest_table); !reason.empty())
      throw InputError(path + ": " + reason);
    const auto bytes = std::filesystem::file_size(path);
    const auto work  = [&]
    {
      limit_growth(file_memory + 20 * bytes);
      confine({ path });
      auto content = read_open_hdf5(path, choose);
      Archive archive;
      archive(content);
      return archive.bytes();
    };
    const auto answer = in_child_process(work, file_timeout + 1e-7 * static_cast<double>(bytes));
    if (!answer.failure.empty())
      throw InputError(path + ": HDF5 " + answer.failure + " on it: the file is damaged");
    TableContent content;
    Archive archive(answer.text);
    archive(content);
    return content;
  }
} // namespace sprag
