// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "support/scene_parts.h"
#include "verification/run_scene.h"

#include <cstdio>
#include <functional>
#include <gtest/gtest.h>

using namespace sprag;

// Model A without inertia on an elastic cylinder.

namespace
{
  constexpr double mu = 0.73;

  using Visit = std::function<void(const Row &row, const FaceState &face)>;

  void follow(const Scene &scene, const Visit &visit)
  {
    dealii::Triangulation<2> triangulation;
    make_mesh(scene, triangulation);
    StaticLever<2> model(triangulation, lever_properties(scene));
    run_quasi_static(model, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
                     [&](const State &state, const Row &row, const Evaluation &found)
                     { visit(row, model.face_state(state, found)); });
  }

  /// P and Q at x moving forward (v > 0) or back, linear between rows.
  struct Forces
  {
    double P, Q;
  };

  Forces forces_at(const std::vector<Row> &rows, const double x, const double v)
  {
    for (std::size_t i = 1; i < rows.size(); ++i)
    {
      const double a = rows[i - 1][Column::x], b = rows[i][Column::x];
      if (rows[i][Column::v] * v > 0. && (a - x) * (b - x) <= 0. && a != b)
      {
        const double share = (x - a) / (b - a);
        const auto between = [&](const Column column) { return (1. - share) * rows[i - 1][column] + share * rows[i][column]; };
        return { between(Column::P), between(Column::Q) };
      }
    }
    ADD_FAILURE() << "no row at x " << x;
    return {};
  }

  /// Largest difference of P and Q over their largest values, at whole x 3 mm and more from the ends of the strokes.
  double difference(const std::vector<Row> &rows, const std::vector<Row> &others)
  {
    double peak_P = 0., peak_Q = 0., off_P = 0., off_Q = 0.;
    for (const double v : { 1., -1. })
      for (double x = 3.; x <= 62.; x += 1.)
      {
        const auto a = forces_at(rows, x, v);
        const auto b = forces_at(others, x, v);
        peak_P       = std::max(peak_P, b.P);
        peak_Q       = std::max(peak_Q, std::abs(b.Q));
        off_P        = std::max(off_P, std::abs(a.P - b.P));
        off_Q        = std::max(off_Q, std::abs(a.Q - b.Q));
      }
    std::printf("P off by %.1e, Q by %.1e of their peaks\n", off_P / peak_P, off_Q / peak_Q);
    return std::max(off_P / peak_P, off_Q / peak_Q);
  }

  Scene coarse()
  {
    return with_face_size(with_coulomb(model_a(), mu), 1.);
  }
} // namespace

// A million times as stiff as aluminium it yields by 1e-12 mm; what is left is how the pressure is integrated, over facets or at
// points 0.02 mm apart, and the lines between rows, (1 mm)^2 / 8 times a curvature of P of some 5e-3 N/mm^2 over 25 N.
TEST(ElasticCylinder, StiffIsTheRigidCircle)
{
  EXPECT_LT(difference(run_scene(on_solid_cylinder(coarse(), 7e10)), run_scene(coarse())), 1e-4);
}

// Coulomb's law holds at each point, on every row and in full sliding with equality.
TEST(ElasticCylinder, FrictionIsMuTimesPressureThroughBothStrokesAndTheReversal)
{
  const Scene short_way = with_drive(coarse(), Drive(DriveProfile::triangle, 40., 65., 112., 1.));
  for (const Scene &scene : { short_way, with_augmented_lagrangian(short_way) })
  {
    unsigned int sliding_rows = 0, partial_rows = 0;
    double worst = 0.;
    follow(on_solid_cylinder(scene, 7e4),
           [&](const Row &row, const FaceState &face)
           {
             double peak = 0., largest = 0., smallest = 1.;
             for (const double p : face.pressure)
               peak = std::max(peak, p);
             for (std::size_t q = 0; q < face.pressure.size(); ++q)
               if (face.pressure[q] > 1e-6 * peak)
               {
                 const double ratio = std::abs(face.traction[q]) / (mu * face.pressure[q]);
                 largest            = std::max(largest, ratio);
                 smallest           = std::min(smallest, ratio);
               }
             EXPECT_LE(largest, 1. + 1e-4) << "x " << row[Column::x];
             const bool slides = row[Column::x] > 40. && (row[Column::v] > 0. || row[Column::x] < 63.);
             if (slides && peak > 0.)
             {
               ++sliding_rows;
               worst = std::max({ worst, 1. - smallest, largest - 1. });
             }
             else if (row[Column::v] < 0. && smallest < 0.9)
               ++partial_rows;
           });
    std::printf("friction over mu p in sliding off by %.1e\n", worst);
    EXPECT_LT(worst, 1e-4);
    EXPECT_GT(sliding_rows, 40u);
    EXPECT_GT(partial_rows, 3u);
  }
}

TEST(ElasticCylinder, MeetsTheGeneralPath)
{
  Scene scene             = on_solid_cylinder(with_face_size(coarse(), 2.), 7e4);
  scene.drive             = Drive(DriveProfile::triangle, 0., 65., 112., 0.5);
  scene.analysis.step     = 13.;
  const auto once         = run_scene(scene);
  scene.analysis.solution = Solution::general;
  const auto general      = run_scene(scene);
  ASSERT_EQ(once.size(), general.size());
  for (std::size_t i = 0; i < once.size(); ++i)
    for (const auto column : { Column::P, Column::Q, Column::elastic_energy })
      EXPECT_NEAR(once[i][column], general[i][column], 1e-8 * once.back()[Column::P]);
}
