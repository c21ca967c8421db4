// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/statics/static_lever.h"
#include "scene/scene.h"
#include "verification/run_scene.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace sprag
{
  /// Model A on a coarse mesh without contraction, so that the plane is exact, in three dimensions.
  inline Scene solid_model_a(const double poisson_ratio)
  {
    Scene scene               = with_face_size(model_a(), 4.);
    scene.analysis.dimension  = 3;
    scene.lever.poisson_ratio = scene.layer.poisson_ratio = poisson_ratio;
    scene.mesh.elements_across                            = 4;
    scene.drive                                           = Drive(DriveProfile::triangle, 0., 20., 112., 1.);
    return scene;
  }

  inline Scene tilted(Scene scene, const double tilt, const double skew = 0.)
  {
    scene.cylinder.tilt = tilt;
    scene.cylinder.skew = skew;
    return scene;
  }

  /// A run in three dimensions.
  struct SolidRun
  {
    explicit SolidRun(const Scene &scene)
    {
      Mesh plane;
      make_mesh(scene, plane);
      const SolidBody body(scene, plane);
      StaticLever<3> lever(body, scene);
      run_quasi_static(
          lever, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
          [&](const State &state, const Row &row, const Evaluation &)
          {
            rows.push_back(row);
            if (rows.size() == 10)
              exactness = std::get<SolidStructure>(lever.structure())
                              .exactness(std::get<SolidStructure>(lever.structure()).samples(state.coordinates, state.forces));
          });
    }

    std::vector<Row> rows;
    SolidStructure::Exactness exactness{};
  };

  inline double largest(const std::vector<Row> &rows, const Column column)
  {
    double result = 0.;
    for (const auto &row : rows)
      result = std::max(result, std::abs(row[column]));
    return result;
  }

  /// Returns the largest difference of a column over its largest value.
  inline double difference(const std::vector<Row> &a, const std::vector<Row> &b, const Column column)
  {
    EXPECT_EQ(a.size(), b.size());
    double result = 0.;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      result = std::max(result, std::abs(a[i][column] - b[i][column]));
    return result / largest(a, column);
  }
} // namespace sprag
