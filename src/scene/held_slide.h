// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/drive.h"
#include "scene/vibration_settings.h"

#include <array>
#include <optional>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Returns position and velocity of the drive at a scene's single slide: Stability/Position, or the drive's largest x, and
  /// Stability/Direction, or backward, at the drive's peak speed.
  DrivePoint held_drive(const Scene &scene);

  /// Returns whether a verdict looks at all x of the drive, as no Stability/Position is given.
  bool looks_over_stroke(const Scene &scene);

  /// Returns the x that a verdict over the stroke looks at, of Stability/Position; near x = 0 nothing presses.
  ParameterRange stroke_range(const Scene &scene, unsigned int points);

  /// Returns the directions that a verdict looks at.
  std::vector<Direction> held_directions(const Scene &scene);

  /// Returns the scene as it is while the drive keeps its velocity: a friction that depends on the drive's speed is a constant
  /// then. With Stability/Damping = off it has no damping.
  Scene held_scene(const Scene &scene);

  /// Returns the first and last xi of the part of the face that models in three dimensions with inertia look at [mm]: where the
  /// contact of a held slide, else of the whole drive, may come, with what it is looked at beside.
  std::array<double, 2> contact_range(const Scene &scene);

  /// Returns the parameters of Stability/Critical with their ranges; none if it cannot be read. `points` is how many are tried
  /// before a root is searched.
  std::optional<std::vector<ParameterRange>> critical_searches(const Scene &scene);

  /// Returns the parameters of Stability/Ranges with their ends; none if it cannot be read.
  std::optional<std::vector<ParameterRange>> uncertain_ranges(const Scene &scene);
} // namespace sprag
