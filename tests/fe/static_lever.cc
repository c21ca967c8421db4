// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_lever.h"

#include "fe/meshed.h"
#include "mpi_environment.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/newton_step.h"
#include "support/quadratic_return.h"
#include "support/random_vector.h"
#include "support/scene_parts.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  Scene coarse_scene(const Solution solution)
  {
    Scene scene             = model_a();
    scene.mesh.face_size    = 2.;
    scene.analysis.solution = solution;
    return scene;
  }

  /// On a spring that hardens by a third over the turn of 0.0068 at x = 20.
  Scene hardening(Scene scene)
  {
    scene.spring = with_cubic_hardening(scene.spring.stiffness, 8e3);
    return scene;
  }

  /// The cylinder shares in the deformation.
  Scene on_soft_cylinder(const Scene &scene)
  {
    return on_solid_cylinder(scene, 200., 0.5);
  }

  Scene pair(const Scene &scene, const SpringJoint joint = SpringJoint::free)
  {
    return paired(scene, joint, 0.3, 0.8);
  }

  /// A scene's model with its mesh.
  class MeshedLever : public Meshed<StaticLever<2>>
  {
  public:
    explicit MeshedLever(const Scene &scene)
        : Meshed(scene, scene)
    {
    }
  };

  DrivePoint forward_to(const double x)
  {
    return { x / 112., x, 112. };
  }

  /// Equilibrium of a step from the accepted state, history not yet stored.
  Solved solved(Model &model, const State &accepted, const DrivePoint &drive)
  {
    Step step         = model.begin_step(accepted, drive);
    const State guess = step.trial;
    auto found        = solve_step(model, step, drive.v < 0. ? FrictionMode::stick : FrictionMode::cone);
    if (!found)
    {
      step.trial = guess;
      found      = solve_step(model, step, drive.v > 0. ? FrictionMode::stick : FrictionMode::cone);
      EXPECT_TRUE(found) << "x " << drive.x;
    }
    return { step.trial, found.value() };
  }

  Row observed(const Model &model, const Solved &at)
  {
    Row row;
    model.observe(at.state, at.found, row);
    return row;
  }

  /// Accepted after sliding forward to 20 mm.
  State slid(Model &model)
  {
    return slid_forward(model, solved);
  }

  /// Back by dx after forward sliding to 20 mm.
  DrivePoint back_by(const double dx)
  {
    return { (20. + dx) / 112., 20. - dx, -112. };
  }

  /// A movement of 1 mm of everything that can move; both levers of a pair swing and open.
  Vector random_direction(const State &state, const StaticLever<2> &model, const unsigned int n_levers)
  {
    Vector result    = random_vector(state.coordinates.size(), 1., 1);
    const auto &body = model.body();
    for (unsigned int lever = 0; lever < n_levers; ++lever)
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

  // A term that is wrong of the springs of a pair leaves its share: without the swing's part about 1e-3, the stiffness of the
  // springs over that of the contact.
  void expect_consistent_tangent(const Scene &scene)
  {
    MeshedLever meshed(scene);
    auto &model              = meshed.model;
    const auto accepted      = slid(model);
    const auto expect_return = [&](const Solved &at)
    { expect_quadratic_return(model, at.state, accepted, random_direction(at.state, model, count_levers(scene))); };
    const auto sliding = solved(model, accepted, forward_to(21.));
    ASSERT_GT(observed(model, sliding)[Column::P], 0.);
    expect_return(sliding);
    // The passage through stick takes some hundredths of a millimetre: all points stick at its beginning; further on some slip.
    for (const double dx : { 1e-4, 5e-3 })
      expect_return(solved(model, accepted, back_by(dx)));
  }

  void expect_consistent_tangents(const std::vector<Scene> &scenes)
  {
    for (std::size_t i = 0; i < scenes.size(); ++i)
    {
      SCOPED_TRACE(i);
      expect_consistent_tangent(scenes[i]);
    }
  }
} // namespace

TEST(StaticLever, CorrectionIsNewtons)
{
  for (const auto solution : { Solution::automatic, Solution::general })
  {
    const Scene plain = coarse_scene(solution), springs = on_sprung_support(hardening(plain), 10.);
    expect_consistent_tangents({ plain, springs, on_soft_cylinder(springs), on_sprung_support(pair(plain), 10.) });
  }
  expect_consistent_tangent(on_soft_cylinder(pair(coarse_scene(Solution::automatic))));
}

TEST(StaticLever, CorrectionOfAPairIsNewtonsSlow)
{
  for (const auto joint : { SpringJoint::held, SpringJoint::free })
    for (const auto solution : { Solution::automatic, Solution::general })
      expect_consistent_tangents({ pair(coarse_scene(solution), joint), pair(hardening(coarse_scene(solution)), joint) });
}

TEST(StaticLever, ApartTheSpringReturnsTheLeverInOneCorrection)
{
  for (const auto solution : { Solution::automatic, Solution::general })
  {
    const auto scene = coarse_scene(solution);
    MeshedLever meshed(scene);
    Step step   = meshed.model.begin_step(meshed.model.initial_state(forward_to(0.)), forward_to(1e-3));
    auto &trial = step.trial;
    trial.coordinates[trial.coordinates.size() - 1] += 0.01;
    const auto found = meshed.model.evaluate(step, FrictionMode::cone);
    const Row row    = observed(meshed.model, { trial, found });
    EXPECT_EQ(row[Column::P], 0.);
    EXPECT_EQ(row[Column::contact_width], 0.);
    EXPECT_TRUE(std::isnan(row[Column::s]));
    trial.coordinates += meshed.model.correction(found);
    EXPECT_NEAR(trial.coordinates[trial.coordinates.size() - 1], 0., 1e-14);
  }
}

// Nothing holds the swing of levers that are apart.
TEST(StaticLever, ApartTheSpringsOfAPairCloseItAndLeaveItsSwing)
{
  for (const auto solution : { Solution::automatic, Solution::general })
  {
    MeshedLever meshed(paired(coarse_scene(solution), SpringJoint::free));
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

TEST(StaticLever, ATriedStepLeavesTheNextStepAsItWas)
{
  MeshedLever meshed(coarse_scene(Solution::automatic));
  auto &model         = meshed.model;
  const auto accepted = slid(model);
  const auto direct   = solved(model, accepted, forward_to(21.));
  State first         = direct.state;
  model.store_history(direct.found, first);

  // A trial far from any equilibrium, given up.
  Step step   = model.begin_step(accepted, back_by(9.));
  auto &trial = step.trial;
  trial.coordinates[trial.coordinates.size() - 1] -= 0.1;
  const auto far = model.evaluate(step, FrictionMode::cone);
  model.augment(far, trial);
  model.correction(far);

  const auto again = solved(model, accepted, forward_to(21.));
  State second     = again.state;
  model.store_history(again.found, second);
  EXPECT_GT(direct.state.forces.values.l2_norm(), 0.);
  EXPECT_TRUE(again.state.forces.values == direct.state.forces.values);
  EXPECT_EQ(again.state.coordinates[model.rotation()], direct.state.coordinates[model.rotation()]);

  // The evaluation found before still answers.
  EXPECT_EQ(model.correction(direct.found).linfty_norm(), model.correction(again.found).linfty_norm());
  ASSERT_FALSE(first.contact.empty());
  ASSERT_EQ(second.contact.size(), first.contact.size());
  for (std::size_t q = 0; q < first.contact.size(); ++q)
    ASSERT_EQ(first.contact[q].traction, second.contact[q].traction);
}
