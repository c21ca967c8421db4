// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/study/study_trade.h"

#include <iosfwd>
#include <vector>

namespace sprag
{
  /// Prints how the runs of a study ended and, where there is a reference, the cheapest settings that meet accuracies: with
  /// `in_full` for each quantity, else for all at once and for each at one accuracy. Without a reference it prints between which
  /// values the results lie.
  void print_study(std::ostream &stream, const StudySettings &study, const std::vector<StudyPoint> &points,
                   const StudyRecords &records, const StudyTrade &trade, bool in_full);
} // namespace sprag
