// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/body_properties.h"

#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <utility>
#include <vector>

namespace sprag
{
  /// A free node of the friction face.
  template <int dim>
  struct FaceNode
  {
    dealii::Point<dim> position; ///< undeformed [mm]
    std::array<unsigned int, dim> dofs;
  };

  /// Most free nodes of a cell's face, which has degree 2.
  template <int dim>
  constexpr unsigned int most_face_nodes = dim == 2 ? 3 : 9;

  /// An integration point of the friction face.
  template <int dim>
  struct FacePoint
  {
    dealii::Point<dim> position;                       ///< undeformed [mm]
    double weight;                                     ///< area of the face that it represents [mm^2]
    std::array<double, most_face_nodes<dim>> shapes{}; ///< of the element's nodes
    std::array<double, most_face_nodes<dim>> slopes{}; ///< of these shapes along the first axis [1/mm]
  };

  /// The points of one cell's face, with the nodes that move them.
  template <int dim>
  struct FaceElement
  {
    unsigned int begin;                                     ///< index of the first point
    unsigned int end;                                       ///< beyond the last
    double length;                                          ///< along the first axis [mm]
    unsigned int n_nodes = 0;                               ///< free ones
    std::array<unsigned int, most_face_nodes<dim>> nodes{}; ///< their indices
  };

  /// All nodes of one cell's face, ordered along the first axis, then the last.
  template <int dim>
  struct FaceEdge
  {
    static constexpr unsigned int held = dealii::numbers::invalid_unsigned_int;

    /// A node of the edge.
    struct Node
    {
      dealii::Point<dim> position; ///< undeformed [mm]
      unsigned int index;          ///< among the free nodes, or `held`
    };
    std::vector<Node> nodes;
  };

  /// The face where a body can be touched.
  template <int dim>
  struct FrictionFace
  {
    std::vector<FaceNode<dim>> nodes;   ///< in three dimensions ordered along the first axis, then the last
    std::vector<FacePoint<dim>> points; ///< element by element, ordered along the first axis, then the last
    std::vector<FaceElement<dim>> elements;
    std::vector<FaceEdge<dim>> edges; ///< of the elements
    double young_modulus = 0.;        ///< largest of its cells [MPa]
    double depth         = 0.;        ///< largest size of its cells normal to the face [mm]
  };

  /// Returns the degrees of freedom of the nodes of a face, one a direction.
  template <int dim>
  std::vector<unsigned int> face_dofs(const FrictionFace<dim> &face)
  {
    std::vector<unsigned int> result;
    for (const auto &node : face.nodes)
      result.insert(result.end(), node.dofs.begin(), node.dofs.end());
    return result;
  }

  /// Returns the indices of places line by line, ordered along the first axis: in three dimensions a line for each place along
  /// the last axis, in a plane one.
  template <int dim>
  std::vector<std::vector<unsigned int>> lines_along(const std::vector<dealii::Point<dim>> &places);

  /// Returns those of the nodes of a face, lines of three or more.
  template <int dim>
  std::vector<std::vector<unsigned int>> lines_along(const FrictionFace<dim> &face);

  /// Reads the faces marked `boundary`. The integration points are denser than the nodes, about
  /// `BodyProperties::point_spacing` apart, so that a contact narrower than a cell has its resultant in the right place and
  /// direction; at most 48 a cell.
  template <int dim>
  FrictionFace<dim> find_friction_face(const dealii::Mapping<dim> &mapping, const dealii::DoFHandler<dim> &dof_handler,
                                       const dealii::AffineConstraints<double> &constraints, const BodyProperties &properties,
                                       dealii::types::boundary_id boundary);
} // namespace sprag
