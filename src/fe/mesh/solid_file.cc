// SPDX-License-Identifier: GPL-3.0-only
#include "fe/mesh/solid_file.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"
#include "fe/body/body_properties.h"
#include "fe/mesh/geometry_script.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/mesh/mesh_checks.h"
#include "scene/device.h"
#include "scene/lever_shape.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using Messages  = std::vector<std::string>;
    using SolidSide = Triangulation<3>::face_iterator;

    /// Positions of the corners of the sides along an axis, in steps of a nanometre.
    std::set<long> places_along(const unsigned int axis, const std::vector<SolidSide> &sides)
    {
      std::set<long> result;
      for (const auto &side : sides)
        for (const unsigned int v : side->vertex_indices())
          result.insert(std::lround(1e6 * side->vertex(v)[axis]));
      return result;
    }

    std::array<double, 2> range(const std::set<long> &places)
    {
      return { { 1e-6 * static_cast<double>(*places.begin()), 1e-6 * static_cast<double>(*places.rbegin()) } };
    }

    std::string from_to(const std::array<double, 2> &ends)
    {
      return rounded_text(ends[0]) + " to " + mm(ends[1]);
    }

    void check_height(const Device &device, const std::vector<SolidSide> &sides, Messages &mistakes)
    {
      const double e     = device.geometry.interface_offset;
      const double small = 1e-6 * device.geometry.cylinder_radius;
      const auto heights = range(places_along(1, sides));
      if (heights[1] - heights[0] > small)
        mistakes.push_back("the surface 'friction face' is not flat: its nodes lie at y = " + from_to(heights) + ", " +
                           mm(heights[1] - heights[0]) + " apart; all must lie at Geometry/Interface offset = " + mm(e));
      else if (std::abs(heights[0] - e) > small)
        mistakes.push_back("the surface 'friction face' lies at y = " + mm(heights[0]) +
                           ", but Geometry/Interface offset = " + rounded_text(e));
    }

    void check_width(const Device &device, const std::vector<SolidSide> &sides, Messages &mistakes)
    {
      const double half  = 0.5 * device.lever.width;
      const double small = 1e-6 * half;
      const auto ends    = range(places_along(2, sides));
      if (std::abs(ends[0] + half) < small && std::abs(ends[1] - half) < small)
        return;
      std::string line = "the surface 'friction face' spans z = " + from_to(ends) +
                         ", but z counts from the middle of Lever/Width = " + rounded_text(device.lever.width) + ": " +
                         from_to({ { -half, half } });
      if (std::abs(ends[0]) < small)
        line += "; give the whole lever: of a mesh of one's own no half is solved";
      mistakes.push_back(line);
    }

    void check_sweep(const Device &device, const std::vector<SolidSide> &sides, Messages &mistakes)
    {
      const auto ends          = range(places_along(0, sides));
      const auto [first, last] = swept_contact(device);
      if (ends[0] > first || ends[1] < last)
        mistakes.push_back("the surface 'friction face' spans " + from_to(ends) + " from the pivot, but the contact sweeps " +
                           rounded_text(first) + " to " + mm(last));
    }

    void check_cylinder(const Device &device, const std::vector<SolidSide> &sides, Messages &mistakes)
    {
      const auto planes = mapped(places_along(2, sides), [](const long place) { return 1e-6 * static_cast<double>(place); });
      if (const auto too_short = cylinder_too_short(device, planes); !too_short.empty())
        mistakes.push_back("Cylinder/Length = " + rounded_text(device.cylinder.length) + " " + too_short);
    }

    /// Returns true if a side is a rectangle with its sides along x and z.
    bool is_straight(const SolidSide &side)
    {
      return places_along(0, { side }).size() == 2 && places_along(2, { side }).size() == 2;
    }

    /// A grid of rectangles in which no line ends or bends.
    void check_lines(const std::vector<SolidSide> &sides, Messages &mistakes)
    {
      const std::string rule =
          "the sides of cells on 'friction face' must be rectangles in lines along x and z, from end to end: ";
      const auto skew = std::find_if_not(sides.begin(), sides.end(), is_straight);
      const auto n    = (places_along(0, sides).size() - 1) * (places_along(2, sides).size() - 1);
      if (skew != sides.end())
        mistakes.push_back(rule + "the one at x = " + rounded_text((*skew)->center()[0]) +
                           " mm, z = " + rounded_text((*skew)->center()[2]) + " mm is not");
      else if (n != sides.size())
        mistakes.push_back(rule + "their " + std::to_string(sides.size()) + " make " + std::to_string(n) +
                           " where all lines cross");
    }

    void check_face(const Device &device, const Triangulation<3> &triangulation, Messages mistakes)
    {
      const auto sides = mapped(friction_face_sides(triangulation), &BoundarySide<3>::side);
      if (sides.empty())
        mistakes.push_back("no side of 'lever', 'plate' or 'layer' lies on the surface 'friction face'");
      else
      {
        check_height(device, sides, mistakes);
        check_width(device, sides, mistakes);
        check_sweep(device, sides, mistakes);
        check_lines(sides, mistakes);
        check_cylinder(device, sides, mistakes);
      }
      for (auto &line : mistakes)
        line = device.mesh.file + ": " + line;
      if (!mistakes.empty())
        throw InputError(mistakes);
    }
  } // namespace

  bool has_solid_file(const Device &device)
  {
    return device.analysis.dimension == 3 && !device.mesh.file.empty() && has_volumes(device.mesh.file);
  }

  void read_solid_file(const Device &device, Triangulation<3> &triangulation)
  {
    const auto groups = lever_groups(device, 3);
    read_gmsh(device.mesh.file, {}, groups, triangulation);
    check_face(device, triangulation, mesh_mistakes(groups, triangulation));
  }

  void check_solid_file(const Device &device)
  {
    Triangulation<3> triangulation;
    read_solid_file(device, triangulation);
  }

  double own_face_size(const Device &device)
  {
    const auto [first, last] = swept_contact(device);
    if (has_solid_file(device))
    {
      Triangulation<3> triangulation;
      read_solid_file(device, triangulation);
      return longest_face_side(triangulation, first, last);
    }
    Mesh triangulation;
    make_mesh(device, triangulation);
    return longest_face_side(triangulation, first, last);
  }
} // namespace sprag
