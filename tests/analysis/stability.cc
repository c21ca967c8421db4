// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/sweep.h"

#include "analysis/stability/stability.h"
#include "analytic/jamming.h"
#include "input/read.h"
#include "model/lever/own_damping.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/shipped.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>

using namespace sprag;

namespace
{
  /// Model A as a rigid lever on a stiff contact, constant mu.
  Scene rigid_lever(const double mu)
  {
    Scene scene             = with_coulomb(model_a(), mu);
    scene.analysis.model    = ModelType::rigid;
    scene.contact.stiffness = 1e7;
    return scene;
  }
} // namespace

// P without friction over P is (s - mu e)/s for a rigid lever, and the beam has 1e4 times the stiffness of aluminium.
TEST(Jamming, StiffBeamJamsWhereTheRigidLeverLocks)
{
  Scene scene               = with_coulomb(model_a(), 0.73);
  scene.analysis.model      = ModelType::beam;
  scene.lever.young_modulus = 7e8;
  scene.contact.stiffness   = 1e7;
  const auto margin         = jamming_margin(scene);
  const DrivePoint slide_at{ 0., margin.x, margin.v, 0. };
  const auto slide = make_reduced_lever(scene)->hold(slide_at, ContactFriction::sliding);
  ASSERT_TRUE(slide);
  EXPECT_NEAR(slide->margin, margin.margin(), 1e-4);
  scene.friction.law   = CoulombFriction{ 2. * margin.critical_mu };
  const double jams_at = 2. * margin.critical_mu * make_reduced_lever(scene)->largest_friction_share(slide_at, 1e-5);
  EXPECT_NEAR(jams_at, margin.critical_mu, 0.02 * margin.critical_mu);
  const auto is_held = [&](const double mu)
  {
    scene.friction.law = CoulombFriction{ mu };
    const auto held    = make_reduced_lever(scene)->hold(slide_at, ContactFriction::sliding);
    return held && held->uniqueness > 0.;
  };
  EXPECT_TRUE(is_held(0.9998 * jams_at));
  EXPECT_FALSE(is_held(1.0002 * jams_at));
}

// mu falls with speed, and a harmonic motion is slowest where s is shortest.
TEST(Jamming, MarginIsTheLeastOnTheWayWithMuAtTheSpeedThere)
{
  Scene scene        = rigid_lever(0.);
  scene.friction.law = TabulatedFriction({ 0., 20., 60., 120. }, { 0.9, 0.85, 0.3, 0.2 });
  const auto least   = [&]
  {
    double result = 2.;
    for (double time = 0.; time < scene.drive.duration(); time += 1e-4)
    {
      const auto at    = scene.drive.at(time);
      const auto slide = closed_form(scene, at.x, at.v);
      result           = std::min(result, 1. + drive_direction(at.v) * slide.mu * 45.6 / slide.contact.s);
    }
    return result;
  };
  const Drive harmonic(DriveProfile::harmonic, 20., 65., 112., 2.);
  const Drive table({ 0., 0.2, 0.5, 0.9, 1.1, 1.5, 2. }, { 0., 30., 60., 60., 20., 50., 0. });
  const Drive cut_short(DriveProfile::harmonic, 20., 65., 112., 4.75);
  for (const auto &drive : { harmonic, table, cut_short })
  {
    scene.drive       = drive;
    const auto margin = jamming_margin(scene);
    EXPECT_NEAR(margin.margin(), least(), 2e-3);
    EXPECT_EQ(drive_direction(margin.v), -1);
  }
  scene.drive = harmonic;
  EXPECT_NEAR(jamming_margin(scene).margin(), 1. - 0.9 * 45.6 / kinematics(scene.geometry, 65.).s, 1e-12);
  // A slide held anywhere has the peak speed.
  scene.analysis.type = AnalysisType::stability;
  EXPECT_GT(jamming_margin(scene).margin(), 0.9);
}

