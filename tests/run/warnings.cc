#include "run/row_warnings.h"
#include "run/scene_warnings.h"
#include "scene/closed_form.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  std::vector<std::string> names(const Warnings &warnings)
  {
    std::vector<std::string> result;
    for (const Warning &warning : warnings)
    {
      EXPECT_FALSE(warning.found.empty() || warning.effect.empty() || warning.remedy.empty()) << warning.name;
      result.push_back(warning.name);
    }
    return result;
  }

  using Names = std::vector<std::string>;

  /// Model A at x = 65 mm backward with the default mesh.
  Row usual_row()
  {
    Row row;
    row[Column::x]                 = 65.;
    row[Column::v]                 = -112.;
    row[Column::s]                 = 120.;
    row[Column::P]                 = 25.4;
    row[Column::F]                 = -18.5;
    row[Column::theta]             = 0.0993;
    row[Column::theta_closed_form] = 0.0995;
    row[Column::contact_width]     = 2.5;
    row[Column::penetration]       = 0.0014;
    row[Column::indentation]       = 0.0164;
    row[Column::elastic_slip]      = 0.001;
    row[Column::largest_pressure]  = 0.34;
    row[Column::step]              = 1.;
    row[Column::drive_work]        = 100.;
    row[Column::friction_work]     = 60.;
    row[Column::spring_energy]     = 39.;
    row[Column::elastic_energy]    = 1.;
    return row;
  }

  Row first_row()
  {
    Row row                     = usual_row();
    row[Column::x]              = 0.;
    row[Column::P]              = 0.;
    row[Column::drive_work]     = 0.;
    row[Column::friction_work]  = 0.;
    row[Column::spring_energy]  = 0.;
    row[Column::elastic_energy] = 0.;
    return row;
  }

  Names names_with(const Column column, const double value, const Scene &scene = model_a())
  {
    Row row     = usual_row();
    row[column] = value;
    return names(row_warnings(scene, { first_row(), row }));
  }

  Scene near_locking(const double gap)
  {
    Scene scene        = with_coulomb(model_a(), 0.);
    const double s     = kinematics(scene.geometry, scene.drive.maximum()).s;
    scene.friction.law = CoulombFriction{ s / scene.geometry.interface_offset - gap };
    return scene;
  }
} // namespace

TEST(RowWarnings, ModelAHasNone)
{
  EXPECT_EQ(names(row_warnings(model_a(), { first_row(), usual_row() })), Names{});
  EXPECT_EQ(names(row_warnings(model_a(), {})), Names{});
}

TEST(RowWarnings, OverlapAgainstApproachAndLayer)
{
  EXPECT_EQ(names_with(Column::penetration, 0.19 / 0.81 * 0.0164), Names{});
  EXPECT_EQ(names_with(Column::penetration, 0.21 / 0.79 * 0.0164), Names{ "soft_penalty" });
  EXPECT_EQ(names_with(Column::penetration, 0.11), (Names{ "overlap_of_layer", "soft_penalty" }));
  Scene thick           = model_a();
  thick.layer.thickness = 2.;
  EXPECT_EQ(names_with(Column::penetration, 0.11, thick), Names{ "soft_penalty" });
}

TEST(RowWarnings, CoarseContact)
{
  Scene scene          = model_a();
  scene.mesh.face_size = 2.;
  EXPECT_EQ(names(row_warnings(scene, { first_row(), usual_row() })), Names{ "coarse_contact" });
}

TEST(RowWarnings, ElasticSlipAgainstContactWidth)
{
  EXPECT_EQ(names_with(Column::elastic_slip, 0.019 * 2.5), Names{});
  EXPECT_EQ(names_with(Column::elastic_slip, 0.021 * 2.5), Names{ "soft_tangential_penalty" });
}

TEST(RowWarnings, DeflectionInLinearTheory)
{
  // Compression and overlap take (0.0164 + 0.0014)/120 = 0.00015 of the difference.
  const double exact = usual_row()[Column::theta_closed_form];
  EXPECT_EQ(names_with(Column::theta, exact - 0.0201), Names{});
  EXPECT_EQ(names_with(Column::theta, exact - 0.0202), Names{ "large_deflection" });
  Scene finite          = model_a();
  finite.lever.material = MaterialModel::neo_hookean;
  EXPECT_EQ(names_with(Column::theta, exact - 0.021, finite), Names{});
  // A lever that has left the cylinder turns freely.
  Row free            = usual_row();
  free[Column::theta] = exact + 0.05;
  free[Column::P]     = 0.;
  EXPECT_EQ(names(row_warnings(model_a(), { first_row(), free, usual_row() })), Names{});
}

