#include "fe/fields/field_frames.h"

#include "scene/mirrored_pair.h"

#include <cmath>
#include <limits>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr const char *of_displacement = "from the position at rest, the hub's rotation included";
    constexpr const char *of_elastic      = "elastic part of the displacement";

    const BodyFields *fields_of(const std::unique_ptr<LeafShapes> &leaf)
    {
      return leaf ? &leaf->fields() : nullptr;
    }
  } // namespace

  /// Values at the nodes of the bodies, block by block.
  struct FieldFrames::Bodies
  {
    std::vector<float> displacement, elastic, stress, von_mises;

    void add(const Tensor<1, 2> &moved, const Tensor<1, 2> &elastically, const NodalField &node, const WorldAxes &axes)
    {
      append(moved, displacement);
      append(elastically, elastic);
      const auto in_world = axes.turned(node.stress);
      for (const double component :
           { in_world[0][0], in_world[0][1], 0., in_world[0][1], in_world[1][1], 0., 0., 0., node.out_of_plane })
        stress.push_back(static_cast<float>(component));
      von_mises.push_back(static_cast<float>(sprag::von_mises(node)));
    }
  };

  FieldFrames::FieldFrames(const Scene &of_scene, const ElasticBody<2> &of_body, const std::string &folder, const bool goes_on)
      : scene(of_scene)
      , body(of_body)
      , fields(body)
      , rest(rest_pose(scene))
      , leaf(scene.spring.type == SpringType::leaf ? std::make_unique<LeafShapes>(scene) : nullptr)
      , blocks(device_blocks(scene, fields, fields_of(leaf)))
  {
    if (!goes_on)
      remove_field_files(folder);
    auto mesh = device_mesh(scene, rest, blocks, fields, fields_of(leaf));
    mesh.name = "fields";
    files     = std::make_unique<FieldFiles>(folder, "fields", std::vector<FieldMesh>{ std::move(mesh), face_mesh() });
  }

  void FieldFrames::write(const DeviceState &state)
  {
    files->write(state.time, { body_fields(state), face_fields(state) });
  }

  std::vector<Field> FieldFrames::body_fields(const DeviceState &state)
  {
    Bodies values;
    for (const auto &block : blocks)
      if (block.part == DevicePart::leaf)
        add_leaf(state, block, values);
      else
        add_meshed(state, block, values);
    return { { "displacement", "mm", of_displacement, 3, std::move(values.displacement) },
             { "elastic_displacement", "mm", of_elastic, 3, std::move(values.elastic) },
             { "stress", "MPa", "Cauchy stress along the axes of the world, by rows", 9, std::move(values.stress) },
             { "von_mises_stress", "MPa", "of each cell by itself; 0 where a part is rigid", 1, std::move(values.von_mises) } };
  }

  void FieldFrames::add_meshed(const DeviceState &state, const DeviceBlock &block, Bodies &values) const
  {
    const auto before = axes_of(scene, rest, block);
    const auto now    = axes_of(scene, state.pose, block);
    const auto nodal  = block.part == DevicePart::rigid_cylinder ? std::vector<NodalField>(block.positions.size())
                                                                 : fields.at(state.displacements.at(block.lever));
    for (unsigned int i = 0; i < block.positions.size(); ++i)
    {
      const auto &node   = nodal[block.nodes.empty() ? i : block.nodes[i]];
      const auto elastic = now.turned(node.displacement);
      values.add(now.place(block.positions[i]) + elastic - before.place(block.positions[i]), elastic, node, now);
    }
  }

  /// Where the joint lets both levers of a pair swing, a leaf spring bends by what they turn on the mean and swings with its
  /// lever.
  void FieldFrames::add_leaf(const DeviceState &state, const DeviceBlock &block, Bodies &values)
  {
    const auto &theta = state.pose.theta;
    const double bent = swings(scene) ? 0.5 * (theta[0] + theta[1]) : theta[block.lever];
    auto frame        = rest; // of the leaf at rest, as the pivot frame and the swing move it
    frame.support     = state.pose.support;
    frame.theta[block.lever] += theta[block.lever] - bent;
    const auto before = axes_of(scene, rest, block);
    const auto at     = axes_of(scene, frame, block);
    const auto hub    = axes_of(scene, state.pose, block);
    const auto found  = leaf->displacement(bent - rest.theta[block.lever]);
    const auto nodal  = found ? leaf->fields().at(*found) : std::vector<NodalField>(leaf->fields().nodes().size());
    for (unsigned int i = 0; i < block.positions.size(); ++i)
    {
      auto node           = nodal[block.nodes[i]];
      const auto &at_rest = block.positions[i];
      const auto rigid    = hub.place(at_rest);
      const auto place    = found ? at.place(at_rest + node.displacement) : rigid;
      if (!found)
        node.stress[0][0] = node.stress[1][1] = node.stress[0][1] = std::numeric_limits<double>::quiet_NaN();
      values.add(place - before.place(at_rest), place - rigid, node, at);
    }
  }

  FieldMesh FieldFrames::face_mesh() const
  {
    FieldMesh mesh;
    mesh.name           = "face";
    mesh.nodes_per_cell = 2;
    Field xi{ "xi", "mm", "lever coordinate from the pivot", 1, {} };
    Field of_lever{ "lever", "1", "whose face it is", 1, {} };
    for (unsigned int lever = 0; lever < number_of_levers(scene); ++lever)
    {
      const auto axes = lever_axes(scene, rest, lever);
      for (const auto &point : body.friction_face().points)
      {
        const auto place   = axes.place(point.position);
        const auto number  = static_cast<unsigned int>(mesh.n_nodes());
        const bool follows = &point != &body.friction_face().points.front();
        mesh.nodes.insert(mesh.nodes.end(), { place[0], place[1] });
        xi.values.push_back(static_cast<float>(point.position[0]));
        of_lever.values.push_back(static_cast<float>(lever + 1));
        if (follows)
          mesh.cells.insert(mesh.cells.end(), { number - 1, number });
      }
    }
    mesh.fixed = { xi, of_lever };
    return mesh;
  }

  std::vector<Field> FieldFrames::face_fields(const DeviceState &state) const
  {
    Field moved{ "displacement", "mm", of_displacement, 3, {} };
    Field elastic{ "elastic_displacement", "mm", of_elastic, 3, {} };
    Field pressure{ "pressure", "MPa", "contact pressure", 1, {} };
    Field friction{ "friction_traction", "MPa", "friction on the lever along -d", 1, {} };
    Field traction{ "traction", "MPa", "pressure and friction on the lever as a vector", 3, {} };
    for (unsigned int lever = 0; lever < number_of_levers(scene); ++lever)
    {
      const auto before = lever_axes(scene, rest, lever);
      const auto now    = lever_axes(scene, state.pose, lever);
      const auto &face  = body.friction_face();
      const auto &p     = lever == 0 ? state.face.pressure : state.face.pressure_2;
      const auto &t     = lever == 0 ? state.face.traction : state.face.traction_2;
      for (unsigned int q = 0; q < face.points.size(); ++q)
      {
        Tensor<1, 2> of_point;
        for (const auto &[node, shape] : face.points[q].nodes)
          for (unsigned int d = 0; d < 2; ++d)
            of_point[d] += shape * state.displacements[lever][face.nodes[node].dofs[d]];
        const auto elastically = now.turned(of_point);
        append(now.place(face.points[q].position) + elastically - before.place(face.points[q].position), moved.values);
        append(elastically, elastic.values);
        pressure.values.push_back(static_cast<float>(p.at(q)));
        friction.values.push_back(static_cast<float>(t.at(q)));
        append(p[q] * now.across - t[q] * now.along, traction.values);
      }
    }
    return { moved, elastic, pressure, friction, traction };
  }
} // namespace sprag
