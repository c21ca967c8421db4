#pragma once

#include "fe/solid/surface_contact.h"

namespace sprag
{
  /// What of a force acts on the lever's place and on the drive.
  inline dealii::Tensor<1, 5> on_lever(const SurfaceKinematics::Row &force)
  {
    return dealii::Tensor<1, 5>({ force[0], force[1], force[2], force[3], force[4] });
  }

  /// Forces of a patch and their derivatives: of the displacements of its nodes, of theta, of x and
  /// of the axis' slopes.
  struct SurfaceContact::Sums
  {
    dealii::Tensor<1, n_local> values;
    dealii::Tensor<2, n_local> tangent;
    bool touched = false;

    void add(const Patches::Point &point, const unsigned int n_nodes, const SurfaceKinematics::Row &force,
             const SurfaceKinematics::Curvature &of_point)
    {
      touched = true;
      for (unsigned int i = 0; i < n_frame; ++i)
      {
        values[n_displacements + i] += point.weight * force[3 + i];
        for (unsigned int j = 0; j < n_frame; ++j)
          tangent[n_displacements + i][n_displacements + j] += point.weight * of_point[3 + i][3 + j];
      }
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int d = 0; d < 3; ++d)
        {
          const double weight = point.weight * point.shapes[a];
          auto &row           = tangent[3 * a + d];
          values[3 * a + d] += weight * force[d];
          for (unsigned int j = 0; j < n_frame; ++j)
          {
            row[n_displacements + j] += weight * of_point[d][3 + j];
            tangent[n_displacements + j][3 * a + d] += weight * of_point[3 + j][d];
          }
          for (unsigned int b = 0; b < n_nodes; ++b)
            for (unsigned int e = 0; e < 3; ++e)
              row[3 * b + e] += weight * point.shapes[b] * of_point[d][e];
        }
    }

    /// Adds what changes with the slope of the slip round the cylinder along the face, as far as the face's direction goes with
    /// it: `by_slope` the derivative of the force by that slope.
    void add_slope(const Patches::Point &point, const std::vector<double> &slopes, const SurfaceKinematics::Row &by_slope,
                   const SurfaceKinematics::Row &slip_row)
    {
      for (unsigned int b = 0; b < slopes.size(); ++b)
        for (unsigned int e = 0; e < 3; ++e)
        {
          const double slope = point.weight * slip_row[e] * slopes[b];
          for (unsigned int a = 0; a < slopes.size(); ++a)
            for (unsigned int d = 0; d < 3; ++d)
              tangent[3 * a + d][3 * b + e] += point.shapes[a] * by_slope[d] * slope;
          for (unsigned int i = 0; i < n_frame; ++i)
            tangent[n_displacements + i][3 * b + e] += by_slope[3 + i] * slope;
        }
    }
  };
} // namespace sprag
