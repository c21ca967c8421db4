// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/sparse_vibration.h"

#include "bar.h"
#include "fe/dynamics/condensed_basis.h"
#include "model/structure/eigenvalues.h"
#include "mpi_environment.h"
#include "support/lever_in_time.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace sprag;

namespace
{
  using Complex = std::complex<double>;
  using Full    = dealii::FullMatrix<double>;
  using Vector  = dealii::Vector<double>;

  constexpr double spring_stiffness = 1e4;

  Bar coarse_bar()
  {
    Bar bar;
    bar.n = 6;
    bar.m = 1;
    return bar;
  }

  LeverDynamics make_dynamics(const bool sprung, const bool damped)
  {
    LeverDynamics result;
    result.spring_stiffness = spring_stiffness;
    result.sprung           = sprung;
    result.support_mass     = 2e-5;
    // With the lever's inertia the lowest vibration, though not by far.
    result.support_stiffness = 50.;
    if (damped)
    {
      result.mass_damping      = 20.;
      result.stiffness_damping = 1e-7;
      result.relaxation        = 2e-6;
      result.support_damping   = 1e-3;
    }
    return result;
  }

  /// A meshed lever, and the same as dense matrices.
  class MeshedLever
  {
  public:
    MeshedLever(const LeverDynamics &lever_constants, const unsigned int n_modes)
        : constants(lever_constants)
        , matrices(std::make_shared<InertialMatrices>(*bar, bar_inertia(1e-3, 1e-7)))
        , interface(*bar, *matrices, constants.sprung)
        , modes(modes_on_spring(*bar, bar_inertia(1e-3, 1e-7), n_modes, spring_stiffness))
        , structure(*bar, matrices, modes, constants)
    {
      const unsigned int n_lever = matrices->coordinates.size();
      mass                       = dense(matrices->mass);
      stiffness                  = dense(matrices->stiffness);
      damping                    = dense(matrices->layer_stiffness);
      damping *= constants.relaxation;
      damping.add(constants.mass_damping, mass, constants.stiffness_damping, stiffness);
      stiffness(n_lever - 1, n_lever - 1) += spring_stiffness;
      if (constants.sprung)
      {
        mass(n_lever, n_lever)      = constants.support_mass;
        damping(n_lever, n_lever)   = constants.support_damping;
        stiffness(n_lever, n_lever) = constants.support_stiffness;
      }
    }

    ModalStructure condensed(const unsigned int n_modes) const
    {
      return ModalStructure(
          modal_data(make_basis(*bar, { n_modes, spring_stiffness, bar_inertia(1e-3, 1e-7), {}, {} }), constants));
    }

    unsigned int n() const
    {
      return interface.n_coordinates();
    }

  private:
    Full dense(const dealii::PETScWrappers::SparseMatrix &matrix) const
    {
      Full result(n(), n());
      for (unsigned int i = 0; i < matrix.m(); ++i)
        for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
          result(i, entry->column()) = entry->value();
      return result;
    }

    const MeshedBar bar{ coarse_bar() };

  public:
    const LeverDynamics constants;
    const std::shared_ptr<const InertialMatrices> matrices;
    const LeverInterface interface;
    const LeverModes modes;
    SparseStructure structure;
    Full mass, damping, stiffness;
  };

  /// Friction along the node's first dof that a spring of 500 N/mm delays; what it is without delay goes to the forces.
  void add_delay(const double time, const unsigned int node, LinearisedForces &forces)
  {
    const auto n = static_cast<unsigned int>(forces.dofs.size());
    FrictionDelay delay{ time, Vector(n), Vector(n), Vector(n) };
    delay.force[2 * node]             = -1.;
    delay.stiffness_row[2 * node + 1] = -580.;
    delay.rate_row[2 * node]          = 500. * time;
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
      {
        forces.friction(a, b) += delay.force[a] * delay.stiffness_row[b];
        forces.friction_rate(a, b) += delay.force[a] * delay.rate_row[b];
      }
    forces.delays.push_back(delay);
  }

