// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/error_estimate.h"
#include "results/result_file.h"
#include "results/warning.h"
#include "scene/analysis_settings.h"

#include <iosfwd>
#include <optional>
#include <vector>

namespace sprag
{
  /// Returns the entries of /accuracy: of each quantity its estimated relative error, NaN where none holds, with the attributes
  /// largest_part and remedy, or why there is none; and of each of its parts one called <quantity>_<part>.
  std::vector<Entry> accuracy_entries(const std::vector<ErrorEstimate> &estimates);

  /// Prints a line a quantity: its error, its parts and what halves the largest.
  void print_accuracy(std::ostream &stream, const std::vector<ErrorEstimate> &estimates);

  /// Warns where the estimated error of a quantity exceeds the target of the scene.
  Warnings target_warnings(const AccuracySettings &accuracy, const std::vector<ErrorEstimate> &estimates);

  /// A line of what a run prints first.
  struct AnswerLine
  {
    std::string label, text;
  };

  /// Returns the group /answer: the lines given, then those of a summary's entries that have one in the tables of the pages, see
  /// SummaryRow, each label once with all its entries behind it. Entries that are unknown (NaN) leave no trace. All else is in
  /// /summary.
  Group answer_lines(AnalysisType type, const std::vector<Entry> &summary, const std::vector<AnswerLine> &first = {});

  /// Prints what a reader wants to know first: those lines, the estimated errors and the cost.
  void print_console_summary(std::ostream &stream, const Group &answer, const std::vector<ErrorEstimate> &errors,
                             double cpu_seconds, double wall_seconds);

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

  /// Completes the entries of the summary of a run of a `type`, of kind "entry", or of its /meta, "fact", that have a row on the
  /// pages: with its unit where they have none, and with its meaning before their own description. Entries of a summary that are
  /// marked by `!`, or that the analysis describes itself, as they are named by the scene, get the attribute `headline`.
  void describe_entries(const std::string &kind, const std::string &type, std::vector<Entry> &entries);
} // namespace sprag