TEST(Jamming, NoOffsetNoRigidLocking)
{
  const auto margin = jamming_margin(with_coulomb(model_b(), 0.73));
  EXPECT_TRUE(std::isinf(margin.critical_mu));
}

TEST(CriticalValues, ThinLeverFluttersThickOneDoesNot)
{
  const Scene scene = shipped("stability-a", {});
  DynamicsMaker maker;
  const auto found = critical_values(scene, { "Lever/Depth", 5., 21., 5 }, 1e-6, maker);
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes.front().below, SlideKind::flutter);
  EXPECT_EQ(found.changes.front().above, SlideKind::stable);
  const auto kind_at = [&](const double depth)
  { return check_slide(variant(scene, { override_text("Lever/Depth", depth) }), maker).kind; };
  EXPECT_EQ(kind_at(found.changes.front().value - 1e-3), SlideKind::flutter);
  EXPECT_EQ(kind_at(found.changes.front().value), SlideKind::stable);
  const auto falling = critical_values(scene, { "Lever/Depth", 21., 5., 5 }, 1e-6, maker);
  ASSERT_EQ(falling.changes.size(), 1u);
  EXPECT_EQ(kind_at(falling.changes.front().value), SlideKind::stable);
}

TEST(CriticalValues, GrowthOfAValueIsTheLargestOfItsPlacesBothWays)
{
  const Scene scene = shipped("stability-a", { "Stability/Position=auto", "Stability/Direction=both" });
  DynamicsMaker maker;
  const auto found = critical_values(scene, { "Lever/Depth", 5., 8., 2 }, 1e-2, maker);
  std::map<double, std::map<double, double>> largest; // of a value, by direction
  for (const auto &place : found.places)
  {
    EXPECT_TRUE(place.x >= 0. && place.x <= 65.);
    auto &here = largest[place.value].emplace(place.direction, place.growth_rate).first->second;
    here       = std::max(here, place.growth_rate);
  }
  ASSERT_GE(found.growth.size(), 2u);
  for (const auto &[value, growth_rate] : found.growth)
    EXPECT_EQ(std::max(largest.at(value).at(1.), largest.at(value).at(-1.)), growth_rate);
}

// Moving back at 5 times mu(v), model A flutters up to x = 17.4 mm, slides stably to 18.6 mm, and jams beyond.
TEST(CriticalValues, FindBothLimitsOfAnotherKindBetweenTheValuesTried)
{
  CheckedSlide slide;
  const auto check_at = [&](const double value)
  {
    slide.kind = value < 0.3 ? SlideKind::flutter : value < 0.4 ? SlideKind::stable : SlideKind::jammed;
    return slide;
  };
  const auto found = search_kinds({ "Stability/Position", 0., 1., 2 }, { 1e-3, 0 }, { check_at });
  ASSERT_EQ(found.changes.size(), 2u);
  EXPECT_EQ(found.changes[0].above, SlideKind::stable);
  EXPECT_NEAR(found.changes[0].value, 0.3, 1e-3);
  EXPECT_EQ(found.changes[1].above, SlideKind::jammed);
  EXPECT_NEAR(found.changes[1].value, 0.4, 1e-3);
}

// Model B flutters from 11.822 to 14.514 mm: between the values tried, of which none does.
TEST(CriticalValues, IslandBetweenTheValuesTriedIsFoundWhereGrowthPeaks)
{
  const Scene scene = shipped("stability-b", {});
  DynamicsMaker maker;
  const auto found = critical_values(scene, { "Lever/Depth", 5., 25., 5 }, 1e-6, maker);
  EXPECT_EQ(found.spacing, 5.);
  EXPECT_GT(found.more_values, 0u);
  ASSERT_EQ(found.changes.size(), 2u);
  EXPECT_NEAR(found.changes[0].value, 11.8190, 5e-4); // as of 64 elements; of eight 11.8220
  EXPECT_NEAR(found.changes[1].value, 14.5114, 5e-4);
  EXPECT_EQ(found.changes[0].above, SlideKind::flutter);
  EXPECT_EQ(found.changes[1].above, SlideKind::stable);
}

