#pragma once

#include "scene/scene.h"

#include <array>

namespace sprag
{
  // Dimensions that follow from those of the scene, in lever axes [mm].

  /// The pivot's axle, which holds a lever frame: of a rigid hub.
  inline constexpr double frame_hub_radius = 5.;

  /// Least metal of the root around it.
  inline constexpr double frame_wall = 5.;

  /// First and last xi that the contact of a rigid lever sweeps in the drive.
  std::array<double, 2> swept_contact(const Scene &scene);

  /// Part of the lever or plate that carries the friction layer, first and last xi.
  std::array<double, 2> friction_face(const Scene &scene);
} // namespace sprag
