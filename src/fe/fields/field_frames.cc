// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/field_frames.h"

#include "base/unknown.h"
#include "fe/fields/help_first_rank.h"
#include "scene/device.h"
#include "scene/mirrored_pair.h"

#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr const char *displacement_meaning = "from the position at rest, the hub's rotation included";
    constexpr const char *elastic_meaning      = "elastic part of the displacement";

    const BodyFields *get_leaf_fields(const std::unique_ptr<LeafShapes> &leaf)
    {
      return leaf ? &leaf->fields() : nullptr;
    }

    /// Closes a face between its mirror image, whose points begin at `first`, and itself, whose points come before those.
    void join_halves(const std::vector<unsigned int> &line, const unsigned int first, const unsigned int n_half,
                     std::vector<unsigned int> &cells)
    {
      for (std::size_t i = 1; i < line.size(); ++i)
        cells.insert(cells.end(),
                     { first + line[i - 1], first + line[i], first - n_half + line[i], first - n_half + line[i - 1] });
    }
  } // namespace

  /// Values at the nodes of the bodies, block by block.
  struct FieldFrames::Bodies
  {
    std::vector<float> displacement, elastic, stress, von_mises;

    void add(const Tensor<1, 3> &moved, const Tensor<1, 3> &elastically, const NodalField &node, const WorldAxes &axes)
    {
      append(moved, displacement);
      append(elastically, elastic);
      const auto in_world = axes.turned(node.stress);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          stress.push_back(static_cast<float>(in_world[i][j]));
      von_mises.push_back(static_cast<float>(sprag::von_mises(node)));
    }
  };

  FieldFrames::FieldFrames(const Device &device_, const BodyFields &fields_, const std::string &folder)
      : device(device_)
      , fields(fields_)
      , rest(rest_pose(device))
      , leaf(device.spring.type == SpringType::leaf ? std::make_unique<LeafShapes>(device) : nullptr)
      , blocks(device_blocks(device, fields, get_leaf_fields(leaf)))
  {
    auto mesh = device_mesh(device, rest, blocks, fields, get_leaf_fields(leaf));
    mesh.name = "fields";
    files     = std::make_unique<FieldFiles>(folder, "fields", std::vector<FieldMesh>{ std::move(mesh), face_mesh() },
                                         FrameStorage::files, writers_at_hand());
  }

  void FieldFrames::write(const DeviceState &state, const bool whole)
  {
    files->write(state.time, { body_fields(state, whole), face_fields(state) });
  }

  std::vector<Field> FieldFrames::body_fields(const DeviceState &state, const bool whole)
  {
    Bodies values;
    for (const auto &block : blocks)
      if (block.part == DevicePart::leaf)
        add_leaf(state, block, values);
      else
        add_meshed(state, block, values);
    std::vector<Field> result{ { "displacement", "mm", displacement_meaning, 3, std::move(values.displacement) },
                               { "elastic_displacement", "mm", elastic_meaning, 3, std::move(values.elastic) },
                               { "von_mises_stress", "MPa", "of each part by itself; 0 where it is rigid", 1,
                                 std::move(values.von_mises) } };
    if (whole)
      result.push_back({ "stress", "MPa", "Cauchy stress along the axes of the world, by rows", 9, std::move(values.stress) });
    return result;
  }

  void FieldFrames::add_meshed(const DeviceState &state, const DeviceBlock &block, Bodies &values) const
  {
    const auto before = block_axes(device, rest, block);
    const auto now    = block_axes(device, state.pose, block);
    const bool rigid  = block.part == DevicePart::rigid_cylinder;
    for (unsigned int i = 0; i < block.positions.size(); ++i)
    {
      const auto node    = rigid ? NodalField() : state.nodal.at(block.lever)[block.nodes[i]];
      const auto elastic = now.turned(node.displacement);
      values.add(now.place(block.positions[i]) + elastic - before.place(block.positions[i]), elastic, node, now);
    }
  }

  /// Adds a leaf spring. If the joint lets both levers of a pair swing, the spring bends by their mean turn and swings with its
  /// lever.
  void FieldFrames::add_leaf(const DeviceState &state, const DeviceBlock &block, Bodies &values)
  {
    const auto &theta = state.pose.theta;
    const double bent = swings(device) ? 0.5 * (theta[0] + theta[1]) : theta[block.lever];
    auto frame        = rest; // of the leaf at rest, as the pivot frame and the swing move it
    frame.support     = state.pose.support;
    frame.theta[block.lever] += theta[block.lever] - bent;
    const auto before = block_axes(device, rest, block);
    const auto at     = block_axes(device, frame, block);
    const auto hub    = block_axes(device, state.pose, block);
    const auto found  = leaf->displacement(bent - rest.theta[block.lever]);
    const auto nodal  = found ? leaf->fields().at(*found) : std::vector<NodalField>(leaf->fields().nodes.size());
    for (unsigned int i = 0; i < block.positions.size(); ++i)
    {
      auto node           = nodal[block.nodes[i]];
      const auto &at_rest = block.positions[i];
      const auto rigid    = hub.place(at_rest);
      const auto place    = found ? at.place(at_rest + node.displacement) : rigid;
      if (!found)
        node.stress *= unknown;
      values.add(place - before.place(at_rest), place - rigid, node, at);
    }
  }

  /// Faces of the levers, and of the mirrored half. Their nodes are points of the face.
  std::vector<DeviceBlock> FieldFrames::faces() const
  {
    std::vector<DeviceBlock> result;
    for (const auto &block : blocks)
      if (block.part == DevicePart::lever)
        result.push_back({ block.part, block.lever, block.is_mirrored, {}, fields.face.points, fields.face.cells });
    return result;
  }

  FieldMesh FieldFrames::face_mesh() const
  {
    FieldMesh mesh;
    mesh.name           = "face";
    mesh.nodes_per_cell = fields.face.points_per_cell;
    Field xi{ "xi", "mm", "lever coordinate from the pivot", 1, {} };
    Field zeta{ "zeta", "mm", "across the lever from the middle of its width", 1, {} };
    Field lever_field{ "lever", "1", "whose face it is", 1, {} };
    for (const auto &block : faces())
    {
      const auto axes  = block_axes(device, rest, block);
      const auto first = static_cast<unsigned int>(mesh.n_nodes());
      for (const auto &point : block.positions)
      {
        const auto place = axes.place(point);
        mesh.nodes.insert(mesh.nodes.end(), { place[0], place[1], place[2] });
        xi.values.push_back(static_cast<float>(point[0]));
        zeta.values.push_back(static_cast<float>(place[2]));
        lever_field.values.push_back(static_cast<float>(block.lever + 1));
      }
      for (const unsigned int corner : block.cells)
        mesh.cells.push_back(first + corner);
      if (block.is_mirrored)
        join_halves(fields.face.first_line, first, static_cast<unsigned int>(block.positions.size()), mesh.cells);
    }
    mesh.fixed = { std::move(xi), std::move(lever_field) };
    if (fields.is_in_space)
      mesh.fixed.push_back(std::move(zeta));
    return mesh;
  }

  std::vector<Field> FieldFrames::face_fields(const DeviceState &state) const
  {
    Field moved{ "displacement", "mm", displacement_meaning, 3, {} };
    Field elastic{ "elastic_displacement", "mm", elastic_meaning, 3, {} };
    Field pressure{ "pressure", "MPa", "contact pressure", 1, {} };
    Field friction{ "friction_traction", "MPa", "friction on the lever along -d", 1, {} };
    Field traction{ "traction", "MPa", "pressure and friction on the lever as a vector", 3, {} };
    for (const auto &block : faces())
    {
      const auto before   = block_axes(device, rest, block);
      const auto now      = block_axes(device, state.pose, block);
      const auto &p       = block.lever == 0 ? state.face.pressure : state.face.pressure_2;
      const auto &t       = block.lever == 0 ? state.face.traction : state.face.traction_2;
      const auto &t_aside = block.lever == 0 ? state.face.traction_across : state.face.traction_across_2;
      for (unsigned int q = 0; q < block.positions.size(); ++q)
      {
        const auto elastically = now.turned(fields.face.moved(q, state.displacements[block.lever]));
        append(now.place(block.positions[q]) + elastically - before.place(block.positions[q]), moved.values);
        append(elastically, elastic.values);
        pressure.values.push_back(static_cast<float>(p.at(q)));
        friction.values.push_back(static_cast<float>(t.at(q)));
        append(now.turned(Tensor<1, 3>({ -t[q], p[q], t_aside.empty() ? 0. : t_aside[q] })), traction.values);
      }
    }
    return { moved, elastic, pressure, friction, traction };
  }
} // namespace sprag
