// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/transient/transient_settings.h"

#include "levers/dynamics.h"
#include "scene/contact_reference.h"
#include "scene/scene.h"

namespace sprag
{
  std::vector<Row> beam_run(Scene scene)
  {
    if (is_meshed(scene.analysis.model))
      scene.analysis.model = ModelType::beam;
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(scene);
    std::vector<Row> rows;
    run_transient(dynamics.model(), scene.drive, transient_settings(scene),
                  [&](const Motion &, const Row &row) { rows.push_back(row); });
    return rows;
  }

  TransientSettings transient_settings(const Scene &scene, const std::vector<GrowingMode> &growing)
  {
    const auto reference = contact_reference(scene);
    return { scene.time, reference.P, reference.stiffness, scene.geometry.cylinder_radius / 200.,
             longest_step(growing, scene.time.spectral_radius) };
  }
} // namespace sprag