TEST(RowWarnings, CompressionInLinearTheory)
{
  EXPECT_EQ(names_with(Column::indentation, 0.099), Names{});
  EXPECT_EQ(names_with(Column::indentation, 0.101), Names{ "large_strain" });
  Scene finite          = model_a();
  finite.lever.material = MaterialModel::neo_hookean;
  EXPECT_EQ(names_with(Column::indentation, 0.101, finite), Names{});
}

TEST(RowWarnings, PressureBeyondStrength)
{
  Scene scene = model_a();
  EXPECT_EQ(names_with(Column::largest_pressure, 0.79, scene), Names{});
  EXPECT_EQ(names_with(Column::largest_pressure, 0.81, scene), Names{ "pressure_beyond_strength" });
  scene.layer.strength = 0.3;
  EXPECT_EQ(names_with(Column::largest_pressure, 0.31, scene), Names{ "pressure_beyond_strength" });
  // Without a face the pressure is estimated, 0.34 MPa.
  scene.analysis.model              = ModelType::beam;
  Row no_face                       = usual_row();
  no_face[Column::largest_pressure] = std::nan("");
  EXPECT_EQ(names(row_warnings(scene, { no_face })), Names{ "pressure_beyond_strength" });
  scene.layer.strength = 0.36;
  EXPECT_EQ(names(row_warnings(scene, { no_face })), Names{});
}

TEST(RowWarnings, StrengthOfCorkAlone)
{
  FrictionLayer layer;
  EXPECT_DOUBLE_EQ(layer_strength(layer).value(), 0.8);
  layer.poisson_ratio = 0.3;
  EXPECT_FALSE(layer_strength(layer));
  layer.strength = 5.;
  EXPECT_DOUBLE_EQ(layer_strength(layer).value(), 5.);
  layer.thickness = 0.;
  EXPECT_FALSE(layer_strength(layer));
}

TEST(RowWarnings, PressureOfAnElasticFoundation)
{
  // Finite elements on a fine mesh: 0.338 MPa.
  EXPECT_NEAR(layer_pressure(model_a(), 25.41), 0.338, 0.03 * 0.338);
  EXPECT_NEAR(layer_pressure(model_a(), 8. * 25.41), 4. * layer_pressure(model_a(), 25.41), 1e-12);
}

TEST(RowWarnings, LongStepsLeaveEnergyOpen)
{
  EXPECT_EQ(names_with(Column::friction_work, 60.25), Names{});
  EXPECT_EQ(names_with(Column::friction_work, 60.26), Names{ "long_steps" });
  Scene in_time         = model_a();
  in_time.analysis.type = AnalysisType::transient;
  EXPECT_EQ(names_with(Column::friction_work, 61.1, in_time), Names{});
  // What the springs of a soft penalty hold is no gap.
  Row soft                  = usual_row();
  soft[Column::penetration] = 0.5;
  soft[Column::spring_energy] -= 10.;
  EXPECT_EQ(names(row_warnings(model_a(), { first_row(), soft })), (Names{ "overlap_of_layer", "soft_penalty" }));
}

TEST(SceneWarnings, ModelAHasNone)
{
  EXPECT_EQ(names(scene_warnings(model_a())), Names{});
}

