// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/transient/transient.h"
#include "analytic/isolated_table.h"
#include "base/archive.h"
#include "model/step/force_history.h"
#include "scene/drive.h"

#include <array>
#include <optional>
#include <string>

namespace sprag
{
  struct Scene;

  /// Divides a span of time into equal units and each of them into 1, 2, 3, 4, 6, 8, 12 ... equal steps, or only 1, 2, 4, 8 ...,
  /// so that the end is hit and few different durations come up: what a model prepares for one serves again. Durations without
  /// their last digits are equal to the last bit where they are equal but for round-off.
  class StepGrid
  {
  public:
    /// Divides units by halves alone from the next choose() on, for models that prepare much for each duration.
    void use_halves_alone()
    {
      by_halves = true;
    }

    /// Begins a span with as few units as are not longer than `longest` [s], > 0. `to` > `from`.
    void begin(double from, double to, double longest);

    /// Returns whether nothing is left of a span that ends at `to`, or it is another.
    bool needs_span(double to) const
    {
      return is_finished() || end != to;
    }

    bool is_finished() const
    {
      return unit == units;
    }

    /// Makes the present step as long as the grid lets it be from here, but not longer than `target` [s].
    void choose(double target);

    /// Makes the present step shorter, to about half or two thirds.
    void shorten();

    /// Returns the duration of the present step [s].
    double duration() const;

    /// Returns the end of the present step [s].
    double step_end() const;

    /// Advances to the next step.
    void advance();

  private:
    double origin = 0., end = 0.;
    unsigned long units = 0, unit = 0;   ///< of the span, and the present one
    unsigned long parts = 1, passed = 0; ///< steps of the unit, and those behind

    bool by_halves = false;

    unsigned long next_parts(unsigned long present) const;

    double length() const
    {
      return (end - origin) / static_cast<double>(units);
    }
  };

  /// A table on levers in time: a model of a lever for z > 0 and one for z < 0, each standing for Isolation/Levers of them. The
  /// end of the table's travel is one more unknown of their implicit step: m [z'] = h (-K <z> - f) - m [x_b'] with [z] = h <z'>,
  /// < > the mean and [ ] the change over the step of h, where f is the force that the levers' steps to that end have, so that
  /// the work that leaves the table is the one that the levers take.
  ///
  /// With Time/Tolerance the travel is extrapolated from the forces of the last steps, and corrected only where it is
  /// further from the end of that equation than a tenth of the error that a step may have. What it lacks is added to the next
  /// travel and the rate z' is that of the forces, so that no momentum is lost.
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

    /// Returns false: sticking levers are elastic, so that z is never constant to the last digit.
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

    /// Returns the mean number of iterations of a step.
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

    /// A step of both levers to a trial position of the table.
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
      double travel_defect       = 0.; ///< integral of the rates less the travel until now [mm]
      double tangent             = 0.; ///< of the levers' force by z [N/mm]
      double force               = 0.;
      std::size_t piece          = 0; ///< of the motion of the base
      unsigned long iterations   = 0;
      unsigned long steps        = 0;
    };

    /// Accelerations of table and base at one instant [mm/s^2].
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
    const double travel_tolerance; ///< of a step [mm]
    std::array<Side, 2> sides;
    SolverState solver;

    bool adapts() const
    {
      return settings.time.tolerance > 0.;
    }

    /// Returns true if a lever is out of contact over a whole step.
    static bool is_free(const Side &side, const StepOutcome &outcome);

    double side_force(const Side &side, const Motion &motion) const;
    std::size_t piece_before(double time) const;
    BasePoint base_at(double time) const;
    DrivePoint drive_point(const Side &side, double time, double z, double rate) const;
    double predicted_travel(double h) const;
    std::optional<Trial> tried(double h, double table_travel, std::optional<Trial> before);
    std::optional<Trial> solved(double h);
    double trial_error(const Trial &trial) const;
    TableEvent take_step();
    void adapt(double h, double error);
    void accept(double h, Trial &trial);
    void accept_levers(Trial &trial, double h);
    void add_integrals(double h, const Accelerations &before, const Accelerations &behind);
    std::string stroke_exceeded() const;
  };
} // namespace sprag
