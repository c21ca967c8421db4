// SPDX-License-Identifier: GPL-3.0-only
#include "report/warnings.h"
#include "base/text.h"
#include "report/console_summary.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/make_row.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

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
    return make_row({ { Column::x, 65. },
                      { Column::v, -112. },
                      { Column::s, 120. },
                      { Column::P, 25.4 },
                      { Column::F, -18.5 },
                      { Column::theta, 0.0993 },
                      { Column::theta_closed_form, 0.0995 },
                      { Column::contact_width, 2.5 },
                      { Column::penetration, 0.0014 },
                      { Column::indentation, 0.0164 },
                      { Column::elastic_slip, 0.001 },
                      { Column::largest_pressure, 0.34 },
                      { Column::step, 1. },
                      { Column::drive_work, 100. },
                      { Column::friction_work, 60. },
                      { Column::spring_energy, 39. },
                      { Column::elastic_energy, 1. } });
  }

  Row first_row()
  {
    Row row = usual_row();
    for (const auto column :
         { Column::x, Column::P, Column::drive_work, Column::friction_work, Column::spring_energy, Column::elastic_energy })
      row[column] = 0.;
    return row;
  }

  Names names_with(const Column column, const double value, const Scene &scene = model_a())
  {
    Row row     = usual_row();
    row[column] = value;
    return names(row_warnings(scene, { first_row(), row }));
  }

  /// The row has no warning with `admitted` in that column, and that one with `beyond`.
  void expect_bound(const Column column, const double admitted, const double beyond, const std::string &name)
  {
    EXPECT_EQ(names_with(column, admitted), Names{});
    EXPECT_EQ(names_with(column, beyond), Names{ name });
  }

  /// The scene has no warning with `admitted` for that number of its, and that one with `beyond`, which stays.
  void expect_bound(const Scene &scene, double &number, const double admitted, const double beyond, const std::string &name)
  {
    number = admitted;
    EXPECT_EQ(names(scene_warnings(scene)), Names{});
    number = beyond;
    EXPECT_EQ(names(scene_warnings(scene)), Names{ name });
  }

  Scene at_finite_strain()
  {
    Scene scene          = model_a();
    scene.lever.material = MaterialModel::neo_hookean;
    return scene;
  }

  Scene near_locking(const double gap)
  {
    Scene scene        = with_coulomb(model_a(), 0.);
    const double s     = kinematics(scene.geometry, scene.drive.maximum()).s;
    scene.friction.law = CoulombFriction{ s / scene.geometry.interface_offset - gap };
    return scene;
  }
} // namespace

TEST(RowWarnings, AreGivenBeyondTheirBounds)
{
  const double exact = usual_row()[Column::theta_closed_form];
  expect_bound(Column::penetration, 0.19 / 0.81 * 0.0164, 0.21 / 0.79 * 0.0164, "soft_penalty");
  expect_bound(Column::elastic_slip, 0.019 * 2.5, 0.021 * 2.5, "soft_tangential_penalty");
  // Compression and penetration take (0.0164 + 0.0014)/120 = 0.00015 of the difference.
  expect_bound(Column::theta, exact - 0.0201, exact - 0.0202, "large_deflection");
  expect_bound(Column::indentation, 0.099, 0.101, "large_strain");
  expect_bound(Column::friction_work, 60.25, 60.26, "long_steps");
  EXPECT_EQ(names_with(Column::penetration, 0.11), (Names{ "overlap_of_layer", "soft_penalty" }));
  EXPECT_EQ(names_with(Column::theta, exact - 0.021, at_finite_strain()), Names{});
  EXPECT_EQ(names_with(Column::indentation, 0.101, at_finite_strain()), Names{});
  Scene in_time         = model_a();
  in_time.analysis.type = AnalysisType::transient;
  EXPECT_EQ(names_with(Column::friction_work, 61.1, in_time), Names{});
}

