// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/result_file.h"
#include "scene/analysis_settings.h"

#include <string>
#include <vector>

namespace sprag
{
  /// Position of a run and the forces there.
  struct StrokePoint
  {
    double x         = 0.; ///< [mm]
    double direction = 0.; ///< of the motion: its sign counts
    double P         = 0.; ///< [N]
    double Q         = 0.; ///< of all levers [N]
  };

  /// The points of a run in the order of time. Where the direction changes a stroke ends; the point of a turn belongs to the
  /// stroke that ends there.
  using StrokeCurve = std::vector<StrokePoint>;

  /// Travel behind a reversal that is left out, over the largest |x| of the reference: friction turns there.
  constexpr double left_out_behind_reversal = 1. / 130.;

  /// Holds the largest relative differences of a curve from the reference [-].
  struct StrokeErrors
  {
    double P; ///< largest difference on any stroke, over the largest |P| of the reference on it
    double Q; ///< the same of Q
  };

  /// Compares each point of the curve with the reference on the same stroke, of which there must be as many, linearly between
  /// its points. Points beyond the ends of the reference's stroke or closer than left_out_behind_reversal behind a turn are left
  /// out. NaN where nothing is left or the strokes are not those of the reference.
  StrokeErrors stroke_errors(const StrokeCurve &curve, const StrokeCurve &reference);

  /// A quantity by which the runs of a study are compared with its reference.
  struct Measure
  {
    std::string name; ///< "P"
    std::string meaning;
  };

  /// Results of a run that comparisons use.
  struct Comparable
  {
    std::vector<Entry> summary;
    StrokeCurve curve; ///< without inertia; else empty
  };

  /// Lists the quantities of this analysis by which runs are compared and that the reference has.
  std::vector<Measure> make_measures(AnalysisType type, const Comparable &reference);

  /// Returns the errors of a run in the order of make_measures(), relative, NaN where the run does not know the quantity.
  std::vector<double> compute_errors(AnalysisType type, const Comparable &run, const Comparable &reference);
} // namespace sprag
