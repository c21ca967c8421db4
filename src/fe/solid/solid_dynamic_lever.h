// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/solid_contact.h"
#include "fe/solid/solid_dynamics.h"
#include "model/dynamic_lever.h"
#include "model/mirrored_ports.h"

#include <algorithm>

namespace sprag
{
  /// A condensed lever in three dimensions, or a pair of them, which tells shapes of modes along an edge of the whole face, by
  /// the modes of the free lever. What these leave out is the dent of the layer under the cylinder. Structure and Contact: see
  /// DynamicLever.
  template <class Structure, class Contact>
  class SolidDynamicLever : public DynamicLever<Structure, Contact>
  {
    using Base = DynamicLever<Structure, Contact>;

  public:
    /// `lever` must outlive this.
    SolidDynamicLever(std::unique_ptr<Structure> structure, std::unique_ptr<Contact> contact, LeverFrame frame,
                      const SolidInTime &lever_)
        : Base(std::move(structure), std::move(contact), std::move(frame))
        , lever(lever_)
        , structures(modes_of_structures(lever, Structure::levers))
    {
    }

    ModeShape mode_shape(const Eigenmode &mode) const override
    {
      const auto nodes = nodes_of_edge();
      ModeShape result = Base::mode_shape(mode);
      result.xi.clear();
      for (const auto *node : nodes)
        result.xi.push_back(node->position[0]);
      for (unsigned int index = 0; index < Structure::levers; ++index)
        for (unsigned int i = 0; i < 2; ++i)
        {
          const auto moved = [&](const unsigned int d)
          {
            std::vector<double> values;
            for (const auto *node : nodes)
              values.push_back(moved_by(mode.mode.coordinates[i], index, node->dofs[d]));
            return values;
          };
          auto &shape       = result.levers.at(index);
          shape.along[i]    = moved(0);
          shape.across[i]   = moved(1);
          shape.sideways[i] = moved(2);
        }
      return result;
    }

  private:
    using Node = FaceNode<3>;

    const SolidInTime &lever;
    const std::vector<const SolidModes *> structures;

    std::vector<const Node *> nodes_of_edge() const
    {
      const auto &nodes     = lever.body->friction_face().nodes;
      const auto is_farther = [](const Node &a, const Node &b) { return a.position[2] < b.position[2]; };
      const double edge     = std::max_element(nodes.begin(), nodes.end(), is_farther)->position[2];
      std::vector<const Node *> result;
      for (const auto &node : nodes)
        if (node.position[2] > edge - 1e-6)
          result.push_back(&node);
      return result;
    }

    /// Of a lever, see MirroredStructure.
    double moved_by(const dealii::Vector<double> &coordinates, const unsigned int index, const unsigned int dof) const
    {
      const auto n  = static_cast<unsigned int>(coordinates.size() / structures.size());
      double result = 0.;
      for (unsigned int part = 0; part < structures.size(); ++part)
      {
        const auto &displacements = structures[part]->displacements;
        const double sign         = part == 1 && index == 1 ? -1. : 1.;
        for (unsigned int j = 0; j < std::min<std::size_t>(n, displacements.size()); ++j)
          result += sign * coordinates[part * n + j] * displacements[j][dof];
      }
      return structures.size() == 2 ? MirroredPorts::share() * result : result;
    }
  };
} // namespace sprag
