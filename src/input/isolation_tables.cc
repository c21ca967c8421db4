// SPDX-License-Identifier: GPL-3.0-only
#include "input/analysis_texts.h"

#include "base/errors.h"
#include "base/table_file.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <map>

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

    /// Splits the rows at the largest x into outward and return stroke. Of two rows there, between which Q jumps, each stroke has
    /// its own.
    DamperLoop make_loop(const std::vector<double> &x, const std::vector<double> &forces)
    {
      const auto largest = std::max_element(x.begin(), x.end()) - x.begin();
      const auto begin =
          largest + 1 < static_cast<std::ptrdiff_t>(x.size()) && x[largest + 1] == x[largest] ? largest + 1 : largest;
      const auto until = [&](const std::vector<double> &all)
      { return std::vector<double>(all.begin(), all.begin() + largest + 1); };
      const auto after = [&](const std::vector<double> &all) { return std::vector<double>(all.rbegin(), all.rend() - begin); };
      DamperLoop loop{ { until(x), until(forces) }, { after(x), after(forces) } };
      for (const auto &[stroke, samples] :
           { std::make_pair("on the way out: ", loop.out), std::make_pair("on the way back: ", loop.back) })
      {
        if (samples.at.size() < 4)
          throw InputError(std::string(stroke) + "must have at least 4 rows, has " + std::to_string(samples.at.size()) +
                           ": x grows from 0 to its largest value and falls to 0 again");
        for (std::size_t i = 1; i < samples.at.size(); ++i)
          if (!(samples.at[i] > samples.at[i - 1]))
            throw InputError(std::string(stroke) + "x = " + number_text(samples.at[i]) + " mm does not change steadily");
        if (samples.at.front() != 0.)
          throw InputError(std::string(stroke) + "x = " + number_text(samples.at.front()) + " mm: must be 0 at the end");
      }
      return loop;
    }

    /// Requires that the loop dissipates energy.
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

    /// Factor to mm/s^2, of a spectrum to its square per Hz. What the file says must not contradict the scene.
    double acceleration_factor(const AccelerationUnit chosen_unit, const NamedColumn &column, const bool is_spectrum)
    {
      const bool is_set         = chosen_unit != AccelerationUnit::from_file;
      const double acceleration = is_set ? in_mm_s2(chosen_unit) : 1.;
      const double scene_factor = is_spectrum ? acceleration * acceleration : acceleration;
      if (column.unit.empty() && !is_set)
        throw InputError(
            "the unit of the acceleration is not known: give Isolation/Base unit = mm/s2, cm/s2, m/s2 or g, or a "
            "header as " +
            std::string(is_spectrum ? "'frequency [Hz], density [(m/s2)^2/Hz]'" : "'time [s], acceleration [m/s2]'") +
            ", or in HDF5 the dataset's attribute unit");
      if (column.unit.empty())
        return scene_factor;
      const double file_factor = factor_to(is_spectrum ? "(mm/s2)^2/Hz" : "mm/s2", column);
      if (is_set && std::abs(file_factor / scene_factor - 1.) > 1e-9)
        throw InputError("column '" + column.name + "': its unit is " + column.unit + ", which Isolation/Base unit contradicts");
      return file_factor;
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

    void read_base(IsolationSettings &settings, UnusedColumns &unused)
    {
      const bool is_spectrum = settings.base == BaseMotionType::random;
      const auto table    = is_spectrum ? read_two_columns(settings.base_file, { "frequency", "freq", "f" }, { "density", "psd" })
                                        : read_two_columns(settings.base_file, { "time", "t" }, { "acceleration", "acc", "a" });
      const double factor = acceleration_factor(settings.unit, table.columns[1], is_spectrum);
      settings.base_table = { values_in(is_spectrum ? "Hz" : "s", table.columns[0]), table.columns[1].values };
      need_increasing(settings.base_table, is_spectrum ? "frequency" : "time");
      if (is_spectrum)
        need_spectrum(settings.base_table);
      else if (settings.base_table.at.front() != 0.)
        throw InputError("row 1: time " + number_text(settings.base_table.at.front()) + " s: must be 0");
      for (double &value : settings.base_table.values)
        value *= factor;
      unused[base_parameter] = table.unused;
    }

    void read_loop(IsolationSettings &settings, UnusedColumns &unused)
    {
      const auto table       = read_two_columns(settings.loop_file, { "x", "displacement", "position" }, { "Q", "force" });
      settings.loop          = make_loop(values_in("mm", table.columns[0]), values_in("N", table.columns[1]));
      unused[loop_parameter] = table.unused;
      need_dissipation(settings.loop);
    }
  } // namespace

  void read_isolation_tables(IsolationSettings &settings, UnusedColumns &unused, const ReportMistake &report)
  {
    if (settings.damper == DamperType::loop)
      read_file(loop_parameter, settings.loop_file, report, [&] { read_loop(settings, unused); });
    if (settings.base == BaseMotionType::record ||
        (settings.base == BaseMotionType::random && settings.spectrum == BaseSpectrum::table))
      read_file(base_parameter, settings.base_file, report, [&] { read_base(settings, unused); });
  }
} // namespace sprag
