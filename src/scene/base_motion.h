// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/isolation.h"

#include <functional>
#include <limits>
#include <vector>

namespace sprag
{
  /// Holds the motion of the base at an instant.
  struct BasePoint
  {
    double x;    ///< displacement [mm]
    double v;    ///< [mm/s]
    double a;    ///< [mm/s^2]
    double jerk; ///< da/dt [mm/s^3]
  };

  /// Motion of the base from t = 0 on, smooth between its kinks. `piece` is the number of kinks before an instant; at a kink it
  /// selects the value before or after.
  struct BaseMotion
  {
    std::function<BasePoint(double time, std::size_t piece)> at;
    std::vector<double> kinks;                                        ///< increasing, > 0 [s]
    std::vector<double> jumps;                                        ///< of its acceleration, among the kinks [s]
    double shortest_period = std::numeric_limits<double>::infinity(); ///< of its sines [s]
    double frequency       = 0.;                                      ///< of a harmonic motion [Hz]; else 0
    double end             = std::numeric_limits<double>::infinity(); ///< time after which the acceleration is 0 [s]
  };

  /// Returns the motion of Isolation/Base.
  BaseMotion base_motion(const IsolationSettings &settings);

  /// Subtracts c + 2 d t from a recorded acceleration, with c t + d t^2 the least squares fit to its velocity.
  Samples without_drift(const Samples &record);

  /// Largest displacements of a recorded base [mm].
  struct RecordedTravel
  {
    double raw, corrected; ///< `corrected` is without_drift()
  };

  RecordedTravel recorded_travel(const Samples &record);

  /// Returns the spectral density of a Kanai-Tajimi acceleration over that of its white noise, with r = f/f_g and damping z:
  ///   (1 + (2 z r)^2) / ((1 - r^2)^2 + (2 z r)^2).
  double kanai_tajimi(double frequency, double ground_frequency, double ground_damping);
} // namespace sprag
