// SPDX-License-Identifier: GPL-3.0-only
#include "base/table_file.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/system/file_content.h"
#include "base/table_hdf5.h"
#include "base/text.h"
#include "base/units.h"
#include "base/unknown.h"

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>

namespace sprag
{
  namespace
  {
    using Names = std::vector<std::string>;

    constexpr std::size_t most_mistakes = 20;

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

    /// Returns all that a comment may give as the unit of a column: units in brackets, behind "in", and at the end of a cell.
    Names likely_units(const std::string &text, const bool is_cell)
    {
      Names units;
      std::size_t begin = 0;
      int depth         = 0;
      for (std::size_t i = 0; i < text.size(); ++i)
      {
        const bool opens = text[i] == '[' || text[i] == '(', closes = text[i] == ']' || text[i] == ')';
        if (opens && ++depth == 1)
          begin = i + 1;
        if (closes && --depth == 0)
          units.push_back(trim(text.substr(begin, i - begin)));
      }
      const auto words = split(single_spaced(text), ' ');
      for (std::size_t i = 1; i < words.size(); ++i)
        if (lower(words[i - 1]) == "in")
          units.push_back(boost::algorithm::trim_right_copy_if(words[i], boost::algorithm::is_any_of(",;.:")));
      if (is_cell)
        append(units, { parse_column(text).unit, text.substr(text.find_last_of(" _") + 1) });
      return filtered(units, [](const auto &unit) { return !unit.empty() && is_unit(unit); });
    }

    std::string with_points(std::string line)
    {
      std::replace(line.begin(), line.end(), ',', '.');
      return line;
    }

    /// A text behind #.
    struct Comment
    {
      unsigned int line;
      std::string text;
      bool is_alone; ///< in its line
    };

    /// Reads a text line by line.
    struct TextReader
    {
      const std::string file;
      const ChooseColumns &choose;
      const bool named; ///< whether the columns must be; a cell may be empty then
      unsigned int number              = 0;
      bool has_rows                    = false;
      bool decimal_commas              = false;
      std::vector<NamedColumn> columns = {};
      ChosenColumns chosen             = {};
      Names mistakes                   = {};
      std::vector<Comment> comments    = {}; ///< before the rows, but for one that is the header

      TableContent read()
      {
        std::istringstream input(read_whole_file(file, largest_table));
        std::string line;
        for (number = 1; std::getline(input, line); ++number)
        {
          if (line.find('\0') != std::string::npos)
            throw InputError(file + ": is not a text in UTF-8");
          const auto hash = line.find('#');
          const auto row  = trim(line.substr(0, hash));
          if (hash != std::string::npos && !has_rows)
            comments.push_back({ number, trim(line.substr(hash + 1)), row.empty() });
          if (row.empty())
            continue;
          auto cells = split_cells(row);
          if (!named && row.find('\t') != std::string::npos) // several of which may align two columns
            cells.erase(std::remove(cells.begin(), cells.end(), ""), cells.end());
          if (!columns.empty() || !read_header(cells, row))
            read_row(cells, row);
        }
        if (mistakes.empty() && !has_rows)
          mistakes.push_back(file + (named && columns.empty() ? ": holds no columns" : ": holds no numbers"));
        for (const auto &comment : comments)
          add_remarks(comment);
        return { std::move(columns), std::move(chosen), std::move(mistakes) };
      }

      void mistake(const std::string &rule)
      {
        if (mistakes.size() < most_mistakes)
          mistakes.push_back(file + ":" + std::to_string(number) + ": " + rule);
      }

      void add_remarks(const Comment &comment)
      {
        const auto cells = split_cells(comment.text);
        const bool fits  = cells.size() == columns.size();
        const auto place = file + ":" + std::to_string(comment.line) + ": the comment '" + comment.text + "'";
        for (std::size_t i = 0; i < columns.size(); ++i)
          if (const auto units = likely_units(fits ? cells[i] : comment.text, fits); columns[i].unit.empty() && !units.empty())
            columns[i].remarks.push_back({ place, units });
      }

      /// Returns the columns of a comment that may stand for a header above rows of this width.
      static std::vector<NamedColumn> commented_columns(const Comment &comment, const std::size_t width)
      {
        const auto result = mapped(split_cells(comment.text), parse_column);
        const auto units  = filtered(mapped(result, &NamedColumn::unit), [](const auto &unit) { return !unit.empty(); });
        const bool named  = comment.text.find('[') != std::string::npos ||
                           (comment.text.find(" (") != std::string::npos && std::all_of(units.begin(), units.end(), is_unit));
        return comment.is_alone && result.size() == width && named ? result : std::vector<NamedColumn>{};
      }

