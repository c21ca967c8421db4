// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/slope.h"
#include "laws/friction.h"
#include "results/page_tables.h"
#include "scene/closed_form.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    Sweep over_coefficient(const Scene &scene)
    {
      Sweep sweep;
      sweep.columns  = page_columns("slope", "mu slope_forward slope_backward dimensionless_forward dimensionless_backward");
      const auto &at = scene.geometry;
      for (unsigned int i = 0; i < scene.slope.n_points; ++i)
      {
        const double mu = scene.slope.maximum_coefficient * i / (scene.slope.n_points - 1.);
        sweep.rows.push_back({ mu, representative_slope(at, scene.spring.stiffness, mu, 1),
                               representative_slope(at, scene.spring.stiffness, mu, -1), dimensionless_slope(at, mu, 1),
                               dimensionless_slope(at, mu, -1) });
      }
      return sweep;
    }

    Sweep over_inclination(const Scene &scene)
    {
      Sweep sweep;
      sweep.columns   = page_columns("slope", "theta0 offset_ratio dimensionless_forward dimensionless_backward");
      const double mu = friction_coefficient(scene.friction, scene.drive.peak_speed()).coefficient;
      for (const double ratio : scene.slope.offset_ratios)
      {
        const double end = std::min(scene.slope.maximum_inclination, std::asin(1. - ratio));
        for (unsigned int i = 1; i <= scene.slope.n_points; ++i)
        {
          const double inclination = end * i / scene.slope.n_points;
          const Geometry geometry{ 1., ratio, (1. - ratio) / std::sin(inclination), 0. };
          sweep.rows.push_back(
              { inclination, ratio, dimensionless_slope(geometry, mu, 1), dimensionless_slope(geometry, mu, -1) });
        }
      }
      return sweep;
    }
  } // namespace

  Sweep slope_sweep(const Scene &scene)
  {
    return scene.slope.sweep == SlopeSweep::coefficient ? over_coefficient(scene) : over_inclination(scene);
  }
} // namespace sprag
