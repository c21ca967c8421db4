// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/quasi_static_accuracy.h"

#include "fe/mesh/geometry_script.h"
#include "run/field_recorder.h"
#include "scene/closed_form.h"
#include "scene/lever_inertia.h"

#include "results/row_statistics.h"
#include "scene/scene.h"
#include "support/made_mesh.h"
#include "verification/run_scene.h"

#include <gtest/gtest.h>
#include <map>

using namespace sprag;

namespace
{
  /// A run and what it tells of its errors.
  struct Estimates
  {
    std::vector<Row> rows;
    std::map<std::string, ErrorEstimate> errors;
    std::map<std::string, double> stress; ///< entries of /summary
    double penalty = 0.;
  };

  Estimates estimated(const Scene &scene)
  {
    Estimates result;
    const MadeMesh mesh(scene);
    StaticLever<2> model(mesh, scene);
    const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
    PhaseTimer timer;
    const auto displacements = [&](const std::vector<FieldSource> &sources)
    { return model.body_displacements(mapped(sources, to_static_state)); };
    FieldRecorder fields(scene, BodyFields(model.body()), displacements, std::nullopt, timer);
    run_quasi_static(
        model, scene.drive, settings,
        [&](const State &state, const Row &row, const Evaluation &found)
        {
          result.rows.push_back(row);
          fields.record(row, model.face_state(state, found), [&] { return FieldSource{ state.coordinates, state.forces, {} }; });
        });
    for (const auto &entry : fields.finish())
      if (const auto *const value = std::get_if<double>(&entry.value))
        result.stress[entry.name] = *value;
    const auto trial_runs = [&] { return plane_trial_runs(scene, model, result.rows, settings, fields.stress_samples()); };
    for (auto &estimate : quasi_static_accuracy(scene, result.rows, trial_runs))
      result.errors.emplace(estimate.quantity, std::move(estimate));
    return result;
  }

  Estimates estimated_in_space(const Scene &scene)
  {
    Estimates result;
    const MadeMesh plane(scene);
    SolidBody body(scene, plane);
    StaticLever<3> lever(body, scene);
    result.penalty = lever.penalties().normal;
    const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
    run_quasi_static(lever, scene.drive, settings,
                     [&](const State &, const Row &row, const Evaluation &) { result.rows.push_back(row); });
    const auto trial_runs = [&] { return solid_trial_runs(scene, body, lever, result.rows, settings); };
    for (auto &estimate : quasi_static_accuracy(scene, result.rows, trial_runs))
      result.errors.emplace(estimate.quantity, std::move(estimate));
    return result;
  }

  /// Model A on a coarse mesh and a short way, to be cheap.
  Scene coarse_scene(const double face_size)
  {
    Scene scene = with_face_size(model_a(), face_size);
    scene.drive = Drive(DriveProfile::triangle, 0., 30., 112., 1);
    return with_step(scene, 2.);
  }

  /// One way, on which all runs have the same rows, of a narrow lever, on which the contact is long.
  Scene solid_scene(const double face_size, const unsigned int across)
  {
    Scene scene                = coarse_scene(face_size);
    scene.analysis.dimension   = 3;
    scene.lever.width          = 10.;
    scene.mesh.elements_across = across;
    scene.drive                = Drive(DriveProfile::triangle, 0., 30., 112., 0.5);
    scene.contact.enforcement  = Enforcement::penalty;
    return scene;
  }
} // namespace

