#include "run/beam_run.h"

#include "analysis/transient/transient.h"
#include "levers/dynamics.h"
#include "scene/contact_reference.h"

namespace sprag
{
  std::vector<Row> beam_run(Scene scene)
  {
    if (is_meshed(scene.analysis.model))
      scene.analysis.model = ModelType::beam;
    DynamicsMaker maker(false);
    const auto dynamics  = maker.make(scene);
    const auto reference = contact_reference(scene);
    std::vector<Row> rows;
    run_transient(dynamics.model(), scene.drive,
                  { scene.time, reference.P, reference.stiffness, scene.geometry.cylinder_radius / 200. },
                  [&](const Motion &, const Row &row) { rows.push_back(row); });
    return rows;
  }
} // namespace sprag
