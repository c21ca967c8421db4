// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_elements.h"

#include <deal.II/base/tensor.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <vector>

namespace sprag
{
  // Two deformable faces that touch: the friction face of the lever and, below it, that of a cylinder (or of any other body), a
  // chain of edges along xi that need not match. The cylinder's axes move with its centre and stay parallel to the lever's, so
  // that its edges stand still below the lever while its material runs through them as the axes turn.
  //
  // A facet is the part of an edge of the lever for which one integration point of the friction face stands; gap and slip of a
  // facet are means over it. They are integrated by segments (mortar): Gauss points between the nodes of the cylinder's face as
  // projected onto the lever, so that forces per facet spread to the nodes of both faces exactly.

  /// Polynomials of the nodes of an edge over 0 ... 1.
  struct EdgeShapes
  {
    std::array<double, 3> values{};
    std::array<double, 3> slopes{};
    std::array<double, 3> bends{}; ///< second derivatives
  };

  /// Returns the polynomials of an edge of 2 or 3 nodes in order at a place from 0 to 1.
  EdgeShapes edge_shapes(unsigned int n_nodes, double place);

  /// An edge of 2 or 3 nodes in order as a parabola over 0 ... 1.
  struct EdgeCurve
  {
    dealii::Tensor<1, 2> origin;
    dealii::Tensor<1, 2> first;  ///< derivative there
    dealii::Tensor<1, 2> second; ///< derivative everywhere

    dealii::Tensor<1, 2> position(const double place) const
    {
      return origin + place * (first + 0.5 * place * second);
    }
    dealii::Tensor<1, 2> slope(const double place) const
    {
      return first + place * second;
    }
  };

  /// The places of both faces.
  struct PairConfiguration
  {
    FaceConfiguration at;                       ///< displacements of the lever's nodes, then of the cylinder's
    dealii::Tensor<1, 2> drive;                 ///< direction of x in lever axes
    std::vector<dealii::Tensor<1, 2>> nodes;    ///< of the cylinder's face, deformed, in lever axes
    std::vector<dealii::Tensor<1, 2>> tangents; ///< between its edges, unit, mean of both sides
  };

  /// A Gauss point of the lever and its closest point on the cylinder, X.
  struct PairPoint
  {
    double weight = 0.;            ///< area [mm^2]
    std::array<double, 3> lever{}; ///< polynomials of the lever's edge
    unsigned int edge = 0;         ///< of the cylinder
    EdgeShapes cylinder;
    dealii::Tensor<1, 2> tangent; ///< of the cylinder, unit, along xi
    dealii::Tensor<1, 2> normal;  ///< out of the cylinder, unit
    double gap         = 0.;      ///< (y - X) . normal [mm]
    double speed       = 0.;      ///< |X'| along the edge, 0 ... 1 [mm]
    double bend_along  = 0.;      ///< X'' . tangent
    double bend_across = 0.;      ///< X'' . normal
    double arc         = 0.;      ///< of the undeformed cylinder, from the first node of its face [mm]
    double arc_speed   = 0.;      ///< its derivative along the edge
    double arc_bend    = 0.;      ///< its second
    double stretch() const        ///< of the cylinder's surface
    {
      return speed / arc_speed;
    }
  };

  /// A place of a facet below which a node between two edges of the cylinder lies. Its two sides differ by kinks.
  struct PairCut
  {
    PairPoint left, right;
    double width = 0.; ///< area of the lever over its edge's parameter [mm^2]
    double speed = 0.; ///< of the lever's edge along the cylinder [mm]
  };

  /// Means over the part of the lever's edge for which a point of its friction face stands.
  struct Facet
  {
    bool opposed           = false; ///< whether all of it lies above the cylinder's face; if not, gap is its distance from that
    double weight          = 0.;    ///< area [mm^2]
    double gap             = 0.;    ///< [mm]
    double arc             = 0.;    ///< where the cylinder's undeformed surface is met, in its axes [mm]
    double stretch         = 1.;    ///< of that surface
    unsigned int begin     = 0;     ///< its Gauss points
    unsigned int end       = 0;
    unsigned int first_cut = 0;
    unsigned int last_cut  = 0; ///< beyond
  };

  /// The facets of a face element, in the order of the points of the friction face.
  struct ElementFacets
  {
    std::vector<Facet> facets;
    std::vector<PairPoint> points;
    std::vector<PairCut> cuts;
  };

