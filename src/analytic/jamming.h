// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/drive.h"

#include <string>

namespace sprag
{
  struct Device;

  /// Distance of a drive from jamming. Moving back a rigid lever locks where s <= mu e; a flexible one where its equilibrium is
  /// no longer unique. The margin is P without friction over P, (s + sgn(v) mu e)/s: 1 without friction, towards 0 where
  /// friction locks, more than 1 moving forward.
  struct JammingMargin
  {
    double x    = 0.; ///< of the drive, where the margin is least [mm]
    double v    = 0.; ///< there [mm/s], of a zero the sign counts
    double s    = 0.; ///< there [mm]
    double mu_e = 0.; ///< [mm]

    /// s / e: mu at which a rigid lever locks there; infinite for e = 0.
    double critical_mu = 0.;

    double margin() const
    {
      return 1. + drive_direction(v) * mu_e / s;
    }
  };

  /// Finds the least margin on the way of the drive with mu at its speed there; where a slide is held, of all x of the drive and
  /// both directions at its peak speed. The lever is rigid.
  JammingMargin jamming_margin(const Device &device);

  /// Returns the margin as a line of text.
  std::string jamming_text(const JammingMargin &margin);
} // namespace sprag
