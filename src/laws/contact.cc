#include "laws/contact.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// Root of mu((trial - t) / (eps dt)) p - t in [0, trial], trial > mu(0) p: Newton kept inside a bracket.
    double slipping_traction(const double trial, const double pressure, const FrictionLaw &law, const double resistance)
    {
      double lower       = 0.;
      double upper       = trial;
      double t           = std::min(trial, friction_coefficient(law, trial / resistance).coefficient * pressure);
      const double small = 4e-16 * trial;
      for (unsigned int i = 0; i < 100 && upper - lower > small; ++i)
      {
        const auto mu                 = friction_coefficient(law, (trial - t) / resistance);
        const double excess           = mu.coefficient * pressure - t;
        (excess > 0. ? lower : upper) = t;
        double next                   = t + excess / (1. + mu.derivative * pressure / resistance);
        if (!(next > lower && next < upper))
          next = std::abs(next - t) <= small ? t : 0.5 * (lower + upper);
        if (std::abs(next - t) <= small)
          return next;
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
    const double t          = slipping_traction(size, pressure, law, resistance);
    const auto mu           = friction_coefficient(law, (size - t) / resistance);
    const double rate       = mu.derivative * pressure / resistance;
    return { sense * t, rate / (1. + rate), sense * mu.coefficient / (1. + rate), mu.coefficient, true };
  }
} // namespace sprag
