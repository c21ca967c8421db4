// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/step/dynamic_model.h"
#include "results/warning.h"
#include "scene/discretisation_settings.h"
#include "scene/drive.h"

#include <vector>

namespace sprag
{
  /// A vibration about the steady slide at one place of a drive that grows enough to matter before the drive leaves.
  struct GrowingMode
  {
    double x;           ///< [mm]
    double v;           ///< of the drive there [mm/s]
    double growth_rate; ///< [1/s], > 0
    double frequency;   ///< [Hz], > 0
  };

  /// Finds the fastest growing vibration at each of a few places of the drive's first cycle, those left out at which none grows
  /// by more than a factor of 1000 within a stroke. Where the model has no slide there is none. Decides by all vibrations of a
  /// small model; requires one that finds them all (not finite elements).
  std::vector<GrowingMode> growing_modes(DynamicModel &model, const Drive &drive);

  /// Returns the algorithmic damping over critical: the loss of the logarithm of an amplitude in a radian, of `angle` > 0 radians
  /// a step, in the generalised-alpha method. It rises with the angle.
  double algorithmic_damping(double spectral_radius, double angle);

  /// Returns by how much, relatively, the method slows a vibration of `angle` >= 0 radians a step.
  double algorithmic_slowing(double spectral_radius, double angle);

  /// Returns the longest step that damps each mode by less than a tenth of its growth and turns it by 1 rad at most [s]; infinite
  /// without modes.
  double longest_step(const std::vector<GrowingMode> &modes, double spectral_radius);

  /// Warns of vibrations that a fixed step hides as it is longer than longest_step(). Adaptive steps never are.
  Warnings hidden_vibration_warnings(const std::vector<GrowingMode> &modes, const TimeSettings &time);
} // namespace sprag