  /// Coordinates of the facets of an element: two a node, then theta, then x, the circle's position.
  struct PairCoordinates
  {
    /// Node i has the dofs 2 nodes[i] and 2 nodes[i] + 1: the lever's first, three or two nodes, then those of the cylinder's
    /// face from `first` on. FaceEdge::held for nodes that do not move.
    std::vector<unsigned int> nodes;
    unsigned int n_lever = 0;
    unsigned int first   = 0; ///< along the chain
    unsigned int degree  = 1; ///< of the chain

    unsigned int theta() const
    {
      return 2 * static_cast<unsigned int>(nodes.size());
    }
    unsigned int x() const
    {
      return theta() + 1;
    }
    unsigned int size() const
    {
      return theta() + 2;
    }
  };

  /// A place on the cylinder's face.
  struct PairPlace
  {
    unsigned int edge = 0;
    double along      = 0.5; ///< 0 ... 1
  };

  /// Gaps and slips between the facets of a lever's face and the closest edges of a cylinder's face.
  class FacePair
  {
  public:
    /// Throws InputError if the edges of the cylinder's face are no chain along xi.
    FacePair(const FrictionFace<2> &lever, const FrictionFace<2> &cylinder);

    PairConfiguration configuration(const FaceConfiguration &at) const;

    /// Smallest gap at the ends and in the middle of an element, less a margin for its bending [mm]. `place` is where on the
    /// cylinder to look first, and then where the element was found.
    double smallest_gap(unsigned int element, const PairConfiguration &at, PairPlace &place) const;

    void find_facets(unsigned int element, const PairConfiguration &at, ElementFacets &result) const;

    /// Coordinates of an element and of the cylinder's edges that its facets touch, in some configurations.
    PairCoordinates coordinates(unsigned int element, std::initializer_list<const ElementFacets *> facets) const;

  private:
    using Vector2 = dealii::Tensor<1, 2>;
    using Nodes   = std::array<Vector2, 3>;

    /// A side of a cell on a face.
    struct Edge
    {
      unsigned int n_nodes = 0;
      std::array<unsigned int, 3> nodes{}; ///< as in PairCoordinates
      Nodes positions;                     ///< undeformed
      EdgeCurve undeformed;
    };
    /// A side on the lever's face.
    struct LeverEdge : Edge
    {
      unsigned int n_facets = 0;
      double width          = 0.;
    };
    /// A side on the cylinder's face.
    struct CylinderEdge : Edge
    {
      double arc = 0.; ///< where it begins
    };
    /// Part of a facet above one edge of the cylinder, along the edge of the lever.
    struct Segment
    {
      double from;
      double to;
    };

    static Edge copy(const FaceEdge<2> &edge, unsigned int first_node);
    static Nodes deformed(const Edge &edge, const dealii::Vector<double> &displacements);
    static EdgeCurve edge_curve(unsigned int n_nodes, const Vector2 *nodes);

    static EdgeCurve deformed_curve(const Edge &edge, const dealii::Vector<double> &displacements)
    {
      return edge_curve(edge.n_nodes, deformed(edge, displacements).data());
    }

    static void average(const ElementFacets &element_facets, Facet &facet);

    /// Signed distance of a position along xi from a vertex of the chain.
    double beyond(const Vector2 &position, const unsigned int vertex, const PairConfiguration &at) const
    {
      return (position - at.nodes[vertex * degree]) * at.tangents[vertex];
    }

    /// Returns how far a position lies beside the whole chain, <= 0 above it [mm].
    double outside(const Vector2 &position, const PairConfiguration &at) const
    {
      return std::max(-beyond(position, 0, at), beyond(position, static_cast<unsigned int>(chain.size()), at));
    }

    void go_to(const Vector2 &position, const PairConfiguration &at, PairPlace &place) const;
    double vertex_above(unsigned int vertex, const EdgeCurve &curve, const PairConfiguration &at, const Segment &within) const;
    PairPoint project(const Vector2 &position, const PairConfiguration &at, PairPlace &place) const;
    PairPoint point_above(const LeverEdge &edge, const EdgeCurve &curve, const PairConfiguration &at, double place_on_lever,
                          PairPlace &place) const;
    void add_segment(const LeverEdge &edge, const EdgeCurve &curve, const PairConfiguration &at, const Segment &segment,
                     PairPlace &place, ElementFacets &result) const;

    void add_cut(const LeverEdge &edge, const EdgeCurve &curve, const PairConfiguration &at, double place_on_lever,
                 PairPlace &place, ElementFacets &result) const;

    std::vector<LeverEdge> lever;
    std::vector<CylinderEdge> chain;
    unsigned int degree = 1; ///< of the chain
    double length       = 0.;
  };
} // namespace sprag
