// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace sprag
{
  /// Axes of a part as they stand in the world: x along the cylinder's path towards the pivot, y up, z along zeta, the origin at
  /// the cylinder's centre for x = 0. Those of a lever inclined by theta are d = (-cos theta, sin theta, 0) and n = (sin theta,
  /// cos theta, 0); a pair's second lever has them mirrored at y = 0, the second half of a symmetric lever its third at z = 0.
  struct WorldAxes
  {
    dealii::Point<3> origin;       ///< [mm]
    dealii::Tensor<1, 3> along;    ///< d
    dealii::Tensor<1, 3> across;   ///< n
    dealii::Tensor<1, 3> sideways; ///< of zeta

    dealii::Tensor<1, 3> turned(const dealii::Tensor<1, 3> &vector) const
    {
      return vector[0] * along + vector[1] * across + vector[2] * sideways;
    }

    dealii::Point<3> place(const dealii::Tensor<1, 3> &position) const
    {
      return origin + turned(position);
    }

    dealii::SymmetricTensor<2, 3> turned(const dealii::SymmetricTensor<2, 3> &stress) const
    {
      dealii::Tensor<2, 3> axes;
      for (unsigned int i = 0; i < 3; ++i)
        axes[i] = dealii::Tensor<1, 3>({ along[i], across[i], sideways[i] });
      return symmetrize(axes * dealii::Tensor<2, 3>(stress) * transpose(axes));
    }

    bool are_left_handed() const
    {
      return cross_product_3d(along, across) * sideways < 0.;
    }
  };

  /// Makes axes of a lever. `side` is 1, or -1 for a pair's second lever; `origin` as it is seen from the first's side.
  inline WorldAxes world_axes(const dealii::Point<2> &origin, const double theta, const double side)
  {
    WorldAxes result;
    result.origin   = dealii::Point<3>(origin[0], side * origin[1], 0.);
    result.along    = dealii::Tensor<1, 3>({ -std::cos(theta), side * std::sin(theta), 0. });
    result.across   = dealii::Tensor<1, 3>({ std::sin(theta), side * std::cos(theta), 0. });
    result.sideways = dealii::Tensor<1, 3>({ 0., 0., 1. });
    return result;
  }
} // namespace sprag
