// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/statics/static_lever.h"
#include "scene/scene.h"
#include "support/compared_rows.h"
#include "support/made_mesh.h"
#include "verification/run_scene.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

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

  inline Scene in_plane(Scene scene)
  {
    scene.analysis.dimension = 2;
    return scene;
  }

  /// With a plate on two places of sensors, each with two of that width.
  inline Scene on_sensors(Scene scene, const double sensor_width)
  {
    scene.plate.type          = PlateType::on_sensors;
    scene.plate.poisson_ratio = scene.lever.poisson_ratio;
    scene.plate.sensors       = { 105., 195. };
    scene.plate.sensor_width  = sensor_width;
    return scene;
  }

  inline double sum(const std::vector<double> &values)
  {
    return std::accumulate(values.begin(), values.end(), 0.);
  }

  /// A run in three dimensions.
  struct SolidRun
  {
    explicit SolidRun(const Scene &scene)
    {
      const MadeMesh plane(scene);
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

  /// Largest difference of the forces of places of sensors over the largest of one.
  inline double sensor_difference(const std::vector<Row> &a, const std::vector<Row> &b)
  {
    double result = 0., largest = 0.;
    for (std::size_t k = 0; k < a.size(); ++k)
      for (std::size_t i = 0; i < a[k].sensor_forces.size(); ++i)
      {
        result  = std::max(result, std::abs(a[k].sensor_forces[i] - b.at(k).sensor_forces.at(i)));
        largest = std::max(largest, std::abs(a[k].sensor_forces[i]));
      }
    return result / largest;
  }
} // namespace sprag
