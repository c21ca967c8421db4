// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/apparatus.h"

#include <array>
#include <string>
#include <vector>

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

  /// Returns the least Lever/Length: as far as a rigid lever touches the cylinder in the drive, and for the contact's width 2 mm
  /// or, with a radius below 56 mm, R/28 more.
  double least_length(const Device &device);

  /// Returns swept_contact() with a margin of a tenth of the cylinder's radius on both sides for the contact's width.
  std::array<double, 2> contact_surroundings(const Device &device);

  /// Returns the first and last xi of the part of lever or plate that carries the friction layer.
  std::array<double, 2> friction_face(const Device &device);

  /// Returns the distance of the middles of the force sensors in three dimensions from the middle of the width [mm]: where the
  /// scene has them, else flush with the sides of the plate.
  double sensors_across(const Device &device);

  /// Returns whether lever, cylinder and motion are the same on both sides of the middle of the width, so that one half is
  /// enough: the axis of a cylinder on an elastic shaft then does not turn. Vibration modes need not be symmetric.
  bool is_symmetric_across(const Device &device);

  /// Returns the planes between the elements across the width of three dimensions, from its middle, growing from both edges to
  /// the middle [mm]; where it is symmetric those of one half.
  std::vector<double> planes_across(const Device &device);

  /// Returns the rule, beginning with "must", that a Cylinder/Length breaks which covers less than two of the elements between
  /// planes across [mm], or an empty text.
  std::string cylinder_too_short(const Device &device, const std::vector<double> &planes);

  /// Returns the planes stretched so that they hold both sides of a web in the middle: those nearest to them move there, or
  /// further ones are added. `web`: its width, at most that of the planes [mm].
  std::vector<double> with_web_sides(double web, std::vector<double> planes);
} // namespace sprag
