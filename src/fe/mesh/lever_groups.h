// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/mesh/geometry_script.h"

namespace sprag
{
  struct Device;

  /// The physical groups of a lever's mesh, in a plane (dimension 2) surfaces and curves, in three dimensions volumes and
  /// surfaces. The scene must outlive them.
  MeshGroups lever_groups(const Device &device, int dimension);
} // namespace sprag
