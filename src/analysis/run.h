#pragma once

#include "scene/scene.h"

#include <string>

namespace sprag
{
  struct RunOptions
  {
    std::string folder; ///< for results; made if it does not exist
    bool quiet = false;
  };

  /// What read_scene() cannot tell: whether the scene's mesh can serve. Throws InputError if not.
  void validate(const Scene &scene);

  /// Carries out the scene's analysis with its model and writes results into the folder. Throws InputError, before anything is
  /// written, for meshes and folders that cannot serve; AnalysisError when the analysis fails or deviates from the closed form by
  /// more than the scene admits, after every finished step was written.
  void run(const Scene &scene, const RunOptions &options);
} // namespace sprag
