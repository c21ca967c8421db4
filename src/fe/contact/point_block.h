// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_elements.h"
#include "fe/contact/rigid_cylinder.h"

#include <algorithm>

namespace sprag
{
  /// Eight integration points of an element of a friction face, or the fewer that are left of it, one a lane. In a plane zeta
  /// is 0.
  template <int dim>
  struct alignas(SimdBatch) PointBlock
  {
    static constexpr unsigned int n_nodes = FaceElements<dim>::max_nodes;
    using Nodal                           = typename FaceElements<dim>::Nodal;

    Triple<Batch> position{}; ///< undeformed
    SimdBatch weight{};       ///< 0 beyond the element's last point
    Batches<n_nodes> shapes{};
    Batches<n_nodes> slopes{}; ///< of the shapes along xi [1/mm]
    unsigned int first;        ///< point
    unsigned int n;            ///< of points

    /// Takes the points from `first_point` on, of an element that ends before `end`.
    PointBlock(const FaceElements<dim> &face, const unsigned int first_point, const unsigned int end)
        : first(first_point)
        , n(std::min(n_lanes, end - first_point))
    {
      for (unsigned int i = 0; i < n_lanes; ++i)
      {
        const unsigned int q = first + std::min(i, n - 1);
        const auto &point    = face.points[q];
        const auto at        = in_space(point.position);
        position.x[i] = at[0], position.y[i] = at[1], position.z[i] = at[2];
        weight[i] = i < n ? point.weight : 0.;
        for (unsigned int a = 0; a < n_nodes; ++a)
        {
          shapes[a][i] = point.shapes[a];
          slopes[a][i] = point.slopes[a];
        }
      }
    }

    /// The deformed places.
    SPRAG_PART Triple<Batch> place(const Nodal &displacement) const
    {
      return sum(position, shapes, displacement);
    }

    /// Displacements of the points, or their rates by those of the nodes.
    SPRAG_PART Triple<Batch> moved(const Nodal &displacement) const
    {
      return sum({}, shapes, displacement);
    }

    /// Derivatives of the deformed places along the undeformed face.
    SPRAG_PART Triple<Batch> direction(const Nodal &displacement) const
    {
      return sum({ uniform_batch(1.), SimdBatch{}, SimdBatch{} }, slopes, displacement);
    }

  private:
    SPRAG_PART static Triple<Batch> sum(Triple<Batch> result, const Batches<n_nodes> &shares, const Nodal &displacement)
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
      {
        result.x += shares[a] * displacement[dim * a], result.y += shares[a] * displacement[dim * a + 1];
        if constexpr (dim == 3)
          result.z += shares[a] * displacement[dim * a + 2];
      }
      return result;
    }
  };
} // namespace sprag
