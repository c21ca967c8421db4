// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"
#include "fe/body/friction_face.h"
#include "fe/statics/solid_body.h"

#include <deal.II/base/symmetric_tensor.h>

#include <functional>
#include <vector>

namespace sprag
{
  /// The points of a friction face that /face and pictures show: in a plane its integration points, in a line, in space the means
  /// over parts of its cells (FaceParts), with quadrilaterals between them.
  class FieldFace
  {
  public:
    explicit FieldFace(const FrictionFace<2> &face);
    explicit FieldFace(const FrictionFace<3> &face);

    /// Displacement of a point in the axes of the body, by those of its degrees of freedom [mm].
    dealii::Tensor<1, 3> moved(unsigned int point, const dealii::Vector<double> &displacement) const;

    unsigned int points_per_cell;
    std::vector<dealii::Point<3>> points; ///< undeformed [mm]
    std::vector<unsigned int> cells;      ///< numbers of points: two for each line, four for each quadrilateral
    std::vector<unsigned int> first_line; ///< points of the line with the lowest zeta, along xi; none in a plane

  private:
    template <int dim>
    void read(const FrictionFace<dim> &face, const std::vector<unsigned int> &indices, const std::vector<double> &share);
    void join_lines();

    std::vector<std::array<unsigned int, 3>> dofs;                    ///< of the nodes; in a plane the last has none
    std::vector<std::vector<std::pair<unsigned int, double>>> movers; ///< of a point: nodes, and how much they move it
  };

  /// Displacement and Cauchy stress at a node, in the axes of the body.
  struct NodalField
  {
    dealii::Tensor<1, 3> displacement;    ///< [mm]
    dealii::SymmetricTensor<2, 3> stress; ///< [MPa]
  };

  /// Returns sqrt(((s1 - s2)^2 + (s2 - s3)^2 + (s3 - s1)^2)/2 + 3 (t12^2 + t23^2 + t31^2)) [MPa].
  double von_mises(const NodalField &node);

  /// Nodes of a body's elements for pictures, and fields there. A body in a plane lies at zeta = 0. An element of degree p has
  /// (p + 1)^dim nodes, in p^dim quadrilaterals or hexahedra, and shares them with its neighbours of the same material, so that
  /// each side of a bond has its own stress.
  ///
  /// Strains are found at the Gauss points, where they are most exact, continued to the nodes by the polynomial through them, and
  /// the stresses averaged over the elements of one material that meet in a node (Barlow 1976; Hinton and Campbell 1974).
  /// Elements at the hub are averaged among themselves.
  class BodyFields
  {
  public:
    /// The body must outlive this.
    explicit BodyFields(const ElasticBody<2> &body);
    explicit BodyFields(const SolidBody &body);

    /// With a part of the body's face.
    BodyFields(const SolidBody &body, const FrictionFace<3> &face);

    /// A node of the pictured elements.
    struct Node
    {
      dealii::Point<3> position; ///< undeformed [mm]
      dealii::types::material_id part;
      bool at_hub; ///< whether its element touches what is held: there the stress of linear elasticity is singular
    };

    std::vector<Node> nodes;
    std::vector<unsigned int> elements;      ///< numbers of the nodes of each element, one element after another
    std::vector<unsigned int> element_cells; ///< of each cell of an element the places of its corners among the element's nodes
    unsigned int nodes_per_element = 0;
    bool is_in_space;
    bool is_half = false; ///< whether the body is a half in space, whose other half is its mirror image
    FieldFace face;

    /// Returns 4 for quadrilaterals, 8 for hexahedra.
    unsigned int nodes_per_cell() const
    {
      return is_in_space ? 8 : 4;
    }

    /// Finds displacement and stress at the nodes by the displacements of the body's degrees of freedom. Of a body in space the
    /// ranks at hand find the stress together.
    std::vector<NodalField> at(const dealii::Vector<double> &displacement) const;

    /// Takes part in what the first rank finds of such a body.
    void take_part() const;

    /// Finds the displacement alone.
    std::vector<dealii::Tensor<1, 3>> moved(const dealii::Vector<double> &displacement) const;

  private:
    using StressSums = std::vector<dealii::SymmetricTensor<2, 3>>;

    template <int dim, class AnyBody>
    void read(const AnyBody &body);
    StressSums stress_sums(dealii::Vector<double> displacement) const;

    const BodyCalls *calls       = nullptr; ///< of a body in space, of which each rank finds a part
    MPI_Comm ranks               = MPI_COMM_SELF;
    unsigned int n_displacements = 0;              ///< of the body
    std::vector<std::array<unsigned int, 3>> dofs; ///< of the nodes; in a plane the last has none
    std::vector<unsigned int> sharing;             ///< number of elements that meet in a node

    /// Adds the stress of the elements of this rank at their nodes.
    using AddStress =
        std::function<void(const dealii::Vector<double> &, const std::vector<unsigned int> &, MPI_Comm, StressSums &)>;
    AddStress add_stress;
  };
} // namespace sprag
