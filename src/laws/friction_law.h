// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "base/monotone_cubic.h"

#include <string>
#include <variant>
#include <vector>

namespace sprag
{
  /// Friction coefficient mu and its derivative with respect to the sliding speed [s/mm].
  struct FrictionValue
  {
    double coefficient;
    double derivative;
  };

  /// mu independent of speed.
  struct CoulombFriction
  {
    double coefficient = 0.73; ///< >= 0
  };

  /// Abrasion-resistant cork on aluminium, Yamaguchi & Yoshida eqs. 13-15, speed in mm/s:
  ///   mu = -9.235e-6 v^2 + 4.422e-3 v + 0.3491  (0 <= v < 200)
  ///   mu = -7.086e-7 v^2 + 1.058e-3 v + 0.6809  (200 <= v < 750)
  ///   mu = 1.076                                (750 <= v)
  struct CorkOnAluminium
  {
  };

  /// Falls from rest with the speed v of slip, and grows with it again where viscous:
  ///   mu = kinetic + (at_rest - kinetic) exp(-(v / speed)^exponent) + viscous v
  struct StribeckFriction
  {
    double at_rest  = 0.9; ///< >= 0
    double kinetic  = 0.6; ///< >= 0
    double speed    = 30.; ///< over which mu falls [mm/s]; > 0
    double exponent = 1.;  ///< 1: steepest at rest, 2: level there; >= 1
    double viscous  = 0.;  ///< [s/mm]; >= 0
  };

  /// mu over speed from a file, joined by a monotone cubic (PCHIP) and constant beyond its ends.
  struct TabulatedFriction
  {
    /// `speeds` [mm/s] start at >= 0 and increase; 0 <= `coefficients` <= 10; at least 4 rows. Throws InputError otherwise, and
    /// where it looks as if both were exchanged: no speed beyond 2 mm/s, but a coefficient.
    TabulatedFriction(const std::vector<double> &speeds, const std::vector<double> &coefficients);

    MonotoneCubic curve;
    double fastest = 0.;    ///< speed of the last row [mm/s]
    bool falls     = false; ///< whether mu falls from one row to a later one by more than 1 % of its largest value
  };

  /// Selects a law of mu over speed.
  SPRAG_ENUMERATION(FrictionChoice, Coulomb, cork_on_aluminium, Stribeck, table)

  using FrictionCurve = std::variant<CoulombFriction, CorkOnAluminium, StribeckFriction, TabulatedFriction>;

  /// The choice of a law and the constants of all, as a parameter file gives them.
  struct FrictionSettings
  {
    FrictionChoice law = FrictionChoice::cork_on_aluminium;
    CoulombFriction coulomb;
    StribeckFriction stribeck;
    std::string table; ///< file of the law that is none of the others

    FrictionCurve curve() const
    {
      return law == FrictionChoice::Coulomb    ? FrictionCurve(coulomb)
             : law == FrictionChoice::Stribeck ? FrictionCurve(stribeck)
                                               : CorkOnAluminium{};
    }
  };

  /// Selects the speed that mu depends on: the material sliding speed, or the speed of the drive (the paper's choice).
  SPRAG_ENUMERATION(FrictionSpeed, sliding, drive)

  /// A law of mu over speed, and how the contact uses it.
  struct FrictionLaw
  {
    FrictionCurve law           = CorkOnAluminium{};
    FrictionSpeed speed         = FrictionSpeed::sliding;
    double regularisation_speed = 0.;   ///< [mm/s]; 0: stick is resolved
    double factor               = 1.;   ///< times mu of the law, >= 0
    double memory_length        = 0.01; ///< of faces sliding on each other, over which a mu that falls follows their speed [mm]
  };

  /// mu and dmu/d|v| at a sliding speed |v| >= 0 [mm/s]. mu(0) is the cone in stick.
  FrictionValue friction_coefficient(const FrictionLaw &law, double speed);

  /// Returns the law with mu the constant that it is at a speed [mm/s].
  FrictionLaw friction_at_speed(FrictionLaw law, double speed);

  /// Returns the law as one step sees it: where mu depends on the drive's speed [mm/s] it is a constant of the step.
  FrictionLaw step_friction(const FrictionLaw &friction, double drive_speed);

  /// mu = (quadratic v + linear) v + constant from a speed on [mm/s].
  struct FrictionPiece
  {
    double from;
    double quadratic, linear, constant;
  };

  /// Returns the pieces of a law that consists of such, falls nowhere, and so lets a load slip at one speed alone; the first one
  /// from 0. Other laws have none.
  std::vector<FrictionPiece> rising_pieces(const FrictionLaw &law);

  /// Returns true if mu falls with speed; in a table by more than 1 % of its largest value.
  bool falls_with_speed(const FrictionLaw &law);
} // namespace sprag
