// SPDX-License-Identifier: GPL-3.0-only
#include "scene/analysis_texts.h"

#include "scene/design_text.h"
#include "scene/identification_text.h"
#include "scene/scene.h"

namespace sprag
{
  void read_analysis_texts(Scene &scene, const std::vector<Parameter> &declared, const ReportMistake &report)
  {
    // A design may ask for what an isolated table does.
    const auto type = scene.analysis.type;
    if (type == AnalysisType::isolation || type == AnalysisType::design)
      read_isolation_tables(scene.isolation, scene.unused_columns, report);
    if (type == AnalysisType::design)
      read_design(scene.design, declared, report);
    if (type == AnalysisType::identification)
      read_identification(scene.identification, scene.unused_columns, report);
  }
} // namespace sprag
