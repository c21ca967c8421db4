#pragma once

#include "fe/solid/surface_contact.h"

namespace sprag
{
  /// What of a force acts on the lever's place and on the drive.
  template <int n>
  dealii::Tensor<1, 5> on_lever(const dealii::Tensor<1, n> &force)
  {
    return dealii::Tensor<1, 5>({ force[0], force[1], force[2], force[3], force[4] });
  }

  /// Forces of a patch and their derivatives: of the displacements of its nodes, of theta, of x and of the axis' slopes.
  /// Displacements along one axis stand together, so that what is summed over the nodes is contiguous. Points may tell of
  /// coordinates without the slopes.
  struct SurfaceContact::Sums
  {
    dealii::Tensor<1, n_local> values;
    dealii::Tensor<2, n_local> tangent;
    bool touched = false;

    static constexpr unsigned int place(const unsigned int node, const unsigned int axis)
    {
      return Patches::max_nodes * axis + node;
    }

    template <int n_coordinates>
    void add(const Patches::Point &point, const dealii::Tensor<1, n_coordinates> &force,
             const dealii::Tensor<2, n_coordinates> &of_point)
    {
      constexpr unsigned int n_frame = n_coordinates - 3;
      constexpr unsigned int n       = Patches::max_nodes; // beyond those of the patch shapes are 0
      touched                        = true;
      const auto &shapes             = point.shapes;
      const auto weighted            = point.weight * of_point;
      for (unsigned int i = 0; i < n_frame; ++i)
      {
        values[n_displacements + i] += point.weight * force[3 + i];
        for (unsigned int j = 0; j < n_frame; ++j)
          tangent[n_displacements + i][n_displacements + j] += weighted[3 + i][3 + j];
        for (unsigned int e = 0; e < 3; ++e)
          add_scaled(weighted[3 + i][e], shapes, &tangent[n_displacements + i][n * e]);
      }
      for (unsigned int d = 0; d < 3; ++d)
      {
        add_scaled(point.weight * force[d], shapes, &values[n * d]);
        for (unsigned int a = 0; a < n; ++a)
        {
          auto &row = tangent[n * d + a];
          for (unsigned int e = 0; e < 3; ++e)
            add_scaled(shapes[a] * weighted[d][e], shapes, &row[n * e]);
          for (unsigned int j = 0; j < n_frame; ++j)
            row[n_displacements + j] += shapes[a] * weighted[d][3 + j];
        }
      }
    }

  private:
    static void add_scaled(const double factor, const std::array<double, Patches::max_nodes> &shapes, double *const sums)
    {
      for (unsigned int b = 0; b < Patches::max_nodes; ++b)
        sums[b] += factor * shapes[b];
    }
  };
} // namespace sprag
