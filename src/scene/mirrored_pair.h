#pragma once

#include "scene/check.h"

namespace sprag
{
  /// 2 of a full pair.
  unsigned int number_of_levers(const Scene &scene);

  /// The scene that a lever of a full pair stands in, in axes mirrored for the second (lever = 1): an offset of the cylinder is
  /// an offset of the pivot the other way, and friction its own. That of a single lever is the scene itself.
  Scene scene_of_lever(const Scene &scene, unsigned int lever);

  // What differs in it.
  Geometry geometry_of_lever(const Scene &scene, unsigned int lever);
  FrictionLaw friction_of_lever(const Scene &scene, unsigned int lever);

  /// Inclination of a lever without moment, that of ideal contact at x = 0 with the cylinder in the mirror plane [rad].
  double rest_inclination(const Scene &scene);

  /// Whether the levers of a full pair swing together without a moment of their springs.
  bool swings(const Scene &scene);

  /// Whether that is another motion of springs and joint, with inertia of its own, than the one in which the levers mirror each
  /// other.
  bool swings_otherwise(const Scene &scene);

  /// The scene of a lever while both swing together: with the inertia of leaf springs and joint in that motion, and the stiffness
  /// of the spring as it is, which the joint takes back.
  Scene swinging_scene(const Scene &scene);

  /// Rules of a full pair.
  void check_pair(const Scene &scene, Rules &rules);
} // namespace sprag
