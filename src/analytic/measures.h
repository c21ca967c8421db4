// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/stroke_errors.h"
#include "results/result_file.h"
#include "scene/analysis_settings.h"

#include <string>
#include <vector>

namespace sprag
{
  /// A quantity by which the runs of a study are compared with its reference.
  struct Measure
  {
    std::string name; ///< "P"
    std::string meaning;
  };

  /// What a run leaves for a comparison.
  struct Comparable
  {
    std::vector<Entry> summary;
    StrokeCurve curve; ///< without inertia; else empty
  };

  /// Lists the quantities that runs of this analysis are compared by, as far as the reference knows them.
  std::vector<Measure> measures_of(AnalysisType type, const Comparable &reference);

  /// Returns the errors of a run in the order of measures_of(), relative, NaN where the run does not know the quantity.
  std::vector<double> errors_of(AnalysisType type, const Comparable &run, const Comparable &reference);
} // namespace sprag
