#include "base/named_columns.h"

#include "base/errors.h"
#include "base/file_content.h"
#include "base/hdf5_handle.h"
#include "base/text.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>

namespace sprag
{
  namespace
  {
    using hdf5::Handle;
    using Names = std::vector<std::string>;

    constexpr std::size_t most_rows = 2000000;
    constexpr double missing        = std::numeric_limits<double>::quiet_NaN();

    bool contains(const Names &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    /// Unlike split() keeps an empty cell at the end.
    Names cells_of(const std::string &line, const char delimiter)
    {
      auto cells = split(line, delimiter);
      if (!line.empty() && line.back() == delimiter)
        cells.emplace_back();
      return cells;
    }

    char delimiter_of(const std::string &header)
    {
      for (const char delimiter : { ';', '\t' })
        if (header.find(delimiter) != std::string::npos)
          return delimiter;
      return ',';
    }

    /// "Q [N]"
    NamedColumn column_of(const std::string &cell)
    {
      const auto open  = cell.find('[');
      const auto close = cell.find(']', open);
      if (open == std::string::npos || close == std::string::npos)
        return { trim(cell), "", {} };
      return { trim(cell.substr(0, open)), trim(cell.substr(open + 1, close - open - 1)), {} };
    }

    /// Reads the lines of a text one by one.
    class TextReader
    {
    public:
      TextReader(const std::string &path, const Names &wanted_names)
          : file(path)
          , wanted(wanted_names)
      {
      }

      std::vector<NamedColumn> read(Names &found)
      {
        std::istringstream input(content_of_file(file, largest_table));
        std::string line;
        for (number = 1; std::getline(input, line); ++number)
        {
          line = trim(line.substr(0, line.find('#')));
          if (line.empty())
            continue;
          if (columns.empty())
            read_header(line);
          else
            read_row(line);
        }
        if (mistakes.empty() && columns.empty())
          mistakes.push_back(file + ": holds no columns");
        if (!mistakes.empty())
          throw InputError(mistakes);
        std::vector<NamedColumn> result;
        for (auto &column : columns)
        {
          found.push_back(column.name);
          if (contains(wanted, column.name))
            result.push_back(std::move(column));
        }
        return result;
      }

    private:
      const std::string file;
      const Names &wanted;
      char delimiter      = ',';
      unsigned int number = 0;
      std::vector<NamedColumn> columns;
      Names mistakes;

      void mistake(const std::string &rule)
      {
        if (mistakes.size() < 20)
          mistakes.push_back(file + ":" + std::to_string(number) + ": " + rule);
      }

      void read_header(const std::string &line)
      {
        delimiter = delimiter_of(line);
        for (const auto &cell : cells_of(line, delimiter))
        {
          columns.push_back(column_of(cell));
          if (leading_number(cell))
            throw InputError(file + ":" + std::to_string(number) + ": " + line +
                             ": must be the names of the columns with their units, as in 'time [s], Q [N]'");
        }
      }

      void read_row(const std::string &line)
      {
        const auto cells = cells_of(line, delimiter);
        if (cells.size() != columns.size())
          return mistake("has " + std::to_string(cells.size()) + " cells, the header " + std::to_string(columns.size()));
        for (std::size_t i = 0; i < cells.size(); ++i)
          if (contains(wanted, columns[i].name))
            columns[i].values.push_back(value_of(cells[i]));
      }

      double value_of(const std::string &cell)
      {
        if (cell.empty() || cell == "nan" || cell == "NaN")
          return missing;
        const auto value = leading_number(cell);
        if (value && value->rest.empty())
          return value->value;
        if (const auto pointed = with_decimal_point(cell))
          mistake(cell + ": numbers need a decimal point: " + *pointed);
        else
          mistake(cell + ": must be a number");
        return missing;
      }
    };

    NamedColumn read_dataset(const Handle &group, const std::string &path, const std::string &name)
    {
      const std::string what = path + ": dataset '" + name + "': ";
      const Handle dataset(H5Dopen2(group.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
      const Handle space(dataset.id() >= 0 ? H5Dget_space(dataset.id()) : H5I_INVALID_HID, H5Sclose);
      hsize_t rows = 0;
      if (H5Sget_simple_extent_ndims(space.id()) != 1 || H5Sget_simple_extent_dims(space.id(), &rows, nullptr) < 0)
        throw InputError(what + "must have one dimension");
      if (rows > most_rows)
        throw InputError(what + "must have at most " + std::to_string(most_rows) + " numbers");
      NamedColumn result{ name, hdf5::text_attribute(dataset, "unit"), std::vector<double>(rows) };
      if (result.unit.empty())
        result.unit = hdf5::text_attribute(dataset, "units");
      if (rows > 0 && H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()) < 0)
        throw InputError(what + "must hold numbers");
      return result;
    }

    std::vector<NamedColumn> read_hdf5(const std::string &path, const Names &wanted, Names &found)
    {
      if (const auto reason = reason_unreadable(path, largest_table); !reason.empty())
        throw InputError(path + ": " + reason);
      hdf5::silence();
      const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      H5Pset_file_locking(access.id(), false, true); // disks that are read-only or without locks are as good as others
      const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
      if (file.id() < 0)
        throw InputError(path + ": cannot be read as HDF5");
      const Handle table(H5Gopen2(file.id(), contains(hdf5::names_in(file), "table") ? "table" : "/", H5P_DEFAULT), H5Gclose);
      std::vector<NamedColumn> result;
      found = hdf5::names_in(table);
      for (const auto &name : found)
        if (contains(wanted, name))
          result.push_back(read_dataset(table, path, name));
      for (const auto &column : result)
        if (column.values.size() != result.front().values.size())
          throw InputError(path + ": dataset '" + column.name + "': must be as long as '" + result.front().name + "'");
      return result;
    }
  } // namespace

  std::vector<NamedColumn> read_named_columns(const std::string &file, const Names &names, Names &found)
  {
    const auto ending = std::filesystem::path(file).extension();
    return ending == ".h5" || ending == ".hdf5" ? read_hdf5(file, names, found) : TextReader(file, names).read(found);
  }
} // namespace sprag
