// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/base/tensor.h>

namespace sprag
{
  /// Geometry of one contact point of a plane in n local generalised coordinates q at a given drive position.
  template <int n>
  struct ContactKinematics
  {
    double gap = 0.;                     ///< g [mm], positive when open
    dealii::Tensor<1, n> gap_row;        ///< dg/dq
    dealii::Tensor<2, n> gap_curvature;  ///< d2g/dq2
    double slip = 0.;                    ///< slip coordinate [mm]: its change is what the counterface slides along the body
    dealii::Tensor<1, n> slip_row;       ///< d(slip)/dq
    dealii::Tensor<2, n> slip_curvature; ///< d2(slip)/dq2
  };

  /// A slip, rate or traction along a face. In a plane a point slips the first way alone, on a surface also along the cylinder.
  using Slip = dealii::Tensor<1, 2>;

  /// The history of a contact point. In an accepted state these are the values at the end of its step.
  struct ContactHistory
  {
    double normal_multiplier = 0.; ///< lambda [MPa]; stays 0 in the penalty method
    Slip traction;                 ///< friction from which the stick predictor starts [MPa]; 0 while open

    // Steps in time only.
    double damping = 0.; ///< force of the dashpot at the end of the last step, per area at points of a face
    Slip slip_speed;     ///< mean of the last step; 0 in stick and where there was no contact [mm/s]
    double mu   = 0.;    ///< where the point slid, else 0
    double step = 0.;    ///< duration of the last step if it ended in contact, else 0 [s]

    unsigned int point = 0; ///< index of the point in a face, where only points in contact have a history

    bool operator==(const ContactHistory &other) const
    {
      return point == other.point && step == other.step && traction == other.traction && slip_speed == other.slip_speed &&
             mu == other.mu && damping == other.damping && normal_multiplier == other.normal_multiplier;
    }
  };

  /// Treatment of friction in an evaluation without inertia.
  enum class FrictionMode
  {
    cone, ///< stick or slip as the law decides
    stick ///< no slip: the predictor at a reversal and the stiffness in stick
  };
} // namespace sprag