// A random device: with its own friction a depth of 5.667 mm grows by -14 and -4/s at the ends of the range of damping, and by
// 24/s at 0.08. The worst is inside that range and at the end of the other: with its own friction it would be stable from 5.80 mm
// on.
TEST(CriticalValues, LookInsideRanges)
{
  const Scene scene = shipped("stability-a", { "Geometry/Cylinder radius=31.76",
                                               "Geometry/Interface offset=21.62",
                                               "Geometry/Pivot distance=114.3",
                                               "Geometry/Pivot height=0.04184",
                                               "Rotational spring/Stiffness=4.971e4",
                                               "Lever/Length=124.6",
                                               "Lever/Width=44.95",
                                               "Lever/Young's modulus=2.1e5",
                                               "Lever/Density=7.85e-9",
                                               "Lever/Mass damping=9.904",
                                               "Lever/Stiffness damping=1.083e-5",
                                               "Lever/Modal damping=0",
                                               "Lever/Inertia=as built",
                                               "Friction layer/Thickness=0",
                                               "Contact/Stiffness=14550",
                                               "Contact/Exponent=1.315",
                                               "Drive/Stroke=51.42",
                                               "Drive/Speed=97.78",
                                               "Friction/Law=Stribeck",
                                               "Friction/Static coefficient=0.4937",
                                               "Friction/Kinetic coefficient=0.6042",
                                               "Friction/Stribeck speed=22.45",
                                               "Stability/Position=30.85",
                                               "Stability/Direction=forward",
                                               "Stability/Ranges=Contact/Damping 0.01 0.2; Friction/Factor 0.9 1.1" });
  DynamicsMaker maker;
  const auto found = critical_values(scene, { "Lever/Depth", 5.9, 6., 2 }, 1e-2, maker);
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes.front().above, SlideKind::stable);
  // Between two of the seven values growth is at most 1/s larger, which is some 5 um of depth.
  const auto largest_growth = [&](const double depth)
  {
    double result = -1e9;
    for (double damping = 0.03; damping < 0.2; damping += 0.01)
      result = std::max(result, check_slide(variant(scene, { override_text("Lever/Depth", depth),
                                                             override_text("Contact/Damping", damping), "Friction/Factor=1.1" }),
                                            maker)
                                    .growth_rate());
    return result;
  };
  EXPECT_GT(largest_growth(found.changes.front().value - 0.02), 0.);
  EXPECT_LT(largest_growth(found.changes.front().value + 0.02), 0.);
}

// Forward from x = 34 to 38 mm friction couples two vibrations of a lever with little damping. Held at x = 36 mm alone the limit
// is 14.390 mm.
TEST(CriticalValues, SeeVibrationsOfAShortPieceOfTheStroke)
{
  const Scene scene = shipped("stability-b", { "Analysis/Model=beam", "Stability/Position=auto", "Stability/Direction=forward",
                                               "Friction/Coefficient=0.3", "Contact/Damping=0.003" });
  DynamicsMaker maker;
  const auto found = critical_values(scene, { "Lever/Depth", 13.6, 14.9, 2 }, 1e-3, maker);
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_NEAR(found.changes.front().value, 14.39, 0.01);
}

