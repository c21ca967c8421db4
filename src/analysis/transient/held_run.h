// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/energy_ledger.h"
#include "model/step/dynamic_model.h"
#include "model/step/force_history.h"

#include <functional>
#include <optional>

namespace sprag
{
  /// Returns position, velocity and surface travel of the cylinder at an instant [s].
  using DrivePath = std::function<DrivePoint(double time)>;

  /// Returns the path of a cylinder that turns about a fixed centre, its surface at the slide's speed.
  DrivePath held_path(const DrivePoint &from, const HeldSlide &slide);

  /// Returns the path along which the centre moves smoothly from one slide's x to another's within `duration` > 0 [s]. The
  /// rotation is reduced by the slip due to that motion, so that the total slip speed stays that of the slides.
  DrivePath moving_path(const DrivePoint &from, const HeldSlide &begin, const HeldSlide &end, double duration);

  /// State from which a run can be resumed.
  struct RunState
  {
    Motion motion;
    StoredEnergy energy;
  };

  /// Integrates vibrations about held slides in steps of constant duration, with an energy ledger.
  class HeldRun
  {
  public:
    double spectral_radius = 1.; ///< spectral radius at infinity of the generalised-alpha steps from now on, 0 to 1
    double dt;                   ///< duration of a step from now on [s]

    /// Prepares steps of `dt` > 0 [s]; one without solution is divided in two, up to 12 times.
    HeldRun(DynamicModel &dynamic_model, const double step_duration)
        : dt(step_duration)
        , model(dynamic_model)
    {
    }

    /// Starts from a motion, the outcome of the model's last hold() or perturbed(). The ledger restarts; the time continues.
    void begin(Motion motion);

    /// Returns to an earlier state of this run; the ledger restarts, the time continues.
    void resume(RunState state);

    const RunState &state() const
    {
      return now;
    }

    /// Advances by dt and returns the row at its end. Throws AnalysisError if there is no solution or the run is interrupted.
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

    /// Returns whether every point in contact slides in the direction of `speed`.
    bool slides(double speed) const;

    /// Returns the report of the ledger with the largest residual.
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
