#pragma once

#include "scene/base_motion.h"
#include "scene/damper.h"

#include <array>
#include <functional>
#include <string>

namespace sprag
{
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

  /// What happened at the end of a step.
  enum class TableEvent
  {
    none,
    turn,    ///< z' = 0, and the table goes back at once
    stop,    ///< z' = 0, and friction holds it
    release, ///< it moves again
    centre,  ///< z = 0
    end      ///< of the damper's way
  };

  /// An instant of the motion, with integrals over time since the start or since reset_period().
  struct TableState
  {
    double time        = 0.;
    double z           = 0.; ///< [mm]
    double rate        = 0.; ///< z' [mm/s]
    double base_work   = 0.; ///< of the base on the table [N mm]
    double dissipated  = 0.; ///< by the damper [N mm]
    double square      = 0.; ///< of the table's acceleration, integrated [mm^2/s^3]
    double cosine      = 0.; ///< of the acceleration times cos 2 pi f t of a harmonic base [mm/s]
    double sine        = 0.;
    double base_square = 0.; ///< of the base's acceleration, integrated [mm^2/s^3]
  };

  /// The motion of a table from event to event. Between them it is smooth and followed by Runge-Kutta-Fehlberg 7(8) with steps of
  /// a given error; an event ends a step and is met to the round-off of time. While friction holds the table, z does not change.
  class TableMotion
  {
  public:
    /// Begins at t = 0 with z and z'. `tolerance` is the error of a step over the amplitude.
    TableMotion(IsolationSystem system, double z, double rate, double tolerance);

    /// Goes on by a step that ends at `until` or before, and tells what happened there. Throws AnalysisError where the damper
    /// ends or locks; state() is that instant then.
    TableEvent advance(double until);

    const TableState &state() const
    {
      return now;
    }

    bool rests() const
    {
      return direction == 0;
    }

    /// Returns the damper's force f [N], while the table rests that which friction holds.
    double damper_force() const;

    /// Returns the force just before the last turn or stop.
    double force_before_turn() const
    {
      return last_force;
    }

    /// Returns the table's acceleration z'' + x_b'' [mm/s^2].
    double acceleration() const;

    BasePoint base() const;

    double damper_energy() const;

    /// Returns the energy of table, spring and damper [N mm].
    double energy() const;

    /// Returns what the energies leave open since the start: base work less change of energy less what was dissipated [N mm].
    double energy_residual() const;

    /// Largest |z''+ x_b''| [mm/s^2] and |z| [mm] since the start or reset_period(), between the ends of steps as well.
    double largest_acceleration() const
    {
      return peak_acceleration;
    }
    double largest_displacement() const
    {
      return peak_displacement;
    }
    double largest_base_acceleration() const
    {
      return peak_base;
    }

    /// Begins new peaks and integrals of the acceleration.
    void reset_period();

  private:
    using Values = std::array<double, 8>;

    const IsolationSystem system;
    const double tolerance;
    const double longest_step;
    TableState now;
    std::size_t piece = 0; ///< of the base's motion
    int side          = 1; ///< sign of z
    int direction     = 0; ///< of z'; 0: the table rests
    double next_step;
    double energy_at_start      = 0.;
    double peak_acceleration    = 0.;
    double peak_displacement    = 0.;
    double peak_base            = 0.;
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
    double end_of_step(double until) const;
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
