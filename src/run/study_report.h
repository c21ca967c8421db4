// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/study/study_trade.h"
#include "results/result_file.h"

#include <string>
#include <vector>

namespace sprag
{
  /// Returns the finished runs of a study without its reference.
  std::vector<const StudyRecord *> finished_rows(const std::vector<StudyPoint> &points, const StudyRecords &records);

  /// Returns the number of those with this outcome.
  std::size_t count_of(const std::vector<const StudyRecord *> &rows, RunOutcome outcome);

  /// Returns an entry of a run's summary, null where it has none of this name.
  const Entry *find_entry(const StudyRecord &record, const std::string &name);

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
} // namespace sprag
