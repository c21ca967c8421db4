// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/map/map.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <utility>

using namespace sprag;

namespace
{
  /// Kind over both coordinates, in intervals of the grid.
  using Kind = std::function<unsigned int(double, double)>;

  struct Found
  {
    MapGrid grid;
    std::vector<BoundaryPoint> boundary;
    KnownKinds known;
    std::size_t on_grid = 0;
  };

  void check(const std::vector<MapSite> &sites, const Kind &forward, const Kind &backward, KnownKinds &known)
  {
    for (const auto &[first, second] : sites)
    {
      const bool is_new = known.insert({ { first, second }, { { forward(first, second), backward(first, second) } } }).second;
      ASSERT_TRUE(is_new) << "asked for twice: " << first << ", " << second;
    }
  }

  Found find(const std::array<unsigned int, 2> &points, const unsigned int coarsest, const unsigned int bisections,
             const Kind &forward, const Kind &backward)
  {
    Found found{ MapGrid(points[0], points[1], coarsest), {}, {}, 0 };
    for (auto sites = found.grid.next_sites(); !sites.empty(); sites = found.grid.next_sites())
    {
      check(sites, forward, backward, found.known);
      found.grid.learn(found.known);
    }
    found.on_grid = found.known.size();
    BoundarySearch search(found.grid, bisections);
    for (auto sites = search.next_sites(); !sites.empty(); sites = search.next_sites())
    {
      for (const auto &site : sites)
        found.known.insert({ site, { { forward(site.first, site.second), backward(site.first, site.second) } } });
      search.learn(found.known);
    }
    found.boundary = search.points();
    return found;
  }

  const Kind nothing = [](double, double) { return 0u; };

  Kind disc(const double centre_first, const double centre_second, const double radius)
  {
    return [=](const double first, const double second)
    { return std::hypot(first - centre_first, second - centre_second) < radius ? 1u : 0u; };
  }

  /// Grid edges whose ends differ, by asking for every point.
  std::size_t crossed_edges(const std::array<unsigned int, 2> &points, const Kind &kind)
  {
    std::size_t count = 0;
    for (unsigned int i = 0; i < points[0]; ++i)
      for (unsigned int j = 0; j < points[1]; ++j)
      {
        count += i + 1 < points[0] && kind(i, j) != kind(i + 1, j);
        count += j + 1 < points[1] && kind(i, j) != kind(i, j + 1);
      }
    return count;
  }

  /// Kinds at all points, as a map's file has them, are those of the full grid.
  void expect_all_kinds(const Found &found, const unsigned int direction, const Kind &kind)
  {
    const auto [n_first, n_second] = found.grid.points();
    std::vector<double> known;
    for (unsigned int i = 0; i < n_first; ++i)
      for (unsigned int j = 0; j < n_second; ++j)
        known.push_back(found.grid.is_known(i, j) ? found.grid.kinds(i, j)[direction] : 99.);
    const auto all = found.grid.interpolated(known);
    for (unsigned int i = 0; i < n_first; ++i)
      for (unsigned int j = 0; j < n_second; ++j)
        ASSERT_EQ(all[i * n_second + j], kind(i, j)) << i << ", " << j;
  }
} // namespace

TEST(MapGrid, CircleWithinTheLastBracket)
{
  const auto circle    = disc(31.3, 28.7, 17.4);
  const auto found     = find({ { 65, 65 } }, 8, 4, circle, nothing);
  const double bracket = 1. / 16.;
  ASSERT_EQ(found.boundary.size(), crossed_edges({ { 65, 65 } }, circle));
  for (const auto &point : found.boundary)
  {
    EXPECT_EQ(point.direction, 0u);
    EXPECT_EQ(point.width, bracket);
    // Along the line that was searched, the circle lies inside the bracket.
    const auto end = [&](const double side)
    {
      MapSite site = point.site;
      (point.along == 0 ? site.first : site.second) += side * 0.5 * bracket;
      return circle(site.first, site.second);
    };
    EXPECT_EQ(end(-1.), point.kinds[0]);
    EXPECT_EQ(end(1.), point.kinds[1]);
    EXPECT_NE(point.kinds[0], point.kinds[1]);
    EXPECT_LE(std::abs(std::hypot(point.site.first - 31.3, point.site.second - 28.7) - 17.4), 0.5 * bracket);
  }
  expect_all_kinds(found, 0, circle);
  // 4225 points; the boundary is 109 intervals long, a band of some five points about it and the coarse grid are checked.
  EXPECT_LT(found.on_grid, 900u);
}

TEST(MapGrid, TwoIslandsOneForEachDirection)
{
  const auto forward = disc(10.2, 9.1, 6.);
  const Kind both    = [](const double first, const double second)
  { return disc(50.3, 12.4, 7.)(first, second) + 2 * disc(20.6, 51.2, 8.)(first, second); };
  const auto found = find({ { 65, 65 } }, 8, 2, forward, both);
  EXPECT_EQ(found.boundary.size(), crossed_edges({ { 65, 65 } }, forward) + crossed_edges({ { 65, 65 } }, both));
  expect_all_kinds(found, 0, forward);
  expect_all_kinds(found, 1, both);
  EXPECT_LT(found.on_grid, 1300u);
}

// The points first checked are alike on both sides of the tongue wherever it is narrow: only its mouth betrays it.
TEST(MapGrid, FollowsATongueNarrowerThanTheCoarseQuads)
{
  const Kind tongue = [](const double first, const double second)
  { return first > 6. && std::abs(second - 35. - 0.2 * first) < 0.9 + 0.05 * first ? 1u : 0u; };
  const auto found = find({ { 65, 65 } }, 16, 1, tongue, nothing);
  expect_all_kinds(found, 0, tongue);
  EXPECT_EQ(found.boundary.size(), crossed_edges({ { 65, 65 } }, tongue));
}

TEST(MapGrid, BoundaryThroughASideOfTheGridWhoseEndIsNoMultiple)
{
  const Kind slope = [](const double first, const double second) { return second > 13.37 + 0.61 * first ? 3u : 0u; };
  const auto found = find({ { 60, 45 } }, 8, 3, nothing, slope);
  ASSERT_EQ(found.boundary.size(), crossed_edges({ { 60, 45 } }, slope));
  for (const auto &point : found.boundary)
  {
    EXPECT_EQ(point.direction, 1u);
    const double across = point.site.second - 13.37 - 0.61 * point.site.first;
    EXPECT_LE(std::abs(across) / (point.along == 0 ? 0.61 : 1.), (1. + 1e-12) / 16.);
  }
  expect_all_kinds(found, 1, slope);
  EXPECT_LT(found.on_grid, 600u);
}

TEST(MapGrid, InterpolatesBilinearFunctionsExactly)
{
  const auto found = find({ { 21, 14 } }, 4, 0, disc(6., 6., 2.), nothing);
  const auto plane = [](const unsigned int i, const unsigned int j) { return 2. + 0.5 * i - 0.25 * j + 0.125 * i * j; };
  std::vector<double> known;
  std::size_t unknown = 0;
  for (unsigned int i = 0; i < 21; ++i)
    for (unsigned int j = 0; j < 14; ++j)
    {
      known.push_back(found.grid.is_known(i, j) ? plane(i, j) : 1e9);
      unknown += !found.grid.is_known(i, j);
    }
  ASSERT_GT(unknown, 50u);
  const auto all = found.grid.interpolated(known);
  for (unsigned int i = 0; i < 21; ++i)
    for (unsigned int j = 0; j < 14; ++j)
      EXPECT_NEAR(all[i * 14 + j], plane(i, j), 1e-13 * plane(20, 13));
}
