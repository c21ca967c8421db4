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