/// The bounds are those that the program promises, 0.5 ... 3; the reference is about ten times as exact. The largest pressure of
/// a single place may be right by accident.
TEST(QuasiStaticAccuracy, ToldErrorsMeetTheTrueOnes)
{
  Scene from_file      = coarse_scene(0.5);
  from_file.mesh.file  = mesh_script("lever.geo"); // with faces of 0.5 mm unless it is told otherwise
  const auto reference = run_scene(with_augmented_lagrangian(with_face_size(coarse_scene(0.5), 0.125)));
  for (const Scene &scene : { coarse_scene(0.5), from_file })
  {
    const auto run   = estimated(scene);
    const auto ratio = [&](const std::string &quantity, const double value, const double exact)
    { return total_error(run.errors.at(quantity)) / std::abs(value / exact - 1.); };
    const double loop = ratio("loop_area", run.rows.back()[Column::drive_work], reference.back()[Column::drive_work]);
    EXPECT_GT(loop, 0.5) << scene.mesh.file;
    EXPECT_LT(loop, 3.) << scene.mesh.file;
    const double pressure =
        ratio("largest_pressure", largest(run.rows, Column::largest_pressure), largest(reference, Column::largest_pressure));
    EXPECT_GT(pressure, 0.5) << scene.mesh.file;
  }
}

/// One way both runs have the same rows.
TEST(QuasiStaticAccuracy, ToldErrorsOfTheForcesHoldAlongTheWay)
{
  Scene scene          = coarse_scene(0.5);
  scene.drive          = Drive(DriveProfile::triangle, 0., 30., 112., 0.5);
  const auto run       = estimated(scene);
  const auto reference = run_scene(with_augmented_lagrangian(with_face_size(scene, 0.125)));
  for (const auto &[quantity, column] : { std::pair<std::string, Column>{ "P", Column::P }, { "Q", Column::Q } })
  {
    double error = 0.;
    for (std::size_t i = 0; i < run.rows.size(); ++i)
    {
      ASSERT_DOUBLE_EQ(run.rows[i][Column::x], reference[i][Column::x]);
      error = std::max(error, std::abs(run.rows[i][column] - reference[i][column]) / largest(reference, column));
    }
    EXPECT_GT(total_error(run.errors.at(quantity)), 0.5 * error) << quantity;
    EXPECT_LT(total_error(run.errors.at(quantity)), 3. * error) << quantity;
  }
}

TEST(QuasiStaticAccuracy, AFinerMeshTellsLessAndTheModelKeepsItsPenalties)
{
  Scene scene = coarse_scene(0.5);
  const MadeMesh mesh(scene);
  StaticLever<2> model(mesh, scene);
  const auto penalties = model.penalties();
  const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
  std::vector<Row> rows;
  run_quasi_static(model, scene.drive, settings, [&](const State &, const Row &row, const Evaluation &) { rows.push_back(row); });
  const auto coarse = quasi_static_accuracy(scene, rows, [&] { return plane_trial_runs(scene, model, rows, settings, {}); });
  EXPECT_EQ(model.penalties().normal, penalties.normal);
  const auto fine = estimated(with_face_size(scene, 0.25));
  for (const auto &estimate : coarse)
  {
    if (estimate.quantity.find("stress") != std::string::npos)
      continue; // none was found
    ASSERT_FALSE(estimate.parts.empty()) << estimate.unknown;
    EXPECT_LT(fine.errors.at(estimate.quantity).parts.front().value, estimate.parts.front().value) << estimate.quantity;
  }
}

/// The largest stress of a run may be right by accident, which no estimate knows: it has to cover the true error.
TEST(QuasiStaticAccuracy, TheLargestStressIsWithinWhatIsTold)
{
  Scene scene     = coarse_scene(0.5);
  const auto run  = estimated(scene);
  const auto fine = estimated(with_face_size(scene, 0.125));
  for (const std::string name : { "largest_lever_stress", "largest_layer_stress" })
  {
    ASSERT_FALSE(run.errors.at(name).parts.empty()) << name;
    const double estimated_error = run.errors.at(name).parts.front().value;
    EXPECT_GT(estimated_error, 0.5 * std::abs(run.stress.at(name) / fine.stress.at(name) - 1.)) << name;
    EXPECT_LT(estimated_error, 0.1) << name;
  }
}

