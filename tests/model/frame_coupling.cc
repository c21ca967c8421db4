// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/frame_coupling.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  const InterfaceLayout layout = { 2, true };
  constexpr double rest        = 0.056;
  constexpr double step        = 1e-3;
  const unsigned int coupled[] = { layout.rotation(), layout.momentum_eta(), layout.momentum_xi(), layout.support() };

  Vector interface_vector(const double rotation, const double eta, const double xi, const double support)
  {
    Vector result(layout.size());
    result[layout.rotation()]     = rotation;
    result[layout.momentum_eta()] = eta;
    result[layout.momentum_xi()]  = xi;
    result[layout.support()]      = support;
    return result;
  }

  Kinematic begin()
  {
    return { interface_vector(0.3, 0.7, -0.2, 0.4), interface_vector(1.1, -0.6, 0.9, 0.8), interface_vector(-2., 1.5, 0.4, 3.) };
  }

  /// A place to which the step may lead, with rates and accelerations of the order of 1.
  Vector end()
  {
    Vector z = begin().position;
    z.add(step, begin().velocity, 0.3 * step * step, begin().acceleration);
    return z;
  }

  /// The scheme with all weight on the end of the step.
  StepWeights implicit()
  {
    return { step, 0., 0., 0.25, 0.5 };
  }

  Kinematic shifted(Kinematic at, const double time)
  {
    at.position.add(time, at.velocity);
    at.velocity.add(time, at.acceleration);
    return at;
  }

  double kinetic_energy(const Kinematic &at)
  {
    return FrameCoupling(layout, rest).kinetic_energy(at);
  }

  /// Returns the energy's derivative by a rate, exact as the energy is at most quadratic in each.
  double momentum(Kinematic at, const unsigned int dof)
  {
    at.velocity[dof] += 0.5;
    const double more = kinetic_energy(at);
    at.velocity[dof] -= 1.;
    return more - kinetic_energy(at);
  }

  double by_position(Kinematic at, const unsigned int dof, const double h)
  {
    at.position[dof] += h;
    const double more = kinetic_energy(at);
    at.position[dof] -= 2. * h;
    return (more - kinetic_energy(at)) / (2. * h);
  }

  InterfaceForces with(const FrameCoupling &coupling, InterfaceForces forces, const Kinematic &begin, const Vector &end,
                       const StepWeights &weights)
  {
    coupling.add_forces(begin, end, weights, forces);
    return forces;
  }
} // namespace

TEST(FrameCoupling, ForcesAreLagrangesOfTheKineticEnergy)
{
  FrameCoupling coupling(layout, rest);
  Kinematic at = unaccelerated(begin(), implicit());
  set_position(at, end(), implicit());
  const auto &forces = with(coupling, InterfaceForces(), begin(), end(), implicit());
  ASSERT_EQ(forces.dofs.size(), 4u);
  for (unsigned int i = 0; i < 4; ++i)
  {
    // Central differences over 1e-5 of numbers of the order of 1: 1e-10 of truncation, 1e-11 of round-off; a step's rates and
    // accelerations are the same both ways to the round-off of positions over step^2.
    const double h    = 1e-5;
    const double rate = (momentum(shifted(at, h), coupled[i]) - momentum(shifted(at, -h), coupled[i])) / (2. * h);
    EXPECT_NEAR(forces.values[i], by_position(at, coupled[i], h) - rate, 1e-8) << i;
    EXPECT_GT(std::abs(forces.values[i]), 0.01);
  }
}

