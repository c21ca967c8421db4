// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/study/study_points.h"
#include "analytic/measures.h"
#include "base/archive.h"
#include "base/choices.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// Classifies the end of a study's run: completed, a failed analysis, or a scene that is refused.
  SPRAG_ENUMERATION(RunOutcome, completed, failed, refused)

  /// Result of a run that a study keeps.
  struct StudyRecord
  {
    std::size_t run    = 0; ///< index among the points of the study; their number for the reference
    RunOutcome outcome = RunOutcome::completed;
    std::string reason;                ///< of a run that is not completed
    double cpu_time    = 0.;           ///< that the run would take alone, meshes that it shares with others included [s]
    double cpu_spent   = 0.;           ///< that it took [s]
    double work        = 0.;           ///< a count that is equal in every repetition; NaN where there is none
    double wall_time   = 0.;           ///< [s]
    double peak_memory = 0.;           ///< of its process while it ran [MiB]
    std::vector<std::string> warnings; ///< their names
    Comparable found;                  ///< of a completed run
  };

  void serialise(Archive &archive, StudyRecord &record);

  /// Finished runs by their index.
  using StudyRecords = std::map<std::size_t, StudyRecord>;

  /// Accuracies for which settings are recommended, relative.
  constexpr std::array<double, 4> recommended_accuracies = { { 0.1, 1e-2, 1e-3, 1e-4 } };

  /// Errors of a study's runs by one measure.
  struct MeasuredErrors
  {
    Measure measure;
    std::vector<double> errors; ///< of the finished runs, in their order
    std::vector<bool> front;    ///< see pareto_front()

    /// Row of the cheapest run that meets each accuracy, as all runs do that differ from it by smaller sizes alone.
    std::array<std::optional<std::size_t>, recommended_accuracies.size()> recommended;
  };

  /// The order with which an error falls with a parameter that is a size.
  struct ObservedOrder
  {
    std::string measure;
    std::string parameter;
    std::string others; ///< values of the other parameters, "Mesh/Degree = 2"; empty where there are none
    double order;
  };

  /// Errors, recommended settings and observed orders of a study's runs.
  struct StudyTrade
  {
    std::vector<MeasuredErrors> measured; ///< each measure, and as the last one their largest, "all", where there are several
    std::vector<ObservedOrder> orders;
  };

  /// Compares the finished runs with the reference; nothing where there is none or it is not completed.
  StudyTrade compute_trade(const StudySettings &study, const std::vector<StudyPoint> &points, const StudyRecords &records);

  /// Returns "Mesh/Face size = 1, Mesh/Degree = 2".
  std::string settings_text(const StudySettings &study, const StudyPoint &point);

  // Trade between cost and error of runs; NaN is an unknown cost or error.

  /// Returns for each run whether nobody is better: no other costs at most as much and is at most as far off, one of them less. A
  /// run without cost or error is none of these.
  std::vector<bool> pareto_front(const std::vector<double> &costs, const std::vector<double> &errors);

  /// Returns the index of the cheapest run with an error of at most `accuracy`, the first of those that cost the same.
  std::optional<std::size_t> cheapest_within(double accuracy, const std::vector<double> &costs,
                                             const std::vector<double> &errors);

  /// Returns the order p of error = C size^p, a fit of least squares to the logarithms of all pairs > 0; NaN where they have
  /// fewer than three sizes.
  double observed_order(const std::vector<double> &sizes, const std::vector<double> &errors);
} // namespace sprag
