// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/step_polynomial.h"

#include "base/ranges.h"

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// Between which a polynomial rises or falls: 0, its turns, 1.
    std::vector<double> monotone_pieces(const StepPolynomial &polynomial)
    {
      std::vector<double> result = { 0. };
      if (polynomial.size() > 2)
        for (const double turn : sign_changes(differentiate(polynomial)))
          result.push_back(turn);
      result.push_back(1.);
      return result;
    }
  } // namespace

  double evaluate(const StepPolynomial &polynomial, const double share)
  {
    double value = 0.;
    for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c)
      value = value * share + *c;
    return value;
  }

  StepPolynomial differentiate(const StepPolynomial &polynomial)
  {
    StepPolynomial result;
    for (std::size_t i = 1; i < polynomial.size(); ++i)
      result.push_back(static_cast<double>(i) * polynomial[i]);
    return result;
  }

  StepPolynomial quintic(const StepEnd &begin, const StepEnd &end)
  {
    const double half = begin.second / 2.;
    const double d0   = end.value - begin.value - begin.first - half;
    const double d1   = end.first - begin.first - begin.second;
    const double d2   = end.second - begin.second;
    return {
      begin.value, begin.first, half, 10. * d0 - 4. * d1 + d2 / 2., -15. * d0 + 7. * d1 - d2, 6. * d0 - 3. * d1 + d2 / 2.
    };
  }

  StepPolynomial cubic(const StepEnd &begin, const StepEnd &end)
  {
    const double rise = end.value - begin.value;
    return { begin.value, begin.first, 3. * rise - 2. * begin.first - end.first, begin.first + end.first - 2. * rise };
  }

  StepPolynomial quartic(const std::vector<double> &y)
  {
    return { y[0], (-25. * y[0] + 48. * y[1] - 36. * y[2] + 16. * y[3] - 3. * y[4]) / 3.,
             (70. * y[0] - 208. * y[1] + 228. * y[2] - 112. * y[3] + 22. * y[4]) / 3.,
             (-80. * y[0] + 288. * y[1] - 384. * y[2] + 224. * y[3] - 48. * y[4]) / 3.,
             (32. * y[0] - 128. * y[1] + 192. * y[2] - 128. * y[3] + 32. * y[4]) / 3. };
  }

  std::vector<double> sign_changes(const StepPolynomial &polynomial)
  {
    std::vector<double> result;
    const auto pieces = monotone_pieces(polynomial);
    const auto value  = [&](const double share) { return evaluate(polynomial, share); };
    for (std::size_t i = 1; i < pieces.size(); ++i)
    {
      const double from = pieces[i - 1], to = pieces[i], before = value(from), behind = value(to);
      if (!((before < 0. && behind > 0.) || (before > 0. && behind < 0.)))
        continue;
      boost::uintmax_t most = 100;
      const auto [low, high] =
          boost::math::tools::toms748_solve(value, from, to, before, behind, boost::math::tools::eps_tolerance<double>(), most);
      result.push_back(0.5 * (low + high));
    }
    return result;
  }

  std::optional<Bracket> first_fall(const StepPolynomial &polynomial)
  {
    constexpr double round_off = 1e-13;
    const auto pieces          = monotone_pieces(polynomial);
    const double scale         = largest(pieces, [&](const double share) { return evaluate(polynomial, share); });
    for (std::size_t i = 1; i < pieces.size(); ++i)
      if (evaluate(polynomial, pieces[i]) < -round_off * scale)
        return Bracket{ pieces[i - 1], pieces[i] };
    return {};
  }
} // namespace sprag
