// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/friction_law.h"

#include <deal.II/base/tensor.h>

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

  /// Size of the friction traction after the return to the cone.
  struct ConeReturn
  {
    double traction;   ///< t >= 0
    double d_trial;    ///< dt/dt_trial
    double d_pressure; ///< dt/dp
    double mu;         ///< coefficient at the slip speed
    bool slipping;
    double d_shift = 0.; ///< dt/d(shift) [N/mm^3]
  };

  /// Return mapping with the cone of the current pressure, of a trial traction >= 0. In stick t_trial <= mu(0) p and t = t_trial.
  /// In slip t and the slip speed w are solved together within the step of duration dt > 0 [s], eps > 0 being the tangential
  /// penalty [N/mm^3]:
  ///   t = mu(w) p,   w = (t_trial - t) / (eps dt).
  /// A decreasing mu(w) may have several solutions: then the one of the largest t, the first met when the trial load rises.
  /// `shift` [mm] is by how much the slip of a step at the speed of its end is longer than the step's own, so that
  ///   w = max(0, (t_trial - t) / eps + shift) / dt;
  /// t stays below t_trial.
  ConeReturn return_to_cone(double trial, double pressure, const FrictionLaw &law, double penalty, double dt, double shift = 0.);

  /// Friction traction over the slips of a point, two on a surface and one in a plane, with derivatives.
  template <int slips>
  struct FrictionTraction
  {
    dealii::Tensor<1, slips> traction;
    dealii::Tensor<2, slips> d_trial;
    dealii::Tensor<1, slips> d_pressure;
    double mu;
    bool slipping;
    dealii::Tensor<2, slips> d_shift; ///< [N/mm^3]
  };

  /// Returns a trial traction to the cone: its size by return_to_cone(), its direction stays. Of `shift` the part in that
  /// direction counts.
  template <int slips>
  FrictionTraction<slips> friction_traction(const dealii::Tensor<1, slips> &trial, double pressure, const FrictionLaw &law,
                                            double penalty, double dt, const dealii::Tensor<1, slips> &shift = {});
} // namespace sprag