  /// Stiff springs and dashpots beside friction that is a fifth of them, on two nodes, the rotation and the support.
  LinearisedForces contact_on(const InterfaceLayout &layout, const double friction)
  {
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    LinearisedForces forces;
    forces.dofs = { 12, 13, 14, 15, layout.rotation() };
    if (layout.sprung)
      for (unsigned int dof = layout.momentum_eta(); dof < layout.size(); ++dof)
        forces.dofs.push_back(dof);
    const auto n = static_cast<unsigned int>(forces.dofs.size());
    for (auto *const matrix :
         { &forces.pressure, &forces.friction, &forces.pressure_rate, &forces.friction_rate, &forces.inertia })
      matrix->reinit(n, n);
    for (unsigned int a = 0; a < 4; ++a)
    {
      forces.pressure(a, a)      = -800.;
      forces.pressure_rate(a, a) = friction == 0. ? 0. : -1e-3;
      for (unsigned int b = 0; b < 5; ++b)
      {
        forces.friction(a, b)      = friction * 160. * uniform(generator);
        forces.friction_rate(a, b) = friction * 1e-4 * uniform(generator);
      }
    }
    if (friction > 0.)
      for (unsigned int i = 0; i < 2; ++i)
        add_delay(2e-5 * (1. + i), i, forces);
    if (layout.sprung)
    {
      forces.inertia(5, 7) = forces.inertia(7, 5) = 0.05;
      forces.inertia(6, 7) = forces.inertia(7, 6) = -1.;
    }
    return forces;
  }

  /// Adds factor B^T A B, B the interface displacements.
  void add_on_interface(const LeverInterface &interface, const std::vector<unsigned int> &chosen, const Full &matrix,
                        const double factor, Full &sum)
  {
    const auto m = static_cast<unsigned int>(chosen.size());
    const auto n = static_cast<unsigned int>(sum.m());
    Full rows(m, n);
    for (unsigned int a = 0; a < m; ++a)
    {
      Vector row(n);
      interface.add_force(chosen[a], 1., row);
      for (unsigned int j = 0; j < n; ++j)
        rows(a, j) = row[j];
    }
    Full half(m, n), whole(n, n);
    matrix.mmult(half, rows);
    rows.Tmmult(whole, half);
    sum.add(factor, whole);
  }

  Full inverse(const Full &matrix)
  {
    dealii::LAPACKFullMatrix<double> lapack(static_cast<unsigned int>(matrix.m()));
    lapack = matrix;
    lapack.invert();
    Full result(matrix.m(), matrix.n());
    result = lapack;
    return result;
  }

  /// Returns the eigenvalues by increasing size of the linearised problem in all coordinates, rates and delayed tractions. They
  /// are those of A^-1 E in
  ///   q' = v,   M v' = -K q - C v + B^T F tau,   time tau' = (stiffness_row + rate_row d/dt) B q - tau
  std::vector<Complex> dense_eigenvalues(const MeshedLever &lever, const LinearisedForces &forces)
  {
    Full m = lever.mass, c = lever.damping, k = lever.stiffness;
    add_on_interface(lever.interface, forces.dofs, forces.immediate_stiffness(), -1., k);
    add_on_interface(lever.interface, forces.dofs, forces.immediate_damping(), -1., c);
    add_on_interface(lever.interface, forces.dofs, forces.inertia, 1., m);
    const unsigned int n       = lever.n();
    const auto n_delays        = static_cast<unsigned int>(forces.delays.size());
    constexpr double frequency = 1e4; // of rates and tractions, so that all parts are of one size
    constexpr double spring    = 500.;
    Full a(2 * n + n_delays, 2 * n + n_delays), e(a.m(), a.m()), quotient(a.m(), a.m());
    for (unsigned int i = 0; i < n; ++i)
    {
      a(i, n + i) = frequency;
      e(i, i)     = 1.;
      for (unsigned int j = 0; j < n; ++j)
      {
        a(n + i, j)     = -k(i, j);
        a(n + i, n + j) = -frequency * c(i, j);
        e(n + i, n + j) = frequency * m(i, j);
      }
    }
    for (unsigned int d = 0; d < n_delays; ++d)
    {
      const auto &delay         = forces.delays[d];
      const unsigned int at     = 2 * n + d;
      const auto in_coordinates = [&](const Vector &dof_values)
      {
        Vector result(n);
        for (unsigned int dof = 0; dof < dof_values.size(); ++dof)
          lever.interface.add_force(forces.dofs[dof], dof_values[dof], result);
        return result;
      };
      const Vector force = in_coordinates(delay.force), by_position = in_coordinates(delay.stiffness_row),
                   by_rate = in_coordinates(delay.rate_row);
      a(at, at)            = -spring;
      e(at, at)            = spring * delay.time;
      for (unsigned int j = 0; j < n; ++j)
      {
        a(n + j, at) = spring * force[j];
        a(at, j)     = by_position[j];
        a(at, n + j) = frequency * by_rate[j];
      }
    }
    inverse(a).mmult(quotient, e);
    std::vector<Complex> result;
    for (const auto &pair : eigenpairs(quotient))
      if (std::abs(pair.value) > 0.)
        result.push_back(std::conj(1. / pair.value));
    std::sort(result.begin(), result.end(), [](const auto x, const auto y) { return std::abs(x) < std::abs(y); });
    return result;
  }

