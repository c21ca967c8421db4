#include "run_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace sprag;

// Largest pressure and contact width of model A with mu 0.73 against hard contact on a fine mesh: penalties of 2400 and 7200
// N/mm^3 on faces of 0.0625 mm, extrapolated to none, to 0.3 % (0.5 % of the width). `tests/benchmarks/pressure.py` prints how
// they converge. Tolerance 2 % of the largest pressure, which the mesh of 0.25 mm was chosen for, and 1 % for what the penalty
// itself yields; 4 % of the width: the penalty adds E_layer/penalty = 0.02 mm to both sides of a contact that is 0.71 mm wide at
// x = 13 mm.

namespace
{
  struct Reference
  {
    double x;                ///< [mm]
    double largest_pressure; ///< [MPa]
    double width;            ///< [mm]
  };

  const std::vector<Reference> forward = {
    { 13., 0.0671, 0.712 }, { 26., 0.1058, 1.059 }, { 39., 0.1455, 1.345 }, { 52., 0.1906, 1.636 }, { 65., 0.2446, 1.926 }
  };

  /// A model and its states without recovery between.
  struct Stroke
  {
    std::vector<Row> rows;
    std::vector<FaceState> faces;
    std::vector<double> weights;
  };

  Stroke stroke(const Scene &scene)
  {
    Stroke result;
    dealii::Triangulation<2> triangulation;
    make_mesh(scene, triangulation);
    LeverModel model(triangulation, lever_properties(scene));
    result.weights = model.face_points().weight;
    run_quasi_static(model, Drive(DriveProfile::triangle, 0., 65., 112., 0.5),
                     { 6.5, scene.analysis.minimum_step, scene.contact },
                     [&](const State &state, const Row &row)
                     {
                       result.rows.push_back(row);
                       result.faces.push_back(model.face_state(state));
                     });
    return result;
  }

  const Row &at(const std::vector<Row> &rows, const double x)
  {
    return *std::min_element(rows.begin(), rows.end(),
                             [x](const Row &a, const Row &b) { return std::abs(a[Column::x] - x) < std::abs(b[Column::x] - x); });
  }

  void expect_reference(const Stroke &found, const double tolerance)
  {
    for (const auto &[x, largest_pressure, width] : forward)
    {
      const Row &row = at(found.rows, x);
      ASSERT_NEAR(row[Column::x], x, 1e-9);
      EXPECT_NEAR(row[Column::largest_pressure] / largest_pressure, 1., tolerance) << "x " << x;
      EXPECT_NEAR(row[Column::contact_width] / width, 1., 0.04) << "x " << x;
    }
  }

  /// From x = 13 mm on, where it is three cells wide, it rises to one peak and falls from it; its resultant is that of the
  /// points.
  void expect_smooth(const Stroke &found)
  {
    for (std::size_t i = 1; i < found.rows.size(); ++i)
    {
      if (found.rows[i][Column::x] < 12.9)
        continue;
      const auto &p   = found.faces[i].pressure;
      const auto peak = std::max_element(p.begin(), p.end());
      EXPECT_TRUE(std::is_sorted(p.begin(), peak)) << "x " << found.rows[i][Column::x];
      EXPECT_TRUE(std::is_sorted(peak, p.end(), std::greater<>())) << "x " << found.rows[i][Column::x];
      double sum = 0.;
      for (std::size_t q = 0; q < p.size(); ++q)
        sum += found.weights[q] * p[q];
      EXPECT_NEAR(sum / found.rows[i][Column::normal_resultant], 1., 1e-9);
    }
  }

  void expect_the_contact_of(const Scene &scene, const double tolerance)
  {
    const auto found = stroke(scene);
    expect_reference(found, tolerance);
    expect_smooth(found);
  }
} // namespace

TEST(ContactPressure, OfThePenaltyMeetsHardContact)
{
  expect_the_contact_of(with_face_size(with_coulomb(model_a(), 0.73), 0.25), 0.03);
}

TEST(ContactPressure, OfTheAugmentedLagrangianMeetsHardContact)
{
  expect_the_contact_of(with_augmented_lagrangian(with_face_size(with_coulomb(model_a(), 0.73), 0.25)), 0.02);
}
