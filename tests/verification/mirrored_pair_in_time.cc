// SPDX-License-Identifier: GPL-3.0-only
#include "fe/leaf/leaf_spring.h"
#include "results/row_statistics.h"
#include "scene/lever_inertia.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"
#include "support/scene_parts.h"
#include "verification/held_slides.h"
#include "verification/meshed_in_time.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  Scene around_a_reversal(Scene scene)
  {
    scene.mesh.face_size = 2.;
    scene.drive          = Drive(DriveProfile::triangle, 45., 46., 112., 1., 5e-3);
    return scene;
  }

  /// Frequencies of undamped modes in contact without friction at x = 30 of a pair [1/s].
  struct Omegas
  {
    double symmetric;
    double swinging;
  };

  /// The mode that has most of its energy in the contact, of either motion.
  Omegas contact_modes(const Scene &scene)
  {
    const auto model = make_reduced_lever(undamped(scene));
    const auto slide = model->hold({ 0., 30., 112., 0. }, ContactFriction::none);
    EXPECT_TRUE(slide);
    Omegas result{};
    double in_contact[2] = { 0., 0. };
    for (const auto &mode : model->vibrations(*slide, true, 4))
    {
      const bool swings = mode.symmetry < 0.;
      EXPECT_NEAR(std::abs(mode.symmetry), 1., 1e-6);
      if (mode.energy.contact < in_contact[swings])
        continue;
      in_contact[swings]                            = mode.energy.contact;
      (swings ? result.swinging : result.symmetric) = mode.mode.eigenvalue.imag();
    }
    return result;
  }

  /// P of the second lever is that of a lever alone, within a share of its peak of some 30 N.
  void expect_second_lever(const std::vector<Row> &pair, const std::vector<Row> &alone, const double tolerance)
  {
    ASSERT_EQ(pair.size(), alone.size());
    for (std::size_t i = 0; i < pair.size(); ++i)
      EXPECT_NEAR(pair[i].second_value(Column::P), alone[i][Column::P], tolerance * 30.) << "row " << i;
  }
} // namespace

// Both levers do the same to round-off, which swinging without a spring lets grow with the square of the time. That of a gap,
// 7e-15 mm of the radius, is 1e-10 of a penetration of 7e-5 mm; the start's speeds, differences of equilibria 0.1 mm apart, make
// some 1e-7 of P of it.
TEST(MirroredPairInTime, WithoutOffsetBothLeversDoWhatOneAloneDoesSlow)
{
  for (const auto model : { ModelType::rigid, ModelType::beam, ModelType::condensed, ModelType::finite_element })
    for (const auto joint : { SpringJoint::free, SpringJoint::held })
    {
      SCOPED_TRACE(testing::Message() << "model " << static_cast<int>(model) << ", joint " << static_cast<int>(joint));
      const auto scene = around_a_reversal(in_time(model_a(), model));
      const auto half  = run_any_in_time(scene).rows;
      const auto full  = run_any_in_time(paired(scene, joint)).rows;
      ASSERT_EQ(half.size(), full.size());
      double error = 0., energy = 0.;
      for (std::size_t i = 0; i < half.size(); ++i)
      {
        error  = std::max(error, std::abs(half[i][Column::P] - full[i][Column::P]));
        energy = std::max(energy, std::abs(2. * half[i][Column::kinetic_energy] - full[i][Column::kinetic_energy]));
        EXPECT_NEAR(2. * half[i][Column::Q], full[i].drive_force(), 2e-7 * 30.);
      }
      EXPECT_LT(error, 3e-7 * 30.);
      EXPECT_LT(energy, 1e-7 * largest(full, [](const Row &row) { return row[Column::kinetic_energy]; }));
      EXPECT_LT(largest(full, [](const Row &row) { return row.lateral_force(); }), 2e-7 * 30.);
    }
}

// The ledger of levers that differ, on a frame that both share: fixed steps without numerical dissipation leave open what
// Newton's tolerance of 1e-7 of a penetration squares to.
TEST(MirroredPairInTime, LedgerClosesForLeversThatDiffer)
{
  for (const auto model : { ModelType::beam, ModelType::condensed })
    for (const auto joint : { SpringJoint::free, SpringJoint::held })
    {
      auto scene                 = paired(on_sprung_support(around_a_reversal(in_time(model_a(), model))), joint);
      scene.pair.cylinder_offset = 0.3;
      scene.pair.friction_ratio  = 0.7;
      scene.pair.spring_ratio    = 0.8;
      const auto run             = run_any_in_time(with_fixed_step(with_spectral_radius(scene, 1.), 5e-5));
      EXPECT_LT(run.report.ledger.share(), 1e-6);
      EXPECT_GT(largest(run.rows, [](const Row &row) { return row.lateral_force(); }), 0.3);
    }
}

// The same of contacts: the damping and the stiffness in stick of each follow from its own stiffness. The run starts with the
// slip of the first lever.
TEST(MirroredPairInTime, LeversOnUnequalContactsDoWhatEachDoesAlone)
{
  constexpr double ratio = 0.3;
  for (const auto model : { ModelType::rigid, ModelType::beam })
  {
    SCOPED_TRACE(testing::Message() << "model " << static_cast<int>(model));
    const auto stiff = with_fixed_step(around_a_reversal(in_time(model_a(), model)), 5e-5);
    auto soft        = stiff;
    soft.contact.stiffness *= ratio;
    auto both               = paired(stiff, SpringJoint::held);
    both.pair.contact_ratio = ratio;
    const auto pair         = run_any_in_time(both).rows;
    const auto first        = run_any_in_time(stiff).rows;
    const auto second       = run_any_in_time(soft).rows;
    expect_second_lever(pair, second, 1e-5);
    double difference = 0.;
    for (std::size_t i = 0; i < pair.size(); ++i)
    {
      EXPECT_NEAR(pair[i][Column::P], first[i][Column::P], 1e-7 * 30.) << "row " << i;
      difference = std::max(difference, std::abs(first[i][Column::P] - second[i][Column::P]));
    }
    EXPECT_GT(difference, 1.);
  }
}

