#pragma once

#include "results/columns.h"

namespace sprag
{
  /// Fills the row of one lever, or of the two of a pair, without inertia: `observe(lever, row)` fills that of each.
  template <class Observe>
  void observe_levers(const unsigned int levers, const Observe &observe, Row &row)
  {
    observe(0u, row);
    if (levers == 1)
      return;
    Row second;
    second[Column::friction_work] = 0.;
    second[Column::drive_work]    = 0.;
    observe(1u, second);
    row.add_second_lever(second);
  }
} // namespace sprag
