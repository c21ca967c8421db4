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

  /// sqrt(((s1 - s2)^2 + (s2 - s3)^2 + (s3 - s1)^2)/2 + 3 t^2) [MPa].
  double von_mises(const NodalField &node);

  /// Nodes of a body's cells for pictures: (p + 1)^2 a cell of degree p, which it shares with no other, so that each side of a
  /// bond has its own stress, in p x p quadrilaterals.
  class BodyFields
  {
  public:
    /// The body must outlive it.
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

    /// Cell by cell, so many each.
    unsigned int nodes_per_cell() const;

    /// Four nodes each.
    const std::vector<unsigned int> &quadrilaterals() const
    {
      return quads;
    }

    std::vector<NodalField> at(const dealii::Vector<double> &displacement) const;

  private:
    const ElasticBody<2> &body;
    const dealii::Quadrature<2> places; ///< of the nodes in the unit cell
    std::vector<Node> all_nodes;
    std::vector<unsigned int> quads;
  };
} // namespace sprag
