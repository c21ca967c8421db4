// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/dynamic_model.h"

namespace sprag
{
  /// Displacements of the ports over a step, with what the contact needs beside them.
  struct PortStep
  {
    const DrivePoint &from;                   ///< drive at the beginning
    const std::vector<ContactMemory> &memory; ///< of the contact there
    const DrivePoint &to;                     ///< drive at the end
    const Kinematic &begin;                   ///< rates are set where the contact or a sprung support uses them
    const dealii::Vector<double> &end;
    const dealii::Vector<double> &end_rate;
    StepWeights weights;
    const std::vector<PointMemory<2>> *surface_memory = nullptr; ///< of the contact of a surface, in place of `memory`
    Request request                                   = Request::with_tangent;
  };
} // namespace sprag
