// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/algebra/mumps.h"
#include "fe/body/connectors.h"

namespace sprag
{
  struct Device;

  /// Finds the connectors of the scene's friction plate; none without one. First come the sensors, of each place along the
  /// lever that on the left (zeta < 0) and that on the right, half as stiff as the place each; of a half, which is the same on
  /// both sides of the middle and has zeta >= 0, the right one alone, which stands for both. Then comes the guide, over the
  /// whole width: a spring along the lever, and of a whole also one across it, as stiff, and one against turning about eta, as
  /// of springs along the lever spread over the width [N mm]. Throws InputError as FacingPads.
  std::vector<Connector> find_connectors(const ElasticBody<3> &body, const Device &device, bool is_half);

  /// Adds the stiffness of a connector to that of its body.
  void add(const Connector &connector, MatrixEntries &stiffness);
} // namespace sprag
