// SPDX-License-Identifier: GPL-3.0-only
#include "base/table_file.h"

#include "base/archive.h"
#include "base/errors.h"
#include "base/hdf5_handle.h"
#include "base/ranges.h"
#include "base/system/child_process.h"
#include "base/system/confinement.h"
#include "base/system/file_content.h"
#include "base/text.h"
#include "base/units.h"
#include "base/unknown.h"

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numeric>
#include <optional>
#include <sstream>

namespace sprag
{
  SPRAG_SERIALISE(NamedColumn, name, unit, values)

  namespace
  {
    using hdf5::Handle;
    using Names = std::vector<std::string>;

    /// Far beyond any measurement, and short enough for memory.
    constexpr std::size_t most_rows = 10000000;

    constexpr std::size_t most_mistakes = 20;

    /// Indices of the requested columns; none for one that the file lacks.
    using Chosen = std::vector<std::optional<std::size_t>>;
    using Choose = std::function<Chosen(const std::vector<NamedColumn> &header)>;

    /// The columns of a file, or what is wrong with it.
    struct Content
    {
      std::vector<NamedColumn> columns;
      Chosen chosen;
      Names mistakes;
    };

    SPRAG_SERIALISE(Content, columns, chosen, mistakes)

    std::string lower(const std::string &text)
    {
      return boost::algorithm::to_lower_copy(text);
    }

    std::string without_quotes(const std::string &cell)
    {
      const bool quoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
      return quoted ? trim(cell.substr(1, cell.size() - 2)) : cell;
    }

    /// Splits at white space outside of brackets, which belong to the word before them.
    Names split_words(const std::string &line)
    {
      Names words;
      int depth   = 0;
      bool inside = false;
      for (const char c : line)
      {
        const bool is_space = depth == 0 && (c == ' ' || c == '\t');
        const bool opens    = c == '[' || c == '(';
        if (!is_space && !inside && !(opens && !words.empty()))
          words.emplace_back();
        if (!is_space)
          words.back() += opens && !inside ? std::string{ ' ', c } : std::string{ c };
        depth += opens ? 1 : c == ']' || c == ')' ? -1 : 0;
        inside = !is_space;
      }
      return words;
    }

    Names split_cells(const std::string &line)
    {
      const auto separator = line.find(';') != std::string::npos ? ';' : line.find('\t') != std::string::npos ? '\t' : ',';
      Names cells;
      if (line.find(separator) == std::string::npos)
        cells = split_words(line);
      else
        boost::algorithm::split(cells, line, [separator](const char c) { return c == separator; });
      for (auto &cell : cells)
      {
        boost::algorithm::trim(cell, std::locale::classic());
        // Spaces as well as tabs may go with commas.
        if (separator == '\t')
          boost::algorithm::trim_if(cell, boost::algorithm::is_any_of(", "));
        cell = without_quotes(cell);
      }
      return cells;
    }

    bool is_missing(const std::string &cell)
    {
      return cell.empty() || lower(cell) == "nan";
    }

    bool is_like_number(const std::string &cell)
    {
      return lower(cell) == "nan" || leading_number(cell) || lower(cell) == "inf" || lower(cell) == "-inf";
    }

    bool are_numbers(const Names &cells)
    {
      return std::all_of(cells.begin(), cells.end(), [](const auto &cell) { return number_alone(cell).has_value(); });
    }

    /// "Q [N]", "Q (N)" or "Q/N"
    NamedColumn parse_column(const std::string &cell)
    {
      const auto name = [&](const std::size_t end)
      { return boost::algorithm::trim_right_copy_if(cell.substr(0, end), boost::algorithm::is_any_of("/ ")); };
      for (const auto &[opening, closing] : { std::pair('[', ']'), std::pair('(', ')') })
      {
        const auto close = cell.rfind(closing);
        const auto open  = cell.find(opening);
        if (close != std::string::npos && open < close)
          return { name(open), trim(cell.substr(open + 1, close - open - 1)), {} };
      }
      const auto slash = cell.find('/');
      return { name(slash), slash == std::string::npos ? "" : trim(cell.substr(slash + 1)), {} };
    }

