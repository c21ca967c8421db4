// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/energy_ledger.h"
#include "model/step/dynamic_model.h"
#include "model/step/force_history.h"

#include <functional>
#include <optional>

namespace sprag
{
  /// Tells where the drive is at an instant of a run [s], how far its surface has run included.
  using DrivePath = std::function<DrivePoint(double time)>;

  /// Returns the path on which the centre stays where it is and the surface runs on at the slide's speed.
  DrivePath held_path(const DrivePoint &from, const HeldSlide &slide);

  /// Returns the path on which the centre moves smoothly from one slide's x to another's within `duration` > 0 [s]. The surface
  /// runs the slower the more that motion slides by itself, so that the slip goes on at the speed of the slides.
  DrivePath moving_path(const DrivePoint &from, const HeldSlide &begin, const HeldSlide &end, double duration);

  /// A state of a run from which it can be taken up again.
  struct RunState
  {
    Motion motion;
    StoredEnergy energy;
  };

  /// Takes steps of one duration about held slides and keeps their energy ledger.
  class HeldRun
  {
  public:
    double spectral_radius = 1.; ///< of the steps from now on, 0 ... 1
    const double dt;             ///< duration of a step [s]

    /// Prepares steps of `dt` > 0 [s]; one without solution is divided in two, up to 12 times.
    HeldRun(DynamicModel &dynamic_model, const double step_duration)
        : dt(step_duration)
        , model(dynamic_model)
    {
    }

    /// Begins at a motion, the outcome of the model's last hold() or perturbed(). The ledger begins anew; the time of a run that
    /// has begun before goes on.
    void begin(Motion motion);

    /// Takes up a former state of this run, its time apart; the ledger begins anew.
    void resume(RunState state);

    const RunState &state() const
    {
      return now;
    }

    /// Goes on by dt and returns the row there. Throws AnalysisError where there is no solution, or when the run is interrupted.
    const Row &step(const DrivePath &path);

    /// Returns where the drive is at the present state.
    const DrivePoint &drive() const
    {
      return now.motion.drive;
    }

    /// Returns the number of steps so far.
    unsigned long steps() const
    {
      return count;
    }

    /// Returns whether every point in contact now slides the way of `speed`.
    bool slides(double speed) const;

    /// Returns the report of the ledger that leaves most open.
    LedgerReport ledger() const;

  private:
    unsigned int advance(const DrivePath &path, double duration, unsigned int halvings);

    DynamicModel &model;
    RunState now;
    ForceHistory forces;
    Row row;
    std::optional<EnergyLedger> account;
    LedgerReport worst;
    unsigned long count = 0;
  };
} // namespace sprag