// A rigid lever on a contact of stiffness k_c: (k + K_c)/J symmetric, K_c/J swinging, K_c with the change of direction in it.
TEST(MirroredPairInTime, SwingingLacksTheSpringOfAFreeJointAlone)
{
  auto scene           = in_time(model_a(), ModelType::rigid);
  const double J       = scene.lever.moment_of_inertia;
  const double k       = scene.spring.stiffness;
  const auto free      = contact_modes(paired(scene, SpringJoint::free));
  const auto held      = contact_modes(paired(scene, SpringJoint::held));
  const double squared = free.symmetric * free.symmetric;
  // A millionth of the spring's share remains; frequencies are solved to 1e-12.
  EXPECT_NEAR(squared - free.swinging * free.swinging, k / J, 2e-6 * k / J + 1e-11 * squared);
  EXPECT_NEAR(held.symmetric, free.symmetric, 1e-10 * free.symmetric);
}

// Cantilever with a tip mass, Euler-Bernoulli: 1 + cos b cosh b + (M/m) b (cos b sinh b - sin b cosh b) = 0. Shear and rotary
// inertia take (h/L)^2, 2e-4; the clamp's hindered contraction adds a quarter of 6e-4, see the stiffness of leaf springs.
TEST(MirroredPairInTime, SwingingLeafIsACantileverWithHalfTheJoint)
{
  LeafSpring leaf;
  leaf.clamp_distance  = 12.;
  const double M       = 7e-5;
  const auto behaviour = swinging_leaf(leaf, PlaneState::stress, M);
  const double area    = leaf.width * leaf.thickness;
  const double m       = leaf.density * area * leaf.length;
  const auto condition = [&](const double b)
  { return 1. + std::cos(b) * std::cosh(b) + M / m * b * (std::cos(b) * std::sinh(b) - std::sin(b) * std::cosh(b)); };
  double low = 0.5, high = 1.8751;
  while (high - low > 1e-12)
    (condition(0.5 * (low + high)) > 0. ? low : high) = 0.5 * (low + high);
  const double bending  = leaf.young_modulus * area * leaf.thickness * leaf.thickness / 12.;
  const double expected = std::pow(low / leaf.length, 4) * bending / (leaf.density * area);
  EXPECT_NEAR(behaviour.modes.front().stiffness, expected, 1e-3 * expected);

  // Turning with the hub it stays straight: that of a rod from c to c + L and of the mass at its end, and its momentum across.
  const double c = leaf.clamp_distance, end = leaf.clamp_distance + leaf.length;
  const double straight = m / leaf.length * (std::pow(end, 3) - std::pow(c, 3)) / 3. + M * end * end;
  EXPECT_NEAR(behaviour.inertia, straight, 1e-4 * straight); // thickness: (h/L)^2/4
  EXPECT_NEAR(behaviour.mass, m + M, 1e-12);
  EXPECT_NEAR(std::abs(behaviour.momentum[1]), m * 0.5 * (c + end) + M * end, 1e-7 * M * end); // statics of a thin leaf
}

// Beam against condensed lever: a lever's joint that swings on its leaf, out of step with the mirror motion.
TEST(MirroredPairInTime, ModesOfAllFidelitiesAgree)
{
  auto scene            = paired(around_a_reversal(in_time(model_a(), ModelType::condensed)), SpringJoint::free);
  scene.spring.type     = SpringType::leaf;
  scene.pair.joint_mass = 1e-4;
  scene.condensed.modes = 40;
  scene.mesh.face_size  = 4.;
  scene.spring          = prepared_spring(scene);
  scene                 = undamped(scene);
  const auto modes      = [](const Scene &slide_scene)
  {
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(slide_scene);
    const auto slide    = dynamics.model().hold({ 0., 45.5, 112., 0. }, ContactFriction::sliding);
    EXPECT_TRUE(slide);
    auto found = dynamics.model().vibrations(*slide, true, 6);
    found.erase(std::remove_if(found.begin(), found.end(), [](const auto &mode) { return mode.mode.eigenvalue.imag() == 0.; }),
                found.end());
    return found;
  };
  const auto condensed = modes(scene);
  scene.analysis.model = ModelType::finite_element;
  const auto meshed    = modes(scene);
  for (unsigned int i = 0; i < 6; ++i)
  {
    // The tolerance is that of one lever: truncated modes are left to statics.
    EXPECT_NEAR(condensed.at(i).mode.eigenvalue.imag(), meshed.at(i).mode.eigenvalue.imag(),
                1e-4 * meshed[i].mode.eigenvalue.imag());
    EXPECT_NEAR(condensed[i].mode.eigenvalue.real(), meshed[i].mode.eigenvalue.real(),
                1e-4 * std::abs(meshed[i].mode.eigenvalue.imag()));
    EXPECT_NEAR(condensed[i].symmetry, meshed[i].symmetry, 1e-3);
  }
  EXPECT_LT(condensed.front().symmetry, -0.99);
}
