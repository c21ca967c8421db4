// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "support/compared_rows.h"
#include "support/made_mesh.h"
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
    const MadeMesh triangulation(scene);
    StaticLever<2> model(triangulation, lever_properties(scene));
    run_quasi_static(model, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
                     [&](const State &state, const Row &row, const Evaluation &found)
                     { visit(row, model.face_state(state, found)); });
  }

  Scene coarse()
  {
    return with_face_size(with_coulomb(model_a(), mu), 1.);
  }
} // namespace

// A million times as stiff as aluminium it yields by 1e-12 mm; what is left is how the pressure is integrated, over facets or at
// points 0.02 mm apart.
TEST(ElasticCylinder, StiffIsTheRigidCircle)
{
  const auto rows = run_scene(on_solid_cylinder(coarse(), 7e10)), rigid = run_scene(coarse());
  for (const Column column : { Column::P, Column::Q })
    EXPECT_LT(difference(rigid, rows, column), 1e-4) << column_info(column).name;
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
