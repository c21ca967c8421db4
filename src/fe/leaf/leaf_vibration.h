#pragma once

#include "fe/leaf/leaf_body.h"

namespace sprag
{
  /// Fills in mass, inertia, momentum and the lowest vibrations with the hub held, linear about rest, all with the consistent
  /// mass matrix of a density [t/mm^3] and a mass [t] on the section at the joint.
  void add_inertia(LeafBody &leaf, double density, double joint_mass, LeafBehaviour &behaviour);
} // namespace sprag
