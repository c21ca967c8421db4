#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace sprag
{
  /// How far a drive stays from jamming. Moving back a rigid lever locks where s <= mu e; a flexible one where its equilibrium
  /// is no longer unique. The margin is P without friction over P: 1 without friction, towards 0 where friction locks.
  struct JammingMargin
  {
    double x    = 0.; ///< of the drive, where s / (mu e) is least [mm]
    double s    = 0.; ///< there [mm]
    double mu   = 0.;
    double mu_e = 0.; ///< [mm]

    /// s / e: mu at which a rigid lever locks there; infinite for e = 0.
    double critical_mu = 0.;

    std::optional<double> flexible;             ///< margin of the lever as a beam, there; none: not asked for, or no equilibrium
    std::optional<double> flexible_critical_mu; ///< at which it jams there; none: above three times the rigid lever's, or 5
  };

  /// `flexible`: whether the lever's flexure is counted, by a beam.
  JammingMargin jamming_margin(const Scene &scene, bool flexible);

  /// The margin in a line.
  std::string jamming_text(const JammingMargin &margin);
} // namespace sprag
