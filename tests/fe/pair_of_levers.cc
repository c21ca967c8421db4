// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_lever.h"

#include "fe/meshed.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/newton_step.h"
#include "support/quadratic_return.h"
#include "support/random_vector.h"
#include "support/scene_parts.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  Scene coarse_scene()
  {
    Scene scene          = model_a();
    scene.mesh.face_size = 2.;
    return scene;
  }

  class MeshedPair : public Meshed<StaticLever<2>>
  {
  public:
    explicit MeshedPair(const Scene &scene)
        : Meshed(scene, scene)
    {
    }
  };

  DrivePoint forward_to(const double x)
  {
    return { x / 112., x, 112. };
  }

  /// Newton's method, halving a correction until the unbalance falls.
  Solved solved(Model &model, const State &accepted, const DrivePoint &drive, const FrictionMode first)
  {
    Step step  = model.begin_step(accepted, drive);
    auto found = solve_step(model, step, first);
    EXPECT_TRUE(found) << "x " << drive.x;
    return { step.trial, found.value() };
  }

  /// After sliding forward to 20 mm.
  State slid(Model &model)
  {
    return slid_forward(model, [](Model &each, const State &accepted, const DrivePoint &drive)
                        { return solved(each, accepted, drive, FrictionMode::cone); });
  }

  /// Both levers swinging and opening with everything on their faces, 1 mm at most.
  Vector random_direction(const StaticLever<2> &model, const State &state)
  {
    Vector result    = random_vector(state.coordinates.size(), 1., 1);
    const auto &body = model.body();
    for (const unsigned int lever : { 0, 1 })
    {
      const unsigned int first = lever * (model.rotation(0) + 1);
      if (model.rotation(0) == body.n_dofs())
        for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
          if (body.is_held(dof))
            result[first + dof] = 0.;
      result[model.rotation(lever)] /= 100.;
    }
    result /= model.movement(result);
    return result;
  }

  // The share that a tangent wrong in one term of the springs leaves: without the swing's part about 1e-3, the stiffness of the
  // springs over that of the contact.
  void expect_return(StaticLever<2> &model, const State &equilibrium, const State &accepted)
  {
    expect_quadratic_return(model, equilibrium, accepted, random_direction(model, equilibrium));
  }

  void expect_consistent_tangent(const Scene &scene)
  {
    MeshedPair meshed(scene);
    const auto accepted = slid(meshed.model);
    expect_return(meshed.model, solved(meshed.model, accepted, forward_to(21.), FrictionMode::cone).state, accepted);
    const DrivePoint back{ (20. + 5e-3) / 112., 20. - 5e-3, -112. }; // some points stick, some slip
    expect_return(meshed.model, solved(meshed.model, accepted, back, FrictionMode::stick).state, accepted);
  }
} // namespace

TEST(PairOfLevers, CorrectionIsNewtonsSlow)
{
  for (const auto joint : { SpringJoint::held, SpringJoint::free })
    for (const auto solution : { Solution::automatic, Solution::general })
    {
      Scene scene             = paired(coarse_scene(), joint, 0.3, 0.8);
      scene.analysis.solution = solution;
      expect_consistent_tangent(scene);
      scene.spring = with_cubic_hardening(scene.spring.stiffness, 8e3); // by a third over the turn at x = 20
      expect_consistent_tangent(scene);
    }
}

TEST(PairOfLevers, CorrectionIsNewtonsOnASprungSupport)
{
  for (const auto solution : { Solution::automatic, Solution::general })
  {
    Scene scene             = paired(coarse_scene(), SpringJoint::free, 0.3, 0.8);
    scene.analysis.solution = solution;
    scene.support.type      = SupportType::sprung;
    scene.support.stiffness = 10.;
    expect_consistent_tangent(scene);
  }
}

TEST(PairOfLevers, CorrectionIsNewtonsOnAnElasticCylinder)
{
  expect_consistent_tangent(on_solid_cylinder(paired(coarse_scene(), SpringJoint::free, 0.3, 0.8), 200., 0.5));
}

// Nothing holds the swing of levers that are apart.
TEST(PairOfLevers, ApartTheSpringsCloseThemAndLeaveTheirSwing)
{
  for (const auto solution : { Solution::automatic, Solution::general })
  {
    Scene scene             = paired(coarse_scene(), SpringJoint::free);
    scene.analysis.solution = solution;
    MeshedPair meshed(scene);
    auto &model         = meshed.model;
    Step step           = model.begin_step(model.initial_state(forward_to(0.)), forward_to(1e-3));
    auto &trial         = step.trial;
    double &first_turn  = trial.coordinates[model.rotation(0)];
    double &second_turn = trial.coordinates[model.rotation(1)];
    first_turn          = 0.02;
    second_turn         = 0.01;
    trial.coordinates += model.correction(model.evaluate(step, FrictionMode::cone));
    EXPECT_NEAR(first_turn, 0.005, 1e-14);
    EXPECT_NEAR(second_turn, -0.005, 1e-14);
  }
}
