// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/body_fields.h"
#include "fe/fields/device_mesh.h"
#include "fe/statics/static_lever.h"
#include "run_scene.h"
#include "scene/scene.h"

#include <algorithm>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Model A on a coarse mesh without contraction, so that the plane is exact, up to the place where it turns.
  Scene model_a_forward(const unsigned int dimension)
  {
    Scene scene               = with_face_size(model_a(), 4.);
    scene.analysis.dimension  = dimension;
    scene.lever.poisson_ratio = scene.layer.poisson_ratio = 0.;
    scene.mesh.elements_across                            = 4;
    scene.drive                                           = Drive(DriveProfile::triangle, 0., 20., 112., 0.5);
    return scene;
  }

  struct Nodal
  {
    std::vector<BodyFields::Node> nodes;
    std::vector<NodalField> fields;
  };

  Nodal nodal(const BodyFields &body, const dealii::Vector<double> &displacement)
  {
    return { body.nodes, body.at(displacement) };
  }

  State last_state(Model &model, const Scene &scene)
  {
    State last;
    run_quasi_static(model, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
                     [&](const State &state, const Row &, const Evaluation &) { last = state; });
    return last;
  }

  struct PlaneRun
  {
    explicit PlaneRun(const Scene &scene)
    {
      make_mesh(scene, mesh);
      StaticLever<2> model(mesh, scene);
      const auto state = last_state(model, scene);
      displacement     = model.body_displacements(state.coordinates, state.forces).front();
      found            = nodal(BodyFields(model.body()), displacement);
    }

    Mesh mesh;
    dealii::Vector<double> displacement;
    Nodal found;
  };

  struct SolidRun
  {
    explicit SolidRun(const Scene &scene)
        : body((make_mesh(scene, mesh), scene), mesh)
        , fields(body)
    {
      StaticLever<3> lever(body, scene);
      const auto state = last_state(lever, scene);
      found            = nodal(fields, lever.body_displacements(state.coordinates, state.forces).front());
    }

    Mesh mesh;
    const SolidBody body;
    const BodyFields fields;
    Nodal found;
  };

  /// The node of the plane below one in space.
  unsigned int below(const Nodal &plane, const BodyFields::Node &node)
  {
    const auto is_there = [&](const BodyFields::Node &other)
    {
      return other.part == node.part && other.at_hub == node.at_hub && std::abs(other.position[0] - node.position[0]) < 1e-9 &&
             std::abs(other.position[1] - node.position[1]) < 1e-9;
    };
    return static_cast<unsigned int>(std::find_if(plane.nodes.begin(), plane.nodes.end(), is_there) - plane.nodes.begin());
  }

  double volume(const FieldMesh &mesh, const double lever_number)
  {
    const auto node = [&](const unsigned int number) {
      return dealii::Tensor<1, 3>({ mesh.nodes[3 * number], mesh.nodes[3 * number + 1], mesh.nodes[3 * number + 2] });
    };
    double result = 0.;
    auto cells    = mesh.cells;
    cells.insert(cells.end(), mesh.rigid_cells.begin(), mesh.rigid_cells.end());
    for (std::size_t first = 0; first < cells.size(); first += 8)
    {
      const auto corner = [&](const unsigned int i) { return node(cells[first + i]); };
      if (mesh.fixed[1].values[cells[first]] != static_cast<float>(lever_number))
        continue;
      // Six tetrahedra about the edge from the first corner to the one opposite, in XDMF's order.
      for (const auto &[a, b] : { std::pair(1u, 2u), { 2u, 3u }, { 3u, 7u }, { 7u, 4u }, { 4u, 5u }, { 5u, 1u } })
      {
        const double part = cross_product_3d(corner(a) - corner(0), corner(b) - corner(0)) * (corner(6) - corner(0)) / 6.;
        EXPECT_GT(part, -1e-9);
        result += part;
      }
    }
    return result;
  }
} // namespace

// Displacements and stress follow from the forces of the face, and these are those of the plane to 1e-6, as P is.
TEST(SolidFields, WithoutContractionTheyAreThoseOfPlaneStress)
{
  const PlaneRun plane(model_a_forward(2));
  const SolidRun solid(model_a_forward(3));
  double moved = 0., stressed = 0.;
  for (const auto &field : plane.found.fields)
  {
    moved    = std::max(moved, field.displacement.norm());
    stressed = std::max(stressed, field.stress.norm());
  }
  EXPECT_GT(stressed, 0.1);
  std::vector<unsigned int> met(plane.found.nodes.size(), 0);
  double displacement = 0., stress = 0.;
  for (unsigned int i = 0; i < solid.found.nodes.size(); ++i)
  {
    const unsigned int other = below(plane.found, solid.found.nodes[i]);
    ASSERT_LT(other, met.size()) << solid.found.nodes[i].position;
    ++met[other];
    displacement = std::max(displacement, (solid.found.fields[i].displacement - plane.found.fields[other].displacement).norm());
    stress       = std::max(stress, (solid.found.fields[i].stress - plane.found.fields[other].stress).norm());
  }
  EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](const unsigned int n) { return n == 5; })); // of two elements in the half
  EXPECT_LT(displacement, 1e-6 * moved);
  EXPECT_LT(stress, 1e-6 * stressed);
}

// The half that is solved is there with its mirror image, all cells count their corners the same way round, and the cylinder is
// a tube around its axis.
TEST(SolidFields, TheMeshIsTheWholeLeverAndTheCylinder)
{
  Scene scene           = model_a_forward(3);
  scene.cylinder.length = 60.;
  for (const double tilt : { 0., 1e-2 })
  {
    scene.cylinder.tilt = tilt;
    Mesh plane;
    make_mesh(scene, plane);
    const SolidBody body(scene, plane);
    const BodyFields fields(body);
    double area = 0.;
    for (const auto &cell : plane.active_cell_iterators())
      area += cell->measure();
    const auto mesh = device_mesh(scene, rest_pose(scene), device_blocks(scene, fields, nullptr), fields, nullptr);
    EXPECT_NEAR(volume(mesh, 1.), area * scene.lever.width, 1e-9 * area * scene.lever.width);
    const double radius = scene.geometry.cylinder_radius, angle = 2. * M_PI / 180.;
    EXPECT_NEAR(volume(mesh, 0.), 90. * radius * radius * std::sin(angle) * scene.cylinder.length, 1.);
    double left = 0., right = 0.;
    for (std::size_t i = 2; i < mesh.nodes.size(); i += 3)
      if (mesh.fixed[1].values[i / 3] == 1.f)
      {
        left  = std::min(left, mesh.nodes[i]);
        right = std::max(right, mesh.nodes[i]);
      }
    EXPECT_NEAR(left, -0.5 * scene.lever.width, 1e-9);
    EXPECT_NEAR(right, 0.5 * scene.lever.width, 1e-9);
  }
}
