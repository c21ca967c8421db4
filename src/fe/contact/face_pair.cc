// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_pair.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    constexpr double gauss_points[] = { 0.5 * (1. - 0.577350269189625764509), 0.5 * (1. + 0.577350269189625764509) };

    /// The round-off of the place of a point at the end of a face, over the face's length.
    constexpr double round_off = 1e-10;

    /// Returns the arc from the beginning of an edge to a place on it, by 3 Gauss points: exact to the fourth power of its angle.
    double arc_to(const double place, const EdgeCurve &edge)
    {
      constexpr double off = 0.774596669241483377036;
      double result        = 0.;
      for (const auto &[point, weight] : { std::pair{ -off, 5. / 18. }, { 0., 8. / 18. }, { off, 5. / 18. } })
        result += weight * edge.slope(0.5 * place * (1. + point)).norm();
      return place * result;
    }
  } // namespace

  EdgeShapes edge_shapes(const unsigned int n_nodes, const double s)
  {
    if (n_nodes == 2)
      return { { { 1. - s, s, 0. } }, { { -1., 1., 0. } }, {} };
    return { { { (1. - s) * (1. - 2. * s), 4. * s * (1. - s), s * (2. * s - 1.) } },
             { { 4. * s - 3., 4. - 8. * s, 4. * s - 1. } },
             { { 4., -8., 4. } } };
  }

  FacePair::FacePair(const FrictionFace<2> &lever_face, const FrictionFace<2> &cylinder_face)
  {
    for (std::size_t i = 0; i < lever_face.edges.size(); ++i)
    {
      const auto &element = lever_face.elements[i];
      LeverEdge edge{ copy(lever_face.edges[i], 0), element.end - element.begin, 0. };
      const double first = gauss_points[0] * 2. / edge.n_facets;
      edge.width         = lever_face.points[element.begin].weight * edge.n_facets / edge.undeformed.slope(first).norm();
      lever.push_back(edge);
    }
    for (const auto &edge : cylinder_face.edges)
    {
      chain.push_back({ copy(edge, static_cast<unsigned int>(lever_face.nodes.size())), length });
      length += arc_to(1., chain.back().undeformed);
    }
    if (chain.empty())
      throw InputError("the elastic cylinder has no face that could touch the lever");
    degree = chain.front().n_nodes - 1;
    for (std::size_t i = 1; i < chain.size(); ++i)
      if ((chain[i].positions[0] - chain[i - 1].positions[degree]).norm() > round_off * length)
        throw InputError("the elastic cylinder's face is no chain of edges along the lever");
  }

  FacePair::Edge FacePair::copy(const FaceEdge<2> &edge, const unsigned int first_node)
  {
    Edge result;
    result.n_nodes = static_cast<unsigned int>(edge.nodes.size());
    if (result.n_nodes > 3)
      throw AnalysisError("contact of two meshes is limited to elements of degree 2");
    for (unsigned int a = 0; a < result.n_nodes; ++a)
    {
      const unsigned int index = edge.nodes[a].index;
      result.positions[a]      = edge.nodes[a].position;
      result.nodes[a]          = index == FaceEdge<2>::held ? index : first_node + index;
    }
    result.undeformed = edge_curve(result.n_nodes, result.positions.data());
    return result;
  }

  FacePair::Nodes FacePair::deformed(const Edge &edge, const Vector<double> &displacements)
  {
    Nodes result = edge.positions;
    for (unsigned int a = 0; a < edge.n_nodes; ++a)
      if (edge.nodes[a] != FaceEdge<2>::held)
        for (unsigned int d = 0; d < 2; ++d)
          result[a][d] += displacements[2 * edge.nodes[a] + d];
    return result;
  }

  EdgeCurve FacePair::edge_curve(const unsigned int n_nodes, const Vector2 *const nodes)
  {
    const Vector2 to_next = nodes[1] - nodes[0];
    if (n_nodes == 2)
      return { nodes[0], to_next, {} };
    const Vector2 to_last = nodes[2] - nodes[0];
    return { nodes[0], 4. * to_next - to_last, 4. * to_last - 8. * to_next };
  }

  PairConfiguration FacePair::configuration(const FaceConfiguration &at) const
  {
    PairConfiguration result{ at, Vector2({ std::cos(at.theta), -std::sin(at.theta) }), {}, {} };
    const Tensor<1, 2> centre({ at.centre.xi, at.centre.eta });
    result.nodes.reserve(chain.size() * degree + 1);
    result.tangents.resize(chain.size() + 1);
    for (std::size_t i = 0; i < chain.size(); ++i)
    {
      const auto nodes = deformed(chain[i], *at.displacement);
      for (unsigned int a = i == 0 ? 0 : 1; a <= degree; ++a)
        result.nodes.push_back(centre + nodes[a]);
      const auto curve = edge_curve(degree + 1, nodes.data());
      for (const unsigned int end : { 0, 1 })
      {
        const auto slope = curve.slope(end);
        result.tangents[i + end] += slope / slope.norm();
      }
    }
    for (auto &tangent : result.tangents)
      tangent /= tangent.norm();
    return result;
  }

  /// Moves `place` to the edge below a position; from one edge to a neighbour at the near end.
  void FacePair::go_to(const Vector2 &position, const PairConfiguration &at, PairPlace &place) const
  {
    const unsigned int from = place.edge;
    while (place.edge + 1 < chain.size() && beyond(position, place.edge + 1, at) > 0.)
      ++place.edge;
    while (place.edge > 0 && beyond(position, place.edge, at) < 0.)
      --place.edge;
    if (place.edge != from)
      place.along = 0.5;
  }

  /// Closest point on the edge at `place`, by Newton's method; the edge is continued beyond its ends where kinks leave a wedge.
  PairPoint FacePair::project(const Vector2 &position, const PairConfiguration &at, PairPlace &place) const
  {
    constexpr unsigned int most_iterations = 30;
    const unsigned int n                   = degree + 1;
    const auto curve                       = edge_curve(n, &at.nodes[place.edge * degree]);
    const auto &bend                       = curve.second;
    Vector2 apart, slope;
    const auto set = [&]
    {
      apart = position - curve.position(place.along);
      slope = curve.slope(place.along);
    };
    for (unsigned int i = 0; i < most_iterations; ++i)
    {
      set();
      const double change = apart * slope / (slope * slope - apart * bend);
      place.along         = std::clamp(place.along + change, -1., 2.);
      // Convergence is quadratic, so that the remaining error is round-off.
      if (std::abs(change) < 1e-6)
        break;
    }
    set();

    PairPoint point;
    point.edge        = place.edge;
    point.cylinder    = edge_shapes(n, place.along);
    point.speed       = slope.norm();
    point.tangent     = slope / point.speed;
    point.normal      = Vector2({ -point.tangent[1], point.tangent[0] });
    point.gap         = apart * point.normal;
    point.bend_along  = bend * point.tangent;
    point.bend_across = bend * point.normal;
    const auto &edge  = chain[place.edge];
    const auto before = edge.undeformed.slope(place.along);
    point.arc         = edge.arc + arc_to(place.along, edge.undeformed);
    point.arc_speed   = before.norm();
    point.arc_bend    = before * edge.undeformed.second / point.arc_speed;
    return point;
  }

  /// Finds where along the lever's edge a vertex of the cylinder lies below it.
  double FacePair::vertex_above(const unsigned int vertex, const EdgeCurve &curve, const PairConfiguration &at,
                                const Segment &within) const
  {
    const auto value = [&](const double s) { return beyond(curve.position(s), vertex, at); };
    const auto slope = [&](const double s) { return curve.slope(s) * at.tangents[vertex]; };
    double s         = 0.5 * (within.from + within.to);
    for (unsigned int i = 0; i < 30; ++i)
    {
      const double change = -value(s) / slope(s);
      s                   = std::clamp(s + change, within.from, within.to);
      if (std::abs(change) < 1e-8 * (within.to - within.from))
        break;
    }
    return s;
  }

  /// Finds the point of the pair at a place on the lever. Its weight is the area over the lever's parameter.
  PairPoint FacePair::point_above(const LeverEdge &edge, const EdgeCurve &curve, const PairConfiguration &at,
                                  const double place_on_lever, PairPlace &place) const
  {
    auto point   = project(curve.position(place_on_lever), at, place);
    point.lever  = edge_shapes(edge.n_nodes, place_on_lever).values;
    point.weight = edge.width * edge.undeformed.slope(place_on_lever).norm();
    return point;
  }

  void FacePair::add_segment(const LeverEdge &edge, const EdgeCurve &curve, const PairConfiguration &at, const Segment &segment,
                             PairPlace &place, ElementFacets &result) const
  {
    const double segment_length = segment.to - segment.from;
    for (const double gauss : gauss_points)
    {
      result.points.push_back(point_above(edge, curve, at, segment.from + gauss * segment_length, place));
      result.points.back().weight *= 0.5 * segment_length;
    }
  }

  /// Adds a cut at the vertex beyond the edge in `place`, which is left for the next.
  void FacePair::add_cut(const LeverEdge &edge, const EdgeCurve &curve, const PairConfiguration &at, const double place_on_lever,
                         PairPlace &place, ElementFacets &result) const
  {
    PairCut cut;
    cut.left  = point_above(edge, curve, at, place_on_lever, place);
    place     = { place.edge + 1, 0. };
    cut.right = point_above(edge, curve, at, place_on_lever, place);
    cut.width = cut.left.weight;
    cut.speed = curve.slope(place_on_lever) * at.tangents[place.edge];
    result.cuts.push_back(cut);
  }

  void FacePair::find_facets(const unsigned int element, const PairConfiguration &at, ElementFacets &result) const
  {
    const auto &edge     = lever[element];
    const auto curve     = deformed_curve(edge, *at.at.displacement);
    const double rounded = round_off * length;
    result.facets.clear();
    result.points.clear();
    result.cuts.clear();
    Vector2 begin = curve.position(0.);
    PairPlace place;
    place.edge = static_cast<unsigned int>(chain.size() / 2);
    for (unsigned int i = 0; i < edge.n_facets; ++i)
    {
      const auto end = curve.position((i + 1.) / edge.n_facets);
      Facet facet;
      facet.begin        = static_cast<unsigned int>(result.points.size());
      facet.first_cut    = static_cast<unsigned int>(result.cuts.size());
      const double aside = std::max(outside(begin, at), outside(end, at));
      if (aside > rounded)
        facet.gap = aside;
      else
      {
        facet.opposed = true;
        go_to(begin, at, place);
        Segment rest{ static_cast<double>(i) / edge.n_facets, (i + 1.) / edge.n_facets };
        while (place.edge + 1 < chain.size() && beyond(end, place.edge + 1, at) > rounded)
        {
          const double cut = vertex_above(place.edge + 1, curve, at, rest);
          add_segment(edge, curve, at, { rest.from, cut }, place, result);
          add_cut(edge, curve, at, cut, place, result);
          rest.from = cut;
        }
        add_segment(edge, curve, at, rest, place, result);
      }
      facet.end      = static_cast<unsigned int>(result.points.size());
      facet.last_cut = static_cast<unsigned int>(result.cuts.size());
      average(result, facet);
      result.facets.push_back(facet);
      begin = end;
    }
  }

  void FacePair::average(const ElementFacets &element_facets, Facet &facet)
  {
    if (!facet.opposed)
      return;
    double stretch = 0.;
    for (unsigned int p = facet.begin; p < facet.end; ++p)
    {
      const auto &point = element_facets.points[p];
      facet.weight += point.weight;
      facet.gap += point.weight * point.gap;
      facet.arc += point.weight * point.arc;
      stretch += point.weight * point.stretch();
    }
    facet.gap /= facet.weight;
    facet.arc /= facet.weight;
    facet.stretch = stretch / facet.weight;
  }

  double FacePair::smallest_gap(const unsigned int element, const PairConfiguration &at, PairPlace &place) const
  {
    const auto curve = deformed_curve(lever[element], *at.at.displacement);
    double smallest  = std::numeric_limits<double>::max();
    for (const double s : { 0., 0.5, 1. })
    {
      const auto position = curve.position(s);
      if (const double aside = outside(position, at); aside > 0.)
      {
        smallest = std::min(smallest, length + aside);
        continue;
      }
      go_to(position, at, place);
      smallest = std::min(smallest, project(position, at, place).gap);
    }
    return smallest - 0.02 * (curve.position(1.) - curve.origin).norm();
  }

  PairCoordinates FacePair::coordinates(const unsigned int element,
                                        const std::initializer_list<const ElementFacets *> facets) const
  {
    PairCoordinates result;
    const auto &edge = lever[element];
    result.n_lever   = edge.n_nodes;
    result.degree    = degree;
    result.nodes.assign(edge.nodes.begin(), edge.nodes.begin() + edge.n_nodes);
    auto first        = static_cast<unsigned int>(chain.size());
    unsigned int last = 0;
    for (const auto *const element_facets : facets)
      for (const auto &point : element_facets->points)
      {
        first = std::min(first, point.edge);
        last  = std::max(last, point.edge);
      }
    result.first = first * degree;
    for (unsigned int e = first; e < chain.size() && e <= last; ++e)
      result.nodes.insert(result.nodes.end(), chain[e].nodes.begin() + (e == first ? 0 : 1), chain[e].nodes.begin() + degree + 1);
    return result;
  }
} // namespace sprag
