// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/device_mesh.h"

#include "fe/contact/rigid_cylinder.h"
#include "scene/device.h"
#include "scene/mirrored_pair.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;
  struct Device;

  namespace
  {
    constexpr unsigned int rim_nodes         = 180;
    constexpr unsigned int barrel_sections   = 16;  ///< sections between its ends
    constexpr unsigned int rounding_sections = 6;   ///< sections of each
    constexpr double drawn_over_width        = 1.5; ///< length of a cylinder that ends beyond the lever
    constexpr unsigned int section_size      = rim_nodes + 1;

    double rim_angle(const unsigned int rim_node)
    {
      return 2. * M_PI * rim_node / rim_nodes;
    }

    /// Corners of a kite between the middle of a section and three nodes of its rim.
    void append_kite(const unsigned int first, const unsigned int i, std::vector<unsigned int> &cells)
    {
      cells.insert(cells.end(), { first, first + 1 + i, first + 2 + i, first + 1 + (i + 2) % rim_nodes });
    }

    /// Places along the axis, from one end to the other, at which the profile is drawn.
    std::vector<double> cylinder_sections(const Device &device)
    {
      const auto &cylinder = device.cylinder;
      const double half    = 0.5 * (cylinder.length > 0. ? cylinder.length : drawn_over_width * device.lever.width);
      const double inner   = half - cylinder.edge_radius;
      std::vector<double> result;
      for (unsigned int i = 0; cylinder.edge_radius > 0. && i < rounding_sections; ++i)
        result.push_back(-inner - cylinder.edge_radius * std::cos(0.5 * M_PI * i / rounding_sections));
      const unsigned int n = cylinder.crown_radius > 0. ? barrel_sections : 1;
      for (unsigned int i = 0; i <= n; ++i)
        result.push_back(inner * (2. * i / n - 1.));
      for (std::size_t i = result.size() - n - 1; i > 0; --i)
        result.push_back(-result[i - 1]);
      result.erase(std::unique(result.begin(), result.end()), result.end()); // ends may be nothing but rounding
      return result;
    }
  } // namespace

  /// A rigid cylinder: in a plane kites between its middle and its rim, in space hexahedra over kites, with tilt, skew, barrel
  /// and rounded ends. One whose length is not given is drawn half as long again as the lever is wide. Positions are from its
  /// middle, along the axes of the world.
  DeviceBlock rigid_cylinder(const Device &device, const bool in_space)
  {
    DeviceBlock result{ DevicePart::rigid_cylinder, 0 };
    const RigidCylinder cylinder(device.geometry, in_space ? device.cylinder : Cylinder());
    const auto sections = in_space ? cylinder_sections(device) : std::vector<double>{ 0. };
    for (const double along : sections)
    {
      result.positions.push_back(cylinder.on_axis(along));
      for (unsigned int i = 0; i < rim_nodes; ++i)
        result.positions.push_back(cylinder.on_surface(along, rim_angle(i)));
    }
    const unsigned int sides = in_space ? 2 : 1; // of a cell
    for (unsigned int section = 0; section + sides <= sections.size(); ++section)
      for (unsigned int i = 0; i < rim_nodes; i += 2)
        for (unsigned int end = section; end < section + sides; ++end)
          append_kite(end * section_size, i, result.cells);
    return result;
  }

  namespace
  {
    double lever_side(const unsigned int lever)
    {
      return lever == 0 ? 1. : -1.;
    }

    double cylinder_height(const Device &device)
    {
      return count_levers(device) == 2 ? device.pair.cylinder_offset : 0.;
    }

    /// Returns true if an element of a body belongs to a block.
    bool is_in_block(const Device &device, const BodyFields &fields, const unsigned int element, const DeviceBlock &block)
    {
      const unsigned int n    = fields.nodes_per_element;
      const auto *const nodes = &fields.elements[n * element];
      const bool cylinder     = fields.nodes[nodes[0]].part == material_id::cylinder;
      if (block.part != DevicePart::cylinder || !cylinder || count_levers(device) == 1)
        return cylinder == (block.part == DevicePart::cylinder);
      Tensor<1, 3> middle;
      for (unsigned int i = 0; i < n; ++i)
        middle += fields.nodes[nodes[i]].position / n;
      return cylinder_axes(device, rest_pose(device), block.lever).turned(middle)[1] * lever_side(block.lever) > 0.;
    }

    DeviceBlock make_block(const Device &device, const BodyFields &fields, DeviceBlock result)
    {
      constexpr unsigned int unknown = numbers::invalid_unsigned_int;
      const unsigned int n           = fields.nodes_per_element;
      std::vector<unsigned int> number(fields.nodes.size(), unknown);
      for (unsigned int element = 0; element < fields.elements.size() / n; ++element)
      {
        if (!is_in_block(device, fields, element, result))
          continue;
        const auto *const nodes = &fields.elements[n * element];
        for (unsigned int i = 0; i < n; ++i)
          if (number[nodes[i]] == unknown)
          {
            number[nodes[i]] = static_cast<unsigned int>(result.nodes.size());
            result.nodes.push_back(nodes[i]);
            result.positions.push_back(fields.nodes[nodes[i]].position);
          }
        for (const unsigned int corner : fields.element_cells)
          result.cells.push_back(number[nodes[corner]]);
      }
      return result;
    }

    /// In left-handed axes cells are turned to count the same way as the others. `is_rigid`(node) says to which cells they go.
    template <class IsRigid>
    void append_cells(const DeviceBlock &block, const unsigned int first, const bool turn, const IsRigid &is_rigid,
                      FieldMesh &mesh)
    {
      const unsigned int second = turn ? 3 : 1;
      for (unsigned int side = 0; side < block.cells.size(); side += 4) // of a hexahedron two sides
      {
        auto &cells = is_rigid(first + block.cells[side]) ? mesh.rigid_cells : mesh.cells;
        for (const unsigned int corner : { 0u, second, 2u, 4 - second })
          cells.push_back(first + block.cells[side + corner]);
      }
    }
  } // namespace

  DevicePose rest_pose(const Device &device)
  {
    const double theta = rest_inclination(device);
    return { 0., 0., { { theta, theta } } };
  }

  DevicePose to_pose(const Row &row)
  {
    const double moved  = row[Column::support_displacement];
    const double first  = row[Column::theta];
    const double second = row.second_lever().empty() ? first : row.second_value(Column::theta);
    return { row[Column::x], std::isnan(moved) ? 0. : moved, { { first, second } } };
  }

  WorldAxes cylinder_axes(const Device &device, const DevicePose &pose, const unsigned int lever)
  {
    return world_axes(Point<2>(pose.x, lever_side(lever) * cylinder_height(device)), pose.theta[lever], lever_side(lever));
  }

  std::vector<DeviceBlock> device_blocks(const Device &device, const BodyFields &body, const BodyFields *const leaf)
  {
    std::vector<DeviceBlock> result;
    for (unsigned int lever = 0; lever < count_levers(device); ++lever)
    {
      result.push_back(make_block(device, body, { DevicePart::lever, lever }));
      if (body.is_half)
      {
        result.push_back(result.back());
        result.back().is_mirrored = true;
      }
      if (device.cylinder.type != CylinderType::rigid)
        result.push_back(make_block(device, body, { DevicePart::cylinder, lever }));
      if (leaf != nullptr)
        result.push_back(make_block(device, *leaf, { DevicePart::leaf, lever }));
    }
    if (device.cylinder.type == CylinderType::rigid)
      result.push_back(rigid_cylinder(device, body.is_in_space));
    return result;
  }

  WorldAxes block_axes(const Device &device, const DevicePose &pose, const DeviceBlock &block)
  {
    if (block.part == DevicePart::rigid_cylinder)
    {
      const Point<3> origin(pose.x, cylinder_height(device), 0.);
      return { origin, Tensor<1, 3>({ 1., 0., 0. }), Tensor<1, 3>({ 0., 1., 0. }), Tensor<1, 3>({ 0., 0., 1. }) };
    }
    const Point<2> pivot(device.geometry.pivot_distance + pose.support, device.geometry.pivot_height);
    auto result = block.part == DevicePart::cylinder ? cylinder_axes(device, pose, block.lever)
                                                     : world_axes(pivot, pose.theta[block.lever], lever_side(block.lever));
    if (block.is_mirrored)
      result.sideways *= -1.;
    return result;
  }

  FieldMesh device_mesh(const Device &device, const DevicePose &pose, const std::vector<DeviceBlock> &blocks,
                        const BodyFields &body, const BodyFields *const leaf)
  {
    FieldMesh mesh;
    mesh.nodes_per_cell = body.nodes_per_cell();
    Field part{ "part", "1", "1 lever, 2 layer, 3 hub, 4 web, 5 plate, 6 cylinder, 7 leaf spring", 1, {} };
    Field lever{ "lever", "1", "to which it belongs: 1, of a pair 2; 0: to none", 1, {} };
    for (const auto &block : blocks)
    {
      const auto first   = static_cast<unsigned int>(mesh.n_nodes());
      const bool rigid   = block.part == DevicePart::rigid_cylinder;
      const auto &fields = block.part == DevicePart::leaf ? *leaf : body;
      const auto axes    = block_axes(device, pose, block);
      for (unsigned int i = 0; i < block.positions.size(); ++i)
      {
        const auto place = axes.place(block.positions[i]);
        mesh.nodes.insert(mesh.nodes.end(), { place[0], place[1], place[2] });
        part.values.push_back(static_cast<float>(rigid ? material_id::cylinder : fields.nodes[block.nodes[i]].part));
        lever.values.push_back(rigid ? 0.f : static_cast<float>(block.lever + 1));
      }
      const auto is_rigid = [&](const unsigned int node)
      { return rigid || static_cast<types::material_id>(part.values[node]) == material_id::hub; };
      append_cells(block, first, axes.are_left_handed(), is_rigid, mesh);
    }
    mesh.fixed = { part, lever };
    return mesh;
  }

  void append(const Tensor<1, 3> &vector, std::vector<float> &values)
  {
    for (unsigned int d = 0; d < 3; ++d)
      values.push_back(static_cast<float>(vector[d]));
  }
} // namespace sprag
