// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/design/design_search.h"
#include "results/result_file.h"
#include "run/design_judges.h"

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// All that a design finds, as far as it came.
  struct DesignFindings
  {
    std::optional<Found> found; ///< by the closed form; of the last round with its corrections
    std::vector<StoppingDemand> stopping;
    bool each_left_out = false;  ///< whether `stopping` is known
    std::vector<Proposal> front; ///< of two aims
    std::vector<Judgement> judgements;
    std::string unmet;            ///< why there is no lever, sentences; empty: there is one
    std::size_t evaluations = 0;  ///< of the closed form
    double search_seconds   = 0.; ///< CPU time of all searches
  };

  std::vector<ColumnInfo> design_columns(const DesignSettings &design);

  /// Returns the values of the columns for a lever.
  std::vector<double> design_row(const DesignSettings &design, const Proposal &lever);

  std::vector<Entry> design_summary(const DesignSettings &design, const DesignFindings &findings);

  /// Returns the groups /judgements, a row for each lever proposed to a judge, and /demands.
  std::vector<Group> design_groups(const DesignSettings &design, const DesignFindings &findings);

  /// Tells why a search within the bounds met not all demands: what stops it and what is nearest.
  std::string unmet_text(const DesignSettings &design, const DesignFindings &findings);

  /// Tells in a sentence how far a lever that a judge saw misses what is demanded.
  std::string missed_text(const DesignSettings &design, const Judgement &judgement);

  void print_design(std::ostream &stream, const DesignSettings &design, const DesignFindings &findings);
} // namespace sprag
