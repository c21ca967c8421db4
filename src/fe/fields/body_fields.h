#pragma once

#include "fe/body/elastic_body.h"

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace sprag
{
  /// Displacement and Cauchy stress at a node, in the axes of the body.
  struct NodalField
  {
    dealii::Tensor<1, 2> displacement;    ///< [mm]
    dealii::SymmetricTensor<2, 2> stress; ///< [MPa]
    double out_of_plane = 0.;             ///< normal stress [MPa]
  };

  /// Returns sqrt(((s1 - s2)^2 + (s2 - s3)^2 + (s3 - s1)^2)/2 + 3 t^2) [MPa].
  double von_mises(const NodalField &node);

  /// Nodes of a body's cells for pictures. A cell of degree p has (p + 1)^2 of them, in p x p quadrilaterals, and shares them
  /// with no other cell, so that each side of a bond has its own stress.
  ///
  /// Strains are found at the Gauss points, where they are most exact, continued to the nodes by the polynomial through them, and
  /// the stresses averaged over the cells of one material that meet in a node (Barlow 1976; Hinton and Campbell 1974). Cells at
  /// the hub are averaged among themselves.
  class BodyFields
  {
  public:
    /// The body must outlive this.
    explicit BodyFields(const ElasticBody<2> &body);

    struct Node
    {
      dealii::Point<2> position; ///< undeformed [mm]
      dealii::types::material_id part;
      bool at_hub; ///< whether its cell touches what is held: there the stress of linear elasticity is singular
    };

    const std::vector<Node> &nodes() const
    {
      return all_nodes;
    }

    /// Returns how many nodes each cell has; nodes() come cell by cell.
    unsigned int nodes_per_cell() const
    {
      return places.size();
    }

    /// Returns the numbers of four nodes for each quadrilateral.
    const std::vector<unsigned int> &quadrilaterals() const
    {
      return quads;
    }

    /// Finds displacement and stress at the nodes by the displacements of the body's degrees of freedom.
    std::vector<NodalField> at(const dealii::Vector<double> &displacement) const;

  private:
    void average(std::vector<NodalField> &nodal) const;

    const ElasticBody<2> &body;
    const dealii::Quadrature<2> places; ///< of the nodes in the unit cell
    std::vector<Node> all_nodes;
    std::vector<unsigned int> quads;
    std::vector<unsigned int> shared; ///< of a node: number of the place in its material that cells have in common
    unsigned int n_shared = 0;
  };
} // namespace sprag
