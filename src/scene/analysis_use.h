#pragma once

#include "scene/scene.h"

namespace sprag
{
  /// Whether an analysis looks at the slide held at one x.
  bool holds_slide(AnalysisType type);

  /// Whether an analysis takes a model of Analysis/Model, of one lever or a pair, along the drive or held at one x of it.
  bool runs_model(AnalysisType type);

  /// Whether anything of the scene is meshed, apart from a leaf spring.
  bool needs_mesh(const Scene &scene);
} // namespace sprag
