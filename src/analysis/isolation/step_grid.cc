// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/isolation/step_grid.h"

#include <cmath>

namespace sprag
{
  namespace
  {
    double rounded(const double duration)
    {
      int exponent          = 0;
      const double mantissa = std::frexp(duration, &exponent);
      return std::ldexp(std::round(std::ldexp(mantissa, 28)), exponent - 28);
    }
  } // namespace

  unsigned long StepGrid::next_parts(const unsigned long present) const
  {
    if (present == 1 || by_halves)
      return 2 * present;
    const bool is_power_of_two = (present & (present - 1)) == 0;
    return is_power_of_two ? present / 2 * 3 : present / 3 * 4;
  }

  void StepGrid::begin(const double from, const double to, const double longest)
  {
    origin = from;
    end    = to;
    units  = static_cast<unsigned long>(std::fmax(1., std::ceil((to - from) / longest - 1e-6)));
    unit = passed = 0;
    parts         = 1;
  }

  void StepGrid::choose(const double target)
  {
    const double least   = length() / target * (1. - 1e-6);
    unsigned long chosen = 1;
    while (static_cast<double>(chosen) < least || passed * chosen % parts != 0)
      chosen = next_parts(chosen);
    passed = passed * chosen / parts;
    parts  = chosen;
  }

  void StepGrid::shorten()
  {
    choose(0.7 * length() / static_cast<double>(parts));
  }

  double StepGrid::duration() const
  {
    return rounded(length() / static_cast<double>(parts));
  }

  double StepGrid::step_end() const
  {
    if (passed + 1 == parts && unit + 1 == units)
      return end;
    return origin + length() * (static_cast<double>(unit) + static_cast<double>(passed + 1) / static_cast<double>(parts));
  }

  void StepGrid::advance()
  {
    if (++passed < parts)
      return;
    passed = 0;
    ++unit;
  }
} // namespace sprag
