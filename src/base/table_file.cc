#include "base/table_file.h"

#include "base/errors.h"
#include "base/text.h"

#include <filesystem>
#include <fstream>
#include <hdf5.h>

namespace sprag
{
  namespace
  {
    /// Far beyond any drive, and short enough for memory.
    constexpr hsize_t most_rows = 10000000;

    /// Keeps the library from printing its error stack while in scope.
    class Silence
    {
    public:
      Silence()
      {
        H5Eget_auto2(H5E_DEFAULT, &function, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      }

      ~Silence()
      {
        H5Eset_auto2(H5E_DEFAULT, function, data);
      }

      Silence(const Silence &)            = delete;
      Silence &operator=(const Silence &) = delete;

    private:
      H5E_auto2_t function = nullptr;
      void *data           = nullptr;
    };

    /// Owner of an identifier, which is negative where its call failed.
    class Identifier
    {
    public:
      Identifier(const hid_t owned, herr_t (*const closing)(hid_t))
          : identifier(owned)
          , close(closing)
      {
      }

      ~Identifier()
      {
        if (valid())
          close(identifier);
      }

      Identifier(const Identifier &)            = delete;
      Identifier &operator=(const Identifier &) = delete;

      bool valid() const
      {
        return identifier >= 0;
      }

      hid_t id() const
      {
        return identifier;
      }

    private:
      const hid_t identifier;
      herr_t (*const close)(hid_t);
    };

    std::vector<std::string> names_at_the_root(const Identifier &file)
    {
      std::vector<std::string> names;
      H5G_info_t group;
      if (H5Gget_info(file.id(), &group) < 0)
        return names;
      const auto name_of = [&](const hsize_t i, char *const name, const std::size_t size)
      { return H5Lget_name_by_idx(file.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, name, size, H5P_DEFAULT); };
      for (hsize_t i = 0; i < group.nlinks; ++i)
        if (const ssize_t length = name_of(i, nullptr, 0); length > 0)
        {
          std::string name(static_cast<std::size_t>(length) + 1, '\0');
          name_of(i, name.data(), name.size());
          name.pop_back();
          names.push_back(name);
        }
      return names;
    }

    bool holds_numbers(const Identifier &dataset)
    {
      const Identifier type(H5Dget_type(dataset.id()), H5Tclose);
      const auto kind = type.valid() ? H5Tget_class(type.id()) : H5T_NO_CLASS;
      return kind == H5T_FLOAT || kind == H5T_INTEGER;
    }

    std::vector<double> read_column(const Identifier &file, const std::string &path, const std::string &name)
    {
      const Identifier dataset(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
      if (!dataset.valid())
      {
        // What has this very name is no dataset.
        const auto similar = nearest(name, names_at_the_root(file));
        throw InputError(path + ": has no dataset '" + name + "' at its root" + (similar != name ? did_you_mean(similar) : ""));
      }
      const std::string what = path + ": dataset '" + name + "': ";
      const Identifier space(H5Dget_space(dataset.id()), H5Sclose);
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
      const Silence silence;
      const Identifier access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      // Disks that are read-only or without locks are as good as others.
      H5Pset_file_locking(access.id(), false, true);
      const Identifier file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
      if (!file.valid())
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
