// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/sparse_structure.h"

#include "bar.h"
#include "mpi_environment.h"
#include "support/lever_in_time.h"
#include "support/random_vector.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;
  using Full   = dealii::FullMatrix<double>;

  /// A small lever with what its parts are made of.
  class SmallLever
  {
  public:
    explicit SmallLever(const bool sprung)
        : SmallLever(damped_dynamics(sprung))
    {
    }

    explicit SmallLever(const LeverDynamics &lever_constants)
        : constants(lever_constants)
        , matrices(std::make_shared<InertialMatrices>(*bar, bar_inertia(1e-3, 1e-7)))
        , modes(modes_on_spring(*bar, bar_inertia(1e-3, 1e-7), 5))
        , structure(*bar, matrices, modes, constants)
    {
    }

  private:
    const MeshedBar bar{ Bar{} };

  public:
    const LeverDynamics constants;
    const std::shared_ptr<const InertialMatrices> matrices;
    const LeverModes modes;
    SparseStructure structure;

    Vector shape(const unsigned int mode) const
    {
      return matrices->coordinates.total(modes.displacements[mode], modes.leaf[mode], modes.rotation[mode]);
    }
  };

  /// Not in equilibrium: displacements of 0.01 mm that turn into each other in 1e-4 s.
  Motion random_motion(const SparseStructure &structure)
  {
    Motion motion        = structure.rest();
    auto &q              = motion.coordinates;
    const unsigned int n = q.position.size();
    q.position           = random_vector(n, 1e-2, 1);
    q.velocity           = random_vector(n, 1e2, 2);
    q.acceleration       = random_vector(n, 1e6, 3);
    return motion;
  }

  /// Forces on three of the face's dofs and all others.
  InterfaceForces random_forces(const InterfaceLayout &layout)
  {
    InterfaceForces forces;
    forces.dofs = { 2, 5, 6, layout.rotation() };
    if (layout.sprung)
      for (unsigned int dof = layout.momentum_eta(); dof < layout.size(); ++dof)
        forces.dofs.push_back(dof);
    forces.values = random_vector(static_cast<unsigned int>(forces.dofs.size()), 5., 4);
    return forces;
  }

  Full dense(const dealii::PETScWrappers::SparseMatrix &matrix, const unsigned int size)
  {
    Full result(size, size);
    for (unsigned int i = 0; i < matrix.m(); ++i)
      for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
        result(i, entry->column()) = entry->value();
    return result;
  }

  /// The same lever as dense matrices, the support's coordinate last.
  struct DenseLever
  {
    explicit DenseLever(const SmallLever &lever)
    {
      const auto &c              = lever.constants;
      const unsigned int n_lever = lever.matrices->coordinates.size();
      const unsigned int n       = n_lever + (c.sprung ? 1 : 0);
      mass                       = dense(lever.matrices->mass, n);
      stiffness                  = dense(lever.matrices->stiffness, n);
      damping                    = dense(lever.matrices->layer_stiffness, n);
      damping *= c.relaxation;
      damping.add(c.mass_damping, mass, c.stiffness_damping, stiffness);
      stiffness(n_lever - 1, n_lever - 1) += c.spring_stiffness;
      for (unsigned int k = 1; k < lever.modes.stiffness.size(); ++k)
      {
        Vector shape = lever.shape(k), momentum(n);
        shape.grow_or_shrink(n);
        mass.vmult(momentum, shape);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            damping(i, j) += 2. * c.modal_damping * std::sqrt(lever.modes.stiffness[k]) * momentum[i] * momentum[j];
      }
      if (c.sprung)
      {
        mass(n_lever, n_lever)      = c.support_mass;
        damping(n_lever, n_lever)   = c.support_damping;
        stiffness(n_lever, n_lever) = c.support_stiffness;
      }
      on_interface.reinit(lever.structure.layout().size(), n);
      for (unsigned int j = 0; j < n; ++j)
      {
        Motion unit                  = lever.structure.rest();
        unit.coordinates.position[j] = 1.;
        const auto displacements     = lever.structure.positions(unit);
        for (unsigned int i = 0; i < on_interface.m(); ++i)
          on_interface(i, j) = displacements[i];
      }
    }

    Vector load(const InterfaceForces &forces) const
    {
      Vector result(static_cast<unsigned int>(mass.m()));
      for (unsigned int a = 0; a < forces.dofs.size(); ++a)
        for (unsigned int j = 0; j < result.size(); ++j)
          result[j] += on_interface(forces.dofs[a], j) * forces.values[a];
      return result;
    }

    /// M a_m + C v_f + K q_f - f.
    Vector residual(const Kinematic &q_0, const Kinematic &q_1, const StepWeights &w, const InterfaceForces &forces) const
    {
      const auto mean = [](const Vector &begin, const Vector &end, const double alpha)
      {
        Vector result(begin.size());
        result.add(1. - alpha, end, alpha, begin);
        return result;
      };
      Vector result = load(forces);
      result *= -1.;
      mass.vmult_add(result, mean(q_0.acceleration, q_1.acceleration, w.alpha_m));
      damping.vmult_add(result, mean(q_0.velocity, q_1.velocity, w.alpha_f));
      stiffness.vmult_add(result, mean(q_0.position, q_1.position, w.alpha_f));
      return result;
    }

    Full mass, damping, stiffness, on_interface;
  };

  struct OneStep
  {
    Motion begin;
    InterfaceForces forces;
    StepWeights weights;
    Vector free;
    Motion end;
  };

  OneStep one_step(SmallLever &lever, const double dt)
  {
    OneStep step;
    step.begin   = random_motion(lever.structure);
    step.forces  = random_forces(lever.structure.layout());
    step.weights = generalised_alpha(0.8, dt);
    lever.structure.use_step(step.weights);
    step.free = lever.structure.free_displacements(step.begin, all_dofs(lever.structure.layout().size()));
    step.end  = lever.structure.advance(step.begin, step.forces, {});
    return step;
  }
} // namespace

