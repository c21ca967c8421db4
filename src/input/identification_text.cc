// SPDX-License-Identifier: GPL-3.0-only
#include "input/analysis_texts.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/table_file.h"
#include "base/text.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    using Names = std::vector<std::string>;

    constexpr std::size_t fewest_rows = 20;

    const char *const table_parameter    = "Identification/Table";
    const char *const unknowns_parameter = "Identification/Unknowns";

    const std::vector<Unknown> friction_unknowns = { Unknown::friction_constant, Unknown::friction_polynomial,
                                                     Unknown::friction_table, Unknown::friction_factor };

    /// Reads words separated by commas.
    template <class T>
    std::vector<T> read_list(const std::string &text, const Choices<T> &choices, const std::string &parameter,
                             const std::string &what, const ReportMistake &report)
    {
      std::vector<T> result;
      const Names words = words_in(choices);
      for (const auto &item : split(text, ','))
      {
        const auto word = single_spaced(item);
        if (!contains(words, word))
          report(parameter, "'" + word + "' is no " + what + did_you_mean(nearest(word, words)) + "; there are " +
                                boost::algorithm::join(words, ", "));
        else if (contains(result, value_for(choices, word)))
          report(parameter, "names '" + word + "' twice");
        else
          result.push_back(value_for(choices, word));
      }
      if (result.empty())
        report(parameter, "must name at least one " + what);
      return result;
    }

    void read_unknowns(IdentificationSettings &settings, const ReportMistake &report)
    {
      settings.sought                = read_list(settings.unknowns, unknown_words(), unknowns_parameter, "unknown", report);
      const auto is_friction_unknown = [](const Unknown unknown) { return contains(friction_unknowns, unknown); };
      if (std::count_if(settings.sought.begin(), settings.sought.end(), is_friction_unknown) > 1)
        report(unknowns_parameter, "can have one of mu, mu polynomial, mu table and friction factor");
      const auto &speeds = settings.friction_speeds;
      const bool grows   = std::adjacent_find(speeds.begin(), speeds.end(), std::greater_equal<>()) == speeds.end();
      if (contains(settings.sought, Unknown::friction_table) && (speeds.size() < 4 || !grows))
        report("Identification/Friction speeds", "must be at least 4 speeds that increase");
    }

    /// Puts the columns that are known into the stroke.
    struct StrokeReader
    {
      const NamedColumns table; ///< with known_columns()

      MeasuredStroke stroke(const std::vector<MeasuredForce> &selected, const bool all) const
      {
        MeasuredStroke result;
        result.time = values(time, "s");
        result.x    = values(position, "mm");
        for (const auto &[word, force] : force_words())
        {
          if (!all && !contains(selected, force))
            continue;
          if (auto forces = measured_values(force); !forces.empty())
            result.channels.push_back({ force, std::move(forces) });
          else if (!all)
            throw InputError("has no column for " + word + ": it has " + names());
        }
        if (result.channels.empty())
          throw InputError("has no column P, Q, sensor_sum or sensor_1: it has " + names());
        if (result.rows() == 0)
          throw InputError("has no column time or x: it has " + names());
        return result;
      }

      // Places of the columns in the table.
      static constexpr std::size_t time = 0, position = 1, normal = 2, drive = 3, sensor_sum = 4, first_sensor = 5;
      static constexpr unsigned int most_sensors = 16;

      static std::vector<ColumnNames> known_columns()
      {
        std::vector<ColumnNames> result = { { "time", "t" }, { "x" }, { "P" }, { "Q" }, { "sensor_sum" } };
        for (unsigned int i = 1; i <= most_sensors; ++i)
          result.push_back({ "sensor_" + std::to_string(i) });
        return result;
      }

      std::string names() const
      {
        return boost::algorithm::join(table.names, ", ");
      }

      /// Empty where there is no such column.
      std::vector<double> values(const std::size_t place, const std::string &unit) const
      {
        const NamedColumn &column = table.columns[place];
        if (!column.values.empty() && column.unit.empty())
          throw InputError("column '" + column.name + "' has no unit: write it in brackets, as in '" + column.name + " [" + unit +
                           "]', or as the dataset's attribute 'unit'");
        return values_in(unit, column);
      }

      std::vector<double> measured_values(const MeasuredForce force) const
      {
        if (force != MeasuredForce::sensors)
          return values(force == MeasuredForce::normal ? normal : drive, "N");
        auto sum = values(sensor_sum, "N");
        for (std::size_t i = 0; i < most_sensors && (sum.empty() || i > 0); ++i)
        {
          const auto one = values(first_sensor + i, "N");
          if (one.empty())
            break;
          sum.resize(one.size(), 0.);
          for (std::size_t row = 0; row < one.size(); ++row)
            sum[row] += one[row];
        }
        return sum;
      }
    };

    void need_usable(const MeasuredStroke &stroke)
    {
      if (stroke.rows() < fewest_rows)
        throw InputError("must have at least " + std::to_string(fewest_rows) + " rows, has " + std::to_string(stroke.rows()));
      for (std::size_t i = 0; i < stroke.time.size(); ++i)
        if (std::isnan(stroke.time[i]) || (i > 0 && stroke.time[i] < stroke.time[i - 1]))
          throw InputError(row_label(i) + "time must not be less than in the row before");
      for (std::size_t i = 0; i < stroke.x.size(); ++i)
        if (std::isnan(stroke.x[i]))
          throw InputError(row_label(i) + "x is missing");
      for (const auto &channel : stroke.channels)
      {
        const auto is_missing = [](const double value) { return std::isnan(value); };
        const auto gaps       = std::count_if(channel.values.begin(), channel.values.end(), is_missing);
        if (stroke.rows() - gaps < fewest_rows)
          throw InputError(word_for(force_words(), channel.force) + " must have at least " + std::to_string(fewest_rows) +
                           " values");
      }
    }
  } // namespace

  const Choices<Unknown> &unknown_words()
  {
    static const Choices<Unknown> all = { { "mu", Unknown::friction_constant },
                                          { "mu polynomial", Unknown::friction_polynomial },
                                          { "mu table", Unknown::friction_table },
                                          { "friction factor", Unknown::friction_factor },
                                          { "k", Unknown::stiffness },
                                          { "e", Unknown::interface_offset },
                                          { "th0", Unknown::inclination },
                                          { "offsets", Unknown::force_offsets },
                                          { "rest", Unknown::rest_angle },
                                          { "lag", Unknown::lag } };
    return all;
  }

  const Choices<MeasuredForce> &force_words()
  {
    static const Choices<MeasuredForce> all = { { "P", MeasuredForce::normal },
                                                { "Q", MeasuredForce::drive },
                                                { "sensors", MeasuredForce::sensors } };
    return all;
  }

  void read_identification(IdentificationSettings &settings, UnusedColumns &unused, const ReportMistake &report)
  {
    read_unknowns(settings, report);
    const bool all = settings.forces == "auto";
    std::vector<MeasuredForce> forces;
    if (!all)
      forces = read_list(settings.forces, force_words(), "Identification/Forces", "force", report);
    const auto read = [&]
    {
      if (!all && forces.empty())
        return;
      const StrokeReader reader{ read_columns(settings.table, StrokeReader::known_columns()) };
      auto stroke = reader.stroke(forces, all);
      need_usable(stroke);
      settings.measured       = std::move(stroke);
      unused[table_parameter] = reader.table.unused;
      if (settings.measured.time.empty() && contains(settings.sought, Unknown::lag))
        report(unknowns_parameter, "lag needs a column time in Identification/Table");
    };
    read_file(table_parameter, settings.table, report, read);
  }
} // namespace sprag
