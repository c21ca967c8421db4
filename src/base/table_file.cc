#include "base/table_file.h"

#include "base/errors.h"
#include "base/file_content.h"
#include "base/hdf5_handle.h"
#include "base/text.h"

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <regex>
#include <sstream>

namespace sprag
{
  namespace
  {
    std::optional<std::pair<double, double>> two_numbers(const std::string &line)
    {
      const auto first = leading_number(line);
      if (!first)
        return std::nullopt;
      const bool separator = !first->rest.empty() && (first->rest[0] == ',' || first->rest[0] == ';');
      const auto second    = leading_number(first->rest.substr(separator ? 1 : 0));
      if (!second || !second->rest.empty())
        return std::nullopt;
      return std::make_pair(first->value, second->value);
    }

    /// The line with points for commas, where that makes two numbers of it.
    std::optional<std::string> with_decimal_points(std::string line)
    {
      std::replace(line.begin(), line.end(), ',', '.');
      return two_numbers(line) ? std::make_optional(line) : std::nullopt;
    }

    /// Separated by commas or semicolons, or else by white space.
    std::vector<std::string> cells_of(const std::string &header)
    {
      const bool separated = header.find_first_of(",;") != std::string::npos;
      const std::regex separator(separated ? "[,;]" : "\\s+");
      return { std::sregex_token_iterator(header.begin(), header.end(), separator, -1), {} };
    }

    bool has_word(const std::string &cell, const std::vector<std::string> &words)
    {
      const std::regex word("[A-Za-z]+");
      return std::any_of(std::sregex_iterator(cell.begin(), cell.end(), word), {},
                         [&](const auto &match)
                         {
                           const auto lower = boost::algorithm::to_lower_copy(match.str());
                           return std::find(words.begin(), words.end(), lower) != words.end();
                         });
    }

    using hdf5::Handle;

    /// Far beyond any drive, and short enough for memory.
    constexpr hsize_t most_rows = 10000000;

    bool holds_numbers(const Handle &dataset)
    {
      const Handle type(H5Dget_type(dataset.id()), H5Tclose);
      const auto kind = type.id() >= 0 ? H5Tget_class(type.id()) : H5T_NO_CLASS;
      return kind == H5T_FLOAT || kind == H5T_INTEGER;
    }

    std::vector<double> read_column(const Handle &file, const std::string &path, const std::string &name, std::string &unit)
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
      unit = hdf5::text_attribute(dataset, "unit");
      return values;
    }

    TwoColumns read_hdf5(const std::string &path, const ColumnNames &names)
    {
      if (const auto reason = reason_unreadable(path, largest_table); !reason.empty())
        throw InputError(path + ": " + reason);
      hdf5::silence();
      const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      // Disks that are read-only or without locks are as good as others.
      H5Pset_file_locking(access.id(), false, true);
      const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
      if (file.id() < 0)
        throw InputError(path + ": cannot be read as HDF5");

      TwoColumns table;
      std::vector<std::string> mistakes;
      const auto read = [&](std::vector<double> &column, const std::string &name, std::string &unit)
      {
        try
        {
          column = read_column(file, path, name, unit);
        }
        catch (const InputError &error)
        {
          mistakes.push_back(error.what());
        }
      };
      read(table.first, names.first, table.first_unit);
      read(table.second, names.second, table.second_unit);
      if (!mistakes.empty())
        throw InputError(mistakes);
      return table;
    }
  } // namespace

  TwoColumns read_two_columns(const std::string &file)
  {
    std::istringstream input(content_of_file(file, largest_table));
    TwoColumns table;
    std::vector<std::string> mistakes;
    bool header_possible = true;
    bool decimal_commas  = false;
    std::string line;
    for (unsigned int number = 1; std::getline(input, line); ++number)
    {
      line = trim(line.substr(0, line.find('#')));
      if (line.empty())
        continue;
      if (const auto row = two_numbers(line))
      {
        table.first.push_back(row->first);
        table.second.push_back(row->second);
      }
      else if (const auto pointed = with_decimal_points(line))
      {
        if (!decimal_commas)
          mistakes.push_back(file + ":" + std::to_string(number) + ": " + line + ": numbers need a decimal point: " + *pointed);
        decimal_commas = true;
      }
      else if (!header_possible || leading_number(line))
        mistakes.push_back(file + ":" + std::to_string(number) + ": " + line + ": must be two numbers");
      else
        table.header = line;
      header_possible = false;
    }
    if (mistakes.empty() && table.first.empty())
      mistakes.push_back(file + ": holds no numbers");
    if (!mistakes.empty())
      throw InputError(mistakes);
    return table;
  }

  bool exchanged_columns(const std::string &header, const std::vector<std::string> &first, const std::vector<std::string> &second)
  {
    const auto cells        = cells_of(header);
    const auto is_alone_for = [](const std::string &cell, const auto &meant, const auto &other)
    { return has_word(cell, meant) && !has_word(cell, other); };
    return cells.size() == 2 && is_alone_for(cells[0], second, first) && is_alone_for(cells[1], first, second);
  }

  TwoColumns read_table(const std::string &file, const ColumnNames &names)
  {
    const auto ending = std::filesystem::path(file).extension();
    return ending == ".h5" || ending == ".hdf5" ? read_hdf5(file, names) : read_two_columns(file);
  }
} // namespace sprag
