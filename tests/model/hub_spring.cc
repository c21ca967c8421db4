// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/hub_spring.h"

#include "model/structure/beam.h"
#include "scenes.h"

#include "scene/scene.h"
#include "support/free_frequencies.h"
#include "support/hardening.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double k = 1000.;
  constexpr double c = 5e5;

  double excess_energy(const double turn)
  {
    return 0.25 * c * std::pow(turn, 4);
  }

  MomentLaw hardening()
  {
    return cubic_hardening(k, c, -10, 10);
  }

  /// On the rotation, 4, and on others.
  InterfaceForces contact_forces(const DofSelection &dofs)
  {
    const auto n = static_cast<unsigned int>(dofs.size());
    InterfaceForces forces{ { dofs, dealii::Vector<double>(n) }, dealii::FullMatrix<double>(n, n) };
    for (unsigned int i = 0; i < n; ++i)
    {
      forces.values[i] = 1. + i;
      for (unsigned int j = 0; j < n; ++j)
        forces.tangent(i, j) = 10. * i + j;
    }
    return forces;
  }

  const InterfaceLayout layout{ 4, false };

  InterfaceForces with(const HubSpringExcess &spring, InterfaceForces forces, const PerLever &turns)
  {
    spring.add_forces(turns, true, forces);
    return forces;
  }

  InterfaceForces with(const HubSpringExcess &spring, InterfaceForces forces, const PerLever &begin, const PerLever &end,
                       const StepWeights &weights)
  {
    spring.add_forces(begin, end, weights, forces);
    return forces;
  }
} // namespace

/// A rigid lever with a leaf spring of one vibration: two degrees of freedom by hand.
TEST(HubSpring, ALeafsVibrationCouplesWithTheRotation)
{
  Scene scene             = model_a();
  scene.lever.hub_inertia = 0.4;
  const double omega      = 2. * M_PI * 180.;
  auto &leaf              = scene.spring.behaviour;
  leaf.inertia            = 0.1;
  leaf.modes              = { { omega * omega, 0.2, { { 0., 0. } } } };
  const double J          = scene.lever.moment_of_inertia;

  // det [k - l J, -l p; -l p, w^2 - l] = 0
  const double a   = J - 0.04;
  const double b   = -(scene.spring.stiffness + J * omega * omega);
  const double at  = scene.spring.stiffness * omega * omega;
  const double d   = std::sqrt(b * b - 4. * a * at);
  const auto found = free_frequencies(scene, { 0, scene.lever.length });
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0], std::sqrt((-b - d) / (2. * a)), 1e-10 * found[0]);
  EXPECT_NEAR(found[1], std::sqrt((-b + d) / (2. * a)), 1e-10 * found[1]);
}

namespace
{
  const InterfaceLayout pair_layout{ 4, false, 0, 2 };

  /// Returns the energy beyond k phi^2 / 2 of each hub: 2 W of the mean opening, less swinging's share but for a millionth.
  double joined_energy(const PerLever &turns)
  {
    const double opening = 0.5 * (turns[0] + turns[1]);
    const double swing   = 0.5 * (turns[0] - turns[1]);
    return 2. * excess_energy(opening) - (1. - 1e-6) * k * swing * swing;
  }
} // namespace

TEST(HubSpring, JoinedOnesOpenAgainstTheirMeanTurnAndSwingFreely)
{
  HubSpringExcess spring(pair_layout, { hardening(), hardening() }, true);
  const PerLever turns{ { 0.05, 0.01 } };
  const auto forces = with(spring, contact_forces({}), turns);
  ASSERT_EQ(forces.dofs, (std::vector<unsigned int>{ 4, 9 }));
  // Both hubs feel the same moment, that of the mean turn: k phi_i of the structure and this together.
  const double moment = k * 0.03 + c * std::pow(0.03, 3);
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_NEAR(k * turns[i] - forces.values[i], moment, 1.1e-6 * k * 0.02);
  EXPECT_NEAR(spring.energy(turns), joined_energy(turns), 1e-12 * k);
  const double h = 1e-6;
  for (unsigned int j = 0; j < 2; ++j)
  {
    PerLever more = turns, less = turns;
    more[j] += h;
    less[j] -= h;
    EXPECT_NEAR(forces.values[j], -(joined_energy(more) - joined_energy(less)) / (2. * h), 1e-8 * k);
    const auto right = with(spring, contact_forces({}), more).values;
    const auto left  = with(spring, contact_forces({}), less).values;
    for (unsigned int i = 0; i < 2; ++i)
      EXPECT_NEAR(forces.tangent(i, j), (right[i] - left[i]) / (2. * h), 1e-8 * k);
  }
}

/// Work of the forces of a step is the change of energy and, with a delay, what the scheme dissipates.
TEST(HubSpring, AStepMakesNoEnergyAndItsTangentMatchesDifferences)
{
  for (const bool joined : { false, true })
    for (const double radius : { 1., 0.8, 0. })
      for (const auto &[begin, end] : { std::pair<PerLever, PerLever>{ { { 0.01, 0.03 } }, { { 0.04, 0.02 } } },
                                        { { { 0.03, 0.02 } }, { { -0.02, 0.02 + 1e-9 } } } })
      {
        HubSpringExcess spring(pair_layout, { hardening(), hardening() }, joined);
        const auto weights = generalised_alpha(radius, 1e-4);
        const auto forces  = with(spring, contact_forces({}), begin, end, weights);
        StepWork work;
        spring.add_work(begin, end, weights, work);
        double done = 0.;
        for (unsigned int i = 0; i < 2; ++i)
          done -= forces.values[i] * (end[i] - begin[i]);
        EXPECT_NEAR(done, spring.energy(end) - spring.energy(begin) + work.algorithmic, 1e-12 * k * 1e-4);
        EXPECT_TRUE(joined || work.algorithmic >= 0.);
        const double h = 1e-6;
        // Differences reach over the end of a step that is shorter than they are.
        for (unsigned int j = 0; j < 2 && std::abs(end[j] - begin[j]) > h; ++j)
        {
          PerLever more = end, less = end;
          more[j] += h;
          less[j] -= h;
          const auto right = with(spring, contact_forces({}), begin, more, weights).values;
          const auto left  = with(spring, contact_forces({}), begin, less, weights).values;
          for (unsigned int i = 0; i < 2; ++i)
            EXPECT_NEAR(forces.tangent(i, j), (right[i] - left[i]) / (2. * h), 1e-8 * k);
        }
      }
}

TEST(HubSpring, EachLeverOfAPairHasItsOwnWhereTheJointIsHeld)
{
  HubSpringExcess spring(pair_layout, { hardening(), hardening() });
  const PerLever turns{ { 0.05, 0.01 } };
  const auto forces = with(spring, contact_forces({}), turns);
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_NEAR(forces.values[i], -c * std::pow(turns[i], 3), 1e-12 * k);
  EXPECT_EQ(forces.tangent(0, 1), 0.);
  EXPECT_NEAR(spring.energy(turns), excess_energy(0.05) + excess_energy(0.01), 1e-12 * k);
}