  double nearest(const Complex target, const std::vector<StructureMode> &modes)
  {
    double distance = 1e300;
    for (const auto &mode : modes)
      distance = std::min(distance, std::abs(mode.eigenvalue - target));
    return distance / std::abs(target);
  }
} // namespace

// A space of a few directions, and all of it where all modes are wanted.
TEST(SparseVibration, IsThatOfTheDenseMatrices)
{
  for (const bool sprung : { false, true })
    for (const bool in_contact : { true, false })
    {
      MeshedLever lever(make_dynamics(sprung, true), 5);
      auto forces = contact_on(lever.structure.layout(), 1.);
      if (!in_contact)
        for (auto *const matrix : { &forces.pressure, &forces.friction, &forces.pressure_rate, &forces.friction_rate })
          *matrix = 0.;
      const auto expected = dense_eigenvalues(lever, forces);
      for (const unsigned int number : { 1u, 8u, lever.n() })
      {
        const auto found = lever.structure.vibrations(forces, number);
        ASSERT_GE(found.size(), std::min(number, 30u));
        for (unsigned int i = 0; i < std::min(number, 30u); ++i)
          EXPECT_LT(nearest(expected[i], found), 1e-8) << sprung << in_contact << number << " " << expected[i];
        for (const auto &mode : found)
        {
          EXPECT_GE(mode.eigenvalue.imag(), 0.);
          EXPECT_LT(mode.residual, 1e-8);
        }
      }
    }
}

TEST(SparseVibration, WithoutFrictionIsThatOfTheSymmetricProblem)
{
  MeshedLever lever(make_dynamics(false, false), 5);
  const auto forces = contact_on(lever.structure.layout(), 0.);
  for (const bool in_contact : { true, false })
  {
    Full k = lever.stiffness;
    if (in_contact)
      add_on_interface(lever.interface, forces.dofs, forces.pressure, -1., k);
    dealii::LAPACKFullMatrix<double> stiffness(lever.n()), mass(lever.n());
    stiffness = k;
    mass      = lever.mass;
    std::vector<Vector> vectors(lever.n());
    stiffness.compute_generalized_eigenvalues_symmetric(mass, vectors);
    const auto found = lever.structure.vibrations(in_contact ? forces : LinearisedForces(), 10);
    for (unsigned int i = 0; i < 10; ++i)
    {
      const double omega = std::sqrt(stiffness.eigenvalue(i).real());
      EXPECT_NEAR(found[i].eigenvalue.imag(), omega, 1e-8 * omega);
      EXPECT_NEAR(found[i].eigenvalue.real(), 0., 1e-8 * omega);
      if (!in_contact && i < 5)
      {
        EXPECT_NEAR(found[i].eigenvalue.imag(), std::sqrt(lever.modes.stiffness[i]), 1e-8 * omega);
      }
    }
  }
}

TEST(SparseVibration, MassDampingTakesHalfOfItsFactorOffEveryVibration)
{
  auto constants         = make_dynamics(false, false);
  constants.mass_damping = 34.;
  MeshedLever lever(constants, 5);
  const auto forces = contact_on(lever.structure.layout(), 0.);
  for (const bool in_contact : { true, false })
  {
    const auto &on = in_contact ? forces : LinearisedForces();
    for (const auto &mode : lever.structure.vibrations(on, 10))
      EXPECT_NEAR(mode.eigenvalue.real(), -17., 1e-9 * std::abs(mode.eigenvalue));
    unsigned int vibrations = 0;
    for (const auto &mode : lever.condensed(10).vibrations(on, 10))
    {
      EXPECT_NEAR(mode.eigenvalue.real(), -17., 1e-9 * std::abs(mode.eigenvalue));
      ++vibrations;
    }
    EXPECT_EQ(vibrations, 10u);
  }
}
