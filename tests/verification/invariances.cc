// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/closed_form.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "verification/run_scene.h"

#include <deal.II/grid/grid_tools.h>

#include <cstdio>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double mu = 0.73;

  std::vector<Scene> models()
  {
    return { with_coulomb(model_a(), mu), with_coulomb(model_b(), mu) };
  }

  /// mu over speed that is not read in mm/s but in a unit of so many of them.
  FrictionLaw tabulated(const double unit)
  {
    return { TabulatedFriction({ 0. / unit, 50. / unit, 100. / unit, 200. / unit }, { 0.35, 0.55, 0.7, 0.86 }),
             FrictionSpeed::sliding };
  }

  /// The factors of every length and every modulus.
  struct Units
  {
    double length;
    double modulus;
  };

  Scene in_units(Scene scene, const Units &units)
  {
    const double a = units.length;
    auto &g        = scene.geometry;
    g              = { a * g.cylinder_radius, a * g.interface_offset, a * g.pivot_distance, a * g.pivot_height };
    scene.spring.stiffness *= units.modulus * a * a * a;
    scene.lever.length *= a;
    scene.lever.depth *= a;
    scene.lever.width *= a;
    scene.layer.thickness *= a;
    scene.lever.young_modulus *= units.modulus;
    scene.layer.young_modulus *= units.modulus;
    scene.analysis.step *= a;
    scene.analysis.minimum_step *= a;
    scene.contact.penetration_tolerance *= a;
    scene.mesh.face_size *= a;
    const Drive &drive = scene.drive;
    scene.drive        = Drive(DriveProfile::triangle, a * drive.minimum(), a * drive.maximum(), a * drive.peak_speed(),
                        drive.reversals().empty() ? 0.5 : 1.);
    return scene;
  }

  /// The scene on the mesh of another one, scaled: the sizes of elements are given in mm.
  std::vector<Row> run_on_scaled_mesh(const Scene &meshed, const Scene &scene, const double factor)
  {
    dealii::Triangulation<2> triangulation;
    make_mesh(meshed, triangulation);
    dealii::GridTools::scale(factor, triangulation);
    StaticLever<2> model(triangulation, lever_properties(scene));
    std::vector<Row> rows;
    run_quasi_static(model, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
                     [&](const State &, const Row &row, const Evaluation &) { rows.push_back(row); });
    return rows;
  }

  constexpr double round_off = 1e-9; ///< of iterations whose last correction is 1e-7 of the penetration, converging quadratically

  /// Between a reversal and the end the analysis chooses the places, by a stiffness found by a difference: over 1e-2 of a
  /// penetration of 1e-4 mm, where positions are rounded off at 5e-14 mm. By that share of steps that grow to 1 mm the rows move
  /// [mm], and their forces by about as much of the peaks, as those fall to nothing over tens of mm.
  constexpr double moved = 1e-6;

  /// Rows of a run whose positions and forces are multiplied by constants; `moved` are those between a reversal and the end.
  void expect_same(const std::vector<Row> &rows, const std::vector<Row> &reference, const double length, const double force,
                   const double tolerance, const double moved_tolerance)
  {
    double peak_P = 0., peak_Q = 0.;
    for (const Row &row : reference)
    {
      peak_P = std::max(peak_P, row[Column::P]);
      peak_Q = std::max(peak_Q, std::abs(row[Column::Q]));
    }
    const auto expect_row = [&](const Row &row, const Row &other, const double x_tolerance, const double share)
    {
      EXPECT_NEAR(row[Column::x] / length, other[Column::x], x_tolerance);
      EXPECT_NEAR(row[Column::P] / force, other[Column::P], share * peak_P);
      EXPECT_NEAR(row[Column::Q] / force, other[Column::Q], share * peak_Q);
      EXPECT_NEAR(row[Column::theta], other[Column::theta], share);
      return std::max(std::abs(row[Column::P] / force - other[Column::P]) / peak_P,
                      std::abs(row[Column::Q] / force - other[Column::Q]) / peak_Q);
    };
    ASSERT_EQ(rows.size(), reference.size());
    constexpr double same_x = 1e-12 * 65.;
    double forward = 0., backward = 0.;
    for (std::size_t i = 0; i + 1 < reference.size(); ++i)
      if (reference[i][Column::v] > 0.)
        forward = std::max(forward, expect_row(rows[i], reference[i], same_x, tolerance));
      else
        backward = std::max(backward, expect_row(rows[i], reference[i], std::max(same_x, moved_tolerance), moved_tolerance));
    const double at_end = expect_row(rows.back(), reference.back(), same_x, tolerance);
    std::printf("largest difference of P and Q over their peaks: %.1e forward, %.1e backward, %.1e at the end\n", forward,
                backward, at_end);
  }

  /// Coulomb friction there and back, and friction that depends on the speed one way.
  std::vector<Scene> scenes_in_units(const Units &units)
  {
    std::vector<Scene> scenes;
    for (const Scene &model : models())
    {
      scenes.push_back(in_units(with_drive(model, Drive(DriveProfile::triangle, 30., 65., 112., 1.)), units));
      Scene by_speed    = with_drive(model, Drive(DriveProfile::triangle, 30., 65., 112., 0.5));
      by_speed          = in_units(by_speed, units);
      by_speed.friction = tabulated(1. / units.length);
      scenes.push_back(by_speed);
    }
    return scenes;
  }

  const Units millimetres{ 1., 1. };
  const Units metres{ 1e-3, 1e6 };
  const Units thousandth{ 1e-3, 1. };
} // namespace

