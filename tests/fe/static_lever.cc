// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_lever.h"

#include "fe/meshed.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/newton_step.h"
#include "support/quadratic_return.h"
#include "support/random_vector.h"

#include <cmath>
#include <gtest/gtest.h>

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

  /// On a soft support and a spring that hardens by a third over the turn of 0.0068 at x = 20.
  Scene coarse_scene_with_springs(const Solution solution)
  {
    Scene scene             = coarse_scene(solution);
    scene.support.type      = SupportType::sprung;
    scene.support.stiffness = 10.;
    scene.spring            = with_cubic_hardening(scene.spring.stiffness, 8e3);
    return scene;
  }

  /// A scene's model with its mesh.
  class MeshedLever : public Meshed<StaticLever<2>>
  {
  public:
    explicit MeshedLever(const Scene &scene)
        : Meshed(scene, lever_properties(scene))
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

  /// A movement of 1 mm of everything that can move.
  Vector random_direction(const State &state, const StaticLever<2> &model, const bool sprung)
  {
    Vector result               = random_vector(state.coordinates.size(), 1., 1);
    const auto &body            = model.body();
    const unsigned int rotation = result.size() - (sprung ? 2 : 1);
    if (rotation == body.n_dofs())
      for (unsigned int dof = 0; dof < rotation; ++dof)
        if (body.is_held(dof))
          result[dof] = 0.;
    result[rotation] /= 100.;
    result /= model.movement(result);
    return result;
  }

  void expect_return(StaticLever<2> &model, const State &equilibrium, const State &accepted, const bool sprung)
  {
    expect_quadratic_return(model, equilibrium, accepted, random_direction(equilibrium, model, sprung));
  }

  void expect_consistent_tangent(const Scene &scene)
  {
    const bool sprung = scene.support.type == SupportType::sprung;
    MeshedLever meshed(scene);
    auto &model         = meshed.model;
    const auto accepted = slid(model);
    const auto sliding  = solved(model, accepted, forward_to(21.));
    ASSERT_GT(observed(model, sliding)[Column::P], 0.);
    expect_return(model, sliding.state, accepted, sprung);
    // The passage through stick takes some hundredths of a millimetre: all points stick at its beginning; further on some slip.
    for (const double dx : { 1e-4, 5e-3 })
      expect_return(model, solved(model, accepted, back_by(dx)).state, accepted, sprung);
  }
} // namespace

TEST(StaticLever, CorrectionIsNewtonsFactorisedOnce)
{
  expect_consistent_tangent(coarse_scene(Solution::automatic));
}

TEST(StaticLever, CorrectionIsNewtonsInGeneral)
{
  expect_consistent_tangent(coarse_scene(Solution::general));
}

TEST(StaticLever, CorrectionIsNewtonsOnASprungSupportAndAHardeningSpring)
{
  for (const auto solution : { Solution::automatic, Solution::general })
    expect_consistent_tangent(coarse_scene_with_springs(solution));
}

TEST(StaticLever, CorrectionIsNewtonsOnAnElasticCylinder)
{
  for (const auto solution : { Solution::automatic, Solution::general })
  {
    Scene scene                  = coarse_scene_with_springs(solution);
    scene.cylinder.type          = CylinderType::solid;
    scene.cylinder.young_modulus = 200.; // so that it shares in the deformation
    scene.cylinder.face_size     = 1.;
    expect_consistent_tangent(scene);
  }
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
