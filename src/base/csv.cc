#include "base/csv.h"

#include "base/errors.h"
#include "base/text.h"

#include <filesystem>
#include <fstream>
#include <optional>

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
  } // namespace

  TwoColumns read_two_columns(const std::string &file)
  {
    std::ifstream input(file);
    if (!input || std::filesystem::is_directory(file))
      throw InputError(file + ": cannot be read");

    TwoColumns table;
    std::vector<std::string> mistakes;
    bool header_possible = true;
    std::string line;
    for (unsigned int number = 1; std::getline(input, line); ++number)
    {
      line = trimmed(line.substr(0, line.find('#')));
      if (line.empty())
        continue;
      if (const auto row = two_numbers(line))
      {
        table.first.push_back(row->first);
        table.second.push_back(row->second);
      }
      else if (!header_possible || leading_number(line))
        mistakes.push_back(file + ":" + std::to_string(number) + ": " + line + ": must be two numbers");
      header_possible = false;
    }
    if (mistakes.empty() && table.first.empty())
      mistakes.push_back(file + ": holds no numbers");
    if (!mistakes.empty())
      throw InputError(mistakes);
    return table;
  }
} // namespace sprag
