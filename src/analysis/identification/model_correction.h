// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <functional>

namespace sprag
{
  struct Scene;

  /// What a model's steady slide has above the closed form, P and Q [N].
  struct ForceDifference
  {
    double P = 0.;
    double Q = 0.;
  };

  /// Takes x [mm] and the direction, 1 or -1.
  using ModelCorrection = std::function<ForceDifference(double x, int direction)>;

  /// Returns the differences of the scene's model from the closed form of the same lever, at the drive's peak speed and at places
  /// over the drive between which they are interpolated; nothing for Analysis/Model = closed form. Throws AnalysisError where the
  /// model has no steady slide.
  ModelCorrection model_correction(const Scene &scene, double peak_speed);
} // namespace sprag
