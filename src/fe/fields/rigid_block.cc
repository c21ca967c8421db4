// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/rigid_block.h"

#include "fe/solid/rigid_cylinder.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int rim_nodes    = 180;
    constexpr unsigned int of_barrel    = 16;  ///< sections between its ends
    constexpr unsigned int of_rounding  = 6;   ///< sections of each
    constexpr double drawn_over_width   = 1.5; ///< length of a cylinder that ends beyond the lever
    constexpr unsigned int section_size = rim_nodes + 1;

    double angle_of(const unsigned int rim_node)
    {
      return 2. * M_PI * rim_node / rim_nodes;
    }

    /// Corners of a kite between the middle of a section and three nodes of its rim.
    void append_kite(const unsigned int first, const unsigned int i, std::vector<unsigned int> &cells)
    {
      cells.insert(cells.end(), { first, first + 1 + i, first + 2 + i, first + 1 + (i + 2) % rim_nodes });
    }

    /// Places along the axis, from one end to the other, at which the profile is drawn.
    std::vector<double> sections_of(const Scene &scene)
    {
      const auto &cylinder = scene.cylinder;
      const double half    = 0.5 * (cylinder.length > 0. ? cylinder.length : drawn_over_width * scene.lever.width);
      const double inner   = half - cylinder.edge_radius;
      std::vector<double> result;
      for (unsigned int i = 0; cylinder.edge_radius > 0. && i < of_rounding; ++i)
        result.push_back(-inner - cylinder.edge_radius * std::cos(0.5 * M_PI * i / of_rounding));
      const unsigned int n = cylinder.crown_radius > 0. ? of_barrel : 1;
      for (unsigned int i = 0; i <= n; ++i)
        result.push_back(inner * (2. * i / n - 1.));
      for (std::size_t i = result.size() - n - 1; i > 0; --i)
        result.push_back(-result[i - 1]);
      result.erase(std::unique(result.begin(), result.end()), result.end()); // ends may be nothing but rounding
      return result;
    }
  } // namespace

  DeviceBlock rigid_disc(const Scene &scene)
  {
    DeviceBlock result{ DevicePart::rigid_cylinder, 0 };
    const double radius = scene.geometry.cylinder_radius;
    result.positions.emplace_back();
    for (unsigned int i = 0; i < rim_nodes; ++i)
      result.positions.emplace_back(radius * std::cos(angle_of(i)), radius * std::sin(angle_of(i)), 0.);
    for (unsigned int i = 0; i < rim_nodes; i += 2)
      append_kite(0, i, result.cells);
    return result;
  }

  DeviceBlock rigid_tube(const Scene &scene)
  {
    DeviceBlock result{ DevicePart::rigid_cylinder, 0 };
    const RigidCylinder cylinder(scene.geometry, scene.cylinder);
    const auto sections = sections_of(scene);
    for (const double along : sections)
    {
      result.positions.push_back(cylinder.on_axis(along));
      for (unsigned int i = 0; i < rim_nodes; ++i)
        result.positions.push_back(cylinder.on_surface(along, angle_of(i)));
    }
    for (unsigned int section = 0; section + 1 < sections.size(); ++section)
      for (unsigned int i = 0; i < rim_nodes; i += 2)
        for (const unsigned int end : { section, section + 1 })
          append_kite(end * section_size, i, result.cells);
    return result;
  }
} // namespace sprag
