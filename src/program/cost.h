// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <iosfwd>
#include <string>

namespace sprag
{
  struct Scene;

  /// Expected cost of a run.
  struct ExpectedCost
  {
    double cpu_seconds = 0.; ///< of all processes; NaN where it cannot be told
    double bytes       = 0.; ///< largest resident memory of all processes
    std::string unknown;     ///< why the time cannot be told, a sentence; else empty
  };

  /// Estimates the cost of what follows_formulas().
  ExpectedCost formula_cost(const Scene &scene);

  /// Returns how much longer than on the machine that the constants of estimates were measured on a short calculation takes here,
  /// as found at the first call.
  double slowness();

  /// Prints the estimate in a line.
  void print_cost(std::ostream &stream, const ExpectedCost &cost);
} // namespace sprag
