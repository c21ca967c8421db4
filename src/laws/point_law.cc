// SPDX-License-Identifier: GPL-3.0-only
#include "laws/point_law.h"

#include "laws/friction_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

    /// Newton's method kept inside the bracket.
    double slip_speed(const Excess &excess)
    {
      double lower           = 0.;
      double upper           = excess.trial / excess.resistance;
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

  SlipLaw slip_law(const FrictionLaw &friction, const double stiffness, const bool is_layer)
  {
    return { friction, stiffness, {}, falls_with_speed(friction), is_layer };
  }

  FrictionLag friction_lag(const FrictionLaw &law, const double stiffness, const bool is_layer, const double slope,
                           const double speed)
  {
    if (slope == 0.)
      return { 0., 1. };
    const bool falls      = falls_with_speed(law);
    const bool has_spring = law.regularisation_speed == 0. && (is_layer || !falls);
    const double memory   = falls ? law.memory_length / std::abs(speed) : 0.;
    const double spring   = has_spring ? (falls ? slope : std::max(0., slope)) / stiffness : 0.;
    const double time     = memory + spring;
    return { time, time == 0. ? 1. : spring / time };
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
      return { std::copysign(mu.coefficient, speed), mu.derivative, mu.coefficient, mu.derivative };
    const double root  = std::hypot(speed, v_r);
    const double share = speed / root;
    const double by_mu = mu.derivative * std::abs(share);
    return { mu.coefficient * share, by_mu + mu.coefficient * v_r * v_r / (root * root * root), mu.coefficient, by_mu };
  }
} // namespace sprag
