// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cmath>
#include <cstdint>

/// A function of a SimdBatch becomes a part of the one that calls it.
#define SPRAG_PART inline __attribute__((always_inline))

namespace sprag
{
  /// A SIMD batch: eight numbers that are computed with at once, one a lane, aligned as any processor may want them. Arithmetic
  /// and comparisons go lane by lane; `mask ? a : b` chooses.
  using SimdBatch = double __attribute__((vector_size(64), aligned(64)));

  /// Result of a comparison of batches, all bits set where it is true.
  using BatchMask = std::int64_t __attribute__((vector_size(64), aligned(64)));

  constexpr unsigned int n_lanes = 8;

  /// Batches of n quantities. std::array would forget their alignment.
  template <unsigned int n>
  struct alignas(SimdBatch) Batches
  {
    SimdBatch values[n];

    SPRAG_PART SimdBatch &operator[](const unsigned int i)
    {
      return values[i];
    }
    SPRAG_PART const SimdBatch &operator[](const unsigned int i) const
    {
      return values[i];
    }
  };

  SPRAG_PART SimdBatch uniform_batch(const double value)
  {
    return SimdBatch{} + value;
  }

  SPRAG_PART SimdBatch square_root(const SimdBatch &value)
  {
    SimdBatch result{};
    for (unsigned int i = 0; i < n_lanes; ++i)
      result[i] = __builtin_sqrt(value[i]);
    return result;
  }

  SPRAG_PART SimdBatch absolute(const SimdBatch &value)
  {
    return value < 0. ? -value : value;
  }

  SPRAG_PART SimdBatch smaller(const SimdBatch &a, const SimdBatch &b)
  {
    return a < b ? a : b;
  }

  SPRAG_PART SimdBatch larger(const SimdBatch &a, const SimdBatch &b)
  {
    return a < b ? b : a;
  }

  SPRAG_PART bool any(const BatchMask &mask)
  {
    std::int64_t result = 0;
    for (unsigned int i = 0; i < n_lanes; ++i)
      result |= mask[i];
    return result != 0;
  }

  SPRAG_PART double sum(const SimdBatch &value)
  {
    using Half        = double __attribute__((vector_size(32)));
    const Half halves = __builtin_shufflevector(value, value, 0, 1, 2, 3) + __builtin_shufflevector(value, value, 4, 5, 6, 7);
    return (halves[0] + halves[2]) + (halves[1] + halves[3]);
  }

  SPRAG_PART double largest(const SimdBatch &value)
  {
    double result = value[0];
    for (unsigned int i = 1; i < n_lanes; ++i)
      result = value[i] > result ? value[i] : result;
    return result;
  }

  /// The angle from (x_0, y_0) to (x_1, y_1), most of them small.
  SPRAG_PART SimdBatch angle_between(const SimdBatch &x_0, const SimdBatch &y_0, const SimdBatch &x_1, const SimdBatch &y_1)
  {
    constexpr double small = 0.03; // where the terms left out are round-off
    const SimdBatch across = x_0 * y_1 - y_0 * x_1;
    const SimdBatch along  = x_0 * x_1 + y_0 * y_1;
    const SimdBatch t      = across / along;
    const SimdBatch s      = t * t;
    SimdBatch result       = t * (1. - s * (1. / 3. - s * (1. / 5. - s * (1. / 7. - s * (1. / 9.)))));
    const BatchMask is_far = (absolute(t) > small) | (along <= 0.);
    if (any(is_far))
      for (unsigned int i = 0; i < n_lanes; ++i)
        if (is_far[i])
          result[i] = std::atan2(across[i], along[i]);
    return result;
  }
} // namespace sprag
