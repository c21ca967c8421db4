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
    unsigned int turns        = 0;       ///< instants at which z' becomes 0, stops included
    unsigned int stops        = 0;       ///< turns after which friction holds the table
    double time               = 0.;      ///< at the end [s]
    bool rests                = false;   ///< friction holds the table at the end
    double residual_offset    = unknown; ///< z at rest, or on a base at rest the mean of the last two turns [mm]
    double residual_amplitude = unknown; ///< half their distance, within which the table comes to rest [mm]; 0 at rest

    double largest_displacement = 0.;      ///< [mm]
    double largest_acceleration = 0.;      ///< of the table [mm/s^2]
    double rms_acceleration     = 0.;      ///< over the whole run [mm/s^2]
    double relative_amplitude   = unknown; ///< largest |z| of the last periods [mm]

    double peak        = unknown;
    double fundamental = unknown;
    double rms         = unknown; ///< of a random base without the first of 13 sections
    double rms_low     = unknown; ///< of a random base: lower end of the 95 % interval for other records of its spectrum
    double rms_high    = unknown;

    bool is_steady        = false;
    unsigned int periods  = 0; ///< of the base, over which the ratios are taken
    double stops_a_period = unknown;
    double steady_from    = unknown; ///< [s]

    double base_work       = 0.; ///< work of the base on the table [N mm]
    double dissipated      = 0.; ///< [N mm]
    double energy_residual = 0.; ///< largest, over the largest energy or work
  };

  /// Records a row of results. `is_before` marks the first of two rows at a turn, with the force just before it.
  using RecordTable = std::function<void(const IsolatedTable &, bool is_before)>;

  /// Keeps the progress of a run; `serialise_table` adds the state of the table.
  struct TableKeeper
  {
    ProgressKeeper &progress;
    ProgressSerialiser serialise_table;
  };

  /// Runs the scene's table to its end and fills in the findings, also if it throws AnalysisError: the damper reaches its end,
  /// it locks, or the energy residual exceeds Analysis/Maximum energy residual. An empty `record` records nothing. With a keeper
  /// an interrupted run is resumed.
  void run_isolation(const Scene &scene, IsolatedTable &table, IsolationFindings &findings, const RecordTable &record,
                     const TableKeeper *keeper = nullptr);

  /// Runs a table on the scene's damper without a model: levers follow the closed form.
  void run_isolation(const Scene &scene, IsolationFindings &findings, const RecordTable &record);

  /// Returns Isolation/Periodic tolerance, with levers in time at least the error of z that their steps make: periods differ by
  /// it.
  double periodic_tolerance(const Scene &scene);

  /// Returns the time between two rows [s]: Isolation/Output step, else the least of 1/100 natural period, 1/10 of the base's
  /// shortest period and the spacing of a record.
  double output_step(const IsolationSettings &settings);
} // namespace sprag
