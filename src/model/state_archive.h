// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "model/dynamic_model.h"
#include "model/model.h"

namespace sprag
{
  void visit(Archive &archive, dealii::Vector<double> &vector);
  void visit(Archive &archive, dealii::FullMatrix<double> &matrix);
  void visit(Archive &archive, Kinematic &coordinates);
  void visit(Archive &archive, PortLoads &loads);
  void visit(Archive &archive, PortForces &forces);
  void visit(Archive &archive, Motion &motion);
  void visit(Archive &archive, State &state);
} // namespace sprag
