// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/step/dynamic_model.h"

namespace sprag
{
  /// Interface displacements over a step, with the further input of the contact.
  struct InterfaceStep
  {
    const DrivePoint &from;                     ///< drive at the beginning
    const std::vector<ContactHistory> &history; ///< of the contact there
    const DrivePoint &to;                       ///< drive at the end
    const Kinematic &begin;                     ///< rates are set where the contact or a sprung support uses them
    const dealii::Vector<double> &end;
    const dealii::Vector<double> &end_rate;
    StepWeights weights;
    Request request = Request::with_tangent;
  };
} // namespace sprag
