// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/isolation/step_grid.h"
#include "analysis/transient/transient.h"
#include "analytic/isolated_table.h"
#include "base/archive.h"
#include "model/step/force_history.h"
#include "scene/drive.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace sprag
{
  struct Scene;

  /// A table on levers in time: a model of a lever for z > 0 and one for z < 0, each standing for Isolation/Levers of them. The
  /// end of the table's way is one more unknown of their implicit step: m [z'] = h (-K <z> - f) - m [x_b'] with [z] = h <z'>, < >
  /// the mean and [ ] the change over the step of h, where f is the force that the levers' steps to that end have, so that the
  /// work that leaves the table is the one that the levers take.
  ///
  /// Where Time/Tolerance is given the way is that which the forces of the last steps lead to, and is corrected only where it is
  /// further from the end of that equation than a tenth of the error that a step may have. What it lacks is added to the next way
  /// and the rate z' is that of the forces, so that no momentum is lost.
  ///
  /// Steps begin with Time/Step and are as long as the error of levers in contact allows, see StepGrid; a 200th of the shortest
  /// period of table and base at most.
  class LeverTable : public IsolatedTable
  {
  public:
    /// Begins at the scene's z and z' with levers at rest: touching at z = 0, or pressed as far as z. Scene and models must live
    /// as long. `settings` are those of a lever in time.
    LeverTable(const Scene &scene, DynamicModel &outward, DynamicModel &inward, const TransientSettings &settings);

    TableEvent advance(double until) override;

    /// Sticking levers are elastic: z never stands still to the last digit.
    bool rests() const override
    {
      return false;
    }

    double damper_force() const override
    {
      return solver.force;
    }

    double force_before_turn() const override
    {
      return solver.force;
    }

    double acceleration() const override
    {
      return -(K * now.z + solver.force) / m;
    }

    BasePoint base() const override;
    double damper_energy() const override;
    double energy() const override;

    /// Returns the mean number of ways tried in a step.
    double iterations_a_step() const
    {
      return solver.steps > 0 ? static_cast<double>(solver.iterations) / static_cast<double>(solver.steps) : 0.;
    }

    unsigned long step_count() const
    {
      return solver.steps;
    }

  private:
    friend void serialise(Archive &archive, LeverTable &table);

    /// A lever of one side.
    struct Side
    {
      DynamicModel &model;
      int sign; ///< of z on which it works
      Motion motion;
      ForceHistory forces;
      StoredEnergy stored;
    };

    /// A step of both levers to an end of the table's way.
    struct Trial
    {
      double z, rate;
      double force; ///< mean of the step
      double residual;
      std::array<StepOutcome, 2> levers;
    };

    /// Variables that change from step to step, apart from states and levers.
    struct SolverState
    {
      StepGrid grid;
      double requested_step      = 0.;
      double last_error          = 1.;
      double last_step           = 0.; ///< durations [s]
      double step_before         = 0.;
      double step_force          = 0.; ///< means over them [N]
      double previous_step_force = 0.;
      double way_owed            = 0.; ///< that the way until now lacks of what follows from the rates [mm]
      double tangent             = 0.; ///< of the levers' force by z [N/mm]
      double force               = 0.;
      std::size_t piece          = 0; ///< of the motion of the base
      unsigned long iterations   = 0;
      unsigned long steps        = 0;
    };

    struct Accelerations
    {
      double table, base;
    };

    const Scene &scene;
    const double m, K, levers;
    const TransientSettings settings;
    const BaseMotion base_excitation;
    const double largest_z;
    const double longest_step;
    const double way_tolerance; ///< to which a step's way is met [mm]
    std::array<Side, 2> sides;
    SolverState solver;

    bool adapts() const
    {
      return settings.time.tolerance > 0.;
    }

    /// Errors of steps go with dt^3 and that of the run with dt^2, see run_transient().
    double local_tolerance() const
    {
      return std::pow(0.5 * settings.time.tolerance, 1.5);
    }

    /// Returns true if a lever is out of contact over a whole step.
    static bool is_free(const Side &side, const StepOutcome &outcome);

    double side_force(const Side &side, const Motion &motion) const;
    std::size_t piece_before(double time) const;
    BasePoint base_at(double time) const;
    DrivePoint drive_point(const Side &side, double time, double z, double rate) const;
    double extrapolation(double h) const;
    double predicted_way(double h) const;
    std::optional<Trial> tried(double h, double table_way, std::optional<Trial> before);
    std::optional<Trial> solved(double h);
    double trial_error(const Trial &trial) const;
    TableEvent take_step();
    void shorten();
    void adapt(double h, double error);
    void accept(double h, Trial &trial);
    void accept_levers(Trial &trial, double h);
    void add_integrals(double h, const Accelerations &before, const Accelerations &behind);
    std::string beyond_the_way() const;
    TableEvent find_event(const TableState &before) const;
  };

  void serialise(Archive &archive, LeverTable &table);
} // namespace sprag