    std::string with_points(std::string line)
    {
      std::replace(line.begin(), line.end(), ',', '.');
      return line;
    }

    /// Reads a text line by line.
    struct TextReader
    {
      const std::string file;
      const Choose &choose;
      const bool named; ///< whether the columns must be; a cell may be empty then
      unsigned int number              = 0;
      bool has_rows                    = false;
      bool decimal_commas              = false;
      std::vector<NamedColumn> columns = {};
      std::vector<char> is_read        = {}; ///< of each column
      Chosen chosen                    = {};
      Names mistakes                   = {};

      Content read()
      {
        std::istringstream input(read_whole_file(file, largest_table));
        std::string line, comment;
        for (number = 1; std::getline(input, line); ++number)
        {
          if (line.find('\0') != std::string::npos)
            throw InputError(file + ": is not a text in UTF-8");
          const auto hash = line.find('#');
          const auto row  = trim(line.substr(0, hash));
          if (row.empty() && hash != std::string::npos && columns.empty())
            comment = trim(line.substr(hash + 1));
          if (row.empty())
            continue;
          auto cells = split_cells(row);
          if (!named && row.find('\t') != std::string::npos) // several of which may align two columns
            cells.erase(std::remove(cells.begin(), cells.end(), ""), cells.end());
          if (!columns.empty() || !read_header(cells, row, comment))
            read_row(cells, row);
        }
        if (mistakes.empty() && !has_rows)
          mistakes.push_back(file + (named && columns.empty() ? ": holds no columns" : ": holds no numbers"));
        return { std::move(columns), std::move(chosen), std::move(mistakes) };
      }

      void mistake(const std::string &rule)
      {
        if (mistakes.size() < most_mistakes)
          mistakes.push_back(file + ":" + std::to_string(number) + ": " + rule);
      }

      /// Returns whether the first line is a header. Before one that is none, a comment of as many cells with a unit in square
      /// brackets is it, as numpy.savetxt() writes; without any there are two columns.
      bool read_header(const Names &cells, const std::string &line, const std::string &comment)
      {
        const bool is_header     = std::none_of(cells.begin(), cells.end(), is_like_number);
        const auto comment_cells = split_cells(comment);
        const bool commented     = !is_header && comment_cells.size() == cells.size() && comment.find('[') != std::string::npos;
        if (!is_header && !commented && named)
          throw InputError(file + ":" + std::to_string(number) + ": " + line +
                           ": must be the names of the columns with their units, as in 'time [s], Q [N]'");
        if (is_header || commented)
          for (const auto &cell : commented ? comment_cells : cells)
            columns.push_back(parse_column(cell));
        else
          columns.resize(2);
        try
        {
          chosen = choose(columns);
        }
        catch (const InputError &error)
        {
          for (const auto &message : error.messages)
            mistakes.push_back(file + ": the header '" + (commented ? comment : line) + "' " + message);
          throw InputError(mistakes);
        }
        is_read.resize(columns.size(), 0);
        for (const auto &index : chosen)
          if (index)
            is_read[*index] = 1;
        return is_header;
      }

      void read_row(const Names &cells, const std::string &line)
      {
        has_rows = true;
        if (cells.size() != columns.size())
          return report_width(cells, line);
        for (std::size_t i = 0; i < cells.size(); ++i)
        {
          if (is_read[i] == 0)
            continue;
          const auto value = number_alone(cells[i]);
          if (!value && !(named && is_missing(cells[i])))
            return report_cell(cells[i], line);
          columns[i].values.push_back(value.value_or(unknown));
          if (columns[i].values.size() > most_rows)
            throw InputError(file + ": must have at most " + std::to_string(most_rows) + " rows");
        }
      }

