// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <boost/math/tools/roots.hpp>

#include <optional>
#include <vector>

namespace sprag
{
  /// A polynomial over the share of a step, 0 to 1: the coefficients of its powers, the constant first.
  using StepPolynomial = std::vector<double>;

  double evaluate(const StepPolynomial &polynomial, double share);

  StepPolynomial differentiate(const StepPolynomial &polynomial);

  /// An end of a step: a quantity with its first and second derivative over the share.
  struct StepEnd
  {
    double value, first, second;
  };

  /// Returns the quintic through both ends.
  StepPolynomial quintic(const StepEnd &begin, const StepEnd &end);

  /// Returns the cubic through values and first derivatives of both ends.
  StepPolynomial cubic(const StepEnd &begin, const StepEnd &end);

  /// Returns the quartic through values at 0, 1/4, 1/2, 3/4 and 1.
  StepPolynomial quartic(const std::vector<double> &values);

  /// Returns the places strictly between 0 and 1 where the polynomial changes its sign, increasing, to round-off.
  std::vector<double> sign_changes(const StepPolynomial &polynomial);

  /// Encloses a sign change, as fractions of the step from 0 to 1.
  struct Bracket
  {
    double from, to;
  };

  /// Returns the first stretch without a turn on which the polynomial falls below 0 by more than round-off; none where it never
  /// does.
  std::optional<Bracket> first_fall(const StepPolynomial &polynomial);

  /// The root of a function that is positive at `from` and negative at `to`, to round-off.
  template <class Function>
  double falling_root(const Function &function, const double from, const double to)
  {
    const double before = function(from), behind = function(to);
    if (before <= 0.)
      return from;
    if (behind >= 0.)
      return to;
    boost::uintmax_t most = 100;
    const auto found =
        boost::math::tools::toms748_solve(function, from, to, before, behind, boost::math::tools::eps_tolerance<double>(), most);
    return 0.5 * (found.first + found.second);
  }
} // namespace sprag
