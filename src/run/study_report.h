#pragma once

#include "analysis/study/study_trade.h"
#include "results/result_file.h"

#include <iosfwd>
#include <vector>

namespace sprag
{
  /// The finished runs of a study, a row each.
  struct StudyTable
  {
    std::vector<Dataset> numbers;   ///< parameters, costs, errors, the numbers of the runs' summaries; NaN where a run has none
    std::vector<TextDataset> texts; ///< parameters, outcome, reason, warnings, the texts of the summaries
  };

  StudyTable study_table(const StudySettings &study, const std::vector<StudyPoint> &points, const StudyRecords &records,
                         const StudyTrade &trade);

  /// Returns the group /trade: the accuracies and for each measure the run that meets them at the least cost; the observed
  /// orders.
  Group trade_group(const StudySettings &study, const std::vector<StudyPoint> &points, const StudyRecords &records,
                    const StudyTrade &trade);

  /// Returns the group /reference: the numbers of the reference's summary.
  Group reference_group(const StudyRecord &reference);

  std::vector<Entry> study_summary(const StudySettings &study, const std::vector<StudyPoint> &points,
                                   const StudyRecords &records);

  /// Prints how the runs ended and what is recommended.
  void print_study(std::ostream &stream, const StudySettings &study, const std::vector<StudyPoint> &points,
                   const StudyRecords &records, const StudyTrade &trade);
} // namespace sprag
