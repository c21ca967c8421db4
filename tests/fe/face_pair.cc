#include "fe/face_pair_rows.h"

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
    FrictionFace<2> lever    = face_along([](double xi) { return dealii::Point<2>(xi, 3.); }, parts_of(8., 16., 20), 2, 4, width);
    FrictionFace<2> cylinder = face_along(on_circle, parts_of(-0.5, 0.5, 21), 2, 4, width);
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

  /// Index among q of a coordinate of a patch.
  unsigned int index(const Faces &faces, const PairCoordinates &coordinates, const unsigned int i)
  {
    return i < coordinates.theta() ? 2 * coordinates.nodes[i / 2] + i % 2 : 2 * faces.n_nodes() + i - coordinates.theta();
  }
} // namespace

TEST(FacePair, RowsAndCurvaturesAreDerivatives)
{
  const Faces faces;
  const double R         = geometry.cylinder_radius;
  unsigned int crossings = 0;
  for (const double theta : { 0.015, 0.02 })
  {
    Vector q         = smooth(faces, theta, 0.3);
    const auto at    = configuration(faces, q);
    const auto range = faces.pair.near(at);
    ASSERT_GT(range.end, range.begin + 1);
    for (unsigned int patch = range.begin; patch < range.end; ++patch)
    {
      PatchFacets of, other;
      faces.pair.find_facets(patch, at, of);
      const auto coordinates = faces.pair.coordinates(patch, { &of });
      for (unsigned int f = 0; f < of.facets.size(); ++f)
      {
        if (!of.facets[f].opposed)
          continue;
        const bool crosses = of.facets[f].end - of.facets[f].begin > 2;
        crossings += crosses ? 1 : 0;
        FacetRows rows, moved;
        find_rows(of, of.facets[f], at, coordinates, R, rows);
        Full gap_curvature(coordinates.size(), coordinates.size()), slip_gradient(coordinates.size(), coordinates.size());
        add_curvature(of, of.facets[f], at, coordinates, R, 1., 0., gap_curvature);
        add_curvature(of, of.facets[f], at, coordinates, R, 0., 1., slip_gradient);
        for (unsigned int j = 0; j < coordinates.size(); ++j)
        {
          const unsigned int port = index(faces, coordinates, j);
          const double from       = q[port];
          const double h          = 1e-5;
          Facet difference;
          std::vector<Vector> by_row(2);
          for (const double sign : { 1., -1. })
          {
            q[port]          = from + sign * h;
            const auto there = configuration(faces, q);
            faces.pair.find_facets(patch, there, other);
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
          q[port] = from;
          EXPECT_NEAR(rows.gap[j], difference.gap, 1e-8) << f << " " << j;
          EXPECT_NEAR(rows.arc[j], difference.arc, 1e-8) << f << " " << j;
          EXPECT_NEAR(rows.stretch[j], difference.weight, 1e-6) << f << " " << j;
          for (unsigned int i = 0; i < coordinates.size(); ++i)
          {
            EXPECT_NEAR(gap_curvature(i, j), by_row[0][i] / (2. * h), 1e-5) << f << " " << i << " " << j;
            EXPECT_NEAR(slip_gradient(i, j), by_row[1][i] / (2. * h), 1e-5) << f << " " << i << " " << j;
          }
        }
      }
    }
  }
  EXPECT_GT(crossings, 3u);
}
