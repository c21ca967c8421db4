// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "model/structure/beam.h"
#include "scene/device.h"

#include <cmath>
#include <vector>

namespace sprag
{
  /// Returns the circular frequencies of the free lever on a rigid support, increasing [rad/s].
  inline std::vector<double> free_frequencies(Device device, const BeamMesh &mesh)
  {
    device.support.type = SupportType::rigid;
    return mapped(beam_modes(device, mesh).stiffness, [](const double stiffness) { return std::sqrt(stiffness); });
  }
} // namespace sprag
