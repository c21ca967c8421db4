#include "laws/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

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

    /// Zeros between 0 and 1 of the parabola through values at 0, 1/2 and 1, ascending; 1 for each that is not there.
    std::pair<double, double> zeros_of_parabola(const double begin, const double middle, const double end)
    {
      const double square   = 2. * (begin - 2. * middle + end);
      const double linear   = 4. * middle - 3. * begin - end;
      const double root     = std::sqrt(linear * linear - 4. * square * begin);
      const double half_sum = -0.5 * (linear + std::copysign(root, linear));
      const auto inside     = [](const double zero) { return zero > 0. && zero < 1. ? zero : 1.; };
      const double first    = inside(half_sum / square);
      const double second   = inside(begin / half_sum);
      return std::minmax({ first, second });
    }

    /// Where the excess, positive at `lower`, first falls to zero between two knots, over which it is one cubic: monotone up to
    /// and from where its derivative vanishes.
    std::optional<Bracket> first_fall(const Excess &excess, const double lower, const double upper)
    {
      const double length     = upper - lower;
      const double middle     = excess.derivative(lower + 0.5 * length);
      const auto [turn, back] = zeros_of_parabola(excess.derivative(lower), middle, excess.derivative(upper));
      double begin            = lower;
      for (const double end : { lower + turn * length, lower + back * length, upper })
      {
        if (excess(end) <= 0.)
          return Bracket{ begin, end };
        begin = end;
      }
      return {};
    }

    /// Around the lowest speed of slip, the excess being monotone between.
    Bracket bracket_of_slip(const Excess &excess)
    {
      const double fastest = excess.trial / excess.resistance;
      double lower         = 0.;
      for (const double knot : friction_knots(excess.law))
      {
        const double upper = std::min(knot, fastest);
        if (const auto found = first_fall(excess, lower, upper))
          return *found;
        lower = upper;
      }
      return { lower, fastest };
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

  NormalTraction normal_traction(const double gap, const double multiplier, const double penalty)
  {
    const double trial = multiplier - penalty * gap;
    return trial > 0. ? NormalTraction{ trial, -penalty } : NormalTraction{ 0., 0. };
  }

  FrictionTraction friction_traction(const double trial, const double pressure, const FrictionLaw &law, const double penalty,
                                     const double dt, const double shift)
  {
    const double size  = std::abs(trial);
    const double mu_0  = friction_coefficient(law, 0.).coefficient;
    const double sense = std::copysign(1., trial);
    if (size <= mu_0 * pressure)
      return { trial, 1., 0., mu_0, false };

    const double shifted = size + sense * penalty * shift;
    if (shifted <= mu_0 * pressure)
      return { sense * mu_0 * pressure, 0., sense * mu_0, mu_0, true };
    const double resistance = penalty * dt;
    const auto mu           = friction_coefficient(law, slip_speed({ law, shifted, pressure, resistance }));
    if (mu.coefficient * pressure > size)
      return { trial, 1., 0., mu.coefficient, false };
    const double rate  = mu.derivative * pressure / resistance;
    const double share = rate / (1. + rate);
    return {
      sense * mu.coefficient * pressure, share, sense * mu.coefficient / (1. + rate), mu.coefficient, true, penalty * share
    };
  }
} // namespace sprag
