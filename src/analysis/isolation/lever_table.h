#pragma once

#include "analysis/isolation/isolated_table.h"
#include "analysis/transient/transient.h"
#include "scene/scene.h"

#include <array>
#include <optional>

namespace sprag
{
  /// A table on levers in time: a model of a lever for z > 0 and one for z < 0, each standing for Isolation/Levers of them. The
  /// end of the table's way is one more unknown of their implicit step: m [z'] = h (-K <z> - f) - m [x_b'] with [z] = h <z'>, < >
  /// the mean and [ ] the change over the step of h, where f is the force that the levers' steps to that end have, so that the
  /// work that leaves the table is the one that the levers take.
  ///
  /// Steps are those of Time/Step and Time/Tolerance: halved where the levers' error is too large or no end is found, doubled
  /// after small errors.
  class LeverTable : public IsolatedTable
  {
  public:
    /// Begins at the scene's z and z' with levers at rest: touching at z = 0, or pressed as far as z. The models must live as
    /// long. `settings` are those of a lever in time.
    LeverTable(const Scene &scene, DynamicModel &outward, DynamicModel &inward, const TransientSettings &settings);

    TableEvent advance(double until) override;

    /// Sticking levers are elastic: z never stands still to the last digit.
    bool rests() const override
    {
      return false;
    }

    double damper_force() const override
    {
      return force;
    }

    double force_before_turn() const override
    {
      return force;
    }

    double acceleration() const override
    {
      return -(K * now.z + force) / m;
    }

    BasePoint base() const override;
    double damper_energy() const override;
    double energy() const override;
    /// Returns the share of the steps' Newton iterations a step, of the table alone.
    double iterations_a_step() const
    {
      return steps > 0 ? static_cast<double>(iterations) / steps : 0.;
    }

    unsigned int number_of_steps() const
    {
      return steps;
    }

  private:
    /// A lever of one side.
    struct Side
    {
      DynamicModel &model;
      int sign; ///< of z on which it works
      Motion motion;
      StoredEnergy stored;
      bool touches;
    };

    /// A step of both levers to an end of the table's way.
    struct Trial
    {
      double z, rate, force, unbalanced;
      std::array<StepOutcome, 2> levers;
      std::array<StoredEnergy, 2> stored;
      std::array<bool, 2> touches;
    };

    const double m, K, levers;
    const TransientSettings settings;
    const BaseMotion motion_of_base;
    const double largest_z;
    std::array<Side, 2> sides;
    std::size_t piece = 0;
    double step;
    unsigned int small_errors = 0;
    double tangent; ///< of the levers' force by z [N/mm]
    double force             = 0.;
    unsigned long iterations = 0;
    unsigned int steps       = 0;

    DrivePoint drive_of(const Side &side, double time, double z, double rate) const;
    std::optional<Trial> tried(double h, double way_of_table, std::optional<Trial> before);
    std::optional<Trial> solved(double h);
    double error_of(const Trial &trial) const;
    void accept(double h, Trial &trial);
    TableEvent event_of(const TableState &before) const;
  };
} // namespace sprag
