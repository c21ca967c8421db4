// SPDX-License-Identifier: GPL-3.0-only
#include "program/isolation_report.h"

#include "analytic/harmonic_balance.h"
#include "base/text.h"
#include "base/unknown.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sprag
{
  namespace
  {
    bool is_harmonic(const Scene &scene)
    {
      return scene.isolation.base == BaseMotionType::harmonic;
    }

    /// Of the motions that the harmonic balance has the one closest to the run's.
    void add_harmonic_balance(const Scene &scene, const IsolationFindings &found, std::vector<Entry> &entries)
    {
      if (!is_harmonic(scene))
        return;
      const auto &settings = scene.isolation;
      const auto motions =
          harmonic_balance(isolation_system(scene), settings.base_amplitude, 2. * M_PI * settings.base_frequency);
      const auto distance = [&](const HarmonicBalance &motion) { return std::abs(motion.transmissibility - found.fundamental); };
      const auto closest  = std::min_element(motions.begin(), motions.end(),
                                             [&](const auto &a, const auto &b) { return distance(a) < distance(b); });
      const bool is_found = closest != motions.end();
      const double ratio  = is_found ? closest->transmissibility : unknown;
      entries.push_back({ "harmonic_balance_transmissibility", ratio, "1",
                          "of the motion of one harmonic that balances the forces; of several the closest to the run's" });
      entries.push_back({ "harmonic_balance_amplitude", is_found ? closest->amplitude : unknown, "mm",
                          "amplitude of z of that motion; 0: friction holds the table" });
      entries.push_back({ "harmonic_balance_solutions", static_cast<double>(motions.size()), "1", "number of such motions" });
      entries.push_back({ "harmonic_balance_error", std::abs(ratio / found.fundamental - 1.), "1",
                          "of its transmissibility, over transmissibility_fundamental of the run" });
    }

    std::vector<Entry> ratios(const IsolationFindings &found)
    {
      return {
        { "transmissibility_peak", found.peak, "1",
          "largest acceleration of the table over that of the base; with a harmonic base in the last periods" },
        { "transmissibility_fundamental", found.fundamental, "1",
          "first harmonic of the table's acceleration over that of a harmonic base" },
        { "transmissibility_rms", found.rms, "1", "root mean squares likewise" },
        { "transmissibility_rms_low", found.rms_low, "1",
          "of a random base: lower end of the interval of 95 %, from the scatter over twelve sections of the record" },
        { "transmissibility_rms_high", found.rms_high, "1", "its upper end" },
        { "relative_amplitude", found.relative_amplitude, "mm", "largest |z| in the last periods of a harmonic base" },
      };
    }

    std::vector<Entry> steadiness(const IsolationFindings &found)
    {
      return {
        { "steady_state", found.is_steady ? 1. : 0., "1",
          "1: the motion repeats at the end within Isolation/Periodic tolerance" },
        { "periods_to_repeat", static_cast<double>(found.periods), "1",
          "of the base, after which the motion repeats and over which ratios are taken" },
        { "steady_from", found.steady_from, "s", "end of the first period after which it repeats" },
        { "stops_a_period", found.stops_a_period, "1", "stops in a period of the base once the motion repeats" },
      };
    }

  } // namespace

  const std::vector<ColumnInfo> &isolation_columns()
  {
    static const std::vector<ColumnInfo> columns = {
      { "time", "s", "time, starting at 0; a turn or stop has two rows, before and behind it" },
      { "x_base", "mm", "displacement of the base" },
      { "z", "mm", "displacement of the table relative to the base" },
      { "z_rate", "mm/s", "dz/dt" },
      { "table_acceleration", "mm/s^2", "acceleration of the table, of z and base together" },
      { "damper_force", "N", "force of the damper against z, of all its levers; at rest that which friction holds" },
      { "base_acceleration", "mm/s^2", "acceleration of the base" },
      { "kinetic_energy", "N mm", "of the table" },
      { "spring_energy", "N mm", "of the restoring spring, K z^2/2" },
      { "damper_energy", "N mm", "stored by the damper" },
      { "dissipated_energy", "N mm", "by the damper since the start" },
      { "base_work", "N mm", "work of the base on the table since the start" },
      { "energy_residual", "N mm", "base_work less the change of the energies stored and dissipated_energy" },
      { "rests", "1", "1 while friction holds the table" },
    };
    return columns;
  }

  std::vector<double> isolation_row(const IsolationSettings &settings, const IsolatedTable &motion, const bool is_before)
  {
    const auto &state  = motion.state();
    const auto base    = motion.base();
    const double force = is_before ? motion.force_before_turn() : motion.damper_force();
    const double speed = state.rate + base.v;
    return { state.time,
             base.x,
             state.z,
             state.rate,
             -(settings.stiffness * state.z + force) / settings.mass,
             force,
             base.a,
             0.5 * settings.mass * speed * speed,
             0.5 * settings.stiffness * state.z * state.z,
             motion.damper_energy(),
             state.dissipated,
             state.base_work,
             motion.energy_residual(),
             !is_before && motion.rests() ? 1. : 0. };
  }

  std::vector<Entry> isolation_summary(const Scene &scene, const IsolationFindings &found)
  {
    const double natural       = std::sqrt(scene.isolation.stiffness / scene.isolation.mass) / (2. * M_PI);
    std::vector<Entry> entries = {
      { "natural_frequency", natural, "Hz", "of the table on its restoring spring alone" },
      { "residual_offset", found.residual_offset, "mm",
        "z where friction holds the table at the end; where it moves on the mean of its last two turns" },
      { "stops", static_cast<double>(found.stops), "1", "how often z' became 0 and friction held the table" },
      { "turns", static_cast<double>(found.turns), "1", "how often z' became 0, stops included" },
      { "rests_at_end", found.rests ? 1. : 0., "1", "1: friction holds the table at the end" },
      { "end_time", found.time, "s", "reached" },
      { "largest_displacement", found.largest_displacement, "mm", "largest |z|" },
      { "largest_acceleration", found.largest_acceleration, "mm/s^2", "largest of the table" },
      { "rms_acceleration", found.rms_acceleration, "mm/s^2", "of the table, root mean square over the run" },
    };
    const auto append = [&entries](const std::vector<Entry> &more) { entries.insert(entries.end(), more.begin(), more.end()); };
    append(ratios(found));
    if (is_harmonic(scene))
      append(steadiness(found));
    add_harmonic_balance(scene, found, entries);
    append({ { "dissipated_energy", found.dissipated, "N mm", "by the damper" },
             { "base_work", found.base_work, "N mm", "of the base on the table" },
             { "energy_residual", found.energy_residual, "1",
               "largest that the balance of energies leaves open, over the largest energy or work" } });
    return entries;
  }

  Warnings isolation_warnings(const Scene &scene, const IsolationFindings &found)
  {
    if (!is_harmonic(scene) || found.is_steady)
      return {};
    return { { "no_steady_state",
               "After " + rounded_text(found.time) + " s the motion does not repeat within Isolation/Periodic tolerance = " +
                   rounded_text(scene.isolation.periodic_tolerance) + ".",
               "Transmissibilities are those of the last period and hold what is left of the beginning.",
               "A longer Isolation/Duration, or a damper that dissipates more." } };
  }
} // namespace sprag
