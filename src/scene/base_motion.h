// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/isolation.h"

#include <functional>
#include <limits>
#include <vector>

namespace sprag
{
  /// Motion of the base at an instant.
  struct BasePoint
  {
    double x;    ///< displacement [mm]
    double v;    ///< [mm/s]
    double a;    ///< [mm/s^2]
    double jerk; ///< da/dt [mm/s^3]
  };

  /// Motion of the base from t = 0 on. It is smooth between its kinks; an instant is asked for with the piece that it belongs to,
  /// 0 before the first kink.
  struct BaseMotion
  {
    std::function<BasePoint(double time, std::size_t piece)> at;
    std::vector<double> kinks;                                        ///< increasing, > 0 [s]
    std::vector<double> jumps;                                        ///< of its acceleration, among the kinks [s]
    double shortest_period = std::numeric_limits<double>::infinity(); ///< of its sines [s]
    double frequency       = 0.;                                      ///< of a harmonic motion [Hz]; else 0
    double end             = std::numeric_limits<double>::infinity(); ///< from which on it has no acceleration [s]
  };

  BaseMotion base_motion(const IsolationSettings &settings);

  /// Takes a line over time off a record, such that the least squares fit of c t + d t^2 to its velocity vanishes.
  Samples without_drift(const Samples &record);

  /// Returns the density of a Kanai-Tajimi acceleration over that of its white noise.
  double kanai_tajimi(double frequency, double ground_frequency, double ground_damping);
} // namespace sprag
