// SPDX-License-Identifier: GPL-3.0-only
#include "program/cost.h"

#include "base/phase_timer.h"
#include "base/text.h"
#include "program/memory.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace sprag
{
  namespace
  {
    constexpr double formula_start_seconds = 0.03;   ///< [s]
    constexpr double formula_row_seconds   = 4e-6;   ///< [s]
    constexpr double usual_calculation     = 3.3e-3; ///< that slowness() refers to [s]

    /// Sines, roots and divisions that wait for each other.
    double calculated()
    {
      double value = 0.5;
      for (unsigned int i = 0; i < 200000; ++i)
        value = std::sqrt(1. + std::sin(value)) / (1. + value);
      return value;
    }

    double shortest_calculation()
    {
      double shortest = 1.;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const double begin = PhaseTimer::cpu_seconds();
        if (!(calculated() > 0.))
          break;
        shortest = std::min(shortest, PhaseTimer::cpu_seconds() - begin);
      }
      return shortest;
    }
  } // namespace

  double slowness()
  {
    static const double found = shortest_calculation() / usual_calculation;
    return found;
  }

  ExpectedCost formula_cost(const Scene &scene)
  {
    return { slowness() * (formula_start_seconds + formula_row_seconds * expected_rows(scene)), expected_memory(scene), {} };
  }

  void print_cost(std::ostream &stream, const ExpectedCost &cost)
  {
    stream << "Cost:         about ";
    if (cost.unknown.empty())
      stream << formatted("%.2g", cost.cpu_seconds) << " s of CPU time, ";
    stream << formatted("%.2g", cost.bytes / 1e9) << " GB";
    stream << (cost.unknown.empty() ? "" : "; how long is not told: " + cost.unknown) << '\n';
  }
} // namespace sprag
