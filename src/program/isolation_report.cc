// SPDX-License-Identifier: GPL-3.0-only
#include "program/isolation_report.h"

#include "analytic/harmonic_balance.h"
#include "base/ranges.h"
#include "base/text.h"
#include "base/unknown.h"
#include "results/page_tables.h"
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

    /// Adds the harmonic balance's solution that is closest to the run's.
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
      append<Entry>(entries, { { "harmonic_balance_transmissibility", ratio },
                               { "harmonic_balance_amplitude", is_found ? closest->amplitude : unknown },
                               { "harmonic_balance_solutions", static_cast<double>(motions.size()) },
                               { "harmonic_balance_error", std::abs(ratio / found.fundamental - 1.) } });
    }

    /// With a harmonic base the harmonic balance stands beside what was found.
    std::vector<Entry> isolation_summary(const Scene &scene, const IsolationFindings &found)
    {
      const double natural       = std::sqrt(scene.isolation.stiffness / scene.isolation.mass) / (2. * M_PI);
      std::vector<Entry> entries = { { "natural_frequency", natural },
                                     { "residual_offset", found.residual_offset },
                                     { "residual_amplitude", found.residual_amplitude },
                                     { "stops", static_cast<double>(found.stops) },
                                     { "turns", static_cast<double>(found.turns) },
                                     { "rests_at_end", found.rests ? 1. : 0. },
                                     { "end_time", found.time },
                                     { "largest_displacement", found.largest_displacement },
                                     { "largest_acceleration", found.largest_acceleration },
                                     { "rms_acceleration", found.rms_acceleration },
                                     { "transmissibility_peak", found.peak },
                                     { "transmissibility_fundamental", found.fundamental },
                                     { "transmissibility_rms", found.rms },
                                     { "transmissibility_rms_low", found.rms_low },
                                     { "transmissibility_rms_high", found.rms_high },
                                     { "relative_amplitude", found.relative_amplitude } };
      if (is_harmonic(scene))
        append<Entry>(entries, { { "steady_state", found.is_steady ? 1. : 0. },
                                 { "periods_to_repeat", static_cast<double>(found.periods) },
                                 { "steady_from", found.steady_from },
                                 { "stops_a_period", found.stops_a_period } });
      add_harmonic_balance(scene, found, entries);
      append<Entry>(entries, { { "dissipated_energy", found.dissipated },
                               { "base_work", found.base_work },
                               { "energy_residual", found.energy_residual } });
      return entries;
    }

    Warnings isolation_warnings(const Scene &scene, const IsolationFindings &found)
    {
      if (!is_harmonic(scene) || found.is_steady)
        return {};
      return { make_warning("no_steady_state", { rounded_text(found.time), rounded_text(periodic_tolerance(scene)) }) };
    }
  } // namespace

  std::vector<ColumnInfo> isolation_columns()
  {
    return page_columns("isolation",
                        "time x_base z z_rate table_acceleration damper_force base_acceleration kinetic_energy spring_energy "
                        "damper_energy dissipated_energy base_work energy_residual rests");
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

  void finish_isolation(const Scene &scene, const IsolationFindings &found, const std::vector<Entry> &facts,
                        const std::string &status, ResultWriter &writer, Warnings &warnings)
  {
    append(warnings, isolation_warnings(scene, found));
    writer.finish(status, { isolation_summary(scene, found), facts }, warnings);
  }
} // namespace sprag
