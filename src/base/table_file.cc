#include "base/table_file.h"

#include "base/errors.h"
#include "base/hdf5_handle.h"
#include "base/text.h"

#include <filesystem>
#include <fstream>

namespace sprag
{
  namespace
  {
    using hdf5::Handle;

    /// Far beyond any drive, and short enough for memory.
    constexpr hsize_t most_rows = 10000000;

    bool holds_numbers(const Handle &dataset)
    {
      const Handle type(H5Dget_type(dataset.id()), H5Tclose);
      const auto kind = type.id() >= 0 ? H5Tget_class(type.id()) : H5T_NO_CLASS;
      return kind == H5T_FLOAT || kind == H5T_INTEGER;
    }

    std::vector<double> read_column(const Handle &file, const std::string &path, const std::string &name)
    {
      const Handle dataset(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
      if (dataset.id() < 0)
      {
        // What has this very name is no dataset.
        const auto similar = nearest(name, hdf5::names_in(file));
        throw InputError(path + ": has no dataset '" + name + "' at its root" + (similar != name ? did_you_mean(similar) : ""));
      }
      const std::string what = path + ": dataset '" + name + "': ";
      const Handle space(H5Dget_space(dataset.id()), H5Sclose);
      hsize_t rows = 0;
      if (H5Sget_simple_extent_ndims(space.id()) != 1 || H5Sget_simple_extent_dims(space.id(), &rows, nullptr) < 0)
        throw InputError(what + "must have one dimension");
      if (!holds_numbers(dataset))
        throw InputError(what + "must hold numbers");
      if (rows > most_rows)
        throw InputError(what + "has " + std::to_string(rows) + " numbers: must have at most " + std::to_string(most_rows));
      std::vector<double> values(rows);
      if (rows > 0 && H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        throw InputError(what + "cannot be read");
      return values;
    }

    TwoColumns read_hdf5(const std::string &path, const ColumnNames &names)
    {
      if (!std::ifstream(path) || std::filesystem::is_directory(path))
        throw InputError(path + ": cannot be read");
      hdf5::silence();
      const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      // Disks that are read-only or without locks are as good as others.
      H5Pset_file_locking(access.id(), false, true);
      const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
      if (file.id() < 0)
        throw InputError(path + ": cannot be read as HDF5");

      TwoColumns table;
      std::vector<std::string> mistakes;
      const auto read = [&](std::vector<double> &column, const std::string &name)
      {
        try
        {
          column = read_column(file, path, name);
        }
        catch (const InputError &error)
        {
          mistakes.push_back(error.what());
        }
      };
      read(table.first, names.first);
      read(table.second, names.second);
      if (!mistakes.empty())
        throw InputError(mistakes);
      return table;
    }
  } // namespace

  TwoColumns read_table(const std::string &file, const ColumnNames &names)
  {
    const auto ending = std::filesystem::path(file).extension();
    return ending == ".h5" || ending == ".hdf5" ? read_hdf5(file, names) : read_two_columns(file);
  }
} // namespace sprag
