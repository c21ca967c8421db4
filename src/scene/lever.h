// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "scene/apparatus.h"

#include <optional>

namespace sprag
{
  /// Positions of cylinder, pivot and friction interface (Fig. 1 of the paper). Seen from the x-axis the lever lies beyond the
  /// cylinder.
  struct Geometry
  {
    double cylinder_radius  = 56.;   ///< R [mm], > 0
    double interface_offset = 45.6;  ///< e [mm], 0 <= e < R: pivot to friction interface
    double pivot_distance   = 185.5; ///< l [mm], > R: origin to pivot along x
    double pivot_height     = 0.;    ///< h [mm], pivot above the x-axis
  };

  /// Selects the elastic law of a meshed part.
  enum class MaterialModel
  {
    linear,
    neo_hookean,
    st_venant_kirchhoff ///< of leaf springs
  };

  /// Says whether densities are scaled to the moment of inertia, or taken as built, so that the moment follows from them.
  SPRAG_ENUMERATION(InertiaSource, scaled, as_built)

  /// Holds dimensions, material, inertia and damping of the lever [mm, MPa, t].
  struct Lever
  {
    LeverOutline outline     = LeverOutline::bar;
    double length            = 210.;   ///< from the pivot to the tip [mm], > 0
    double depth             = 20.;    ///< metal only [mm], > 0
    double width             = 40.;    ///< [mm], > 0
    double young_modulus     = 70000.; ///< [MPa], > 0
    double poisson_ratio     = 0.33;
    double density           = 2.7e-9;                ///< [t/mm^3]
    MaterialModel material   = MaterialModel::linear; ///< of lever and friction layer
    double moment_of_inertia = 6.45;                  ///< J about the pivot, arm and tip mass included [t mm^2]
    InertiaSource inertia    = InertiaSource::scaled;
    double hub_inertia       = 0.;             ///< added to the rigid hub, about the pivot [t mm^2], >= 0
    double tip_mass          = 0.;             ///< at the neutral axis [t]
    std::optional<double> neutral_axis_offset; ///< e_a [mm], from the pivot; none: e + layer + depth/2
    double modal_damping     = 0.01;           ///< of critical, on each bending mode of the free lever
    double mass_damping      = 0.;             ///< alpha of Rayleigh damping C = alpha M + beta K [1/s]
    double stiffness_damping = 0.;             ///< beta of it, K without the rotational spring [s]
  };

  /// Describes the friction layer (cork) bonded to the lever along the friction interface.
  struct FrictionLayer
  {
    double thickness     = 1.;  ///< [mm], >= 0; 0: no layer
    double young_modulus = 20.; ///< [MPa], > 0
    double poisson_ratio = 0.;
    double density       = 2e-10;              ///< [t/mm^3], scaled together with the lever's
    PlaneState plane     = PlaneState::strain; ///< plane strain, as it is thin on a wide lever
    std::optional<double> strength; ///< pressure at which its cells give way [MPa]; none: 0.04 times its Young's modulus
  };

  /// Says whether the pivot frame is fixed (rigid) or moves along x on a spring (sprung).
  SPRAG_ENUMERATION(SupportType, rigid, sprung)

  /// Describes the pivot frame between lever and force sensor. A rigid one uses the type alone.
  struct Support
  {
    SupportType type = SupportType::rigid;
    double mass      = 2e-3;  ///< m_f [t], > 0
    double stiffness = 5000.; ///< k_f [N/mm], > 0
    double damping   = 0.02;  ///< ratio to critical damping of frame and lever on k_f
  };
} // namespace sprag