TEST(SceneWarnings, AreGivenBeyondTheirBounds)
{
  Scene leaf       = model_a();
  leaf.spring.type = SpringType::leaf;
  // 2 t/L times a turn of 0.0303 rad: 0.4 % from 6.6 mm on.
  expect_bound(leaf, leaf.spring.leaf.thickness, 6.5, 6.8, "leaf_beyond_yield");
  Scene layer       = model_a();
  layer.layer.plane = PlaneState::stress;
  expect_bound(layer, layer.layer.poisson_ratio, 0.41, 0.42, "plane_stress_of_layer");
  // mu / (s/e - mu) = 10 at a gap of an eleventh of s/e = 2.633.
  EXPECT_EQ(names(scene_warnings(near_locking(0.25))), Names{});
  EXPECT_EQ(names(scene_warnings(near_locking(0.23))), Names{ "near_locking" });
}

// A cylinder of 60 MPa yields 3500 times as far as a lever of steel and hides what the penalty overlaps.
TEST(RowWarnings, OverlapBesideAnElasticCylinder)
{
  Scene soft                  = model_a();
  soft.layer.thickness        = 0.;
  soft.cylinder.type          = CylinderType::solid;
  soft.cylinder.young_modulus = 60.;
  soft.cylinder.poisson_ratio = 0.49;
  Row row                     = usual_row();
  row[Column::indentation]    = 0.;
  const auto names_at         = [&](const double share)
  {
    const double compliance = (1. - std::pow(soft.lever.poisson_ratio, 2)) / soft.lever.young_modulus + (1. - 0.49 * 0.49) / 60.;
    const double a = std::sqrt(4. * row[Column::P] * soft.geometry.cylinder_radius * compliance / (M_PI * soft.lever.width));
    row[Column::penetration] = share / (1. - share) * a * a / (2. * soft.geometry.cylinder_radius);
    return names(row_warnings(soft, { first_row(), row }));
  };
  EXPECT_FALSE(contains(names_at(0.19), "soft_penalty"));
  EXPECT_TRUE(contains(names_at(0.21), "soft_penalty"));
  // Without the cylinder it would be 22 % of the approach.
  soft.layer.thickness        = 1.;
  soft.cylinder.young_modulus = 20.;
  row[Column::indentation]    = 0.0164;
  row[Column::penetration]    = 0.22 / 0.78 * 0.0164;
  EXPECT_FALSE(contains(names(row_warnings(soft, { first_row(), row })), "soft_penalty"));
}

TEST(RowWarnings, PressureOfSinglePoints)
{
  const auto with_peak = [](const double over_mean, const bool specified, const double poisson_ratio, const double tilt = 0.)
  {
    Scene scene               = model_a();
    scene.layer.poisson_ratio = poisson_ratio;
    scene.analysis.dimension  = 3;
    scene.cylinder.tilt       = tilt;
    if (specified)
      scene.contact.penalty = 1e4;
    const Row row = usual_row();
    return names_with(Column::largest_pressure, over_mean * row[Column::P] / (row[Column::contact_width] * scene.lever.width),
                      scene);
  };
  EXPECT_EQ(with_peak(1.55, true, 0.), Names{});
  EXPECT_EQ(with_peak(1.65, true, 0.), Names{ "stiff_penalty" });
  EXPECT_EQ(with_peak(1.65, false, 0.), Names{});
  EXPECT_EQ(with_peak(1.9, true, 0.45), Names{});
  EXPECT_EQ(with_peak(2.1, true, 0.45), Names{ "stiff_penalty" });
  EXPECT_EQ(with_peak(3., true, 0., 1e-3), Names{}); // pressed by one side of the width, twice the mean there
}

