#pragma once

#include "model/dynamic_model.h"

namespace sprag
{
  /// Port displacements over a step.
  struct PortStep
  {
    const Motion &accepted; ///< at the beginning
    const DrivePoint &to;   ///< drive at the end
    const Kinematic &begin; ///< rates are set where the contact or a sprung support uses them
    const dealii::Vector<double> &end;
    const dealii::Vector<double> &end_rate;
    StepWeights weights;
  };
} // namespace sprag
