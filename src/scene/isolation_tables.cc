#include "scene/isolation_tables.h"

#include "base/errors.h"
#include "base/table_file.h"
#include "base/text.h"

#include <algorithm>
#include <map>
#include <optional>
#include <regex>

namespace sprag
{
  namespace
  {
    constexpr double standard_gravity = 9806.65; ///< [mm/s^2]

    const char *const loop_parameter = "Isolation/Loop table";
    const char *const base_parameter = "Isolation/Base table";

    void need_increasing(const Samples &samples, const std::string &name)
    {
      if (samples.at.size() < 4)
        throw InputError("must have at least 4 rows, has " + std::to_string(samples.at.size()));
      for (std::size_t i = 1; i < samples.at.size(); ++i)
        if (!(samples.at[i] > samples.at[i - 1]))
          throw InputError(row_label(i) + name + " " + number_text(samples.at[i]) + ": must be more than in the row before");
    }

    /// The row of the largest x ends the way out and begins that back.
    DamperLoop loop_of(const TwoColumns &table)
    {
      const auto &x    = table.first;
      const auto turn  = std::max_element(x.begin(), x.end()) - x.begin();
      const auto until = [&](const std::vector<double> &all) { return std::vector<double>(all.begin(), all.begin() + turn + 1); };
      const auto after = [&](const std::vector<double> &all) { return std::vector<double>(all.rbegin(), all.rend() - turn); };
      DamperLoop loop{ { until(x), until(table.second) }, { after(x), after(table.second) } };
      for (const auto &[way, samples] :
           { std::make_pair("on the way out: ", loop.out), std::make_pair("on the way back: ", loop.back) })
      {
        if (samples.at.size() < 4)
          throw InputError(std::string(way) + "must have at least 4 rows, has " + std::to_string(samples.at.size()) +
                           ": x grows from 0 to its largest value and falls to 0 again");
        for (std::size_t i = 1; i < samples.at.size(); ++i)
          if (!(samples.at[i] > samples.at[i - 1]))
            throw InputError(std::string(way) + "x = " + number_text(samples.at[i]) + " mm does not change steadily");
        if (samples.at.front() != 0.)
          throw InputError(std::string(way) + "x = " + number_text(samples.at.front()) + " mm: must be 0 at the end");
      }
      return loop;
    }

    /// A loop that went round the other way would give energy away.
    void need_dissipation(const DamperLoop &loop)
    {
      double area = 0.;
      for (const auto &[samples, sign] : { std::make_pair(loop.out, 1.), std::make_pair(loop.back, -1.) })
        for (std::size_t i = 1; i < samples.at.size(); ++i)
          area += sign * 0.5 * (samples.at[i] - samples.at[i - 1]) * (samples.values[i] + samples.values[i - 1]);
      if (area < 0.)
        throw InputError("Q is larger on the way back than on the way out: the loop gives " + rounded_text(-area) +
                         " N mm a round and dissipates nothing");
    }

    double in_mm_s2(const AccelerationUnit unit)
    {
      static const std::map<AccelerationUnit, double> all = { { AccelerationUnit::mm_s2, 1. },
                                                              { AccelerationUnit::cm_s2, 10. },
                                                              { AccelerationUnit::m_s2, 1000. },
                                                              { AccelerationUnit::g, standard_gravity } };
      return all.at(unit);
    }

    std::optional<AccelerationUnit> known_unit(const std::string &word)
    {
      static const std::map<std::string, AccelerationUnit> words = {
        { "mm/s2", AccelerationUnit::mm_s2 },  { "mm/s^2", AccelerationUnit::mm_s2 }, { "cm/s2", AccelerationUnit::cm_s2 },
        { "cm/s^2", AccelerationUnit::cm_s2 }, { "gal", AccelerationUnit::cm_s2 },    { "m/s2", AccelerationUnit::m_s2 },
        { "m/s^2", AccelerationUnit::m_s2 },   { "g", AccelerationUnit::g }
      };
      const auto found = words.find(word);
      return found != words.end() ? std::make_optional(found->second) : std::nullopt;
    }

