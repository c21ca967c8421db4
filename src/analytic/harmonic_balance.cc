// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/harmonic_balance.h"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// Returns a = 1/pi int D sin phi dphi and b = 1/pi int D cos phi dphi of the damper's force D over a cycle z = A sin phi,
    /// as twice the integrals over the quarters on which z > 0 grows and shrinks: the other half cycle is symmetric.
    std::pair<double, double> first_harmonic(const Damper &damper, const double amplitude, const double w)
    {
      const auto force = [&](const double angle, const int away)
      { return damper.resistance(amplitude * std::sin(angle), amplitude * w * std::cos(angle), away).force; };
      const auto part = [&](const auto &integrand)
      { return 2. / M_PI * boost::math::quadrature::gauss<double, 30>::integrate(integrand, 0., 0.5 * M_PI); };
      return { part([&](const double angle) { return (force(angle, 1) + force(angle, -1)) * std::sin(angle); }),
               part([&](const double angle) { return (force(angle, 1) - force(angle, -1)) * std::cos(angle); }) };
    }
  } // namespace

  std::vector<HarmonicBalance> harmonic_balance(const IsolationSystem &system, const double base_amplitude,
                                                const double angular_frequency)
  {
    constexpr unsigned int brackets = 160; // of A, geometrically spaced; each change of sign holds a solution
    const double w = angular_frequency, base_force = system.mass * w * w * base_amplitude;
    const double largest = std::min(system.damper.reach, 1e3 * base_amplitude);
    const auto residual  = [&](const double A)
    {
      const auto [a, b] = first_harmonic(system.damper, A, w);
      return std::hypot((system.stiffness - system.mass * w * w) * A + a, b) - base_force;
    };
    const auto found_at = [&](const double A)
    {
      const auto [a, b] = first_harmonic(system.damper, A, w);
      return HarmonicBalance{ A, std::hypot(system.stiffness * A + a, b) / base_force };
    };
    std::vector<HarmonicBalance> found;
    double from = 1e-6 * largest, before = residual(from);
    if (before >= 0.)
      found.push_back({ 0., 1. });
    for (unsigned int i = 1; i <= brackets; ++i)
    {
      const double to = largest * std::pow(1e-6, 1. - static_cast<double>(i) / brackets), after = residual(to);
      if (std::isfinite(after) && before * after < 0.)
      {
        boost::uintmax_t most = 100;
        const auto root       = boost::math::tools::toms748_solve(residual, from, to, before, after,
                                                                  boost::math::tools::eps_tolerance<double>(48), most);
        found.push_back(found_at(0.5 * (root.first + root.second)));
      }
      from   = to;
      before = after;
    }
    return found;
  }
} // namespace sprag
