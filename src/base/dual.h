// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/simd_batch.h"

#include <cmath>
#include <type_traits>

#define SPRAG_EACH _Pragma("GCC unroll 16") for (int i = 0; i < n; ++i)

namespace sprag
{
  /// The batch as an argument of templates, which forget its alignment: what is kept of it in memory says alignas(SimdBatch).
  using Batch = double __attribute__((vector_size(64)));

  /// A number with its derivatives by n variables (forward differentiation). T is double, SimdBatch, or a dual number of these.
  template <class T, int n>
  struct Dual
  {
    T v{};
    T d[n]{};
  };

  /// Strips all levels of Dual from a number type.
  template <class N>
  struct PlainType
  {
    using type = N;
  };
  template <class T, int n>
  struct PlainType<Dual<T, n>> : PlainType<T>
  {
  };

  /// The numbers below all derivatives: double or SimdBatch.
  template <class N>
  using Plain = typename PlainType<N>::type;

  /// Is true where C is a constant to dual numbers over T: it has none of their derivatives.
  template <class C, class T>
  constexpr bool is_constant = std::is_arithmetic_v<C> || std::is_same_v<C, T>;
  template <class C, class T, int n>
  constexpr bool is_constant<C, Dual<T, n>> = std::is_same_v<C, Dual<T, n>> || is_constant<C, T>;

  /// The result of a comparison of such numbers.
  template <class N>
  using Mask = decltype(Plain<N>{} < Plain<N>{});

  // The same functions of all numbers.

  SPRAG_PART double value(const double a)
  {
    return a;
  }
  SPRAG_PART SimdBatch value(const SimdBatch &a)
  {
    return a;
  }
  template <class T, int n>
  SPRAG_PART Plain<T> value(const Dual<T, n> &a)
  {
    return value(a.v);
  }

  SPRAG_PART bool any(const bool mask)
  {
    return mask;
  }
  SPRAG_PART bool negated(const bool mask)
  {
    return !mask;
  }
  SPRAG_PART BatchMask negated(const BatchMask &mask)
  {
    return ~mask;
  }

  SPRAG_PART double select(const bool mask, const double a, const double b)
  {
    return mask ? a : b;
  }
  SPRAG_PART SimdBatch select(const BatchMask &mask, const SimdBatch &a, const SimdBatch &b)
  {
    return mask ? a : b;
  }
  template <class M, class T, int n>
  SPRAG_PART Dual<T, n> select(const M &mask, const Dual<T, n> &a, const Dual<T, n> &b)
  {
    Dual<T, n> r;
    r.v               = select(mask, a.v, b.v);
    SPRAG_EACH r.d[i] = select(mask, a.d[i], b.d[i]);
    return r;
  }

  SPRAG_PART double square_root(const double a)
  {
    return std::sqrt(a);
  }
  SPRAG_PART double angle_between(const double x_0, const double y_0, const double x_1, const double y_1)
  {
    return std::atan2(x_0 * y_1 - y_0 * x_1, x_0 * x_1 + y_0 * y_1);
  }

  /// Number `lane` of some, and the same with another there.
  SPRAG_PART double at_lane(const double a, unsigned int)
  {
    return a;
  }
  SPRAG_PART double at_lane(const SimdBatch &a, const unsigned int lane)
  {
    return a[lane];
  }
  SPRAG_PART void set_lane(double &a, unsigned int, const double to)
  {
    a = to;
  }
  SPRAG_PART void set_lane(SimdBatch &a, const unsigned int lane, const double to)
  {
    a[lane] = to;
  }

  /// Calls visit(lane) where the mask is set.
  template <class LaneVisitor>
  SPRAG_PART void for_each_lane(const bool mask, const LaneVisitor &visit)
  {
    if (mask)
      visit(0u);
  }
  template <class LaneVisitor>
  SPRAG_PART void for_each_lane(const BatchMask &mask, const LaneVisitor &visit)
  {
    if (any(mask))
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        if (mask[lane])
          visit(lane);
  }

  template <class T, int n>
  SPRAG_PART Dual<T, n> operator+(const Dual<T, n> &a, const Dual<T, n> &b)
  {
    Dual<T, n> r;
    r.v               = a.v + b.v;
    SPRAG_EACH r.d[i] = a.d[i] + b.d[i];
    return r;
  }
  template <class T, int n>
  SPRAG_PART Dual<T, n> operator-(const Dual<T, n> &a)
  {
    Dual<T, n> r;
    r.v               = -a.v;
    SPRAG_EACH r.d[i] = -a.d[i];
    return r;
  }
  template <class T, int n>
  SPRAG_PART Dual<T, n> operator-(const Dual<T, n> &a, const Dual<T, n> &b)
  {
    Dual<T, n> r;
    r.v               = a.v - b.v;
    SPRAG_EACH r.d[i] = a.d[i] - b.d[i];
    return r;
  }
  template <class T, int n>
  SPRAG_PART Dual<T, n> operator*(const Dual<T, n> &a, const Dual<T, n> &b)
  {
    Dual<T, n> r;
    r.v               = a.v * b.v;
    SPRAG_EACH r.d[i] = a.d[i] * b.v + a.v * b.d[i];
    return r;
  }
  template <class T, int n>
  SPRAG_PART Dual<T, n> operator/(const Dual<T, n> &a, const Dual<T, n> &b)
  {
    Dual<T, n> r;
    r.v               = a.v / b.v;
    const T s         = 1. / b.v;
    SPRAG_EACH r.d[i] = s * (a.d[i] - r.v * b.d[i]);
    return r;
  }

