#pragma once

#include "laws/friction.h"

namespace sprag
{
  /// Pressure p = max(0, lambda - eps g) of a unilateral contact, gap g [mm] positive when open, multiplier lambda [MPa],
  /// penalty eps > 0 [N/mm^3]; lambda = 0 is the pure penalty method.
  struct NormalTraction
  {
    double pressure;   ///< [MPa], >= 0
    double derivative; ///< dp/dg [N/mm^3]
  };

  NormalTraction normal_traction(double gap, double multiplier, double penalty);

  /// Friction traction after the return to the cone.
  struct FrictionTraction
  {
    double traction;   ///< t [MPa], signed as the trial traction
    double d_trial;    ///< dt/dt_trial
    double d_pressure; ///< dt/dp
    double mu;         ///< coefficient at the slip speed
    bool slipping;
    double d_shift = 0.; ///< dt/d(shift) [N/mm^3]
  };

  /// Return mapping with the cone of the current pressure. In stick |t_trial| <= mu(0) p and t = t_trial. In slip t and the slip
  /// speed w are solved together within the step of duration dt > 0 [s], eps > 0 being the tangential penalty [N/mm^3]:
  ///   |t| = mu(w) p,   w = (|t_trial| - |t|) / (eps dt).
  /// A decreasing mu(w) may have several solutions: then the one of the largest |t|, the first met when the trial load rises.
  /// `shift` [mm], signed as the slip: what the slip of a step at the speed of its end is longer than the step's own, so that
  ///   w = max(0, (|t_trial| - |t|) / eps + shift sgn t_trial) / dt;
  /// |t| stays within |t_trial|.
  FrictionTraction friction_traction(double trial, double pressure, const FrictionLaw &law, double penalty, double dt,
                                     double shift = 0.);
} // namespace sprag
