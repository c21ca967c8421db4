// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/inertial_matrices.h"
#include "fe/dynamics/sparse_structure.h"

namespace sprag
{
  struct Device;

  /// The masses of a scene's meshed lever.
  LeverInertia lever_inertia(const Device &device);

  /// Spring, damping and support of a scene's meshed lever. `relaxation`: damping over stiffness of the friction layer [s];
  /// `lever_mass`: what moves with a sprung support [t].
  LeverDynamics make_lever_dynamics(const Device &device, double relaxation, double lever_mass);
} // namespace sprag
