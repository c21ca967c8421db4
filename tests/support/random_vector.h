// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/lac/vector.h>

#include <random>

namespace sprag
{
  /// Entries between -size and size, the same for the same seed.
  inline dealii::Vector<double> random_vector(const unsigned int n, const double size, const unsigned int seed)
  {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-size, size);
    dealii::Vector<double> result(n);
    for (auto &value : result)
      value = uniform(generator);
    return result;
  }
} // namespace sprag
