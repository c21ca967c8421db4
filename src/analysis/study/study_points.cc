// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/study/study_points.h"

#include "base/ranges.h"
#include "input/read.h"
#include "scene/scene.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    /// The next point of a grid; false after the last one.
    bool advance(const StudySettings &study, StudyPoint &point)
    {
      for (std::size_t i = point.size(); i-- > 0; point[i] = 0)
        if (++point[i] < study.varied[i].values.size())
          return true;
      return false;
    }

    /// Scene of a run: the study's scene read with these overrides, without fields.
    Scene make_run_scene(const Scene &study, const std::vector<std::string> &settings)
    {
      auto overrides = joined({ "Analysis/Type=" + study.parameters->at("Study/Type") }, settings);
      overrides.push_back("Output/Fields=none");
      return variant(study, overrides);
    }
  } // namespace

  std::vector<StudyPoint> make_study_points(const StudySettings &study)
  {
    std::vector<StudyPoint> points;
    if (study.combine == Combination::list)
      for (std::size_t i = 0; i < study.varied.front().values.size(); ++i)
        points.emplace_back(study.varied.size(), i);
    else
    {
      StudyPoint point(study.varied.size(), 0);
      do
        points.push_back(point);
      while (advance(study, point));
    }
    return points;
  }

  Scene scene_at(const Scene &study, const StudyPoint &point)
  {
    const auto &varied = study.study.varied;
    std::vector<std::string> settings;
    for (std::size_t i = 0; i < point.size(); ++i)
      settings.push_back(varied[i].name + "=" + varied[i].values[point[i]]);
    return make_run_scene(study, settings);
  }

  Scene reference_scene(const Scene &study)
  {
    const auto setting = [](const VariedParameter &one) { return one.name + "=" + one.values.front(); };
    return make_run_scene(study, mapped(study.study.reference_values, setting));
  }
} // namespace sprag
