// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/unknown.h"

#include <deal.II/lac/vector.h>

#include <array>
#include <complex>
#include <vector>

namespace sprag
{
  /// Friction where a slide is held.
  enum class ContactFriction
  {
    sliding,
    none,
    stuck ///< no slip beyond the contact's tangential stiffness, about a state without friction
  };

  /// Real and imaginary part of a complex vector.
  using ComplexVector = std::array<dealii::Vector<double>, 2>;

  /// A structure's answer to exp(lambda t), before it is known what feeds it.
  struct StructureMode
  {
    std::complex<double> eigenvalue; ///< lambda [1/s], imaginary part >= 0
    double residual = 0.;            ///< backward error of (lambda^2 M + lambda C + K) phi = 0
    ComplexVector coordinates;       ///< phi, in the structure's coordinates
    ComplexVector face_force;        ///< elastic forces in the static face shapes; empty without such shapes
  };

  /// Parts of the growth rate [1/s]: each mechanism's mean power over twice the mode's energy. They add up to Re lambda.
  struct GrowthShares
  {
    double friction_rotation = 0.; ///< friction's forces as they follow displacements, working on the hub's rotation
    double friction_bending  = 0.; ///< on the deflection of the lever in its own axes, and on that of the cylinder's shaft
    double friction_support  = 0.; ///< on the displacement of the support
    double friction_speed    = 0.; ///< mu'(v), and friction of contact damping's pressure
    double contact_damping   = 0.;
    double structure_damping = 0.; ///< of lever, layer and support
  };

  /// Parts of a mode's potential energy; they add up to 1.
  struct EnergyShares
  {
    double rotation = 0.; ///< in the rotational spring
    double bending  = 0.; ///< in lever, layer and the cylinder's shaft
    double support  = 0.;
    double contact  = 0.; ///< in the contact's springs, with the change of their direction
  };

  /// A vibration about a held slide.
  struct Eigenmode
  {
    StructureMode mode;          ///< of modal mass phi^H M phi = 1 t
    ComplexVector displacements; ///< displacements, in lever axes; the rotation's real and positive where there is one
    GrowthShares growth;
    EnergyShares energy;

    /// In a pair 1 of a symmetric mode, -1 of an antisymmetric one, where both levers swing the same way.
    double symmetry = unknown;

    /// In three dimensions the shares of the kinetic energy that lie in motion as in a plane, in twisting and in motion along the
    /// cylinder's axis; NaN else.
    struct AcrossShares
    {
      double plane    = unknown;
      double twisting = unknown;
      double sideways = unknown;
    };
    AcrossShares across{};
  };

  /// Points along the lever and how a mode moves them in lever axes [mm per unit of the mode].
  struct ModeShape
  {
    /// Displacements of one lever, real and imaginary part.
    struct LeverShape
    {
      std::array<std::vector<double>, 2> along;
      std::array<std::vector<double>, 2> across;     ///< away from the cylinder, without the rotation of the axes
      std::array<std::vector<double>, 2> sideways{}; ///< along the cylinder's axis, in three dimensions alone
      std::complex<double> rotation{};               ///< [rad]
    };

    std::vector<double> xi;         ///< undeformed [mm]
    std::vector<LeverShape> levers; ///< one, or both of a mirrored pair, each in its own axes
    std::complex<double> support;   ///< [mm]
  };
} // namespace sprag