      std::string row_rule(const std::string &line) const
      {
        return line + ": must be " + (columns.size() == 2 ? "two" : std::to_string(columns.size())) + " numbers";
      }

      void report_width(const Names &cells, const std::string &line)
      {
        const auto pointed = with_points(line);
        if (const auto retry = split_cells(pointed); pointed != line && retry.size() == columns.size() && are_numbers(retry))
          report_decimal_comma(line);
        else
          mistake(named ? "has " + std::to_string(cells.size()) + " cells, the header " + std::to_string(columns.size())
                        : row_rule(line));
      }

      void report_cell(const std::string &cell, const std::string &line)
      {
        if (with_decimal_point(cell))
          report_decimal_comma(line);
        else
          mistake(named ? cell + ": must be a number" : row_rule(line));
      }

      void report_decimal_comma(const std::string &line)
      {
        if (!decimal_commas)
          mistake(line + ": numbers need a decimal point: " + with_points(line));
        decimal_commas = true;
      }
    };

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
      if (*rows > most_rows)
        throw InputError(what + "has " + std::to_string(*rows) + " numbers: must have at most " + std::to_string(most_rows));
      column.values.resize(*rows);
      if (*rows > 0 && H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()) < 0)
        throw InputError(what + "cannot be read");
      for (const auto &attribute : hdf5::attribute_names(dataset))
        if (lower(attribute) == "unit" || lower(attribute) == "units")
        {
          const auto unit = hdf5::text_attribute(dataset, attribute);
          if (!unit)
            throw InputError(what + "its attribute '" + attribute + "' must be a text");
          column.unit = column.unit.empty() ? *unit : column.unit;
        }
    }

    Content read_open_hdf5(const std::string &path, const Choose &choose)
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
      Content content;
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

    /// Reads the file in a process without rights, as it may crash the library or name other files.
    Content read_hdf5(const std::string &path, const Choose &choose)
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
      Content content;
      Archive archive(answer.text);
      archive(content);
      return content;
    }

    /// The columns whose names satisfy `is_named`.
    template <class Condition>
    std::vector<std::size_t> columns_where(const std::vector<NamedColumn> &header, const Condition &is_named)
    {
      std::vector<std::size_t> result;
      for (std::size_t i = 0; i < header.size(); ++i)
        if (is_named(header[i].name))
          result.push_back(i);
      return result;
    }

    /// Returns the first of the names that the file has. Columns that differ in capitals alone are ambiguous.
    std::optional<std::size_t> column_called(const std::vector<NamedColumn> &header, const ColumnNames &names)
    {
      for (const auto &name : names)
      {
        const auto found = columns_where(header, [&](const auto &own) { return lower(own) == lower(name); });
        if (found.size() > 1)
          throw InputError("has two columns '" + header[found[0]].name + "'");
        if (!found.empty())
          return found.front();
      }
      return std::nullopt;
    }

    bool has_word(const std::string &name, const ColumnNames &words)
    {
      Names own;
      boost::algorithm::split(own, lower(name), [](const unsigned char c) { return std::isalnum(c) == 0; });
      return std::any_of(words.begin(), words.end(), [&](const auto &word) { return contains(own, lower(word)); });
    }

    /// A column with other words beside its name, as in "sliding speed", which is not that of `other`.
    std::optional<std::size_t> column_with_word(const std::vector<NamedColumn> &header, const ColumnNames &words,
                                                const ColumnNames &other)
    {
      const auto found = columns_where(header, [&](const auto &name) { return has_word(name, words) && !has_word(name, other); });
      if (found.size() > 1)
        throw InputError("'" + header[found[0]].name + "' and '" + header[found[1]].name + "' may both be the column " +
                         words.front());
      return found.empty() ? std::nullopt : std::make_optional(found.front());
    }

    Chosen choose_two(const std::vector<NamedColumn> &header, const ColumnNames &first, const ColumnNames &second,
                      const bool is_ordered)
    {
      Chosen found;
      for (const auto &[names, other] : { std::tie(first, second), std::tie(second, first) })
      {
        found.push_back(column_called(header, names));
        if (!found.back())
          found.back() = column_with_word(header, names, other);
      }
      if (is_ordered && header.size() == 2)
        for (std::size_t i = 0; i < 2; ++i)
          if (!found[i] && found[1 - i] != i)
            found[i] = i;
      const auto names = mapped(header, &NamedColumn::name);
      Names mistakes;
      for (std::size_t i = 0; i < 2; ++i)
        if (!found[i])
        {
          const auto &own = (i == 0 ? first : second).front();
          mistakes.push_back("has no column '" + own + "': it has " + boost::algorithm::join(names, ", "));
        }
      if (!mistakes.empty())
        throw InputError(mistakes);
      return found;
    }

    bool is_hdf5(const std::string &file)
    {
      const auto ending = std::filesystem::path(file).extension();
      return ending == ".h5" || ending == ".hdf5";
    }

    NamedColumns read_table(const std::string &file, const Choose &choose, const bool named)
    {
      auto [columns, chosen, mistakes] = is_hdf5(file) ? read_hdf5(file, choose) : TextReader{ file, choose, named }.read();
      if (!mistakes.empty())
        throw InputError(mistakes);
      NamedColumns table;
      for (std::size_t i = 0; i < columns.size(); ++i)
      {
        table.names.push_back(columns[i].name);
        if (!contains(chosen, i))
          table.unused.push_back(columns[i].name);
      }
      for (const auto &index : chosen)
        table.columns.push_back(index ? std::move(columns[*index]) : NamedColumn{});
      return table;
    }

    /// The last word of a name without unit where the numbers would change if it was theirs, as in "x_m" or "Weg in m".
    std::string unit_in_name(const std::string &unit, const NamedColumn &column)
    {
      const auto before = column.unit.empty() ? column.name.find_last_of(" _") : std::string::npos;
      try
      {
        const auto word = before == std::string::npos ? "" : column.name.substr(before + 1);
        return word.empty() || unit_factor(word, unit) == 1. ? "" : word;
      }
      catch (const InputError &)
      {
        return {}; // a word of another kind
      }
    }
  } // namespace

  NamedColumns read_columns(const std::string &file, const std::vector<ColumnNames> &requested)
  {
    const auto choose = [&](const std::vector<NamedColumn> &header)
    { return mapped(requested, [&](const ColumnNames &names) { return column_called(header, names); }); };
    return read_table(file, choose, true);
  }

  NamedColumns read_two_columns(const std::string &file, const ColumnNames &first, const ColumnNames &second)
  {
    const bool is_ordered = !is_hdf5(file);
    const auto table      = read_table(
             file, [&](const auto &header) { return choose_two(header, first, second, is_ordered); }, false);
    for (const auto &column : table.columns)
    {
      if (column.values.empty())
        throw InputError(file + ": holds no numbers");
      for (std::size_t i = 0; i < column.values.size(); ++i)
        if (!std::isfinite(column.values[i]))
          throw InputError(file + ": " + row_label(i) + column.name + ": must be a finite number");
    }
    return table;
  }

  double factor_to(const std::string &unit, const NamedColumn &column)
  {
    if (const auto likely = unit_in_name(unit, column); !likely.empty())
      throw InputError("column '" + column.name + "': '" + likely + "' may be its unit: must be in brackets, as '[" + likely +
                       "]', or not there");
    try
    {
      return column.unit.empty() ? 1. : unit_factor(column.unit, unit);
    }
    catch (const InputError &error)
    {
      throw InputError("column '" + column.name + "': must be " + (unit.empty() ? "without unit" : "in " + unit) + ": " +
                       error.what());
    }
  }

  std::vector<double> values_in(const std::string &unit, const NamedColumn &column)
  {
    auto result         = column.values;
    const double factor = factor_to(unit, column);
    for (double &value : result)
      value *= factor;
    return result;
  }
} // namespace sprag
