// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/analysis_settings.h"
#include "scene/apparatus.h"

namespace sprag
{
  struct Device;

  /// Finds the behaviour of a leaf spring by finite elements, over its whole width: finite rotations in the moment, sampled from
  /// `smallest_turn` <= 0 to `largest_turn` >= 0 [rad] of the hub so finely that between samples it is within 1e-8 of the largest
  /// moment of them; inertia and vibrations linear about rest. Throws InputError for a shape that has no mesh, AnalysisError
  /// where the leaf does not follow the turn. `joint_mass`: at its far end [t].
  LeafBehaviour leaf_behaviour(const LeafSpring &leaf, PlaneState plane, double smallest_turn, double largest_turn,
                               double joint_mass = 0.);

  /// Finds the behaviour of a leaf whose far end nothing holds, as where both of a mirrored pair swing together with their joint:
  /// inertia and vibrations, and no moment.
  LeafBehaviour swinging_leaf(LeafSpring leaf, PlaneState plane, double joint_mass);

  /// Returns the device's spring with the stiffness of a leaf spring and its behaviour over the turns of the drive and half of
  /// the largest, at least 0.02 rad, beyond on both sides; of a full pair with a free joint also how the springs swing. A
  /// torsional spring stays as it is.
  RotationalSpring prepared_spring(const Device &device);
} // namespace sprag
