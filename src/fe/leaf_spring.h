#pragma once

#include "scene/scene.h"

namespace sprag
{
  /// A leaf spring by finite elements, per leaf over its whole width: finite rotations in the moment, sampled from
  /// `smallest_turn` <= 0 to `largest_turn` >= 0 [rad] of the hub so finely that between samples it is within 1e-8 of the
  /// largest moment of them; inertia and vibrations linear about rest. Throws InputError for a shape that has no mesh,
  /// AnalysisError where the leaf does not follow the turn.
  LeafBehaviour leaf_behaviour(const LeafSpring &leaf, PlaneState plane, double smallest_turn, double largest_turn);

  /// With a leaf spring its behaviour, over the turns of the drive and half of the largest, at least 0.02 rad, beyond on both
  /// sides, and its stiffness filled in. With a torsional spring the scene as it is.
  Scene with_leaf_spring(Scene scene);
} // namespace sprag
