// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"
#include "fe/fields/field_face.h"
#include "fe/solid/solid_body.h"

#include <deal.II/base/symmetric_tensor.h>

#include <functional>
#include <vector>

namespace sprag
{
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

    struct Node
    {
      dealii::Point<3> position; ///< undeformed [mm]
      dealii::types::material_id part;
      bool at_hub; ///< whether its element touches what is held: there the stress of linear elasticity is singular
    };

    const std::vector<Node> &nodes() const
    {
      return all_nodes;
    }

    /// Returns the numbers of the nodes of each element, one element after another.
    const std::vector<unsigned int> &elements() const
    {
      return nodes_of_elements;
    }

    unsigned int nodes_per_element() const
    {
      return n_places;
    }

    /// Returns the cells of an element: for each of them the places of its corners among the element's nodes.
    const std::vector<unsigned int> &cells_of_element() const
    {
      return corners;
    }

    /// Returns 4 for quadrilaterals, 8 for hexahedra.
    unsigned int nodes_per_cell() const
    {
      return in_space ? 8 : 4;
    }

    bool is_in_space() const
    {
      return in_space;
    }

    /// Whether it is a half of one in space, whose other half is its mirror image.
    bool is_half() const
    {
      return of_half;
    }

    const FieldFace &face() const
    {
      return of_face;
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
    StressSums sums_of_stress(dealii::Vector<double> displacement) const;

    bool in_space;
    bool of_half = false;
    FieldFace of_face;
    const BodyCalls *calls       = nullptr; ///< of a body in space, of which each rank finds a part
    MPI_Comm ranks               = MPI_COMM_SELF;
    unsigned int n_displacements = 0; ///< of the body
    unsigned int n_places        = 0; ///< of nodes in an element
    std::vector<Node> all_nodes;
    std::vector<std::array<unsigned int, 3>> dofs; ///< of the nodes; in a plane the last has none
    std::vector<unsigned int> nodes_of_elements;
    std::vector<unsigned int> corners;
    std::vector<unsigned int> sharing; ///< number of elements that meet in a node

    /// Adds the stress of the elements of this rank at their nodes.
    using AddStress =
        std::function<void(const dealii::Vector<double> &, const std::vector<unsigned int> &, MPI_Comm, StressSums &)>;
    AddStress add_stress;
  };
} // namespace sprag
