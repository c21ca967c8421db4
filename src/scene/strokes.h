#pragma once

#include <algorithm>
#include <vector>

namespace sprag
{
  /// One way of the cylinder, the last one possibly cut short.
  struct Stroke
  {
    double from;
    double to;
    double part; ///< of the way that is gone, 0 < part <= 1
  };

  /// There and back, `cycles` > 0 times.
  inline std::vector<Stroke> strokes(const double start, const double stroke, const double cycles)
  {
    const double n_half_cycles = 2. * cycles;
    std::vector<Stroke> result;
    for (unsigned int i = 0; i < n_half_cycles; ++i)
      result.push_back({ i % 2 == 0 ? start : stroke, i % 2 == 0 ? stroke : start, std::min(1., n_half_cycles - i) });
    return result;
  }
} // namespace sprag