// The contact is wider than its elements near the centre, to which a model looks until it has found a slide itself.
TEST(SweptSlides, OfEqualEquilibriaAreThoseOfModelsOfTheirOwn)
{
  const Scene scene = shipped(
      "stability-b", { "Analysis/Model=condensed", "Mesh/Face size=0.5", "Geometry/Cylinder radius=42",
                       "Geometry/Interface offset=6", "Geometry/Pivot distance=160", "Geometry/Pivot height=0",
                       "Rotational spring/Stiffness=5e4", "Lever/Made of=aluminium", "Lever/Length=180", "Lever/Depth=2.942",
                       "Friction layer/Thickness=3", "Friction/Coefficient=0.7", "Friction/Factor=1.2", "Stability/Position=50",
                       "Stability/Direction=backward", "Contact/Damping=0.02", "Stability/Ranges=Contact/Damping 0.02 0.1" });
  DynamicsMaker maker;
  const auto swept = sweep(scene, maker, { true });
  for (const auto &[direction, constants, along] : swept.sweeps)
  {
    DynamicsMaker own_maker;
    const double growth_rate = check_slide(variant(scene, constants), own_maker).growth_rate();
    EXPECT_NEAR(along.worst->growth_rate, growth_rate, 1e-4 * std::abs(growth_rate));
  }
}

// Against slides checked one by one: the limits are found to 0.6 % of the depths searched.
TEST(CriticalValues, HoldForTheSceneAndForMostOfTheRanges)
{
  const Scene scene = shipped("stability-a", { "Stability/Position=35", "Stability/Direction=forward",
                                               "Stability/Ranges=Friction/Factor 0.8 1.2; Contact/Damping 0.01 0.15" });
  DynamicsMaker maker;
  constexpr double resolution = 6e-3 * (25. - 5.);
  const auto found            = critical_values(scene, { "Lever/Depth", 5., 25., 5 }, 1e-6, maker);
  ASSERT_EQ(found.changes.size(), 2u); // thinner levers flutter further in
  const auto &limit  = found.changes.back();
  const auto kind_at = [&](const double depth, const double factor, const double damping)
  {
    return check_slide(variant(scene, { override_text("Lever/Depth", depth), override_text("Friction/Factor", factor),
                                        override_text("Contact/Damping", damping) }),
                       maker)
        .kind;
  };
  EXPECT_EQ(kind_at(limit.own, 1., 0.02), SlideKind::stable);
  EXPECT_EQ(kind_at(limit.own - resolution, 1., 0.02), SlideKind::flutter);
  constexpr unsigned int n = 16;
  const auto stable_share  = [&](const double depth)
  {
    unsigned int stable = 0;
    for (unsigned int i = 0; i < n * n; ++i)
    {
      const double factor  = 0.8 + 0.4 * (i % n + 0.5) / n;
      const double damping = 0.01 + 0.14 * (i / n + 0.5) / n;
      stable += kind_at(depth, factor, damping) == SlideKind::stable ? 1 : 0;
    }
    return static_cast<double>(stable) / (n * n);
  };
  EXPECT_LT(limit.likely, limit.value - 2. * resolution);
  EXPECT_NEAR(stable_share(limit.likely), probable_share, 0.02) << limit.likely;
}

// Oscillators of stiffness K over mass 1, all of it with the loss factor eta: with c = eta K/w their lambda is -c/2 + i w, w^2 =
// K - c^2/4. Static shapes that creep have frequencies by round-off, here a tenth of their rate: below those of the oscillators.
// The c of the first oscillator leaves the second without a vibration.
TEST(LossFactor, IsFoundBesideShapesThatCreep)
{
  using namespace std::complex_literals;
  constexpr double eta                = 0.2;
  const std::vector<double> stiffness = { 1e4, 4e6 };
  const auto eigenvalues              = [&](const double relaxation)
  {
    std::vector<std::complex<double>> result;
    for (const double K : stiffness)
      result.push_back(-0.5 * relaxation * K + 1i * std::sqrt(std::complex(K - std::pow(0.5 * relaxation * K, 2))));
    if (relaxation > 0.)
      result.emplace_back(-1. / relaxation, 0.1 / relaxation);
    return result;
  };
  const auto found = own_damped_vibrations(eta, 10, eigenvalues);
  ASSERT_EQ(found.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    const double K       = stiffness[i];
    const double squared = 0.5 * (K + std::sqrt(K * K - eta * eta * K * K)); // w^4 - K w^2 + eta^2 K^2/4 = 0
    EXPECT_NEAR(found[i].eigenvalue.imag(), std::sqrt(squared), 1e-6 * std::sqrt(K));
    EXPECT_NEAR(found[i].eigenvalue.real(), -0.5 * eta * K / std::sqrt(squared), 1e-6 * std::sqrt(K));
  }
}