  // With constants: double, SimdBatch, or dual numbers of fewer derivatives.
  template <class C, class T, int n, class = std::enable_if_t<is_constant<C, T>>>
  SPRAG_PART Dual<T, n> operator+(const Dual<T, n> &a, const C &b)
  {
    Dual<T, n> r = a;
    r.v          = r.v + b;
    return r;
  }
  template <class C, class T, int n, class = std::enable_if_t<is_constant<C, T>>>
  SPRAG_PART Dual<T, n> operator+(const C &b, const Dual<T, n> &a)
  {
    return a + b;
  }
  template <class C, class T, int n, class = std::enable_if_t<is_constant<C, T>>>
  SPRAG_PART Dual<T, n> operator-(const Dual<T, n> &a, const C &b)
  {
    Dual<T, n> r = a;
    r.v          = r.v - b;
    return r;
  }
  template <class C, class T, int n, class = std::enable_if_t<is_constant<C, T>>>
  SPRAG_PART Dual<T, n> operator-(const C &b, const Dual<T, n> &a)
  {
    return -a + b;
  }
  template <class C, class T, int n, class = std::enable_if_t<is_constant<C, T>>>
  SPRAG_PART Dual<T, n> operator*(const C &b, const Dual<T, n> &a)
  {
    Dual<T, n> r;
    r.v               = b * a.v;
    SPRAG_EACH r.d[i] = b * a.d[i];
    return r;
  }
  template <class C, class T, int n, class = std::enable_if_t<is_constant<C, T>>>
  SPRAG_PART Dual<T, n> operator*(const Dual<T, n> &a, const C &b)
  {
    return b * a;
  }
  template <class C, class T, int n, class = std::enable_if_t<is_constant<C, T>>>
  SPRAG_PART Dual<T, n> operator/(const C &b, const Dual<T, n> &a)
  {
    return (Dual<T, n>{} + b) / a;
  }

  /// A function's value and its slope at a number, as a function of that.
  SPRAG_PART double chained(const double f, double, double)
  {
    return f;
  }
  SPRAG_PART SimdBatch chained(const SimdBatch &f, const SimdBatch &, const SimdBatch &)
  {
    return f;
  }
  template <class T, int n>
  SPRAG_PART Dual<T, n> chained(const T &f, const T &slope, const Dual<T, n> &a)
  {
    Dual<T, n> r;
    r.v               = f;
    SPRAG_EACH r.d[i] = slope * a.d[i];
    return r;
  }

  template <class T, int n>
  SPRAG_PART Dual<T, n> square_root(const Dual<T, n> &a)
  {
    const T r = square_root(a.v);
    return chained(r, T(0.5 / r), a);
  }
  inline double sine(const double a)
  {
    return std::sin(a);
  }
  inline double cosine(const double a)
  {
    return std::cos(a);
  }
  template <class T, int n>
  Dual<T, n> cosine(const Dual<T, n> &a);
  template <class T, int n>
  Dual<T, n> sine(const Dual<T, n> &a)
  {
    return chained(sine(a.v), cosine(a.v), a);
  }
  template <class T, int n>
  Dual<T, n> cosine(const Dual<T, n> &a)
  {
    return chained(cosine(a.v), T(-sine(a.v)), a);
  }

  inline double power(const double a, const double exponent)
  {
    return std::pow(a, exponent);
  }
  template <int n>
  Dual<double, n> power(const Dual<double, n> &a, const double exponent)
  {
    return chained(std::pow(a.v, exponent), exponent * std::pow(a.v, exponent - 1.), a);
  }

  /// The angle to (x, y) from a constant place.
  template <class C, class T, int n>
  SPRAG_PART Dual<T, n> angle_between(const C &x_0, const C &y_0, const Dual<T, n> &x, const Dual<T, n> &y)
  {
    Dual<T, n> r;
    r.v               = angle_between(x_0, y_0, x.v, y.v);
    const T s         = 1. / (x.v * x.v + y.v * y.v);
    SPRAG_EACH r.d[i] = s * (x.v * y.d[i] - y.v * x.d[i]);
    return r;
  }

  /// The same number in all lanes.
  SPRAG_PART Batch to_batch(const double a)
  {
    return uniform_batch(a);
  }
  template <class T, int n>
  SPRAG_PART auto to_batch(const Dual<T, n> &a)
  {
    Dual<decltype(to_batch(a.v)), n> r;
    r.v               = to_batch(a.v);
    SPRAG_EACH r.d[i] = to_batch(a.d[i]);
    return r;
  }

  /// Variable number `i` of those by which derivatives are taken, which moves the number by `rate`.
  template <class N>
  SPRAG_PART N variable(const double at, const int i, const double rate = 1.)
  {
    N r{};
    r.v = r.v + at;
    if (i < static_cast<int>(sizeof(r.d) / sizeof(r.v)))
      r.d[i] = r.d[i] + rate;
    return r;
  }
} // namespace sprag
