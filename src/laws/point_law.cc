// SPDX-License-Identifier: GPL-3.0-only
#include "laws/point_law.h"

#include "laws/friction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sprag
{
  namespace
  {
    /// trial - eps dt w - mu(w) p over the slip speed w: positive at rest beyond the stick limit, zero on the cone, not positive
    /// at w = trial / (eps dt).
    struct Excess
    {
      const FrictionLaw &law;
      double trial;
      double pressure;
      double resistance; ///< eps dt

      double operator()(const double w) const
      {
        return trial - resistance * w - friction_coefficient(law, w).coefficient * pressure;
      }
      double derivative(const double w) const
      {
        return -resistance - friction_coefficient(law, w).derivative * pressure;
      }
    };

    struct Bracket
    {
      double lower;
      double upper;
    };

    /// Finds where the excess, positive at `lower`, first falls to zero between two knots, over which its derivative is monotone:
    /// it changes its sign once in the bracket. Between two positive ends it may do so on both sides of a minimum.
    std::optional<Bracket> first_fall(const Excess &excess, const double lower, const double upper)
    {
      if (excess(upper) <= 0.)
        return Bracket{ lower, upper };
      if (excess.derivative(lower) >= 0. || excess.derivative(std::nextafter(upper, lower)) <= 0.)
        return {};
      double falling = lower;
      double rising  = upper;
      // To the root of round-off, over which a minimum is flat.
      for (unsigned int i = 0; i < 30; ++i)
      {
        const double middle = 0.5 * (falling + rising);
        if (excess(middle) <= 0.)
          return Bracket{ lower, middle };
        (excess.derivative(middle) < 0. ? falling : rising) = middle;
      }
      return {};
    }

    /// Returns a bracket around the lowest speed of slip.
    Bracket bracket_of_slip(const Excess &excess)
    {
      const double fastest = excess.trial / excess.resistance;
      double lower         = 0.;
      for (double knot = next_friction_knot(excess.law, 0.); knot < fastest; knot = next_friction_knot(excess.law, knot))
      {
        if (const auto found = first_fall(excess, lower, knot))
          return *found;
        lower = knot;
      }
      return first_fall(excess, lower, fastest).value_or(Bracket{ lower, fastest });
    }

    /// Newton's method kept inside the bracket.
    double slip_speed(const Excess &excess)
    {
      auto [lower, upper]    = bracket_of_slip(excess);
      const double round_off = 4. * std::numeric_limits<double>::epsilon();
      double w               = upper;
      for (unsigned int i = 0; i < 100 && upper - lower > round_off * upper; ++i)
      {
        const double value = excess(w);
        if (std::abs(value) <= round_off * excess.trial)
          return w;
        (value > 0. ? lower : upper) = w;
        w -= value / excess.derivative(w);
        if (!(w > lower && w < upper))
          w = 0.5 * (lower + upper);
      }
      return w;
    }
  } // namespace

  double friction_in_stick(const FrictionLaw &law)
  {
    return friction_coefficient(law, 0.).coefficient;
  }

  FrictionValue slip_friction(const FrictionLaw &law, const double load, const double resistance, const double pressure)
  {
    return friction_coefficient(law, slip_speed({ law, load, pressure, resistance }));
  }

  SlidingFriction sliding_friction(const FrictionLaw &law, const double speed)
  {
    const auto mu    = friction_coefficient(law, std::abs(speed));
    const double v_r = law.regularisation_speed;
    if (v_r == 0.)
      return { std::copysign(mu.coefficient, speed), mu.derivative, mu.coefficient };
    const double root  = std::hypot(speed, v_r);
    const double share = speed / root;
    return { mu.coefficient * share, mu.derivative * std::abs(share) + mu.coefficient * v_r * v_r / (root * root * root),
             mu.coefficient };
  }
} // namespace sprag
