// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <array>

namespace sprag
{
  struct Device;

  // Dimensions that follow from those of the scene, in lever axes [mm].

  /// Radius of the pivot's axle, the rigid hub that holds a lever frame.
  inline constexpr double frame_hub_radius = 5.;

  /// Least thickness of the metal that the root has around it.
  inline constexpr double frame_wall = 5.;

  /// Returns the first and last xi that the contact of a rigid lever sweeps in the drive.
  std::array<double, 2> swept_contact(const Device &device);

  /// Returns the first and last xi of the part of lever or plate that carries the friction layer.
  std::array<double, 2> friction_face(const Device &device);
} // namespace sprag
