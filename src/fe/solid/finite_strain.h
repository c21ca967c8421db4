// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/solid_body.h"
#include "fe/solid/stiffness_product.h"
#include "model/port_forces.h"

namespace sprag
{
  /// Returns the degree of freedom of a port of the body's face, three ports a node.
  inline unsigned int dof_of_port(const SolidBody &body, const unsigned int port)
  {
    return body.friction_face().nodes[port / 3].dofs[port % 3];
  }

  /// A body at finite strain under forces f on its friction face, by the factors of its stiffness K without load: what its
  /// internal forces R differ from K u by are loads,
  ///   u = K^-1 (f + K u - R(u)).
  /// Displacements u are those of all degrees of freedom [mm]. Of the first rank.
  class FiniteStrain
  {
  public:
    /// The body must outlive this.
    explicit FiniteStrain(const SolidBody &body);

    /// Returns by how much a displacement falls short of what its own strain and the forces make of it,
    /// K^-1 (f + K u - R(u)) - u. Throws AnalysisError where an element turned inside out.
    dealii::Vector<double> unbalance(const dealii::Vector<double> &displacement, const PortLoads &on_face);

    /// Returns the correction by an unbalance and a change of the forces that goes with it.
    dealii::Vector<double> correction(const dealii::Vector<double> &unbalance, const PortLoads &change) const;

  private:
    struct Cell
    {
      dealii::DoFHandler<3>::active_cell_iterator cell;
      std::vector<dealii::types::global_dof_index> dofs;
    };

    const dealii::Vector<double> &of(const Cell &cell, const dealii::Vector<double> &displacement);
    void add(const PortLoads &on_face, std::vector<double> &loads) const;

    const SolidBody &body;
    const StiffnessProduct stiffness; ///< of the cells, without load
    CellElasticity<3> elasticity;
    std::vector<Cell> cells;
    dealii::Vector<double> of_cell;
  };
} // namespace sprag
