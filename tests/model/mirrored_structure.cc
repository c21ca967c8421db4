// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/mirrored_structure.h"

#include "support/three_modes.h"

#include <algorithm>
#include <gtest/gtest.h>

using namespace sprag;
using Vector = dealii::Vector<double>;

// Levers of a pair that are alike and have neither joint nor support in common feel nothing of each other: what the pair does is
// what each lever does alone.

namespace
{
  constexpr unsigned int n_interface = 3; ///< of a lever

  std::unique_ptr<ModalStructure> lever(const bool with_statics)
  {
    return std::make_unique<ModalStructure>(three_modes(with_statics));
  }

  MirroredStructure<ModalStructure> pair(const bool with_statics)
  {
    return MirroredStructure<ModalStructure>(lever(with_statics), lever(with_statics), true);
  }

  /// A contact's forces on dofs 0 and 1, with friction that delays.
  LinearisedForces contact_forces(const double size)
  {
    LinearisedForces forces({ 0, 1 });
    forces.pressure(0, 0)      = -30. * size;
    forces.pressure(1, 1)      = -70. * size;
    forces.friction(0, 1)      = 25. * size;
    forces.pressure_rate(1, 1) = -0.05 * size;
    forces.friction_rate(0, 0) = -0.02 * size;
    FrictionDelay delay{ 1e-3, Vector(2), Vector(2), Vector(2) };
    delay.force[0]         = -1.;
    delay.stiffness_row[1] = -5. * size;
    delay.rate_row[0]      = 0.01 * size;
    forces.delays.push_back(delay);
    return forces;
  }

  /// Both levers' forces on the dofs of the pair.
  LinearisedForces on_pair(const double first, const double second)
  {
    LinearisedForces result({ 0, 1, n_interface, n_interface + 1 });
    for (unsigned int i = 0; i < 2; ++i)
    {
      auto lever_forces = contact_forces(i == 0 ? first : second);
      for (auto &dof : lever_forces.dofs)
        dof += i * n_interface;
      result.add(lever_forces);
    }
    return result;
  }

  std::vector<std::complex<double>> sorted(const std::vector<StructureMode> &modes)
  {
    std::vector<std::complex<double>> result;
    for (const auto &mode : modes)
      result.push_back(mode.eigenvalue);
    std::sort(result.begin(), result.end(),
              [](const auto &a, const auto &b)
              { return std::abs(a) != std::abs(b) ? std::abs(a) < std::abs(b) : a.real() < b.real(); });
    return result;
  }
} // namespace

TEST(MirroredStructure, VibrationsAreThoseOfEachLeverAlone)
{
  for (const bool with_statics : { false, true })
    for (const double second : { 1., 0.7 })
    {
      auto both     = pair(with_statics);
      auto expected = lever(with_statics)->vibrations(contact_forces(1.), 0);
      for (auto &mode : lever(with_statics)->vibrations(contact_forces(second), 0))
        expected.push_back(mode);
      const auto found = both.vibrations(on_pair(1., second), 0);
      const auto a = sorted(found), b = sorted(expected);
      ASSERT_EQ(a.size(), b.size()) << with_statics << second;
      for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_LT(std::abs(a[i] - b[i]), 1e-9 * std::abs(b[i])) << with_statics << second << " " << i;
      for (const auto &mode : found)
        EXPECT_LT(mode.residual, 1e-10);
    }
}

TEST(MirroredStructure, StepsAreThoseOfEachLeverAlone)
{
  for (const bool with_statics : { false, true })
  {
    auto both = pair(with_statics);
    std::array<std::unique_ptr<ModalStructure>, 2> alone{ { lever(with_statics), lever(with_statics) } };
    const auto weights = generalised_alpha(0.8, 1e-3);
    both.use_step(weights);
    Motion motion = both.rest();
    std::array<Motion, 2> motions;
    for (unsigned int i = 0; i < 2; ++i)
    {
      alone[i]->use_step(weights);
      motions[i] = alone[i]->rest();
    }
    const auto all = all_dofs(2 * n_interface);
    for (unsigned int step = 0; step < 20; ++step)
    {
      // Forces on all dofs of the first lever and two of the second.
      InterfaceForces forces{ { 0, 1, 2, 3, 5 }, Vector(5), dealii::FullMatrix<double>() };
      for (unsigned int a = 0; a < 5; ++a)
        forces.values[a] = std::sin(1. + a + 0.3 * step);
      Vector predicted = both.free_displacements(motion, all);
      add_response(both.compliance(), forces.dofs, forces.values, all, predicted);
      motion = both.advance(motion, forces, {});
      for (unsigned int i = 0; i < 2; ++i)
      {
        InterfaceForces own;
        for (unsigned int a = 0; a < 5; ++a)
          if (forces.dofs[a] / n_interface == i)
            own.dofs.push_back(forces.dofs[a] % n_interface);
        own.values.reinit(static_cast<unsigned int>(own.dofs.size()));
        std::copy_n(forces.values.begin() + (i == 0 ? 0 : 3), own.dofs.size(), own.values.begin());
        alone[i]->free_displacements(motions[i], all_dofs(n_interface));
        motions[i]          = alone[i]->advance(motions[i], own, {});
        const auto expected = alone[i]->positions(motions[i]);
        const auto found    = both.positions(motion);
        for (unsigned int dof = 0; dof < n_interface; ++dof)
        {
          EXPECT_NEAR(found[i * n_interface + dof], expected[dof], 1e-12) << step;
          EXPECT_NEAR(predicted[i * n_interface + dof], expected[dof], 1e-12) << step;
          EXPECT_NEAR(both.dof_state(motion, i * n_interface + dof).velocity, alone[i]->dof_state(motions[i], dof).velocity,
                      1e-10);
        }
      }
    }
    const auto energy = both.stored_energy(motion);
    const auto first = alone[0]->stored_energy(motions[0]), second = alone[1]->stored_energy(motions[1]);
    EXPECT_NEAR(energy.kinetic, first.kinetic + second.kinetic, 1e-12 * energy.kinetic);
    EXPECT_NEAR(energy.elastic, first.elastic + second.elastic, 1e-12 * energy.elastic);
  }
}
