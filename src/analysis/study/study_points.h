// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/study_settings.h"

#include <vector>

namespace sprag
{
  struct Scene;

  /// The values of one run: for each of the study's varied parameters the index of its value.
  using StudyPoint = std::vector<std::size_t>;

  /// Lists the runs of a study; of a grid those of the last parameter follow each other.
  std::vector<StudyPoint> make_study_points(const StudySettings &study);

  /// Returns the scene of a run. Throws InputError where it is refused.
  Scene scene_at(const Scene &study, const StudyPoint &point);

  /// Returns the scene of the run that the others are compared with. Throws InputError where it is refused.
  Scene reference_scene(const Scene &study);
} // namespace sprag
