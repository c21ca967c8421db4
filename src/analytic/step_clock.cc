// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/step_clock.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  StepClock::StepClock(const Drive &drive, const double step, const unsigned int doublings)
      : ends(drive.kinks())
      , largest(std::ldexp(step, static_cast<int>(doublings)))
      , nominal_step(step)
  {
    ends.push_back(drive.duration());
    begin_segment();
  }

  void StepClock::begin_segment()
  {
    passed = 0;
    count  = std::max(1ul, static_cast<unsigned long>(std::ceil((ends[segment] - begin) / nominal_step - 1e-6)));
    // A count with many factors of 2 lets the step grow later; it shortens the step by an eighth at most.
    for (double step = nominal_step; step < 0.99 * largest && count >= 8; step *= 2.)
      if (const unsigned long unit = 2ul * static_cast<unsigned long>(std::lround(step / nominal_step)); count >= 8 * unit)
        count = (count + unit - 1) / unit * unit;
  }

  bool StepClock::grow()
  {
    if (nominal_step >= 0.99 * largest || count % 2 != 0 || passed % 2 != 0 || count - passed < 2)
      return false;
    count /= 2;
    passed /= 2;
    nominal_step *= 2.;
    return true;
  }

  void StepClock::advance()
  {
    if (++passed < count)
      return;
    begin = ends[segment++];
    if (!finished())
      begin_segment();
  }

  SPRAG_SERIALISE(StepClock, ends, largest, nominal_step, segment, begin, count, passed)
} // namespace sprag