/// In space the reference has cells of half the length and width, and a penalty three times as stiff.
TEST(QuasiStaticAccuracy, InThreeDimensionsToldErrorsMeetTheTrueOnesSlow)
{
  const auto coarse    = estimated_in_space(solid_scene(1., 2));
  Scene fine           = solid_scene(0.5, 4);
  fine.contact.penalty = 3. * coarse.penalty;
  const auto reference = estimated_in_space(fine).rows;
  for (const auto &[quantity, column] : { std::pair<std::string, Column>{ "P", Column::P }, { "Q", Column::Q } })
  {
    double error = 0.;
    for (std::size_t i = 0; i < coarse.rows.size(); ++i)
      error = std::max(error, std::abs(coarse.rows[i][column] - reference.at(i)[column]) / largest(reference, column));
    EXPECT_GT(total_error(coarse.errors.at(quantity)), 0.5 * error) << quantity;
    EXPECT_LT(total_error(coarse.errors.at(quantity)), 3. * error) << quantity;
  }
  EXPECT_NE(coarse.errors.at("largest_pressure").unknown.find("faces wide"), std::string::npos);
}

/// J d^2(th)/dt^2 = J v^2 d^2(th)/dx^2 with dth/dx = sin th / s, whose derivative follows from the kinematics by hand:
/// ds/dx = -cos th - (R - e) dth/dx.
TEST(QuasiStaticAccuracy, TellsTheInertiaThatIsLeftOut)
{
  const Scene scene = coarse_scene(0.5);
  std::vector<Row> rows;
  double expected = 0.;
  for (const double x : { 10., 20. })
  {
    Row row;
    row[Column::time] = x / 112.;
    row[Column::x]    = x;
    row[Column::v]    = 112.;
    row[Column::P]    = 10.;
    rows.push_back(row);
    const auto [theta, s, slope] = kinematics(scene.geometry, x);
    const auto &geometry         = scene.geometry;
    const double s_change        = -std::cos(theta) - (geometry.cylinder_radius - geometry.interface_offset) * slope;
    const double curvature       = (std::cos(theta) * slope - std::sin(theta) * s_change / s) / s;
    const double moment          = scene.spring.stiffness * (theta - kinematics(geometry, 0.).theta);
    expected                     = std::max(expected, moment_of_inertia(scene) * 112. * 112. * curvature / moment);
  }
  EXPECT_NEAR(left_out_inertia(scene, rows), expected, 0.02 * expected);
  rows.front()[Column::v] = rows.back()[Column::v] = 0.;
  EXPECT_EQ(left_out_inertia(scene, rows), 0.);
}

TEST(QuasiStaticAccuracy, SaysWhereTheContactIsTooNarrow)
{
  const auto run = estimated(coarse_scene(1.));
  EXPECT_TRUE(run.errors.at("largest_pressure").parts.empty());
  EXPECT_NE(run.errors.at("largest_pressure").unknown.find("faces wide"), std::string::npos);
  EXPECT_FALSE(run.errors.at("P").parts.empty());
}

TEST(QuasiStaticAccuracy, SaysWhyThereIsNoEstimate)
{
  Scene scene              = coarse_scene(0.5);
  scene.mesh.file          = "lever.msh";
  scene.analysis.dimension = 3;
  const auto estimates     = quasi_static_accuracy(scene, {}, [] { return TrialRuns{}; });
  ASSERT_EQ(estimates.size(), 9u);
  for (const auto &estimate : estimates)
    EXPECT_NE(estimate.unknown.find("mesh from a file"), std::string::npos);
}

TEST(QuasiStaticAccuracy, ARunEndsWellWhereTheCoarserMeshCannotServe)
{
  const auto fails     = []() -> TrialRuns { throw InputError("pads do not fit"); };
  const auto estimates = quasi_static_accuracy(coarse_scene(0.5), {}, fails);
  ASSERT_EQ(estimates.size(), 7u);
  EXPECT_NE(estimates.front().unknown.find("pads do not fit"), std::string::npos);
}
