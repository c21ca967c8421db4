#include "laws/contact.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// mu((trial - t) / (eps dt)) p - t, negative at t = trial beyond the stick limit and not negative at t = 0.
    struct Excess
    {
      const FrictionLaw &law;
      double trial;
      double pressure;
      double resistance; ///< eps dt

      double operator()(const double t) const
      {
        return friction_coefficient(law, (trial - t) / resistance).coefficient * pressure - t;
      }
      double derivative(const double t) const
      {
        return -friction_coefficient(law, (trial - t) / resistance).derivative * pressure / resistance - 1.;
      }
    };

    struct Bracket
    {
      double lower;
      double upper;
    };

    /// Around the largest root. Only a table can fall and so have several, which are looked for from above.
    Bracket bracket_of_root(const Excess &excess)
    {
      if (!std::holds_alternative<TabulatedFriction>(excess.law.law))
        return { 0., excess.trial };
      constexpr unsigned int parts = 64;
      double upper                 = excess.trial;
      for (unsigned int i = parts - 1; i > 0; --i)
      {
        const double t = excess.trial * i / parts;
        if (excess(t) >= 0.)
          return { t, upper };
        upper = t;
      }
      return { 0., upper };
    }

    /// Newton's method kept inside the bracket.
    double slipping_traction(const Excess &excess)
    {
      auto [lower, upper] = bracket_of_root(excess);
      const double small  = 4e-16 * excess.trial;
      double t            = std::clamp(excess(0.), lower, upper);
      for (unsigned int i = 0; i < 100 && upper - lower > small; ++i)
      {
        const double value           = excess(t);
        (value > 0. ? lower : upper) = t;
        double next                  = t - value / excess.derivative(t);
        if (std::abs(next - t) <= small)
          return next;
        if (!(next > lower && next < upper))
          next = 0.5 * (lower + upper);
        t = next;
      }
      return t;
    }
  } // namespace

  NormalTraction normal_traction(const double gap, const double multiplier, const double penalty)
  {
    const double trial = multiplier - penalty * gap;
    return trial > 0. ? NormalTraction{ trial, -penalty } : NormalTraction{ 0., 0. };
  }

  FrictionTraction friction_traction(const double trial, const double pressure, const FrictionLaw &law, const double penalty,
                                     const double dt)
  {
    const double size  = std::abs(trial);
    const double mu_0  = friction_coefficient(law, 0.).coefficient;
    const double sense = std::copysign(1., trial);
    if (size <= mu_0 * pressure)
      return { trial, 1., 0., mu_0, false };

    const double resistance = penalty * dt;
    const double t          = slipping_traction({ law, size, pressure, resistance });
    const auto mu           = friction_coefficient(law, (size - t) / resistance);
    const double rate       = mu.derivative * pressure / resistance;
    return { sense * t, rate / (1. + rate), sense * mu.coefficient / (1. + rate), mu.coefficient, true };
  }
} // namespace sprag
