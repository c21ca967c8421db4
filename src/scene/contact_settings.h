// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <optional>

namespace sprag
{
  enum class ContactType
  {
    compliant,
    ideal ///< rigid lever always in contact, theta from the drive
  };

  enum class Enforcement
  {
    penalty,
    augmented_lagrangian
  };

  struct ContactSettings
  {
    Enforcement enforcement = Enforcement::penalty;
    std::optional<double> penalty;             ///< [N/mm^3], > 0; none: chosen from mesh and layer
    std::optional<double> tangential_penalty;  ///< [N/mm^3], > 0; none: equal to the normal one
    double penetration_tolerance       = 1e-6; ///< augmented Lagrangian: largest penetration left [mm], > 0
    unsigned int maximum_augmentations = 20;

    // Contact of the reduced models (rigid, beam): P = k delta^n + c delta'.
    ContactType type = ContactType::compliant;
    double stiffness = 2000.;                   ///< k [N/mm^n], > 0
    double exponent  = 1.;                      ///< n, >= 1
    double damping   = 0.02;                    ///< of critical, of the lever's inertia on the contact, see contact_time()
    std::optional<double> tangential_stiffness; ///< in stick [N/mm]; none: from the layer's shear
  };
} // namespace sprag
