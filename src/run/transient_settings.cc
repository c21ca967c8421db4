// SPDX-License-Identifier: GPL-3.0-only
#include "run/transient_settings.h"

#include "scene/contact_reference.h"
#include "scene/scene.h"

namespace sprag
{
  TransientSettings transient_settings(const Scene &scene, const std::vector<GrowingMode> &growing)
  {
    const auto reference = contact_reference(scene);
    return { scene.time, reference.P, reference.stiffness, scene.geometry.cylinder_radius / 200.,
             longest_step(growing, scene.time.spectral_radius) };
  }
} // namespace sprag
