#include "analysis/quasi_static.h"
#include "fe/lever_model.h"
#include "mpi_environment.h"
#include "scenes.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  std::vector<Row> run(const Solution solution, const Enforcement enforcement)
  {
    Scene scene               = model_a();
    scene.mesh.face_size      = 2.;
    scene.analysis.step       = 5.;
    scene.analysis.solution   = solution;
    scene.contact.enforcement = enforcement;
    dealii::Triangulation<2> triangulation;
    make_mesh(scene, triangulation);
    LeverModel model(triangulation, lever_properties(scene));
    std::vector<Row> rows;
    const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
    run_quasi_static(model, scene.drive, settings, [&](const State &, const Row &row) { rows.push_back(row); });
    return rows;
  }

  // Both iterate the same equations to corrections below 1e-7 of the overlap, with quadratic convergence: 1e-8 of the peak is
  // asked for.
  void expect_same_answers(const Enforcement enforcement)
  {
    const auto once    = run(Solution::automatic, enforcement);
    const auto general = run(Solution::general, enforcement);
    ASSERT_EQ(once.size(), general.size());
    ASSERT_GT(once.size(), 26u);
    for (const auto column : { Column::P, Column::Q, Column::theta, Column::elastic_energy })
    {
      double peak = 0.;
      for (const auto &row : once)
        peak = std::max(peak, std::abs(row[column]));
      double largest = 0.;
      for (std::size_t i = 0; i < once.size(); ++i)
        largest = std::max(largest, std::abs(once[i][column] - general[i][column]) / peak);
      EXPECT_LE(largest, 1e-8) << column_info(column).name;
    }
    EXPECT_LT(once.back()[Column::Q], 0.);
  }
} // namespace

TEST(FactoriseOnce, MeetsTheGeneralPathThroughTheReversal)
{
  expect_same_answers(Enforcement::penalty);
}

TEST(FactoriseOnce, MeetsTheGeneralPathWithMultipliersSlow)
{
  expect_same_answers(Enforcement::augmented_lagrangian);
}
