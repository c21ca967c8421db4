// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/body_mass.h"
#include "fe/dynamics/dynamic_face_lever.h"
#include "fe/leaf/leaf_spring.h"
#include "levers/dynamics.h"
#include "scene/scene.h"
#include "support/made_mesh.h"
#include "verification/held_slides.h"
#include "verification/solid_run.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numeric>

// Parts of a lever in three dimensions with inertia: leaf spring, tip mass, friction plate on sensors.

using namespace sprag;

namespace
{
  const std::size_t first_sensor = columns_across().size(); ///< among the columns across, where the axis is fixed

  /// Model A without contraction, where plane stress is exact.
  Scene in_space(const AnalysisType type)
  {
    Scene scene                = with_face_size(solid_model_a(0.), 2.);
    scene.layer.thickness      = 2.;
    scene.mesh.elements_across = 2;
    scene.analysis.type        = type;
    scene.analysis.model       = ModelType::condensed;
    scene.condensed.modes      = 12;
    scene.stability.position   = 15.;
    scene.stability.critical   = "none";
    scene.friction.law         = CoulombFriction{ 0.73 }; // which nothing delays, see linearise()
    scene.drive                = Drive(DriveProfile::triangle, 18., 20., 112., 1., 5e-3);
    return with_fixed_step(scene, 1e-4);
  }

  /// A leaf spring heavy enough to be felt, a tip mass, and a support that feels the momentum of both.
  Scene on_leaf_with_tip(Scene scene)
  {
    scene.spring.type           = SpringType::leaf;
    scene.spring.leaf.thickness = 2.;
    scene.lever.tip_mass        = 2e-5;
    scene.support.type          = SupportType::sprung;
    scene.spring                = prepared_spring(scene);
    return scene;
  }

  struct BothRuns
  {
    std::vector<Row> plane, solid;
  };

  /// The lever with those of twice the scene's modes that are no higher than one.
  Dynamics with_modes_up_to(const double stiffness, Scene scene, DynamicsMaker &maker)
  {
    scene.condensed.modes *= 2;
    const auto found = maker.make(scene).solid->modes.stiffness;
    const auto number =
        std::count_if(found.begin(), found.end(), [&](const double value) { return value < 1.00001 * stiffness; });
    return maker.make(scene, static_cast<unsigned int>(number));
  }

  BothRuns run_both(const Scene &scene)
  {
    DynamicsMaker plane_maker(false), space_maker(false);
    const auto plane = plane_maker.make(in_plane(scene));
    const auto solid = with_modes_up_to(plane.lever->condensed.lever->stiffness.back(), scene, space_maker);
    return { run_in_time(plane.model(), scene).rows, run_in_time(solid.model(), scene).rows };
  }
} // namespace

// Scaled as in a plane, whether the half or the whole is there.
TEST(SolidPartsInTime, MassAndMomentOfInertiaAreThePlanes)
{
  for (const auto outline : { LeverOutline::bar, LeverOutline::frame })
    for (const auto source : { InertiaSource::scaled, InertiaSource::as_built })
      for (const double tilt : { 0., 1e-4 })
      {
        Scene scene          = tilted(on_leaf_with_tip(in_space(AnalysisType::transient)), tilt);
        scene.mesh.face_size = 8.;
        scene.mesh.degree    = 1;
        scene.lever.outline  = outline;
        scene.lever.inertia  = source;
        const MadeMesh plane(scene);
        const ElasticBody<2> plane_body(plane, lever_properties(scene).body);
        const InertialMatrices expected(plane_body, lever_inertia(scene));
        const SolidBody body(scene, plane);
        const BodyMass<3> mass(body, lever_inertia(scene));
        EXPECT_EQ(body.is_half(), tilt == 0.);
        EXPECT_NEAR(mass.total_mass, expected.total_mass, 1e-10 * expected.total_mass);
        EXPECT_NEAR(mass.moment_of_inertia, expected.moment_of_inertia, 1e-10 * expected.moment_of_inertia);
        EXPECT_NEAR(mass.density_factor, expected.density_factor, 1e-10 * expected.density_factor);
      }
}

