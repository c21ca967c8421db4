// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/study/study_record.h"

#include "analysis/task_farm/results_log.h"

#include <array>
#include <map>

namespace sprag
{
  namespace
  {
    const std::array<std::string, 3> names = { { "completed", "failed", "refused" } };

    constexpr char separator = '\t';

    /// Writes fields, which may hold anything, one after another.
    struct FieldWriter
    {
      std::string line = {};

      void text(const std::string &field)
      {
        static const std::map<char, std::string> escapes = { { separator, "\\t" }, { '\n', "\\n" }, { '\\', "\\\\" } };
        for (const char c : field)
          if (const auto escape = escapes.find(c); escape != escapes.end())
            line += escape->second;
          else
            line += c;
        line += separator;
      }

      void numbers(const std::vector<double> &all)
      {
        text(exact_text(all));
      }
    };

    struct FieldReader
    {
      const std::string &line;
      std::size_t at = 0;

      std::string text()
      {
        std::string field;
        for (; line.at(at) != separator; ++at)
          if (line[at] != '\\')
            field += line[at];
          else if (const char escaped = line.at(++at); escaped == 't')
            field += separator;
          else
            field += escaped == 'n' ? '\n' : escaped;
        ++at;
        return field;
      }

      std::vector<double> numbers()
      {
        return exact_numbers(text());
      }
    };

    void write(const Entry &entry, FieldWriter &fields)
    {
      const double *number = std::get_if<double>(&entry.value);
      fields.text(entry.name);
      fields.text(number != nullptr ? "n" : "t");
      if (number != nullptr)
        fields.numbers({ *number });
      else
        fields.text(std::get<std::string>(entry.value));
      fields.text(entry.unit);
      fields.text(entry.description);
    }

    Entry read_entry(FieldReader &fields)
    {
      Entry entry;
      entry.name = fields.text();
      if (fields.text() == "n")
        entry.value = fields.numbers().at(0);
      else
        entry.value = fields.text();
      entry.unit        = fields.text();
      entry.description = fields.text();
      return entry;
    }
  } // namespace

  std::string outcome_name(const RunOutcome outcome)
  {
    return names.at(static_cast<std::size_t>(outcome));
  }

  std::string to_line(const StudyRecord &record)
  {
    FieldWriter fields;
    fields.numbers({ static_cast<double>(record.run), static_cast<double>(record.outcome), record.cpu_time, record.cpu_spent,
                     record.work, record.wall_time, record.peak_memory, static_cast<double>(record.warnings.size()),
                     static_cast<double>(record.found.summary.size()) });
    fields.text(record.reason);
    for (const auto &warning : record.warnings)
      fields.text(warning);
    for (const auto &entry : record.found.summary)
      write(entry, fields);
    std::vector<double> curve;
    for (const auto &point : record.found.curve)
      curve.insert(curve.end(), { point.x, point.direction, point.P, point.Q });
    fields.numbers(curve);
    return fields.line;
  }

  StudyRecord parse_record(const std::string &line)
  {
    FieldReader fields{ line };
    StudyRecord record;
    const auto numbers = fields.numbers();
    record.run         = static_cast<std::size_t>(numbers.at(0));
    record.outcome     = static_cast<RunOutcome>(static_cast<int>(numbers.at(1)));
    record.cpu_time    = numbers.at(2);
    record.cpu_spent   = numbers.at(3);
    record.work        = numbers.at(4);
    record.wall_time   = numbers.at(5);
    record.peak_memory = numbers.at(6);
    record.reason      = fields.text();
    for (double i = 0.; i < numbers.at(7); ++i)
      record.warnings.push_back(fields.text());
    for (double i = 0.; i < numbers.at(8); ++i)
      record.found.summary.push_back(read_entry(fields));
    const auto curve = fields.numbers();
    for (std::size_t i = 0; i + 3 < curve.size(); i += 4)
      record.found.curve.push_back({ curve[i], curve[i + 1], curve[i + 2], curve[i + 3] });
    return record;
  }
} // namespace sprag
