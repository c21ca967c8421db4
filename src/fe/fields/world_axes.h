#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace sprag
{
  /// Axes of a lever as they stand in the world: x along the cylinder's path towards the pivot, y up, the origin at the
  /// cylinder's centre for x = 0. Those of a lever inclined by theta are d = (-cos theta, sin theta) and n = (sin theta,
  /// cos theta); a pair's second lever has them mirrored at y = 0.
  struct WorldAxes
  {
    dealii::Point<2> origin;     ///< [mm]
    dealii::Tensor<1, 2> along;  ///< d
    dealii::Tensor<1, 2> across; ///< n

    dealii::Tensor<1, 2> turned(const dealii::Tensor<1, 2> &vector) const
    {
      return vector[0] * along + vector[1] * across;
    }

    dealii::Point<2> place(const dealii::Tensor<1, 2> &position) const
    {
      return origin + turned(position);
    }

    dealii::SymmetricTensor<2, 2> turned(const dealii::SymmetricTensor<2, 2> &stress) const
    {
      dealii::SymmetricTensor<2, 2> result;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = i; j < 2; ++j)
          result[i][j] = stress[0][0] * along[i] * along[j] + stress[1][1] * across[i] * across[j] +
                         stress[0][1] * (along[i] * across[j] + across[i] * along[j]);
      return result;
    }
  };

  /// Makes axes. `side` is 1, or -1 for a pair's second lever; `origin` as it is seen from the first's side.
  inline WorldAxes world_axes(const dealii::Point<2> &origin, const double theta, const double side)
  {
    WorldAxes result;
    result.origin    = dealii::Point<2>(origin[0], side * origin[1]);
    result.along[0]  = -std::cos(theta);
    result.along[1]  = side * std::sin(theta);
    result.across[0] = std::sin(theta);
    result.across[1] = side * std::cos(theta);
    return result;
  }
} // namespace sprag
