// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/body_fields.h"
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
