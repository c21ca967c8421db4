// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_pair_rows.h"

#include "face_chain.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;
  using Full   = dealii::FullMatrix<double>;

  const Geometry geometry{ 6., 3., 12., 2.75 };
  const double width = 4.;

  dealii::Point<2> on_circle(const double angle)
  {
    return { geometry.cylinder_radius * std::sin(angle), geometry.cylinder_radius * std::cos(angle) };
  }

  /// A straight face at eta = 3 from xi = 8 to 16 on an arc of +-0.5 rad of the cylinder, edges of 0.4 mm on some of 0.29 mm.
  struct Faces
  {
    FrictionFace<2> lever    = face_along([](double xi) { return dealii::Point<2>(xi, 3.); }, divide(8., 16., 20), 2, 4, width);
    FrictionFace<2> cylinder = face_along(on_circle, divide(-0.5, 0.5, 21), 2, 4, width);
    FacePair pair{ lever, cylinder };

    unsigned int n_nodes() const
    {
      return static_cast<unsigned int>(lever.nodes.size() + cylinder.nodes.size());
    }
  };

  /// Two entries a node, then theta and x: polynomials of degree 2, which the edges follow without kinks.
  Vector smooth(const Faces &faces, const double theta, const double x)
  {
    Vector q(2 * faces.n_nodes() + 2);
    unsigned int i = 0;
    for (const auto *const face : { &faces.lever, &faces.cylinder })
      for (const auto &node : face->nodes)
      {
        const double at = node.position[0] - (face == &faces.lever ? 12. : 0.);
        q[i++]          = face == &faces.lever ? 0.01 * at : -0.02 * at;
        q[i++]          = face == &faces.lever ? -0.03 + 0.002 * at * at : 0.01 * at;
      }
    q[i++] = theta;
    q[i]   = x;
    return q;
  }

  PairConfiguration configuration(const Faces &faces, const Vector &q)
  {
    const unsigned int n = 2 * faces.n_nodes();
    return faces.pair.configuration({ &q, q[n], q[n + 1], cylinder_centre(geometry, q[n + 1], q[n]) });
  }

  /// Returns the elements of the lever within reach of the cylinder.
  std::vector<unsigned int> near(const Faces &faces, const PairConfiguration &at)
  {
    PairPlace place;
    std::vector<unsigned int> result;
    for (unsigned int element = 0; element < faces.lever.elements.size(); ++element)
      if (faces.pair.smallest_gap(element, at, place) < 0.)
        result.push_back(element);
    return result;
  }

  /// Index among q of a coordinate of an element.
  unsigned int index(const Faces &faces, const PairCoordinates &coordinates, const unsigned int i)
  {
    return i < coordinates.theta() ? 2 * coordinates.nodes[i / 2] + i % 2 : 2 * faces.n_nodes() + i - coordinates.theta();
  }
} // namespace

// Below 2e-6 mm of movement. Where a facet lies above a vertex, kinks of a^3/2 of edges of an angle 2 a count: the derivative of
// the slip row leaves out kink * gap (7e-7 mm) times what the vertex moves, some 20 * 4^2 / 0.29^2 mm^-2; entries are up to 20.
TEST(FacePair, RowsAndCurvaturesAreDerivatives)
{
  const Faces faces;
  const double R         = geometry.cylinder_radius;
  unsigned int crossings = 0;
  for (const double theta : { 0.015, 0.02 })
  {
    Vector q            = smooth(faces, theta, 0.3);
    const auto at       = configuration(faces, q);
    const auto elements = near(faces, at);
    ASSERT_GT(elements.size(), 1u);
    for (const unsigned int element : elements)
    {
      ElementFacets element_facets, other;
      faces.pair.find_facets(element, at, element_facets);
      const auto coordinates = faces.pair.coordinates(element, { &element_facets });
      for (unsigned int f = 0; f < element_facets.facets.size(); ++f)
      {
        if (!element_facets.facets[f].opposed)
          continue;
        const bool crosses = element_facets.facets[f].end - element_facets.facets[f].begin > 2;
        crossings += crosses ? 1 : 0;
        const double gap_tolerance  = crosses ? 3e-5 : 3e-6;
        const double slip_tolerance = crosses ? 3e-3 : 3e-6;
        FacetRows rows, moved;
        find_rows(element_facets, element_facets.facets[f], at, coordinates, R, rows);
        Full gap_curvature(coordinates.size(), coordinates.size()), slip_gradient(coordinates.size(), coordinates.size());
        add_curvature(element_facets, element_facets.facets[f], at, coordinates, R, 1., 0., gap_curvature);
        add_curvature(element_facets, element_facets.facets[f], at, coordinates, R, 0., 1., slip_gradient);
        for (unsigned int j = 0; j < coordinates.size(); ++j)
        {
          const unsigned int dof = index(faces, coordinates, j);
          const double from      = q[dof];
          const double h         = 2e-6;
          Facet difference;
          std::vector<Vector> by_row(2);
          for (const double sign : { 1., -1. })
          {
            q[dof]           = from + sign * h;
            const auto there = configuration(faces, q);
            faces.pair.find_facets(element, there, other);
            find_rows(other, other.facets[f], there, coordinates, R, moved);
            difference.gap += sign / (2. * h) * other.facets[f].gap;
            difference.arc += sign / (2. * h) * other.facets[f].arc;
            difference.weight += sign / (2. * h) * other.facets[f].stretch;
            if (sign > 0.)
              by_row = { moved.gap, moved.slip };
            else
            {
              by_row[0] -= moved.gap;
              by_row[1] -= moved.slip;
            }
          }
          q[dof] = from;
          EXPECT_NEAR(rows.gap[j], difference.gap, 3e-8) << f << " " << j;
          EXPECT_NEAR(rows.arc[j], difference.arc, 3e-8) << f << " " << j;
          EXPECT_NEAR(rows.stretch[j], difference.weight, gap_tolerance) << f << " " << j;
          for (unsigned int i = 0; i < coordinates.size(); ++i)
          {
            EXPECT_NEAR(gap_curvature(i, j), by_row[0][i] / (2. * h), gap_tolerance) << f << " " << i << " " << j;
            EXPECT_NEAR(slip_gradient(i, j), by_row[1][i] / (2. * h), slip_tolerance) << f << " " << i << " " << j;
          }
        }
      }
    }
  }
  EXPECT_GT(crossings, 3u);
}

TEST(FacePair, FacetsBesideTheCylindersFaceAreNotOpposed)
{
  const auto upper = face_along([](double xi) { return dealii::Point<2>(xi, 0.1); }, divide(0., 4., 8), 2, 4, width);
  const auto lower = face_along([](double xi) { return dealii::Point<2>(xi, 0.); }, divide(1., 2.2, 5), 2, 4, width);
  const FacePair pair(upper, lower);
  const Vector none(2 * static_cast<unsigned int>(upper.nodes.size() + lower.nodes.size()));
  const auto at = pair.configuration({ &none, 0., 0., { 0., 0. } });
  for (unsigned int element = 0; element < upper.elements.size(); ++element)
  {
    ElementFacets element_facets;
    pair.find_facets(element, at, element_facets);
    for (unsigned int f = 0; f < element_facets.facets.size(); ++f)
    {
      const double begin = 0.5 * element + 0.0625 * f;
      const bool above   = begin > 1. - 1e-9 && begin + 0.0625 < 2.2 + 1e-9;
      EXPECT_EQ(element_facets.facets[f].opposed, above) << begin;
      EXPECT_GT(element_facets.facets[f].gap, 0.);
      EXPECT_EQ(element_facets.facets[f].weight > 0., above);
    }
  }
}
