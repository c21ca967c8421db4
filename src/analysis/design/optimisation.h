// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <functional>
#include <vector>

namespace sprag
{
  /// A function to be minimised over the unit cube under constraints, all of which an evaluation finds together.
  struct BoxProblem
  {
    struct Evaluation
    {
      double objective = 0.;
      std::vector<double> constraints; ///< each <= 0 where it is kept
    };

    std::size_t dimension     = 0;
    std::size_t n_constraints = 0; ///< >= 1
    std::function<Evaluation(const std::vector<double> &)> evaluate;
  };

  struct SearchSettings
  {
    unsigned int evaluations = 4000; ///< of the global search
    unsigned int starts      = 24;   ///< of local searches besides it
    unsigned int local       = 400;  ///< evaluations of a local search
    unsigned int seed        = 1;
    std::vector<double> near = {}; ///< a place whose neighbourhood is enough where constraints can be kept there; empty: none
  };

  struct Optimum
  {
    std::vector<double> place; ///< in the unit cube
    double objective = 0.;
    double violation = 0.; ///< the largest of the constraints there
  };

  /// Finds the place at which the largest constraint is smallest: by evolution (ISRES) over the cube, then from there and from
  /// other starts by linear approximations (COBYLA). It stops where all constraints are kept.
  Optimum least_violation(const BoxProblem &problem, const SearchSettings &settings);

  /// Finds the smallest objective where all constraints are kept, likewise; of a start that keeps none the nearest place that
  /// does is the beginning. Where there is no such place it is that of least_violation().
  Optimum best_in_box(const BoxProblem &problem, const SearchSettings &settings);
} // namespace sprag