TEST(SparseStructure, AStepFulfilsTheEquationsOfMotion)
{
  for (const bool sprung : { false, true })
  {
    SmallLever lever(sprung);
    const DenseLever reference(lever);
    for (const double dt : { 1e-4, 1e-6 })
    {
      const auto step = one_step(lever, dt);
      const auto &q_0 = step.begin.coordinates;
      const auto &q_1 = step.end.coordinates;
      const auto left = reference.residual(q_0, q_1, step.weights, step.forces);
      // Beside the forces of the largest accelerations and displacements.
      Vector inertia(left.size()), elastic(left.size());
      reference.mass.vmult(inertia, q_1.acceleration);
      reference.stiffness.vmult(elastic, q_0.position);
      EXPECT_LE(left.linfty_norm(), 1e-10 * (inertia.linfty_norm() + elastic.linfty_norm())) << sprung << " " << dt;
      EXPECT_NEAR(q_1.velocity[3],
                  q_0.velocity[3] +
                      dt * ((1. - step.weights.gamma) * q_0.acceleration[3] + step.weights.gamma * q_1.acceleration[3]),
                  1e-9 * std::abs(q_1.velocity[3]));
    }
  }
}

TEST(SparseStructure, ItsComplianceIsWhatForcesDoToTheInterface)
{
  for (const bool sprung : { false, true })
  {
    SmallLever lever(sprung);
    const auto step  = one_step(lever, 1e-4);
    Vector predicted = step.free;
    add_response(lever.structure.compliance(), step.forces.dofs, step.forces.values, all_dofs(predicted.size()), predicted);
    predicted -= lever.structure.positions(step.end);
    EXPECT_LE(predicted.linfty_norm(), 1e-10 * step.free.linfty_norm()) << sprung;

    lever.structure.use_statics();
    const auto deformed = lever.structure.positions(lever.structure.deform(step.forces));
    Vector expected(deformed.size());
    add_response(lever.structure.compliance(), step.forces.dofs, step.forces.values, all_dofs(expected.size()), expected);
    expected -= deformed;
    EXPECT_LE(expected.linfty_norm(), 1e-10 * deformed.linfty_norm()) << sprung;
  }
}

// Over a short step an undamped oscillation is off by dt^3 a' (beta - 1/6), a' = -omega^2 v.
TEST(SparseStructure, TellsTheLocalErrorOfAMode)
{
  LeverDynamics undamped;
  undamped.spring_stiffness = 1e4;
  SmallLever lever(undamped);
  const double omega = std::sqrt(lever.modes.stiffness[0]);
  const double dt    = 0.02 / omega;
  const auto w       = generalised_alpha(1., dt);
  auto &structure    = lever.structure;
  structure.use_step(w);
  Motion begin               = structure.rest();
  begin.coordinates.velocity = lever.shape(0);
  structure.free_displacements(begin, all_dofs(structure.layout().size()));
  const Motion end       = structure.advance(begin, InterfaceForces(), {});
  const auto error       = structure.local_error(begin, end);
  const auto rate        = structure.kinematics(begin).velocity;
  const unsigned int hub = structure.layout().rotation();
  const double expected  = -dt * dt * dt * (w.beta - 1. / 6.) * omega * omega * rate[hub];
  EXPECT_NEAR(error[hub], expected, 0.02 * std::abs(expected));
}
