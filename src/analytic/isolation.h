// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/table_motion.h"
#include "base/progress_keeper.h"
#include "base/unknown.h"

#include <functional>

namespace sprag
{
  struct Scene;

  /// Findings of a run of an isolation system. Ratios are of the table's acceleration to that of the base: with a harmonic base
  /// over the last periods, otherwise over the whole run. A finding that does not apply is NaN.
  struct IsolationFindings
  {
    unsigned int turns     = 0;  ///< instants with z' = 0 that a motion led to, stops included
    unsigned int stops     = 0;  ///< of these at which friction held the table
    double time            = 0.; ///< at the end [s]
    bool rests             = false;
    double residual_offset = unknown; ///< z at rest, or on a base at rest the mean of the last two turns [mm]

    double largest_displacement = 0.;      ///< [mm]
    double largest_acceleration = 0.;      ///< of the table [mm/s^2]
    double rms_acceleration     = 0.;      ///< over the whole run [mm/s^2]
    double relative_amplitude   = unknown; ///< largest |z| of the last periods [mm]

    double peak        = unknown;
    double fundamental = unknown;
    double rms         = unknown;
    double rms_low     = unknown; ///< of a random base: what another record of its spectrum gives lies between, with 95 %
    double rms_high    = unknown;

    bool is_steady        = false;
    unsigned int periods  = 0; ///< of the base, over which the ratios are taken
    double stops_a_period = unknown;
    double steady_from    = unknown; ///< [s]

    double base_work       = 0.; ///< [N mm]
    double dissipated      = 0.;
    double energy_residual = 0.; ///< largest, over the largest energy or work
  };

  /// Takes the motion at the instants of the table; `is_before` tells that the force is still that before a turn.
  using RecordTable = std::function<void(const IsolatedTable &, bool is_before)>;

  /// Keeper of a run's progress, with the serialiser of the table's part of it.
  struct TableKeeper
  {
    ProgressKeeper &progress;
    ProgressSerialiser serialise_table;
  };

  /// Follows a table of the scene to its end and fills in what it finds, also where it throws AnalysisError: the damper ends,
  /// locks, or more energy is left open than Analysis/Maximum energy residual. Without `record` nothing is recorded. With a
  /// keeper, null without, a run goes on from where an interrupted one was.
  void run_isolation(const Scene &scene, IsolatedTable &table, IsolationFindings &findings, const RecordTable &record,
                     const TableKeeper *keeper = nullptr);

  /// Does so with the damper that formulas give.
  void run_isolation(const Scene &scene, IsolationFindings &findings, const RecordTable &record);

  /// Returns the time between two rows [s]: that given, or a hundredth of the natural period, and a tenth of the base's shortest
  /// where that is less.
  double output_step(const IsolationSettings &settings);
} // namespace sprag
