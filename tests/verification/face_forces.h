// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/statics/solid_body.h"
#include "model/step/model.h"

#include <array>

namespace sprag
{
  /// Sum of forces at places of the lever, and of their moments about the pivot.
  struct Resultant
  {
    using Vector = dealii::Tensor<1, 3>;

    Vector force, moment;

    void add(const dealii::Point<3> &place, const Vector &at)
    {
      force += at;
      moment += cross_product_3d(Vector(place), at);
    }
  };

  /// Returns the resultants of the forces on the nodes of the face, at their undeformed and at their deformed positions.
  inline std::array<Resultant, 2> forces_on(const SolidBody &body, const State &state)
  {
    std::array<Resultant, 2> result;
    const auto &nodes = body.friction_face().nodes;
    for (unsigned int i = 0; i < state.forces.dofs.size(); ++i)
      if (const unsigned int dof = state.forces.dofs[i]; dof < 3 * nodes.size())
      {
        const auto &place = nodes[dof / 3].position;
        Resultant::Vector force, moved;
        force[dof % 3] = state.forces.values[i];
        for (unsigned int d = 0; d < 3; ++d)
          moved[d] = state.coordinates[dof - dof % 3 + d];
        result[0].add(place, force);
        result[1].add(place + moved, force);
      }
    return result;
  }
} // namespace sprag
