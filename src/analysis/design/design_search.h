// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/design/design_problem.h"

#include <string>
#include <vector>

namespace sprag
{
  /// A demand without which all others can be met.
  struct StoppingDemand
  {
    std::size_t demand; ///< its index
    double attainable;  ///< value of its quantity closest to the target if all other demands are met
    Proposal lever;     ///< with this value
  };

  /// Result of a search within the bounds.
  struct Found
  {
    Proposal lever;          ///< the best, or the one with the smallest violation
    bool meets_all  = false; ///< all demands of the search are met
    double distance = 0.;    ///< largest violation, 0 if all are met
  };

  /// Finds the best lever by the first aim among those that meet all demands. With `near` the search starts at that lever, and
  /// searches the whole cube only if no lever there meets the demands.
  Found best_lever(const DesignProblem &problem, const std::optional<Proposal> &near = {});

  /// Returns each demand without which a lever meets all others. The result is empty if leaving out one demand is not enough,
  /// or if no lever satisfies the rules.
  std::vector<StoppingDemand> stopping_demands(const DesignProblem &problem);

  /// Returns Pareto-optimal levers of two aims (epsilon-constraint method): each optimises the first aim with a bound on the
  /// second. The bounds are equally spaced between the second aim's values of the two single optima.
  std::vector<Proposal> pareto_front(const DesignProblem &problem);
} // namespace sprag
