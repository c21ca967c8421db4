// SPDX-License-Identifier: GPL-3.0-only
#include "levers/prepared_scene.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "fe/leaf/leaf_spring.h"
#include "fe/mesh/solid_file.h"
#include "input/check.h"
#include "scene/analysis_use.h"
#include "scene/scene.h"

namespace sprag
{
  Scene prepared(const Scene &scene)
  {
    // Each run of a study is prepared by itself.
    if (scene.spring.type == SpringType::torsional || scene.analysis.type == AnalysisType::study)
      return scene;
    Scene result        = scene;
    result.spring       = prepared_spring(scene);
    const auto mistakes = mapped(violations(result), [&](const auto &broken)
                                 { return scene.name + ".prm: " + broken.parameter + " " + broken.rule; });
    if (!mistakes.empty())
      throw InputError(mistakes);
    return result;
  }

  Scene with_own_face_size(Scene scene)
  {
    if (needs_mesh(scene) && !scene.mesh.file.empty())
      scene.mesh.face_size = own_face_size(scene);
    return scene;
  }
} // namespace sprag