      /// Takes the comment that is the header, as numpy.savetxt() writes, out of the others. Returns its text; empty without one.
      std::string take_commented_header(const std::size_t width)
      {
        const auto is_header = [&](const Comment &comment) { return !commented_columns(comment, width).empty(); };
        const auto headers   = filtered(comments, is_header);
        const auto units = [&](const Comment &comment) { return mapped(commented_columns(comment, width), &NamedColumn::unit); };
        for (const auto &header : headers)
          if (units(header) != units(headers.back()))
            throw InputError(file + ":" + std::to_string(header.line) + ": the comments '" + header.text + "' and '" +
                             headers.back().text + "' name different units: one alone may");
        comments.erase(std::remove_if(comments.begin(), comments.end(), is_header), comments.end());
        if (headers.empty())
          return {};
        columns = commented_columns(headers.back(), width);
        return headers.back().text;
      }

      /// Returns whether the first line is a header. Before one that is none, a comment with units may be it; without any there
      /// are two columns.
      bool read_header(const Names &cells, const std::string &line)
      {
        const bool is_header = std::none_of(cells.begin(), cells.end(), is_like_number);
        const auto comment   = is_header ? "" : take_commented_header(cells.size());
        if (!is_header && comment.empty() && named)
          throw InputError(file + ":" + std::to_string(number) + ": " + line +
                           ": must be the names of the columns with their units, as in 'time [s], Q [N]'");
        if (is_header)
          columns = mapped(cells, parse_column);
        else if (comment.empty())
          columns.resize(2);
        try
        {
          chosen = choose(columns);
        }
        catch (const InputError &error)
        {
          for (const auto &message : error.messages)
            mistakes.push_back(file + ": the header '" + (comment.empty() ? line : comment) + "' " + message);
          throw InputError(mistakes);
        }
        return is_header;
      }

      void read_row(const Names &cells, const std::string &line)
      {
        has_rows = true;
        if (cells.size() != columns.size())
          return report_width(cells, line);
        for (std::size_t i = 0; i < cells.size(); ++i)
        {
          if (!contains(chosen, i))
            continue;
          const auto value = number_alone(cells[i]);
          if (!value && !(named && is_missing(cells[i])))
            return report_cell(cells[i], line);
          columns[i].values.push_back(value.value_or(unknown));
          if (columns[i].values.size() > most_table_rows)
            throw InputError(file + ": must have at most " + std::to_string(most_table_rows) + " rows");
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
        if (comma_rule(cell))
          report_decimal_comma(line);
        else
          mistake(named ? cell + ": must be a number" : row_rule(line));
      }

      void report_decimal_comma(const std::string &line)
      {
        if (!decimal_commas)
          mistake(line + ": numbers need a decimal point" +
                  (may_separate_thousands(line) ? " and no separator of thousands" : ": " + with_points(line)));
        decimal_commas = true;
      }
    };

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

    ChosenColumns choose_two(const std::vector<NamedColumn> &header, const ColumnNames &first, const ColumnNames &second,
                             const bool is_ordered)
    {
      ChosenColumns found;
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

    NamedColumns read_table(const std::string &file, const ChooseColumns &choose, const bool named)
    {
      auto [columns, chosen, mistakes] = is_hdf5(file) ? read_hdf5_table(file, choose) : TextReader{ file, choose, named }.read();
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

    /// Returns whether numbers would change if this was their unit, which a word of another kind is not.
    bool changes_numbers(const std::string &word, const std::string &unit)
    {
      try
      {
        return !word.empty() && unit_factor(word, unit) != 1.;
      }
      catch (const InputError &)
      {
        return false;
      }
    }

    /// Throws where the name of a column without unit, as "x_m" or "Weg in m", or a comment above it may tell another.
    void need_no_other_unit(const std::string &unit, const NamedColumn &column)
    {
      const auto before = column.name.find_last_of(" _");
      const auto word   = before == std::string::npos ? "" : column.name.substr(before + 1);
      if (changes_numbers(word, unit))
        throw InputError("column '" + column.name + "': '" + word + "' may be its unit: must be in brackets, as '[" + word +
                         "]', or not there");
      for (const auto &remark : column.remarks)
        for (const auto &likely : remark.likely_units)
          if (changes_numbers(likely, unit))
            throw InputError(remark.place + " may tell the unit '" + likely + "', and the column '" + column.name +
                             "' has none: write a first line as '" + column.name + " [" + likely + "], ...', with [" +
                             (unit.empty() ? "-" : unit) + "] where the comment means something else");
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
    auto table            = read_table(
                   file, [&](const auto &header) { return choose_two(header, first, second, is_ordered); }, false);
    for (std::size_t place = 0; place < 2; ++place)
    {
      auto &column = table.columns[place];
      if (column.name.empty())
        column.name = (place == 0 ? first : second).front();
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
    if (column.unit.empty())
      need_no_other_unit(unit, column);
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
