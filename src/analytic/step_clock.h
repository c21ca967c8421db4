// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "scene/drive.h"

#include <vector>

namespace sprag
{
  /// Limits the doublings of Time/Step by adaptive steps.
  constexpr unsigned int largest_doublings = 4;

  /// Divides the time between the kinks of a drive into equal steps, which can be halved and doubled: few different durations, so
  /// that what a model prepares for one serves again, and every kink is hit.
  class StepClock
  {
  public:
    /// Begins with steps of at most `step` [s], which may be doubled `doublings` times. If at all, the steps of a segment
    /// are up to an eighth shorter than requested, so that they can be.
    StepClock(const Drive &drive, double step, unsigned int doublings);

    /// Returns the duration of the present step [s].
    double duration() const
    {
      return (ends[segment] - begin) / static_cast<double>(count);
    }

    /// Returns the end of the present step [s].
    double step_end() const
    {
      return passed + 1 == count ? ends[segment] : begin + static_cast<double>(passed + 1) * duration();
    }

    bool finished() const
    {
      return segment == ends.size();
    }

    void halve()
    {
      count *= 2;
      passed *= 2;
      nominal_step *= 0.5;
    }

    /// Doubles the step where that leaves a whole number of them, up to the largest one; returns whether it did.
    bool grow();

    void advance();

  private:
    friend void serialise(Archive &archive, StepClock &clock);

    void begin_segment();

    std::vector<double> ends; ///< of the segments
    double largest;
    double nominal_step;
    std::size_t segment  = 0;
    double begin         = 0.;
    unsigned long count  = 1; ///< steps of the segment
    unsigned long passed = 0;
  };
} // namespace sprag
