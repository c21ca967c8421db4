// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"

#include <array>
#include <memory>

namespace sprag
{
  /// Linear springs at hub, support and the cylinder's slopes of a lever without inertia.
  struct JointSprings
  {
    double rotation = 0.;           ///< k [N mm/rad], > 0
    double support  = 0.;           ///< k_f a lever [N/mm], > 0; counts on a sprung support
    double arm      = 0.;           ///< length that turns a rotation into a movement [mm], > 0
    std::array<double, 2> slopes{}; ///< compliances of the cylinder's shaft [rad/(N mm)], >= 0; count where its axis is free
    double slope_arm = 0.;          ///< length that turns its slopes into movements [mm], > 0
  };

  /// Residual of the coordinates.
  struct Residual
  {
    dealii::Vector<double> values;
    double norm;                                                             ///< as a displacement or a force, hubs by their arm
    std::shared_ptr<const dealii::PETScWrappers::SparseMatrix> tangent = {}; ///< of structures that are factorised anew
  };
} // namespace sprag
