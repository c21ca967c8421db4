// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/step/dynamic_model.h"
#include "scene/lever_inertia.h"

#include <memory>

namespace sprag
{
  struct Device;

  /// The scene's lever as rigid body or beam of that many elements, with a point contact: Analysis/Model = rigid or beam.
  std::unique_ptr<DynamicModel> make_reduced_lever(const Device &device, unsigned int elements = beam_elements);
} // namespace sprag
