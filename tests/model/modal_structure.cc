// SPDX-License-Identifier: GPL-3.0-only
#include "support/three_modes.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  InterfaceForces forces_on(const std::vector<double> &values)
  {
    InterfaceForces forces;
    forces.values.reinit(static_cast<unsigned int>(values.size()));
    for (unsigned int a = 0; a < values.size(); ++a)
    {
      forces.dofs.push_back(a);
      forces.values[a] = values[a];
    }
    return forces;
  }

  double total(const StoredEnergy &energy)
  {
    return energy.kinetic + energy.spring + energy.elastic + energy.support;
  }

  /// One mode of frequency omega and that damping, its dof its displacement.
  ModalData oscillator(const double omega, const double damping)
  {
    ModalData data;
    data.layout    = { 0, false };
    data.stiffness = { omega * omega };
    data.damping.reinit(1, 1);
    data.damping(0, 0) = damping;
    data.shapes.reinit(1, 1);
    data.shapes(0, 0) = 1.;
    return data;
  }

  Motion step(ModalStructure &structure, const Motion &motion, const InterfaceForces &forces, const StepWeights &weights)
  {
    structure.use_step(weights);
    structure.free_displacements(motion, all_dofs(structure.layout().size()));
    return structure.advance(motion, forces, {});
  }

  /// Largest eigenvalue of the step of (dt^2 a, dt v, u), from the characteristic polynomial of its matrix.
  double amplification(ModalStructure &structure, const StepWeights &weights)
  {
    const double scale[3] = { 1., 1. / weights.dt, 1. / (weights.dt * weights.dt) };
    double m[3][3];
    for (unsigned int j = 0; j < 3; ++j)
    {
      Motion motion                      = structure.rest();
      motion.coordinates.position[0]     = j == 0 ? 1. : 0.;
      motion.coordinates.velocity[0]     = j == 1 ? scale[1] : 0.;
      motion.coordinates.acceleration[0] = j == 2 ? scale[2] : 0.;
      const Motion after                 = step(structure, motion, InterfaceForces(), weights);
      m[0][j]                            = after.coordinates.position[0];
      m[1][j]                            = after.coordinates.velocity[0] / scale[1];
      m[2][j]                            = after.coordinates.acceleration[0] / scale[2];
    }
    const double trace = m[0][0] + m[1][1] + m[2][2];
    const double minors =
        m[0][0] * m[1][1] - m[0][1] * m[1][0] + m[0][0] * m[2][2] - m[0][2] * m[2][0] + m[1][1] * m[2][2] - m[1][2] * m[2][1];
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    // All roots at once (Durand and Kerner).
    using Complex   = std::complex<double>;
    Complex root[3] = { { 1., 0. }, { 0.4, 0.9 }, { -0.65, 0.72 } };
    for (unsigned int i = 0; i < 500; ++i)
      for (unsigned int j = 0; j < 3; ++j)
      {
        const Complex z     = root[j];
        const Complex value = ((z - trace) * z + minors) * z - determinant;
        root[j] -= value / ((z - root[(j + 1) % 3]) * (z - root[(j + 2) % 3]) + 1e-300);
      }
    return std::max({ std::abs(root[0]), std::abs(root[1]), std::abs(root[2]) });
  }

  double ten_step_spectral_norm(ModalStructure &structure, const StepWeights &weights)
  {
    Motion motion        = structure.rest();
    motion.face_force[0] = 1.;
    for (unsigned int i = 0; i < 10; ++i)
      motion = step(structure, motion, InterfaceForces(), weights);
    return std::pow(std::abs(motion.face_force[0]), 0.1);
  }
} // namespace

TEST(ModalStructure, EnergyDampingAndAlgorithmicWorkMakeUpTheWorkOfTheForces)
{
  for (const bool with_statics : { false, true })
    for (const double radius : { 1., 0.8, 0.3, 0. })
    {
      ModalStructure structure(three_modes(with_statics));
      structure.use_statics();
      Motion motion                   = structure.deform(forces_on({ 0.4, -0.7, 0.9 }));
      const StepWeights all_weights[] = { generalised_alpha(radius, 3e-3), generalised_alpha(radius, 2e-4) };
      for (unsigned int i = 0; i < 60; ++i)
      {
        const auto forces = forces_on({ std::sin(0.7 * i), 2. - 0.1 * i, 5. * std::cos(2.3 * i) });
        const Motion next = step(structure, motion, forces, all_weights[i % 7 < 4 ? 0 : 1]);
        Vector moved      = structure.positions(next);
        moved -= structure.positions(motion);
        StepWork work;
        structure.add_work(motion, next, work);
        const double before = total(structure.stored_energy(motion));
        const double after  = total(structure.stored_energy(next));
        // Round-off of the energies and works, and of velocities from differences of positions over the step.
        EXPECT_NEAR(after - before + work.damping + work.algorithmic, forces.values * moved, 1e-13 * (before + after + 10.)) << i;
        if (radius == 1.)
        {
          EXPECT_NEAR(work.algorithmic, 0., 1e-13 * (before + after + 1.));
        }
        motion = next;
      }
    }
}