// Contact/Damping refers to w of equation 20. Frequencies are found to 1e-6.
TEST(LossFactor, IsThatOfADashpotAtTheOwnFrequency)
{
  for (const std::vector<std::string> &lever :
       { std::vector<std::string>{ "Analysis/Model=beam" },
         { "Analysis/Model=condensed", "Mesh/Face size=2" },
         { "Analysis/Model=beam", "Mirrored pair/Type=full", "Mirrored pair/Friction ratio=0.9" } })
  {
    auto changes = lever;
    changes.insert(changes.end(),
                   { "Contact/Damping=0.1", "Contact/Damping law=loss factor", "Contact/Exponent=1", "Contact/Stiffness=1e4" });
    const Scene scene    = shipped("stability-a", changes);
    const auto reference = contact_reference(scene);
    DynamicsMaker maker;
    const auto found = check_slide(scene, maker);
    ASSERT_GE(found.modes.size(), 4u);
    for (const auto &mode : found.modes)
    {
      const auto lambda = mode.mode.eigenvalue;
      if (lambda.imag() == 0.)
        continue;
      Scene dashpot               = scene;
      dashpot.contact.damping_law = DampingLaw::dashpot;
      dashpot.contact.damping     = 0.1 * 0.2 / reference.relaxation / lambda.imag();
      double distance             = std::abs(lambda);
      for (const auto &other : check_slide(dashpot, maker).modes)
        distance = std::min(distance, std::abs(other.mode.eigenvalue - lambda));
      EXPECT_LT(distance, 1e-5 * std::abs(lambda)) << changes.front() << " " << lambda;
    }
  }
}

// No equilibrium of a thin beam is found at 6.62 times the friction; beyond it slides are found.
TEST(CriticalValues, AreToldAcrossValuesThatCannotBeChecked)
{
  DynamicsMaker maker;
  const auto found = critical_values(shipped("stability-a", {}), { "Friction/Factor", 0.1, 8., 49 }, 1e-6, maker);
  ASSERT_EQ(found.not_checked.size(), 1u);
  EXPECT_GT(found.not_checked.front(), 6.);
  EXPECT_LT(found.not_checked.front(), 7.);
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes.front().above, SlideKind::flutter);
  EXPECT_NEAR(found.changes.front().value, 0.5136, 1e-3);
}

// With mu = 0.4 + 0.004 s/mm v the layer is pressed to half its thickness at 608.4 and 579.3 mm/s under levers of 10 and 12 mm,
// by an own cantilever on a turning hub: its mu over the force, and its slip speed from neighbouring x.
TEST(CriticalValues, FrictionThatRisesJamsFromOneSpeedOn)
{
  for (const auto &[depth, speed] : { std::pair<std::string, double>{ "10", 608.4 }, { "12", 579.3 } })
  {
    const Scene scene =
        shipped("stability-a", { "Lever/Depth=" + depth, "Friction/Law=Stribeck", "Friction/Static coefficient=0.4",
                                 "Friction/Kinetic coefficient=0.4", "Friction/Viscous coefficient=0.004" });
    DynamicsMaker maker;
    const auto found = critical_values(scene, { "Drive/Speed", 540., 900., 9 }, 1e-4, maker);
    EXPECT_TRUE(found.not_checked.empty());
    ASSERT_FALSE(found.changes.empty());
    EXPECT_EQ(found.changes.back().above, SlideKind::jammed);
    EXPECT_NEAR(found.changes.back().value, speed, 2e-3 * speed);
  }
}

