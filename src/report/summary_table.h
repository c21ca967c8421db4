// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/result_file.h"
#include "scene/analysis_settings.h"

#include <optional>

namespace sprag
{
  /// A row of the tables of /summary on the pages of postprocess/, see page_row(), for one entry.
  struct SummaryRow
  {
    std::string unit;
    int number = 0;                 ///< that the name of the entry has in place of `*`; 0 without one
    std::string label;              ///< of the line on which the entry is printed; empty: with --verbose alone
    std::string text;               ///< behind the label, `#` for the number
    bool is_main           = false; ///< marked by `!`: printed for the runs of a study, the first numbers of a report
    bool is_hidden_if_idle = false; ///< marked by `?`: not printed where it is 0 or what the entry before it is
  };

  /// Finds the row of an entry among those of an analysis.
  std::optional<SummaryRow> summary_row(AnalysisType type, const std::string &entry);

  /// Completes the entries of the summary of a run, or of its /meta, that have a row on the pages: with its unit where they have
  /// none, and with its meaning before their own description. Entries of a summary that are marked by `!`, or that the analysis
  /// describes itself, as they are named by the scene, get the attribute `headline`.
  void describe_summary(AnalysisType type, std::vector<Entry> &entries);
  void describe_facts(std::vector<Entry> &entries);
} // namespace sprag