// omega dt = 1e6: the limit is reached to 1e-12; it is a triple root, which moves by the cube root of that.
TEST(ModalStructure, StiffModesDecayByTheSpectralRadiusAskedFor)
{
  for (const double radius : { 1., 0.8, 0.5, 0. })
  {
    ModalStructure structure(oscillator(1e9, 0.));
    EXPECT_NEAR(amplification(structure, generalised_alpha(radius, 1e-3)), radius, 2e-4) << radius;
  }
}

TEST(ModalStructure, StaticShapesDecayByTheSpectralRadiusAskedFor)
{
  for (const double radius : { 1., 0.8, 0.5 })
  {
    auto data       = three_modes(true);
    data.relaxation = 0.;
    ModalStructure structure(data);
    EXPECT_NEAR(ten_step_spectral_norm(structure, generalised_alpha(radius, 1e-3)), radius, 1e-12) << radius;
  }
}

TEST(ModalStructure, StaticShapesForgetTheirForceWithTheRelaxationTime)
{
  // f = K (u + tau du/dt), free: u decays as exp(-t/tau); the midpoint rule errs by (dt/tau)^2/12 of the rate.
  ModalStructure structure(three_modes(true));
  const double dt      = 1e-5;
  Motion motion        = structure.rest();
  motion.face_force[0] = 1.;
  for (unsigned int i = 0; i < 40; ++i)
    motion = step(structure, motion, InterfaceForces(), generalised_alpha(1., dt));
  EXPECT_NEAR(motion.face_force[0], std::exp(-40. * dt / 2e-4), 1e-3);
}

// The oscillator u'' + 2 zeta omega u' + omega^2 u = 0 starts from u = 1 at rest. Steps of a tenth of a radian and less are
// halved: terms of third order add that share to the ratio at most.
TEST(ModalStructure, OrderIsTwoOnADampedOscillator)
{
  constexpr double omega = 50.;
  constexpr double zeta  = 0.1;
  constexpr double end   = 0.2;
  for (const double radius : { 1., 0.8, 0. })
  {
    const auto error = [&](const unsigned int steps)
    {
      ModalStructure structure(oscillator(omega, 2. * zeta * omega));
      Motion motion                      = structure.rest();
      motion.coordinates.position[0]     = 1.;
      motion.coordinates.acceleration[0] = -omega * omega;
      for (unsigned int i = 0; i < steps; ++i)
        motion = step(structure, motion, InterfaceForces(), generalised_alpha(radius, end / steps));
      const double damped = omega * std::sqrt(1. - zeta * zeta);
      const double exact =
          std::exp(-zeta * omega * end) * (std::cos(damped * end) + zeta * omega / damped * std::sin(damped * end));
      return std::abs(motion.coordinates.position[0] - exact);
    };
    EXPECT_NEAR(std::log2(error(400) / error(800)), 2., 0.05) << radius;
    EXPECT_NEAR(std::log2(error(800) / error(1600)), 2., 0.03) << radius;
  }
}

TEST(ModalStructure, LocalErrorIsOfThirdOrder)
{
  // The error is that of one step from the same instant against the exact motion; the estimate is of the same size.
  constexpr double omega = 50.;
  for (const double radius : { 1., 0.8 })
  {
    const auto estimate = [&](const double dt)
    {
      ModalStructure structure(oscillator(omega, 0.));
      const auto at = [&](const double time)
      {
        Motion motion                      = structure.rest();
        motion.coordinates.position[0]     = std::sin(omega * time);
        motion.coordinates.velocity[0]     = omega * std::cos(omega * time);
        motion.coordinates.acceleration[0] = -omega * omega * std::sin(omega * time);
        return motion;
      };
      const Motion from      = at(0.01);
      const Motion to        = step(structure, from, InterfaceForces(), generalised_alpha(radius, dt));
      const double predicted = std::abs(structure.local_error(from, to)[0]);
      const double is        = std::abs(to.coordinates.position[0] - std::sin(omega * (0.01 + dt)));
      EXPECT_LT(is, 3. * predicted) << radius;
      EXPECT_GT(is, 0.1 * predicted) << radius;
      return predicted;
    };
    EXPECT_NEAR(estimate(1e-3) / estimate(5e-4), 8., 0.5) << radius;
  }
}