    /// What stands in brackets behind the second column's name, as in "acceleration [m/s2]".
    std::string unit_in(const std::string &header)
    {
      std::smatch found;
      static const std::regex second("[,;].*\\[\\s*([^\\]]*?)\\s*\\]\\s*$|\\]\\s+\\S*\\s*\\[\\s*([^\\]]*?)\\s*\\]\\s*$");
      if (!std::regex_search(header, found, second))
        return {};
      return found[1].matched ? found[1].str() : found[2].str();
    }

    /// A dataset's own unit counts first; the scene's must not contradict it. Of a spectrum, whose unit is squared per Hz,
    /// nothing is read.
    AccelerationUnit unit_of(const AccelerationUnit given, const TwoColumns &table, const bool is_spectrum)
    {
      const bool is_given = given != AccelerationUnit::from_file;
      if (!is_spectrum && !table.first_unit.empty() && table.first_unit != "s")
        throw InputError("dataset 'time': its unit is " + table.first_unit + ", must be s");
      const auto of_dataset = is_spectrum ? std::nullopt : known_unit(table.second_unit);
      if (of_dataset && is_given && *of_dataset != given)
        throw InputError("dataset 'acceleration': its unit is " + table.second_unit + ", which Isolation/Base unit contradicts");
      if (of_dataset)
        return *of_dataset;
      if (is_given)
        return given;
      if (const auto of_header = is_spectrum ? std::nullopt : known_unit(unit_in(table.header)))
        return *of_header;
      throw InputError("the unit of the acceleration is not known: give Isolation/Base unit = mm/s2, cm/s2, m/s2 or g" +
                       std::string(is_spectrum ? ""
                                               : ", or a header as 'time [s], acceleration [m/s2]', or in HDF5 the dataset's "
                                                 "attribute unit"));
    }

    void need_spectrum(const Samples &spectrum)
    {
      for (std::size_t i = 0; i < spectrum.at.size(); ++i)
      {
        if (spectrum.at[i] < 0.)
          throw InputError(row_label(i) + "frequency " + number_text(spectrum.at[i]) + " Hz: must be >= 0");
        if (spectrum.values[i] < 0.)
          throw InputError(row_label(i) + "density " + number_text(spectrum.values[i]) +
                           ": must be >= 0, as no spectrum is negative");
      }
      if (*std::max_element(spectrum.values.begin(), spectrum.values.end()) == 0.)
        throw InputError("must have a density above 0");
    }

    void read_base(IsolationSettings &settings)
    {
      const bool is_spectrum = settings.base == BaseMotionType::random;
      const auto table       = read_table(settings.base_file,
                                    is_spectrum ? ColumnNames{ "frequency", "density" } : ColumnNames{ "time", "acceleration" });
      const double factor    = in_mm_s2(unit_of(settings.unit, table, is_spectrum));
      settings.base_table    = { table.first, table.second };
      need_increasing(settings.base_table, is_spectrum ? "frequency" : "time");
      if (is_spectrum)
        need_spectrum(settings.base_table);
      else if (settings.base_table.at.front() != 0.)
        throw InputError("row 1: time " + number_text(settings.base_table.at.front()) + " s: must be 0");
      for (double &value : settings.base_table.values)
        value *= is_spectrum ? factor * factor : factor;
    }

    void read_loop(IsolationSettings &settings)
    {
      settings.loop = loop_of(read_table(settings.loop_file, { "x", "Q" }));
      need_dissipation(settings.loop);
    }

    void read_file(IsolationSettings &settings, const std::string &parameter, const std::string &file,
                   void (*read)(IsolationSettings &), const ReportMistake &report)
    {
      if (file.empty())
        return report(parameter, "must name a file");
      try
      {
        read(settings);
      }
      catch (const InputError &error)
      {
        for (const auto &message : error.messages)
          report(parameter, message);
      }
    }
  } // namespace

  void read_isolation_tables(IsolationSettings &settings, const ReportMistake &report)
  {
    if (settings.damper == DamperType::loop)
      read_file(settings, loop_parameter, settings.loop_file, read_loop, report);
    if (settings.base == BaseMotionType::record ||
        (settings.base == BaseMotionType::random && settings.spectrum == BaseSpectrum::table))
      read_file(settings, base_parameter, settings.base_file, read_base, report);
  }
} // namespace sprag