TEST(CriticalValues, TellTheMotionOfAPair)
{
  // A held joint leaves the levers nothing in common.
  const Scene scene = shipped("pair-stability-a", { "Mirrored pair/Joint=held", "Support/Type=rigid" });
  DynamicsMaker maker;
  const auto present = check_slide(scene, maker);
  EXPECT_EQ(present.motion(), "either");
  EXPECT_NEAR(present.worst_mode().symmetry, 1., 1e-9);
  const auto found = critical_values(scene, { "Lever/Depth", 5., 21., 5 }, 1e-6, maker);
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes.front().worse.motion, "either");
  const auto found_roles = roles(scene, present, maker);
  const auto without_damping =
      std::find_if(found_roles.begin(), found_roles.end(), [](const Role &role) { return role.name == "without_damping"; });
  ASSERT_NE(without_damping, found_roles.end());
  EXPECT_EQ(without_damping->found.value().motion(), "either");
  const auto free = check_slide(variant(scene, { "Mirrored pair/Joint=free" }), maker);
  EXPECT_TRUE(free.motion() == "swinging" || free.motion() == "mirroring") << free.motion();
}

TEST(CriticalValues, ScenesThatAreNotAdmittedArePassedOver)
{
  const Scene scene = shipped("stability-a", {});
  DynamicsMaker maker;
  EXPECT_TRUE(critical_values(scene, { "Geometry/Interface offset", 56., 80., 3 }, 1e-3, maker).changes.empty());
}

// A thin one: bending that is made stiff alone still vibrates at 3 kHz, with hardly any damping.
TEST(Roles, ABeamWithoutFlexureIsARigidLever)
{
  const Scene scene = shipped("stability-a", { "Lever/Depth=2", "Lever/Modal damping=0.001", "Contact/Damping=0.2",
                                               "Stability/Position=40", "Stability/Direction=forward" });
  DynamicsMaker maker;
  const auto found   = roles(scene, check_slide(scene, maker), maker);
  const auto flexure = std::find_if(found.begin(), found.end(), [](const Role &role) { return role.name == "without_flexure"; });
  ASSERT_NE(flexure, found.end());
  const double rigid = check_slide(variant(scene, { "Analysis/Model=rigid" }), maker).growth_rate();
  EXPECT_NEAR(flexure->found.value().growth_rate(), rigid, 1e-6 * std::abs(rigid));
}

TEST(Roles, FlexureMakesTheSpragSlip)
{
  const Scene scene = shipped("stability-a", {});
  DynamicsMaker maker;
  const auto present = check_slide(scene, maker);
  ASSERT_EQ(present.kind, SlideKind::flutter);
  std::map<std::string, Role> found_roles;
  for (const auto &role : roles(scene, present, maker))
    found_roles[role.name] = role;
  EXPECT_EQ(found_roles.at("without_flexure").found.value().kind, SlideKind::stable);
  EXPECT_EQ(found_roles.at("without_inertia").found.value().kind, SlideKind::stable);
  EXPECT_EQ(found_roles.at("without_friction_derivative").found.value().kind, SlideKind::flutter);
  EXPECT_GT(found_roles.at("without_damping").found.value().growth_rate(), present.growth_rate());
  EXPECT_EQ(found_roles.count("without_support"), 0u);
}

TEST(Roles, SupportIsLeftOutWhereThereIsOne)
{
  const Scene scene = shipped("stability-a", { "Support/Type=sprung" });
  DynamicsMaker maker;
  const auto present = check_slide(scene, maker);
  const auto fixed   = check_slide(variant(scene, { "Support/Type=rigid" }), maker);
  for (const auto &role : roles(scene, present, maker))
    if (role.name == "without_support")
    {
      EXPECT_DOUBLE_EQ(role.found.value().growth_rate(), fixed.growth_rate());
      EXPECT_NE(role.found.value().growth_rate(), present.growth_rate());
      return;
    }
  FAIL() << "no role of the support";
}
