#pragma once

#include <vector>

namespace sprag
{
  /// Pressures of the points of a friction face, along it.
  struct PressureSamples
  {
    std::vector<double> xi;       ///< deformed, increasing [mm]
    std::vector<double> weight;   ///< area that a point stands for, > 0 [mm^2]
    std::vector<double> pressure; ///< [MPa], >= 0
    double begin = 0.;            ///< of the face [mm]
    double end   = 0.;
  };

  /// The pressure on a contact as far as a solution tells it.
  struct RecoveredPressure
  {
    std::vector<double> pressure; ///< of the samples [MPa], >= 0
    double width   = 0.;          ///< of the contact [mm]
    double largest = 0.;          ///< [MPa]
    double place   = 0.;          ///< of the largest [mm]
    bool is_fitted = false;       ///< whether the pressure below is its own fit; else that of the samples
  };

  /// Smooths a pressure that finite elements leave with dents at the edges of their cells: over one contact [a, b] between smooth
  /// bodies p = (1 - s^2)^m (c_0 + c_1 s + c_2 s^2), s from -1 at a to 1 at b, with m = 1/2 as of elastic half planes, 1 as of a
  /// thin layer or a penalty, or 3/4 between, which fits best. Fitted by least squares weighted with (1 - s^2)^-m, so that the
  /// resultant, its moment and the second moment of the samples are kept to round-off; a, b from the least squares of the
  /// pressure. Where this is not what touches (two contacts, a contact that reaches the face's end, fewer than ten samples, a
  /// misfit of more than a quarter) the samples themselves count, their edges linear between them.
  RecoveredPressure recover(const PressureSamples &samples);
} // namespace sprag
