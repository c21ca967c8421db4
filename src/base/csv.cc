#include "base/csv.h"

#include "base/errors.h"
#include "base/text.h"

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>

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
  } // namespace

  TwoColumns read_two_columns(const std::string &file)
  {
    std::ifstream input(file);
    if (!input || std::filesystem::is_directory(file))
      throw InputError(file + ": cannot be read");

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
} // namespace sprag