TEST(RowWarnings, PressureBeyondStrength)
{
  expect_bound(Column::largest_pressure, 0.79, 0.81, "pressure_beyond_strength");
  Scene scene          = model_a();
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

// The second lever of a pair presses its cork beyond 0.8 MPa, bends, or slides where friction falls too fast, and the first does
// not. The slip speed's share is that of both.
TEST(SlideWarnings, OfThePairsSecondLever)
{
  Scene scene          = model_a();
  scene.pair.type      = PairType::full;
  scene.analysis.model = ModelType::beam;
  const double ideal   = kinematics(scene.geometry, 30.).theta;
  const auto warned    = [&](const double P, const double turn, const double own_speed_share, const double speed = 100.)
  {
    Row row           = make_row({ { Column::x, 30. },
                                   { Column::v, speed },
                                   { Column::v_rel, speed },
                                   { Column::theta, ideal },
                                   { Column::P, 5. },
                                   { Column::indentation, 0. } });
    Row second        = row;
    second[Column::P] = P;
    second[Column::theta] += turn;
    row.add_second_lever(second);
    return slide_warnings(scene, row, own_speed_share);
  };
  EXPECT_EQ(names(warned(5., 0.019, 0.049)), Names{});
  EXPECT_EQ(names(warned(5., 0.021, 0.)), Names{ "large_deflection" });
  EXPECT_EQ(names(warned(5., 0., 0.051)), Names{ "path_dependent_slide" });
  EXPECT_EQ(names(warned(500., 0., 0.)), Names{ "pressure_beyond_strength" });
  EXPECT_NE(warned(500., 0., 0.).front().found.find("second lever"), std::string::npos);
  scene.friction.law           = StribeckFriction{ 0.9, 0.3, 10. };
  scene.friction.memory_length = 1e-3;
  scene.friction.factor        = 1e-3;
  scene.pair.friction_ratio    = 1e3;
  EXPECT_EQ(names(warned(5., 0., 0., 10.)), Names{ "runaway_slip" });
}

// Largest pressures of a rigid cylinder of R = 56 mm under 0.895 N/mm on a bonded layer in plane strain, by collocation with the
// kernel of the layer, outside of this program. The last one is Hertz's.
TEST(RowWarnings, PressureOfALayer)
{
  struct Known
  {
    double poisson_ratio, thickness, young_modulus, pressure, tolerance;
  };
  for (const auto &[nu, t, E, p, tolerance] :
       { Known{ 0., 0.5, 20., 0.5447, 0.002 }, Known{ 0., 3., 20., 0.3453, 0.055 }, Known{ 0., 10., 20., 0.3218, 0.01 },
         Known{ 0.3, 1., 1., 0.1747, 0.005 }, Known{ 0.45, 0.5, 20., 0.6895, 0.035 }, Known{ 0.49, 1., 5., 0.3672, 0.06 },
         Known{ 0.4995, 3., 20., 0.4088, 0.07 }, Known{ 0.4995, 1., 1., 0.2438, 0.11 },
         Known{ 0.3, 1e4, 20., std::sqrt(0.895 * 20. / (0.91 * M_PI * 56.)), 1e-3 } })
  {
    Scene scene               = model_a();
    scene.layer.plane         = PlaneState::strain;
    scene.layer.poisson_ratio = nu;
    scene.layer.thickness     = t;
    scene.layer.young_modulus = E;
    EXPECT_NEAR(layer_pressure(scene, 0.895 * scene.lever.width), p, tolerance * p) << nu << ' ' << t;
    // Bulging freely along the width.
    const double free         = nu / (1. - nu);
    scene.layer.plane         = PlaneState::stress;
    scene.layer.poisson_ratio = free;
    scene.layer.young_modulus = E * std::pow(1. + free, 2) / (1. + 2. * free);
    EXPECT_NEAR(layer_pressure(scene, 0.895 * scene.lever.width), p, tolerance * p) << nu << ' ' << t;
  }
  // Finite elements on a fine mesh: 0.338 MPa.
  EXPECT_NEAR(layer_pressure(model_a(), 25.41), 0.338, 0.03 * 0.338);
}

TEST(SceneWarnings, DefaultsInAnotherDevice)
{
  Scene scene = model_b();
  EXPECT_EQ(names(scene_warnings(scene)), Names{ "defaults_of_model_a" });
  scene.specified  = { "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot distance",
                       "Rotational spring/Stiffness" };
  const auto found = scene_warnings(scene);
  ASSERT_EQ(names(found), Names{ "defaults_of_model_a" });
  EXPECT_NE(found[0].found.find("Lever/Length = 210, Lever/Depth = 20, Lever/Width = 40"), std::string::npos) << found[0].found;
  EXPECT_EQ(found[0].found.find("Moment of inertia"), std::string::npos) << found[0].found;

  scene.specified.insert({ "Lever/Length", "Lever/Depth", "Lever/Width" });
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

TEST(SceneWarnings, AnotherLeverIsNotScaledToTheInertiaOfModelA)
{
  Scene scene          = model_a();
  scene.analysis.type  = AnalysisType::transient;
  scene.analysis.model = ModelType::condensed;
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
  scene.mesh.file  = "own.msh";
  const auto found = scene_warnings(scene);
  ASSERT_EQ(names(found), Names{ "defaults_of_model_a" });
  EXPECT_NE(found[0].found.find("The lever is of another device"), std::string::npos) << found[0].found;
  EXPECT_NE(found[0].found.find("give Lever/Moment of inertia = 6.45: "), std::string::npos) << found[0].found;
  Scene built         = scene;
  built.lever.inertia = InertiaSource::as_built;
  EXPECT_EQ(names(scene_warnings(built)), Names{});
  Scene at_rest         = scene;
  at_rest.analysis.type = AnalysisType::quasi_static;
  EXPECT_EQ(names(scene_warnings(at_rest)), Names{});
  scene.specified = { "Lever/Moment of inertia" };
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
}

// Rigid levers and beams have the stiffness of Contact/Stiffness, whatever the layer.
TEST(SceneWarnings, ForeignContactLaw)
{
  Scene scene          = model_a();
  scene.analysis.type  = AnalysisType::transient;
  scene.analysis.model = ModelType::beam;
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
  scene.layer.young_modulus = 40.;
  const auto found          = scene_warnings(scene);
  ASSERT_EQ(names(found), Names{ "foreign_contact_law" });
  Scene meshed          = scene;
  meshed.analysis.model = ModelType::condensed;
  EXPECT_EQ(names(scene_warnings(meshed)), Names{});
  const auto law = face_law(meshed);
  // Contact/Stiffness = 9541 N/mm^1.455 was fitted to half of that modulus; a law of the power 1.5 goes with its power 1.5.
  EXPECT_NEAR(law.stiffness, std::pow(2., 1.5) * 9541., 0.3 * law.stiffness);
  EXPECT_NE(found[0].found.find("has about " + rounded_text(law.stiffness) + " N/mm^n with n = 1.5."), std::string::npos)
      << found[0].found;
  scene.layer.poisson_ratio = 0.49;
  EXPECT_EQ(scene_warnings(scene).at(0).found.find("has about"), std::string::npos);

  scene.specified = { "Contact/Stiffness", "Friction layer/Young's modulus" };
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
  scene.by_option = { "Friction layer/Young's modulus" };
  EXPECT_EQ(names(scene_warnings(scene)), Names{ "foreign_contact_law" });
  scene.by_option.insert("Contact/Stiffness");
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
}

TEST(SceneWarnings, LockingOfModelsThatCanBend)
{
  const auto locks = [](const Warnings &warnings)
  { return std::any_of(warnings.begin(), warnings.end(), [](const Warning &each) { return each.name == "locks"; }); };
  // s = 120.05 mm at x = 65 mm, e = 45.6 mm: mu = 2.6327.
  EXPECT_FALSE(locks(scene_warnings(with_coulomb(model_a(), 2.63))));
  EXPECT_TRUE(locks(scene_warnings(with_coulomb(model_a(), 2.64))));
  Scene pair               = with_coulomb(model_a(), 1.8);
  pair.pair.type           = PairType::full;
  pair.pair.friction_ratio = 1.45; // 2.61
  EXPECT_FALSE(locks(scene_warnings(pair)));
  pair.pair.friction_ratio = 1.5; // 2.7
  EXPECT_TRUE(locks(scene_warnings(pair)));
  for (const auto type : { AnalysisType::stability, AnalysisType::sprag_slip })
  {
    Scene held         = with_coulomb(model_a(), 2.64);
    held.analysis.type = type;
    EXPECT_TRUE(locks(scene_warnings(held)));
    held.stability.direction = Direction::forward;
    EXPECT_FALSE(locks(scene_warnings(held)));
    held.stability.direction = Direction::backward;
    held.stability.position  = 64.;
    EXPECT_FALSE(locks(scene_warnings(held)));
  }
}

// Each number is that of model A in another unit.
TEST(SceneWarnings, ValuesOfAnotherUnitNameIt)
{
  const auto remedy = [](const std::string &parameter, const std::function<void(Scene &)> &change)
  {
    Scene scene = model_a();
    change(scene);
    EXPECT_EQ(names(scene_warnings(scene)), Names{}) << "not given";
    scene.specified.insert(parameter);
    const auto warnings = scene_warnings(scene);
    EXPECT_EQ(names(warnings), Names{ "implausible_values" }) << parameter;
    return warnings.empty() ? "" : warnings[0].remedy;
  };
  const auto expect_meant =
      [&](const std::string &parameter, const std::string &meant, const std::function<void(Scene &)> &change)
  { EXPECT_EQ(remedy(parameter, change).rfind(parameter + " may be meant as " + meant + ". ", 0), 0u) << parameter; };
  expect_meant("Lever/Density", "2700 kg/m3, which is 2.7e-09 t/mm3", [](Scene &scene) { scene.lever.density = 2700.; });
  expect_meant("Lever/Density", "2.7 g/cm3, which is 2.7e-09 t/mm3", [](Scene &scene) { scene.lever.density = 2.7; });
  expect_meant("Leaf spring/Young's modulus", "2.06e+11 Pa, which is 206000 MPa",
               [](Scene &scene)
               {
                 scene.specified                 = { "Rotational spring/Type" };
                 scene.spring.leaf.young_modulus = 2.06e11;
               });
  expect_meant("Lever/Young's modulus", "70 GPa, which is 70000 MPa", [](Scene &scene) { scene.lever.young_modulus = 70.; });
  expect_meant("Lever/Depth", "0.02 m, which is 20 mm", [](Scene &scene) { scene.lever.depth = 0.02; });
  expect_meant("Lever/Moment of inertia", "0.00645 kg m2, which is 6.45 t mm2",
               [](Scene &scene) { scene.lever.moment_of_inertia = 6.45e-3; });
  expect_meant("Rotational spring/Stiffness", "74 N m/rad, which is 74000 N mm/rad",
               [](Scene &scene) { scene.spring.stiffness = 74.; });
  EXPECT_EQ(remedy("Lever/Density", [](Scene &scene) { scene.lever.density = 1e9; }).rfind("Give", 0), 0u);

  // A lever that does not bend.
  Scene stiff               = model_a();
  stiff.lever.young_modulus = 7e7;
  stiff.layer.young_modulus = 2e4;
  stiff.specified           = { "Lever/Young's modulus", "Friction layer/Young's modulus" };
  EXPECT_EQ(names(scene_warnings(stiff)), Names{});
}

TEST(SceneWarnings, PartsThatAreNotThere)
{
  Scene scene      = model_a();
  scene.specified  = { "Cylinder/Tilt", "Friction plate/Made of", "Leaf spring/Length" };
  const auto found = scene_warnings(scene);
  ASSERT_EQ(names(found), Names{ "absent_part" });
  EXPECT_EQ(found[0].found,
            "Leaf spring/Length counts only with Rotational spring/Type = leaf. Friction plate/Made of counts only "
            "with Friction plate/Type = on sensors.");
  scene.specified.insert({ "Rotational spring/Type", "Friction plate/Type" });
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
  scene.specified.insert("Cylinder/Made of");
  EXPECT_EQ(names(scene_warnings(scene)), Names{ "absent_part" });
}

TEST(SceneWarnings, ColumnsThatNobodyWrites)
{
  Scene scene          = model_a();
  scene.unused_columns = { { "Drive/Table", { "P", "theta_2", "lateral_force", "sensor_1", "" } } };
  EXPECT_EQ(names(scene_warnings(scene)), Names{});
  scene.unused_columns = { { "Drive/Table", { "P", "Tmie", "xx" } } };
  EXPECT_EQ(names(scene_warnings(scene)), Names{ "unused_columns" });
  EXPECT_EQ(scene_warnings(scene)[0].found, "Of Drive/Table these columns are not used: Tmie, xx.");
}

namespace
{
  /// A stroke there and back in 0.8 s, 500 rows a second, with something on each position.
  Scene measured_stroke(const std::function<double(double x, unsigned int row)> &position)
  {
    std::vector<double> times, positions;
    for (unsigned int i = 0; i <= 400; ++i)
    {
      times.push_back(0.002 * i);
      positions.push_back(std::max(0., position(20. * (1. - std::cos(2. * M_PI * i / 400.)), i)));
    }
    Scene scene         = model_a();
    scene.analysis.type = AnalysisType::transient;
    scene.drive         = Drive(times, positions);
    return scene;
  }
} // namespace

TEST(SceneWarnings, PositionsThatShake)
{
  const auto warned = [](const auto &position) { return names(scene_warnings(measured_stroke(position))); };
  std::minstd_rand random(1);
  std::normal_distribution<double> noise;
  EXPECT_EQ(warned([](const double x, unsigned int) { return x; }), Names{});
  EXPECT_EQ(warned([](const double x, const unsigned int i) { return x + 0.5 * std::sin(0.6 * i); }), Names{}); // 48 Hz
  EXPECT_EQ(warned([](const double, const unsigned int i) { return std::abs(std::remainder(i, 40.)); }), Names{});
  EXPECT_EQ(warned([](const double, const unsigned int i) { return i / 10 % 2 == 0 ? i % 10 : 10. - i % 10; }), Names{});
  for (const double step : { 0.1, 0.02 })
    EXPECT_EQ(warned([=](const double x, unsigned int) { return step * std::round(x / step); }), Names{ "shaking_drive" })
        << step;
  for (const double deviation : { 0.02, 0.005 })
    EXPECT_EQ(warned([&](const double x, unsigned int) { return x + deviation * noise(random); }), Names{ "shaking_drive" })
        << deviation;

  // Constant friction without inertia knows no speed.
  Scene slow         = with_coulomb(measured_stroke([](const double x, unsigned int) { return std::round(x); }), 0.5);
  slow.analysis.type = AnalysisType::quasi_static;
  EXPECT_EQ(names(scene_warnings(slow)), Names{});
}

TEST(SceneWarnings, ARecordThatDriftsWithTheOffsetOfItsSensor)
{
  const auto warned = [](const double offset)
  {
    Scene scene          = model_a();
    scene.analysis.type  = AnalysisType::isolation;
    scene.isolation.base = BaseMotionType::record;
    for (double t = 0.; t <= 30.; t += 0.01)
    {
      scene.isolation.base_table.at.push_back(t);
      scene.isolation.base_table.values.push_back(40. * std::cos(8. * t) + offset);
    }
    return names(scene_warnings(scene));
  };
  EXPECT_EQ(warned(0.), Names{});
  EXPECT_EQ(warned(20.), Names{ "drifting_record" });
}

TEST(RowWarnings, SpeedsBeyondATableOfFriction)
{
  Scene scene        = model_a();
  scene.friction.law = TabulatedFriction({ 0., 40., 80., 120. }, { 1., 0.6, 0.5, 0.45 });
  EXPECT_EQ(names_with(Column::v_rel, -120., scene), Names{});
  EXPECT_EQ(names_with(Column::v_rel, -121., scene), Names{ "speed_beyond_table" });
  scene.friction.speed = FrictionSpeed::drive;
  EXPECT_EQ(names_with(Column::v_rel, -121., scene), Names{});
  EXPECT_EQ(names_with(Column::v, -121., scene), Names{ "speed_beyond_table" });
}
