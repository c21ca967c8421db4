// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/isolated_table.h"
#include "scene/damper.h"

#include <cmath>
#include <memory>

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

    /// Returns that of the table on its spring alone [1/s].
    double natural_frequency() const
    {
      return std::sqrt(stiffness / mass);
    }
  };

  IsolationSystem isolation_system(const Scene &scene);

  /// Begins at t = 0 with z and z' the motion of a table from event to event. Between them it is smooth and followed by
  /// Runge-Kutta-Fehlberg 7(8) with steps of a given error, `tolerance` over the amplitude; an event ends a step and is met to
  /// the round-off of time. While friction holds the table, z does not change.
  std::unique_ptr<IsolatedTable> make_table_motion(IsolationSystem system, double z, double rate, double tolerance);
} // namespace sprag
