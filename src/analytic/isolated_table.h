// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/base_motion.h"

#include <cmath>

namespace sprag
{
  /// Event at the end of a step.
  enum class TableEvent
  {
    none,
    turn,    ///< z' = 0, and the table goes back at once
    stop,    ///< z' = 0, and friction holds it
    release, ///< it moves again
    centre,  ///< z = 0
    end      ///< of the damper's stroke
  };

  /// Holds an instant of the motion, with integrals over time since the start or since reset_period().
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

  /// A table on its spring and damper over a base that moves, at any fidelity of the damper.
  class IsolatedTable
  {
  public:
    virtual ~IsolatedTable() = default;

    /// Takes a step that ends at `until` or before, and returns the event at its end. Throws AnalysisError where the damper
    /// ends or locks, or no step is found; state() is the last instant then.
    virtual TableEvent advance(double until) = 0;

    const TableState &state() const
    {
      return now;
    }

    /// Returns whether friction holds the table, if the model resolves stick.
    virtual bool rests() const = 0;

    /// Returns the damper's force f [N], while the table rests that which friction holds.
    virtual double damper_force() const = 0;

    /// Returns the force just before the last turn or stop.
    virtual double force_before_turn() const = 0;

    /// Returns the table's acceleration z'' + x_b'' [mm/s^2].
    virtual double acceleration() const = 0;

    virtual BasePoint base() const = 0;

    virtual double damper_energy() const = 0;

    /// Returns the energy of table, spring and damper [N mm].
    virtual double energy() const = 0;

    /// Returns the residual of the energy balance since the start: work of the base less change of energy less dissipation
    /// [N mm].
    double energy_residual() const
    {
      return now.base_work - (energy() - energy_at_start) - now.dissipated;
    }

    // Largest |z'' + x_b''| and |x_b''| [mm/s^2] and |z| [mm] since the start or reset_period(), between the ends of steps as
    // well.
    double largest_acceleration() const
    {
      return peak_acceleration;
    }
    double largest_base_acceleration() const
    {
      return peak_base;
    }
    double largest_displacement() const
    {
      return peak_displacement;
    }

    /// Begins new peaks and integrals of the acceleration.
    void reset_period()
    {
      peak_acceleration = std::abs(acceleration());
      peak_displacement = std::abs(now.z);
      peak_base         = std::abs(base().a);
      now.square = now.cosine = now.sine = now.base_square = 0.;
    }

  protected:
    /// Begins the balance of energies and the first period, once the state at the start is set.
    void begin()
    {
      energy_at_start = energy();
      reset_period();
    }

    TableState now;
    double peak_acceleration = 0., peak_displacement = 0., peak_base = 0.;
    double energy_at_start = 0.;
  };
} // namespace sprag
