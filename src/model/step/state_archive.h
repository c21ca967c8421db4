// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "model/step/dynamic_model.h"
#include "model/step/model.h"

namespace sprag
{
  void serialise(Archive &archive, dealii::Vector<double> &vector);
  void serialise(Archive &archive, dealii::FullMatrix<double> &matrix);
  void serialise(Archive &archive, Kinematic &coordinates);
  void serialise(Archive &archive, DofLoads &loads);
  void serialise(Archive &archive, InterfaceForces &forces);
  void serialise(Archive &archive, Motion &motion);
  void serialise(Archive &archive, State &state);
} // namespace sprag
