#include "fe/mirrored_levers.h"

#include "fe/meshed.h"
#include "mpi_environment.h"
#include "scenes.h"

#include <gtest/gtest.h>
#include <random>

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

  Scene pair(Scene scene, const SpringJoint joint, const double offset = 0., const double friction_ratio = 1.)
  {
    scene.pair.type            = PairType::full;
    scene.pair.joint           = joint;
    scene.pair.cylinder_offset = offset;
    scene.pair.friction_ratio  = friction_ratio;
    return scene;
  }

  Scene with_elastic_cylinder(Scene scene)
  {
    scene.cylinder.type          = CylinderType::solid;
    scene.cylinder.young_modulus = 200.; // so that it shares in the deformation
    scene.cylinder.face_size     = 0.5;
    return scene;
  }

  class MeshedPair : public Meshed<MirroredLevers>
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
  State solved(Model &model, const State &accepted, const DrivePoint &drive, const FrictionMode first)
  {
    State trial = accepted;
    trial.drive = drive;
    model.predict(trial, accepted);
    double norm     = model.evaluate(trial, accepted, first).norm;
    double movement = 1.;
    for (unsigned int i = 0; i < 40 && movement > 1e-12; ++i)
    {
      const auto correction = model.correction();
      movement              = model.movement(correction);
      const bool full       = movement <= 1e-10 || (first == FrictionMode::stick && i == 0);
      const Vector from     = trial.coordinates;
      double next           = norm;
      for (double share = 1.; share > 0.01; share *= 0.5)
      {
        trial.coordinates = from;
        trial.coordinates.add(share, correction);
        next = model.evaluate(trial, accepted, FrictionMode::cone).norm;
        if (full || next < norm)
          break;
      }
      norm = next;
    }
    EXPECT_LE(movement, 1e-12) << "x " << drive.x;
    return trial;
  }

  /// After sliding forward to 20 mm.
  State slid(Model &model)
  {
    State accepted = model.initial_state(forward_to(0.));
    for (const double x : { 5., 10., 15., 20. })
    {
      accepted         = solved(model, accepted, forward_to(x), FrictionMode::cone);
      accepted.contact = model.memory();
    }
    return accepted;
  }

  /// Both levers swinging and opening with everything on their faces, 1 mm at most.
  Vector random_direction(const MirroredLevers &model, const State &state)
  {
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    Vector result(state.coordinates.size());
    for (auto &value : result)
      value = uniform(generator);
    const unsigned int n        = result.size() / 2;
    const unsigned int rotation = model.lever(0).rotation();
    const auto &body            = model.lever(0).elastic_body();
    for (const unsigned int begin : { 0u, n })
    {
      if (rotation == body.n_dofs())
        for (unsigned int dof = 0; dof < rotation; ++dof)
          if (body.is_held(dof))
            result[begin + dof] = 0.;
      result[begin + rotation] /= 100.;
    }
    result /= model.movement(result);
    return result;
  }

  // As for a single lever: from h away a consistent correction returns but for a share proportional to h, as long as no point
  // changes between stick, slip and separation. A tangent of the springs wrong in one term leaves a share that does not depend on
  // h: without the swing's part about 1e-3, the stiffness of the springs over that of the contact.
  void expect_quadratic_return(MirroredLevers &model, const State &equilibrium, const State &accepted)
  {
    const auto direction = random_direction(model, equilibrium);
    for (const double h : { 1e-6, 1e-7 })
    {
      State trial = equilibrium;
      trial.coordinates.add(h, direction);
      model.evaluate(trial, accepted, FrictionMode::cone);
      Vector left = model.correction();
      left.add(h, direction);
      EXPECT_LE(model.movement(left), (5e3 * h + 1e-12 / h) * h) << "h " << h;
    }
  }

  void expect_consistent_tangent(const Scene &scene)
  {
    MeshedPair meshed(scene);
    const auto accepted = slid(meshed.model);
    expect_quadratic_return(meshed.model, solved(meshed.model, accepted, forward_to(21.), FrictionMode::cone), accepted);
    const DrivePoint back{ (20. + 5e-3) / 112., 20. - 5e-3, -112. }; // some points stick, some slip
    expect_quadratic_return(meshed.model, solved(meshed.model, accepted, back, FrictionMode::stick), accepted);
  }
} // namespace

TEST(MirroredLevers, CorrectionIsNewtons)
{
  for (const auto joint : { SpringJoint::held, SpringJoint::free })
    for (const auto solution : { Solution::automatic, Solution::general })
    {
      Scene scene             = pair(coarse_scene(), joint, 0.3, 0.8);
      scene.analysis.solution = solution;
      expect_consistent_tangent(scene);
      scene.spring = with_cubic_hardening(scene.spring.stiffness, 8e3); // by a third over the turn at x = 20
      expect_consistent_tangent(scene);
    }
}

TEST(MirroredLevers, CorrectionIsNewtonsOnAnElasticCylinder)
{
  expect_consistent_tangent(with_elastic_cylinder(pair(coarse_scene(), SpringJoint::free, 0.3, 0.8)));
}

// Nothing holds the swing of levers that are apart.
TEST(MirroredLevers, ApartTheSpringsCloseThemAndLeaveTheirSwing)
{
  for (const auto solution : { Solution::automatic, Solution::general })
  {
    Scene scene             = pair(coarse_scene(), SpringJoint::free);
    scene.analysis.solution = solution;
    MeshedPair meshed(scene);
    auto &model         = meshed.model;
    const auto accepted = model.initial_state(forward_to(0.));
    State trial         = accepted;
    trial.drive         = forward_to(1e-3);
    const auto n        = trial.coordinates.size() / 2;
    const auto rotation = model.lever(0).rotation();
    double &first_turn  = trial.coordinates[rotation];
    double &second_turn = trial.coordinates[n + rotation];
    first_turn          = 0.02;
    second_turn         = 0.01;
    model.evaluate(trial, accepted, FrictionMode::cone);
    trial.coordinates += model.correction();
    EXPECT_NEAR(first_turn, 0.005, 1e-14);
    EXPECT_NEAR(second_turn, -0.005, 1e-14);
  }
}