namespace
{
  /// Ringing that dies away, so that what the compliance of the face leaves out does not add up from one oscillation to the next.
  Scene hardly_ringing()
  {
    Scene scene           = in_space(AnalysisType::transient);
    scene.contact.damping = 0.3;
    return scene;
  }
} // namespace

// The residual of steps of the plane, 1e-8 of the penetration, makes up to 7e-7 of the peak of P, more or less by the kernels of
// OpenBLAS, and twice that of the kinetic energy.
TEST(SolidPartsInTime, ALeverMovesAsInThePlane)
{
  const auto runs = run_both(hardly_ringing());
  for (const Column column : { Column::P, Column::Q, Column::theta })
    EXPECT_LT(difference(runs.plane, runs.solid, column), 1e-6) << column_info(column).name;
  EXPECT_LT(difference(runs.plane, runs.solid, Column::kinetic_energy), 2e-6);
}

TEST(SolidPartsInTime, ALeafSpringAndATipMassMoveAsInThePlaneSlow)
{
  const auto runs = run_both(on_leaf_with_tip(hardly_ringing()));
  for (const Column column : { Column::P, Column::Q, Column::theta, Column::Q_support, Column::kinetic_energy })
    EXPECT_LT(difference(runs.plane, runs.solid, column), 1e-6) << column_info(column).name;
}

TEST(SolidPartsInTime, SensorsFeelWhatThePlanesFeel)
{
  const Scene scene = hardly_ringing();
  const auto runs   = run_both(on_sensors(scene, 0.5 * scene.lever.width)); // the plane's
  for (const Column column : { Column::P, Column::Q, Column::theta })
    EXPECT_LT(difference(runs.plane, runs.solid, column), 1e-6) << column_info(column).name;
  EXPECT_LT(sensor_difference(runs.plane, runs.solid), 1e-6);
  for (const auto &row : runs.solid)
    for (const std::size_t place : { 0u, 1u })
      for (const std::size_t side : { 0u, 1u })
        EXPECT_EQ(row.across.at(first_sensor + 2 * place + side), 0.5 * row.sensor_forces[place]);
}

namespace
{
  /// Narrow pads at the corners, with contraction, the axis out of true.
  Scene at_corners(const double tilt, const AnalysisType type = AnalysisType::transient)
  {
    Scene scene               = tilted(with_face_size(in_space(type), 4.), tilt);
    scene.lever.poisson_ratio = scene.layer.poisson_ratio = 0.3;
    scene.drive                                           = Drive(DriveProfile::triangle, 18., 19., 112., 1.);
    return on_sensors(scene, 8.);
  }
} // namespace

// At rest they balance the contact, whatever the number of modes; in motion they are those of the body as it is deformed.
TEST(SolidPartsInTime, SensorsAreThoseOfTheDeformedBodySlow)
{
  Scene scene           = at_corners(2e-4, AnalysisType::stability);
  scene.condensed.modes = 3;
  DynamicsMaker maker(false);
  const auto dynamics = maker.make(scene);
  auto &model         = dynamics.model();
  const auto slide    = model.hold(held_drive(scene), ContactFriction::sliding);
  ASSERT_TRUE(slide);
  Row row;
  model.observe(slide->motion, row);
  EXPECT_NEAR(sum(row.sensor_forces), row[Column::P], 1e-8 * row[Column::P]);

  auto motion = model.initial_motion(scene.drive.at(0.));
  for (unsigned int i = 1; i <= 10; ++i)
  {
    motion = model.step(motion, scene.drive.at(i * 1e-4), StepWeights{ 1e-4, 0., 0., 0.25, 0.5 }).motion.value();
    model.observe(motion, row);
    const auto expected = dynamics.solid->body->sensor_forces(dynamics.meshed.elastic_displacement(motion, 0));
    ASSERT_EQ(row.across.size(), first_sensor + expected.size());
    for (std::size_t side = 0; side < expected.size(); ++side)
      EXPECT_NEAR(row.across[first_sensor + side], expected[side], 1e-7 * row[Column::P]);
  }
}
