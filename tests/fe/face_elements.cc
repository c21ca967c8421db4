// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_elements.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// A flat face in three dimensions of n by n elements of 1 mm with four nodes and one point each, all free; elements from row
  /// `first_apart` on are `apart` further along xi.
  FrictionFace<3> square_face(const unsigned int n, const unsigned int first_apart, const double apart)
  {
    FrictionFace<3> face;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        const auto element = static_cast<unsigned int>(face.elements.size());
        const double xi    = i + (i < first_apart ? 0. : apart);
        FaceEdge<3> edge;
        FacePoint<3> point{ dealii::Point<3>(xi + 0.5, 0., j + 0.5), 1. };
        FaceElement<3> added{ element, element + 1, std::sqrt(2.), 4 };
        for (unsigned int a = 0; a < 4; ++a)
        {
          edge.nodes.push_back({ dealii::Point<3>(xi + a / 2, 0., j + a % 2), 4 * element + a });
          added.nodes[a]  = 4 * element + a;
          point.shapes[a] = 0.25;
        }
        face.elements.push_back(added);
        face.points.push_back(point);
        face.edges.push_back(edge);
      }
    return face;
  }
} // namespace

TEST(FaceElements, AreFoundByBoxInThreeDimensions)
{
  const FaceElements<3> face(square_face(6, 6, 0.));
  const auto found = face.elements_in({ { { 1.5, -1., 3.2 }, { 2.5, 1., 3.8 } } });
  EXPECT_EQ(found, (std::vector<unsigned int>{ 9, 15 }));
  // Beside the face the closest.
  EXPECT_EQ(face.elements_in({ { { 8., -1., 4.2 }, { 9., 1., 4.4 } } }), (std::vector<unsigned int>{ 34 }));
  EXPECT_EQ(face.element_displacements({ 1, 0 }).size(), 24u);
  EXPECT_EQ(face.point_elements[7], 7u);
}

// If displacements move the face, a sphere touches what a search of all elements finds, also across a slit.
TEST(FaceElements, NearASphereAreThoseOfASearchOfAll)
{
  for (const double slit : { 0., 0.7 })
  {
    const auto layout = square_face(12, 5, slit);
    const FaceElements<3> face(layout);
    dealii::Vector<double> displacement(3 * 4 * 144);
    for (unsigned int i = 0; i < displacement.size(); ++i)
      displacement[i] = 0.02 * std::sin(1.3 * i);
    for (const double centre : { 1., 4.6, 7.3, 40. })
    {
      const dealii::Point<3> middle(centre, 9.5, 4.2);
      const auto gap = [&](const unsigned int element)
      {
        const auto nodal = FaceElements<3>::nodal(face.elements[element], displacement);
        return FaceElements<3>::position(face.points[element], nodal).distance(middle) - 10.;
      };
      std::vector<unsigned int> expected;
      unsigned int closest = 0;
      for (unsigned int element = 0; element < 144; ++element)
      {
        if (gap(element) < 0.)
          expected.push_back(element);
        if (gap(element) < gap(closest))
          closest = element;
      }
      if (expected.empty())
        expected.push_back(closest);
      for (const auto &from : { middle, dealii::Point<3>(0., 0., 0.), dealii::Point<3>(9., 0., 12.) })
        EXPECT_EQ(face.find_near(from, gap), expected) << slit << " " << centre << " " << from;
    }
  }
}
