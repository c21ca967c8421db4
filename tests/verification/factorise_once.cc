#include "analysis/newton.h"
#include "analysis/quasi_static.h"
#include "fe/lever_model.h"
#include "mpi_environment.h"
#include "scenes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>

using namespace sprag;

namespace
{
  /// A coarse model A.
  class Meshed
  {
  public:
    Meshed(const Solution solution, const Enforcement enforcement, const double face_size)
    {
      scene.mesh.face_size      = face_size;
      scene.analysis.solution   = solution;
      scene.contact.enforcement = enforcement;
      make_mesh(scene, triangulation);
      model.emplace(triangulation, lever_properties(scene));
    }

    Scene scene = model_a();
    dealii::Triangulation<2> triangulation;
    std::optional<LeverModel> model;
  };

  /// Where the accepted steps of a whole run end.
  std::vector<DrivePoint> run(Meshed &meshed)
  {
    std::vector<DrivePoint> drive;
    const QuasiStaticSettings settings{ 5., 1e-6, meshed.scene.contact };
    run_quasi_static(*meshed.model, meshed.scene.drive, settings,
                     [&](const State &state, const Row &) { drive.push_back(state.drive); });
    return drive;
  }

  /// Through the very positions of `drive`, with augmentations down to 1e-6 mm where the model has multipliers.
  std::vector<Row> follow(Meshed &meshed, const std::vector<DrivePoint> &drive)
  {
    auto &model       = *meshed.model;
    const bool augmented = meshed.scene.contact.enforcement == Enforcement::augmented_lagrangian;
    std::vector<Row> rows;
    State accepted = model.initial_state(drive.front());
    for (const auto &point : drive)
    {
      State trial = accepted;
      trial.drive = point;
      model.predict(trial, accepted);
      const State guess = trial;
      if (!solve_equilibrium(model, trial, accepted, false).converged)
      {
        trial = guess;
        EXPECT_TRUE(solve_equilibrium(model, trial, accepted, true).converged) << "x " << point.x;
      }
      for (unsigned int i = 0; augmented && model.penetration() > meshed.scene.contact.penetration_tolerance && i < 20; ++i)
      {
        model.augment(trial);
        EXPECT_TRUE(solve_equilibrium(model, trial, accepted, false).converged) << "x " << point.x;
      }
      Row row;
      model.observe(trial, row);
      rows.push_back(row);
      trial.contact = model.memory();
      accepted      = trial;
    }
    return rows;
  }

  // Both solve the same equations to corrections below 1e-7 of the overlap where convergence is quadratic: what is left is
  // round-off. The steps are the same; those that run_quasi_static() chooses after a reversal depend on round-off.
  void expect_same_answers(const Enforcement enforcement, const double face_size)
  {
    Meshed once(Solution::automatic, enforcement, face_size);
    Meshed general(Solution::general, enforcement, face_size);
    const auto drive = run(once);
    const auto fast  = follow(once, drive);
    const auto slow  = follow(general, drive);
    ASSERT_GT(fast.size(), 26u);
    for (const auto column : { Column::P, Column::Q, Column::theta, Column::elastic_energy })
    {
      double peak    = 0.;
      double largest = 0.;
      for (const auto &row : fast)
        peak = std::max(peak, std::abs(row[column]));
      for (std::size_t i = 0; i < fast.size(); ++i)
        largest = std::max(largest, std::abs(fast[i][column] - slow[i][column]));
      EXPECT_GT(peak, 0.);
      EXPECT_LE(largest, 1e-8 * peak) << column_info(column).name;
    }
  }
} // namespace

TEST(FactoriseOnce, MeetsTheGeneralPathThroughTheReversal)
{
  expect_same_answers(Enforcement::penalty, 2.);
}

TEST(FactoriseOnce, MeetsTheGeneralPathWithMultipliersSlow)
{
  expect_same_answers(Enforcement::augmented_lagrangian, 1.);
}
