#pragma once

#include <deal.II/base/tensor.h>

#include <array>

namespace sprag
{
  /// Slopes of a cylinder's axis towards the lever (tilt) and along x (skew).
  using AxisSlopes = std::array<double, 2>;

  /// Axes of a cylinder in those of the world, and how they turn with its slopes: `axis` lies along (skew, tilt, 1), `right` has
  /// no part towards the lever, `upward` is across both. With b_1, b_2, b_3 for the three and indices for derivatives by the
  /// slopes
  ///   turn_i = sum of b (x) b_i,   bend_ij = sum of b (x) b_ij,
  /// so that a place w, fixed in the world, moves past the cylinder as by turn_i w, of a second order as by bend_ij w.
  struct CylinderAxes
  {
    using Vector = dealii::Tensor<1, 3>;
    using Matrix = dealii::Tensor<2, 3>;

    CylinderAxes()
        : CylinderAxes(AxisSlopes{})
    {
    }

    explicit CylinderAxes(const AxisSlopes &slopes);

    Vector axis, right, upward;
    std::array<Matrix, 2> turn;
    std::array<std::array<Matrix, 2>, 2> bend;
  };
} // namespace sprag
