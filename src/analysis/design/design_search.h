// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/design/design_problem.h"

#include <string>
#include <vector>

namespace sprag
{
  /// A demand without which the others can be met.
  struct StoppingDemand
  {
    std::size_t demand;
    double attainable; ///< the value of its quantity that is closest to it where all others are met
    Proposal lever;    ///< that has it
  };

  /// Result of a search within the bounds.
  struct Found
  {
    Proposal lever;          ///< the best, or the one that misses the demands least
    bool meets_all  = false; ///< of the demands that the search knew
    double distance = 0.;    ///< largest violation, of one that misses any
  };

  /// Finds the lever that meets all demands and is best by the first aim. `near`: a lever in whose neighbourhood it is looked for
  /// first, and where one is found nowhere else; none: everywhere.
  Found best_lever(const DesignProblem &problem, const std::optional<Proposal> &near = {});

  /// Leaves out each demand in turn and returns those without which there is a lever; none where two or more exclude one
  /// another in pairs, or the rules that every lever keeps exclude all.
  std::vector<StoppingDemand> stopping_demands(const DesignProblem &problem);

  /// Finds levers between the best by either of two aims, equally apart in what the second aim has: each the best by the first
  /// aim among those at least as good by the second one. Levers that another beats in both are left out.
  std::vector<Proposal> pareto_front(const DesignProblem &problem);
} // namespace sprag
