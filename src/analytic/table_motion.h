// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/isolated_table.h"
#include "scene/damper.h"

#include <array>
#include <functional>
#include <string>

namespace sprag
{
  struct Scene;

  /// m z'' + K z + f(z, z') = -m x_b'' with the damper's force f.
  struct IsolationSystem
  {
    double mass;      ///< m [t]
    double stiffness; ///< K [N/mm]
    Damper damper;
    BaseMotion base;

    double natural_frequency() const; ///< of the table on its spring alone [1/s]
  };

  IsolationSystem isolation_system(const Scene &scene);

  /// The motion of a table from event to event. Between them it is smooth and followed by Runge-Kutta-Fehlberg 7(8) with steps of
  /// a given error; an event ends a step and is met to the round-off of time. While friction holds the table, z does not change.
  class TableMotion : public IsolatedTable
  {
  public:
    /// Begins at t = 0 with z and z'. `tolerance` is the error of a step over the amplitude.
    TableMotion(IsolationSystem system, double z, double rate, double tolerance);

    TableEvent advance(double until) override;

    bool rests() const override
    {
      return direction == 0;
    }

    double damper_force() const override;

    double force_before_turn() const override
    {
      return last_force;
    }

    double acceleration() const override;

    BasePoint base() const override;

    double damper_energy() const override;

    double energy() const override;

  private:
    using Values = std::array<double, 8>;

    const IsolationSystem system;
    const double tolerance;
    const double longest_step;
    std::size_t piece = 0; ///< of the base's motion
    int side          = 1; ///< sign of z
    int direction     = 0; ///< of z'; 0: the table rests
    double next_step;
    double last_force           = 0.;
    unsigned int events_at_once = 0;

    struct Range
    {
      double low, high;
    };

    Resistance resistance(double z, double rate) const;
    double moving_acceleration(double z, double rate, const BasePoint &base) const;
    double force_needed(const BasePoint &base) const;
    Range friction_at_rest() const;
    double excess(const BasePoint &base) const;
    void derivatives(const Values &values, Values &rates, double time) const;
    Values tried(double duration, double &error) const;
    Values stepped(double duration) const;
    double step_end(double until) const;
    TableEvent advance_at_rest(double until);
    TableEvent advance_moving(double until);
    double accepted_step(double until, Values &end);
    double step_to_event(double duration, Values &end, TableEvent &event);
    void check_locking(double duration, const Values &end);
    void take(double duration, const Values &end);
    void note_peaks(const TableState &from, double duration);
    TableEvent turn();
    void set_out(int towards);
    int way_out() const;
    void pass_kink();
    [[noreturn]] void fail(const std::string &what) const;
  };
} // namespace sprag
