#include "run/quasi_static_accuracy.h"

#include "results/row_statistics.h"
#include "verification/run_scene.h"

#include <gtest/gtest.h>
#include <map>

using namespace sprag;

namespace
{
  /// A run and what it tells of its errors.
  struct Told
  {
    std::vector<Row> rows;
    std::map<std::string, ErrorEstimate> errors;
  };

  Told told(const Scene &scene)
  {
    Told result;
    Mesh mesh;
    make_mesh(scene, mesh);
    LeverModel model(mesh, scene);
    const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
    run_quasi_static(model, scene.drive, settings, [&](const State &, const Row &row) { result.rows.push_back(row); });
    for (auto &estimate : quasi_static_accuracy(scene, model, result.rows, settings))
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
} // namespace

/// The bounds are those that the program promises, 0.5 ... 3; the reference is about ten times as exact. The largest pressure of
/// a single place may be right by accident.
TEST(QuasiStaticAccuracy, ToldErrorsMeetTheTrueOnes)
{
  const auto run       = told(coarse_scene(0.5));
  const auto reference = run_scene(with_augmented_lagrangian(with_face_size(coarse_scene(0.5), 0.125)));
  const auto ratio     = [&](const std::string &quantity, const double value, const double exact)
  { return total_error(run.errors.at(quantity)) / std::abs(value / exact - 1.); };
  const double loop = ratio("loop_area", run.rows.back()[Column::drive_work], reference.back()[Column::drive_work]);
  EXPECT_GT(loop, 0.5);
  EXPECT_LT(loop, 3.);
  const double pressure =
      ratio("largest_pressure", largest(run.rows, Column::largest_pressure), largest(reference, Column::largest_pressure));
  EXPECT_GT(pressure, 0.5);
}

/// One way both runs have the same rows.
TEST(QuasiStaticAccuracy, ToldErrorsOfTheForcesHoldAlongTheWay)
{
  Scene scene          = coarse_scene(0.5);
  scene.drive          = Drive(DriveProfile::triangle, 0., 30., 112., 0.5);
  const auto run       = told(scene);
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
  Mesh mesh;
  make_mesh(scene, mesh);
  LeverModel model(mesh, scene);
  const auto penalties = model.penalties();
  const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
  std::vector<Row> rows;
  run_quasi_static(model, scene.drive, settings, [&](const State &, const Row &row) { rows.push_back(row); });
  const auto coarse = quasi_static_accuracy(scene, model, rows, settings);
  EXPECT_EQ(model.penalties().normal, penalties.normal);
  const auto fine = told(with_face_size(scene, 0.25));
  for (const auto &estimate : coarse)
  {
    ASSERT_FALSE(estimate.parts.empty()) << estimate.unknown;
    EXPECT_LT(fine.errors.at(estimate.quantity).parts.front().value, estimate.parts.front().value) << estimate.quantity;
  }
}

TEST(QuasiStaticAccuracy, SaysWhereTheContactIsTooNarrow)
{
  const auto run = told(coarse_scene(1.));
  EXPECT_TRUE(run.errors.at("largest_pressure").parts.empty());
  EXPECT_NE(run.errors.at("largest_pressure").unknown.find("faces wide"), std::string::npos);
  EXPECT_FALSE(run.errors.at("P").parts.empty());
}

TEST(QuasiStaticAccuracy, SaysWhyThereIsNoEstimate)
{
  Scene scene = coarse_scene(0.5);
  Mesh mesh;
  make_mesh(scene, mesh);
  LeverModel model(mesh, scene);
  scene.mesh.file      = "lever.msh";
  const auto estimates = quasi_static_accuracy(scene, model, {}, {});
  ASSERT_EQ(estimates.size(), 5u);
  for (const auto &estimate : estimates)
    EXPECT_NE(estimate.unknown.find("mesh from a file"), std::string::npos);
}