TEST(Units, DoNotMatterToTheFiniteElements)
{
  for (const auto enforcement : { Enforcement::penalty, Enforcement::augmented_lagrangian })
    for (std::size_t i = 0; i < (enforcement == Enforcement::penalty ? 4u : 2u); ++i) // both models by penalty
    {
      const auto run_in = [&](const Units &units)
      {
        Scene scene               = scenes_in_units(units)[i];
        scene.contact.enforcement = enforcement;
        return run_on_scaled_mesh(with_face_size(scenes_in_units(millimetres)[i], 2.), scene, units.length);
      };
      const Units &units = i % 2 == 0 ? metres : thousandth;
      expect_same(run_in(units), run_in(millimetres), units.length, units.modulus * units.length * units.length, round_off,
                  moved);
    }
}

namespace
{
  struct Ledger
  {
    double drive, friction, residual;
  };

  /// A loop between 50 and 60 mm.
  Ledger compute_ledger(const Scene &scene, const double step)
  {
    const Scene finer  = with_step(with_drive(scene, Drive(DriveProfile::triangle, 50., 60., 112., 1.)), step);
    const auto summary = make_summary(finer, run_scene(finer));
    return { find_value(summary, "loop_area"), find_value(summary, "friction_work"), find_value(summary, "energy_residual") };
  }

  double residual(const Scene &scene, const double step)
  {
    const auto ledger = compute_ledger(scene, step);
    std::printf("step %-5g drive work %.5f, friction work %.5f, residual %.5f N mm\n", step, ledger.drive, ledger.friction,
                ledger.residual);
    return ledger.residual / ledger.friction;
  }
} // namespace

// Friction works at the speed at which points slide where a step ends, so that long steps close the ledger as short ones do. What
// is left, 1e-4, is the passage through stick behind the reversal, whose steps are chosen by the analysis.
TEST(EnergyLedger, ClosesAtEveryStep)
{
  for (const Scene &scene : models())
    for (const double step : { 2., 0.5 })
      EXPECT_LT(std::abs(residual(scene, step)), 2e-4);
}

// Facets of both faces carry the friction; its speed is that of their slip, whose slope is a difference between neighbours.
TEST(EnergyLedger, ClosesWithAnElasticCylinder)
{
  Scene scene         = models().front();
  scene.cylinder.type = CylinderType::solid;
  EXPECT_LT(std::abs(residual(scene, 1.)), 5e-4);
}

// P and Q of both strokes at mu and at 0.9 mu: what they change by is the closed form's change but for the change of the
// deviation between the two, itself a few per cent of the deviation's size, 1 to 2 %. What augmentation leaves of the penetration
// turns the lever by as much over the distance of the contact.
TEST(PenetrationTolerance, IsHowFarAugmentationLeavesTheLever)
{
  Scene scene           = with_face_size(with_augmented_lagrangian(with_coulomb(model_a(), mu)), 2.);
  scene.drive           = Drive(DriveProfile::triangle, 0., 65., 112., 0.5);
  scene.analysis.step   = 20.;
  scene.contact.penalty = 50.;
  const auto theta_with = [&](const double tolerance)
  {
    scene.contact.penetration_tolerance = tolerance;
    return run_scene(scene).back()[Column::theta];
  };
  const double s = kinematics(scene.geometry, 65.).s;
  EXPECT_LT(std::abs(theta_with(1e-6) - theta_with(1e-9)), 1e-6 / s);
}
