// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"

#include <optional>
#include <vector>

namespace sprag
{
  /// Tells from the state at the same phase of each period of the base whether the motion repeats.
  class SteadyState
  {
  public:
    /// Adds a state, both of the unit of `amplitude`, the largest displacement of the period that ends with it.
    void add(double z, double rate_over_frequency, double amplitude);

    /// Returns after how many periods, at most 8, the motion repeats so closely that the way left to the steady state is below
    /// this share of the amplitude, at the last two instants; none where it does not. What is left follows from how fast changes
    /// become smaller.
    std::optional<unsigned int> periods(double tolerance) const;

  private:
    friend void visit(Archive &archive, SteadyState &steady);

    struct Instant
    {
      double z, rate, amplitude;
    };

    std::vector<Instant> instants;

    double change(std::size_t instant, unsigned int periods) const;
    unsigned int shortest(unsigned int repeating, double tolerance) const;
    bool repeats(std::size_t instant, unsigned int periods, double tolerance) const;
  };

  void visit(Archive &archive, SteadyState &steady);
} // namespace sprag
