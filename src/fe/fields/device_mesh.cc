#include "fe/fields/device_mesh.h"

#include "scene/mirrored_pair.h"

#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int rim_nodes = 180; ///< of a rigid cylinder

    double side_of(const unsigned int lever)
    {
      return lever == 0 ? 1. : -1.;
    }

    double cylinder_height(const Scene &scene)
    {
      return number_of_levers(scene) == 2 ? scene.pair.cylinder_offset : 0.;
    }

    Point<2> middle_of_cell(const BodyFields &fields, const unsigned int first, const unsigned int n)
    {
      Point<2> result;
      for (unsigned int i = 0; i < n; ++i)
        result += fields.nodes()[first + i].position / n;
      return result;
    }

    DeviceBlock block_of(const Scene &scene, const BodyFields &fields, const DevicePart part, const unsigned int lever)
    {
      DeviceBlock result{ part, lever, {}, {} };
      const unsigned int n = fields.nodes_per_cell();
      const auto axes      = cylinder_axes(scene, rest_pose(scene), lever);
      const auto of_part   = [&](const unsigned int first)
      {
        const bool cylinder = fields.nodes()[first].part == material_id::cylinder;
        if (part != DevicePart::cylinder || !cylinder || number_of_levers(scene) == 1)
          return cylinder == (part == DevicePart::cylinder);
        return axes.turned(middle_of_cell(fields, first, n))[1] * side_of(lever) > 0.;
      };
      for (unsigned int first = 0; first < fields.nodes().size(); first += n)
        if (of_part(first))
          for (unsigned int i = first; i < first + n; ++i)
          {
            result.nodes.push_back(i);
            result.positions.push_back(fields.nodes()[i].position);
          }
      return result;
    }

    DeviceBlock rigid_cylinder(const Scene &scene)
    {
      DeviceBlock result{ DevicePart::rigid_cylinder, 0, {}, { Point<2>() } };
      for (unsigned int i = 0; i < rim_nodes; ++i)
      {
        const double angle = 2. * M_PI * i / rim_nodes;
        result.positions.emplace_back(scene.geometry.cylinder_radius * std::cos(angle),
                                      scene.geometry.cylinder_radius * std::sin(angle));
      }
      return result;
    }

    /// Kites between the centre and three nodes of the rim.
    void append_disc(const unsigned int first, std::vector<unsigned int> &cells)
    {
      for (unsigned int i = 0; i < rim_nodes; i += 2)
        cells.insert(cells.end(), { first, first + 1 + i, first + 2 + i, first + 1 + (i + 2) % rim_nodes });
    }

    /// The first lever's axes are left-handed: its quadrilaterals are turned to count the same way as the others.
    void append_cells(const BodyFields &fields, const DeviceBlock &block, const unsigned int first,
                      std::vector<unsigned int> &cells)
    {
      std::vector<unsigned int> number(fields.nodes().size(), numbers::invalid_unsigned_int);
      for (unsigned int i = 0; i < block.nodes.size(); ++i)
        number[block.nodes[i]] = first + i;
      const auto &quads = fields.quadrilaterals();
      for (unsigned int q = 0; q < quads.size(); q += 4)
        if (number[quads[q]] != numbers::invalid_unsigned_int)
        {
          const unsigned int second = block.lever == 0 ? 3 : 1;
          for (const unsigned int corner : { 0u, second, 2u, 4 - second })
            cells.push_back(number[quads[q + corner]]);
        }
    }
  } // namespace

  DevicePose rest_pose(const Scene &scene)
  {
    const double theta = rest_inclination(scene);
    return { 0., 0., { { theta, theta } } };
  }

  DevicePose pose_of(const Row &row)
  {
    const double moved  = row[Column::support_displacement];
    const double first  = row[Column::theta];
    const double second = row.second_lever().empty() ? first : row.of_second_lever(Column::theta);
    return { row[Column::x], std::isnan(moved) ? 0. : moved, { { first, second } } };
  }

  WorldAxes lever_axes(const Scene &scene, const DevicePose &pose, const unsigned int lever)
  {
    const Point<2> pivot(scene.geometry.pivot_distance + pose.support, scene.geometry.pivot_height);
    return world_axes(pivot, pose.theta[lever], side_of(lever));
  }

  WorldAxes cylinder_axes(const Scene &scene, const DevicePose &pose, const unsigned int lever)
  {
    return world_axes(Point<2>(pose.x, side_of(lever) * cylinder_height(scene)), pose.theta[lever], side_of(lever));
  }

  std::vector<DeviceBlock> device_blocks(const Scene &scene, const BodyFields &body, const BodyFields *const leaf)
  {
    std::vector<DeviceBlock> result;
    for (unsigned int lever = 0; lever < number_of_levers(scene); ++lever)
    {
      result.push_back(block_of(scene, body, DevicePart::lever, lever));
      if (scene.cylinder.type != CylinderType::rigid)
        result.push_back(block_of(scene, body, DevicePart::cylinder, lever));
      if (leaf != nullptr)
        result.push_back(block_of(scene, *leaf, DevicePart::leaf, lever));
    }
    if (scene.cylinder.type == CylinderType::rigid)
      result.push_back(rigid_cylinder(scene));
    return result;
  }

  WorldAxes axes_of(const Scene &scene, const DevicePose &pose, const DeviceBlock &block)
  {
    if (block.part == DevicePart::rigid_cylinder) // which way it is turned cannot be seen
      return world_axes(Point<2>(pose.x, cylinder_height(scene)), 0., 1.);
    return block.part == DevicePart::cylinder ? cylinder_axes(scene, pose, block.lever) : lever_axes(scene, pose, block.lever);
  }

  FieldMesh device_mesh(const Scene &scene, const DevicePose &pose, const std::vector<DeviceBlock> &blocks,
                        const BodyFields &body, const BodyFields *const leaf)
  {
    FieldMesh mesh;
    Field part{ "part", "1", "1 lever, 2 layer, 3 hub, 4 web, 5 plate, 6 cylinder, 7 leaf spring", 1, {} };
    Field lever{ "lever", "1", "to which it belongs: 1, of a pair 2; 0: to none", 1, {} };
    for (const auto &block : blocks)
    {
      const auto first   = static_cast<unsigned int>(mesh.n_nodes());
      const bool disc    = block.part == DevicePart::rigid_cylinder;
      const auto &fields = block.part == DevicePart::leaf ? *leaf : body;
      const auto axes    = axes_of(scene, pose, block);
      for (unsigned int i = 0; i < block.positions.size(); ++i)
      {
        const auto place = axes.place(block.positions[i]);
        mesh.nodes.insert(mesh.nodes.end(), { place[0], place[1] });
        part.values.push_back(static_cast<float>(disc ? material_id::cylinder : fields.nodes()[block.nodes[i]].part));
        lever.values.push_back(disc ? 0.f : static_cast<float>(block.lever + 1));
      }
      if (disc)
        append_disc(first, mesh.cells);
      else
        append_cells(fields, block, first, mesh.cells);
    }
    mesh.fixed = { part, lever };
    return mesh;
  }

  void append(const Tensor<1, 2> &vector, std::vector<float> &values)
  {
    values.insert(values.end(), { static_cast<float>(vector[0]), static_cast<float>(vector[1]), 0.f });
  }
} // namespace sprag