TEST(FrameCoupling, TangentIsTheDerivativeOfTheForces)
{
  FrameCoupling coupling(layout, rest);
  for (const double radius : { 1., 0.8, 0. })
  {
    const auto weights          = generalised_alpha(radius, step);
    const InterfaceForces exact = with(coupling, InterfaceForces(), begin(), end(), weights);
    // It is added to that of the contact.
    const InterfaceForces contact{ { { layout.rotation() }, Vector(1) }, dealii::FullMatrix<double>(dealii::IdentityMatrix(1)) };
    EXPECT_DOUBLE_EQ(with(coupling, contact, begin(), end(), weights).tangent(0, 0), exact.tangent(0, 0) + 1.);
    for (unsigned int j = 0; j < 4; ++j)
    {
      // Movements of 1e-6 change accelerations by 1: h^2 of the third derivative, mass() times 1, is 1e-5; round-off 1e-10 of it.
      const double h = 1e-6;
      Vector z       = end();
      z[coupled[j]] += h;
      const Vector right = with(coupling, InterfaceForces(), begin(), z, weights).values;
      z[coupled[j]] -= 2. * h;
      const Vector left = with(coupling, InterfaceForces(), begin(), z, weights).values;
      for (unsigned int i = 0; i < 4; ++i)
        EXPECT_NEAR(exact.tangent(i, j), (right[i] - left[i]) / (2. * h), 1e-9 * weights.mass()) << i << j << ", " << radius;
    }
  }
}

TEST(FrameCoupling, WorkOfItsForcesIsTheKineticEnergyButForTheSchemesDissipation)
{
  // Up to third order in the step; with a spectral radius below 1 the forces that go with products of rates count a little later
  // than in the middle, which is of second order and not told as dissipation. Shown by quartering the step.
  FrameCoupling coupling(layout, rest);
  for (const double radius : { 1., 0.8 })
  {
    const auto open = [&](const double duration)
    {
      const auto weights = generalised_alpha(radius, duration);
      Kinematic after    = unaccelerated(begin(), weights);
      Vector z           = begin().position;
      z.add(duration, begin().velocity, 0.5 * duration * duration, begin().acceleration);
      set_position(after, z, weights);
      Vector moved = z;
      moved -= begin().position;
      const auto &forces = with(coupling, InterfaceForces(), begin(), z, weights);
      double taken       = 0.;
      for (unsigned int a = 0; a < forces.dofs.size(); ++a)
        taken += forces.values[a] * moved[forces.dofs[a]];
      StepWork work;
      coupling.add_work(begin(), z, weights, work);
      return std::abs(-taken - (kinetic_energy(after) - kinetic_energy(begin())) - work.algorithmic);
    };
    EXPECT_LT(open(1e-2), 1e-4);
    EXPECT_LT(open(2.5e-3), open(1e-2) / (radius == 1. ? 50. : 12.)) << radius;
  }
}

TEST(FrameCoupling, InertiaIsTheDerivativeOfItsForcesByAccelerations)
{
  const auto weights = implicit();
  FrameCoupling coupling(layout, rest);
  Kinematic begin{ Vector(layout.size()), Vector(layout.size()), Vector(layout.size()) };
  begin.position[layout.rotation()] = 0.07;
  begin.position[layout.support()]  = 0.3;
  const auto dofs                   = coupling.coupled_dofs();
  dealii::FullMatrix<double> inertia(4, 4);
  coupling.add_inertia(dofs, { { rest + 0.07 } }, inertia);
  for (unsigned int j = 0; j < 4; ++j)
  {
    // Over an acceleration of 10 the interface moves by 2.5e-6, of which 5e-17 is round-off; what is not linear is even.
    const double a = 10.;
    Vector values[2];
    for (const double sign : { 1., -1. })
    {
      Vector end = begin.position;
      end[dofs[j]] += sign * a * weights.beta * weights.dt * weights.dt;
      InterfaceForces forces;
      coupling.add_forces(begin, end, weights, forces);
      values[sign > 0. ? 0 : 1] = forces.values;
    }
    for (unsigned int i = 0; i < 4; ++i)
      EXPECT_NEAR(-inertia(i, j), (values[0][i] - values[1][i]) / (2. * a), 1e-9) << i << j;
  }
  EXPECT_NEAR(inertia(1, 3), std::sin(rest + 0.07), 1e-15);
}