TEST(SceneWarnings, DefaultsInAnotherDevice)
{
  Scene scene = model_b();
  EXPECT_EQ(names(scene_warnings(scene)), Names{ "defaults_of_model_a" });
  scene.given      = { "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot distance",
                       "Rotational spring/Stiffness" };
  const auto found = scene_warnings(scene);
  ASSERT_EQ(names(found), Names{ "defaults_of_model_a" });
  EXPECT_NE(found[0].found.find("Lever/Length = 210, Lever/Depth = 20, Lever/Width = 40"), std::string::npos) << found[0].found;
  EXPECT_EQ(found[0].found.find("Moment of inertia"), std::string::npos) << found[0].found;

  scene.given.insert({ "Lever/Length", "Lever/Depth", "Lever/Width" });
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
  scene.analysis.type  = AnalysisType::transient;
  scene.analysis.model = ModelType::rigid;
  const auto in_time   = scene_warnings(scene);
  ASSERT_EQ(names(in_time), Names{ "defaults_of_model_a" });
  EXPECT_NE(in_time[0].found.find("Lever/Moment of inertia = 6.45, Contact/Stiffness = 2000"), std::string::npos)
      << in_time[0].found;
  scene.lever.inertia = InertiaSource::as_built;
  scene.contact.type  = ContactType::ideal;
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
}

TEST(SceneWarnings, AVariationOfModelAIsNoOtherDevice)
{
  Scene scene                    = model_a();
  scene.geometry.cylinder_radius = 58.;
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
  scene.geometry.pivot_distance = 190.;
  EXPECT_EQ(names(scene_warnings(scene)), Names{ "defaults_of_model_a" });
}

TEST(SceneWarnings, WhatAMapVariesIsGiven)
{
  Scene scene          = model_b();
  scene.analysis.type  = AnalysisType::map;
  scene.analysis.model = ModelType::rigid;
  scene.given          = { "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot distance",
                           "Rotational spring/Stiffness", "Lever/Moment of inertia" };
  EXPECT_EQ(names(scene_warnings(scene)), Names{ "defaults_of_model_a" });
  scene.map.second.name = "Contact/Stiffness";
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
}

TEST(SceneWarnings, NearLocking)
{
  // mu / (s/e - mu) = 10 at a gap of an eleventh of s/e = 2.633.
  EXPECT_EQ(names(scene_warnings(near_locking(0.25))), Names{});
  EXPECT_EQ(names(scene_warnings(near_locking(0.23))), Names{ "near_locking" });
  EXPECT_EQ(names(scene_warnings(near_locking(0.01))), Names{ "near_locking" });
  Scene held         = near_locking(0.01);
  held.analysis.type = AnalysisType::slope;
  EXPECT_EQ(names(scene_warnings(held)), Names{});
}

TEST(SceneWarnings, NearLockingTellsTheSensitivityOfTheClosedForm)
{
  const Scene scene = near_locking(0.1);
  const double x    = scene.drive.maximum();
  const auto P      = [&](const double factor)
  {
    Scene changed = scene;
    changed.friction.factor *= factor;
    return closed_form(changed, x, -112.).P;
  };
  const double told = (P(1. + 1e-6) - P(1. - 1e-6)) / (2e-6 * P(1.));
  const auto found  = scene_warnings(scene).at(0).found;
  const auto begin  = found.find("mu e/(s - mu e) = ") + 18;
  EXPECT_NEAR(std::stod(found.substr(begin)), told, 1e-4 * told) << found;
}

TEST(SceneWarnings, StrainOfALeaf)
{
  // 2 t/L times a turn of 0.0303 rad: 0.4 % from 6.6 mm on.
  Scene scene                 = model_a();
  scene.spring.type           = SpringType::leaf;
  scene.spring.leaf.thickness = 6.5;
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
  scene.spring.leaf.thickness = 6.8;
  EXPECT_EQ(names(scene_warnings(scene)), Names{ "leaf_beyond_yield" });
  scene.spring.leaf.end = LeafEnd::pinned;
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
  scene.spring.leaf.clamp_distance = 40.;
  EXPECT_EQ(names(scene_warnings(scene)), Names{ "leaf_beyond_yield" });
}

TEST(SceneWarnings, PlaneStressOfALayer)
{
  Scene scene               = model_a();
  scene.layer.poisson_ratio = 0.41;
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
  scene.layer.poisson_ratio = 0.42;
  EXPECT_EQ(names(scene_warnings(scene)), Names{ "plane_stress_of_layer" });
  Scene other          = scene;
  other.analysis.plane = PlaneState::strain;
  EXPECT_EQ(names(scene_warnings(other)), Names{});
  other                = scene;
  other.analysis.model = ModelType::closed_form;
  EXPECT_EQ(names(scene_warnings(other)), Names{});
}
