// SPDX-License-Identifier: GPL-3.0-only
#include "mpi_environment.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "scenes.h"
#include "verification/run_scene.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  // The formula of tests/deviation.md: closed form of a lever that bends, faced with a layer that yields, nu = 0.

  struct Layer
  {
    double indentation;   ///< delta [mm]
    double offset;        ///< of the centre of pressure towards +xi for F > 0 [mm]
    double peak_pressure; ///< [MPa]
  };

  /// Fits to the exact bonded layer, bonded_layer.py, for 0.1 <= P R/(E t^2) <= 4 within 3 %; `force` per width [N/mm].
  Layer layer_contact(const Scene &scene, const double force, const double signed_mu, const double penalty)
  {
    const double R    = scene.geometry.cylinder_radius;
    const double t    = scene.layer.thickness;
    const double E    = scene.layer.young_modulus;
    const double load = force * R / (E * t * t);
    double lower = 0., upper = 20.;
    for (unsigned int i = 0; i < 80; ++i)
    {
      const double z                                                         = 0.5 * (lower + upper);
      (2. * z * z * z / 3. + 0.36 * z * z + 0.05 * z < load ? lower : upper) = z;
    }
    const double z = lower;
    // The penalty is a second layer, which does not shear: its share of the tilting compliance takes from the offset.
    const double softened = 1. - 2. * E / (t * penalty);
    return { (0.5 * z * z + 0.18 * z) * t * t / R, signed_mu * 0.5 * t * z / (z + 1.3) * softened, 0.75 * force / (z * t) };
  }

  struct Bending
  {
    double deflection;
    double slope;
  };

  /// Cantilever with shear: P across at s, and F along the face, which lies c off the neutral axis.
  Bending bending(const Scene &scene, const double s, const double P, const double F)
  {
    const auto &lever = scene.lever;
    const double EI   = lever.young_modulus * lever.width * std::pow(lever.depth, 3) / 12.;
    const double nu   = lever.poisson_ratio;
    const double section =
        10. * (1. + nu) / (12. + 11. * nu) * lever.young_modulus / (2. * (1. + nu)) * lever.width * lever.depth;
    const double c = scene.layer.thickness + 0.5 * lever.depth;
    return { P * s * s * s / (3. * EI) - F * c * s * s / (2. * EI) + P * s / section,
             P * s * s / (2. * EI) - F * c * s / EI + P / section };
  }

  struct Prediction
  {
    double P;
    double Q;
  };

  /// Fixed point of: inclination of a cylinder sunk by delta and deflection, its normal tilted by slope and offset.
  Prediction predict(const Scene &scene, const double x, const double signed_mu, const double penalty)
  {
    const double theta_0 = kinematics(scene.geometry, 0.).theta;
    const double R       = scene.geometry.cylinder_radius;
    Geometry sunk        = scene.geometry;
    double beta = 0., theta = 0., P = 0., F = 0.;
    for (unsigned int i = 0; i < 100; ++i)
    {
      theta             = kinematics(sunk, x).theta;
      const auto centre = cylinder_centre(scene.geometry, x, theta);
      const double sine = std::sin(beta), cosine = std::cos(beta);
      const double arm    = centre.xi * cosine - centre.eta * sine + signed_mu * (centre.xi * sine + centre.eta * cosine + R);
      const double normal = scene.spring.stiffness * (theta - theta_0) / arm;
      P                   = normal * (cosine + signed_mu * sine);
      F                   = normal * (signed_mu * cosine - sine);
      const auto bent     = bending(scene, centre.xi + R * sine, P, F);
      const auto layer    = layer_contact(scene, std::max(P, 1e-9) / scene.lever.width, signed_mu, penalty);
      sunk.interface_offset =
          scene.geometry.interface_offset + bent.deflection + layer.indentation + layer.peak_pressure / penalty;
      beta = layer.offset / R - bent.slope;
    }
    return { P, P * std::sin(theta) + F * std::cos(theta) };
  }

  struct Misses
  {
    double deviation   = 0.;
    double unexplained = 0.;
    void add(const double value, const double closed_form, const double predicted)
    {
      deviation   = std::max(deviation, std::abs(value - closed_form));
      unexplained = std::max(unexplained, std::abs(value - predicted));
    }
  };

  /// Largest deviations over one stroke, 10 mm < x, 2 mm clear of the reversal; mu is the run's own.
  void expect_predicted(const Scene &scene, const int direction)
  {
    const double penalty = 12. * scene.layer.young_modulus / scene.layer.thickness;
    Misses P, Q;
    for (const Row &row : run_scene(scene))
      if (row[Column::v] * direction > 0. && row[Column::x] > 10. && (direction > 0 || row[Column::x] < 63.))
      {
        const auto predicted = predict(scene, row[Column::x], direction * row[Column::mu], penalty);
        P.add(row[Column::P], row[Column::P_closed_form], predicted.P);
        Q.add(row[Column::Q], row[Column::Q_closed_form], predicted.Q);
      }
    std::printf("direction %+d: deviation of P %.4f N, unexplained %.1f %%; of Q %.4f N, unexplained %.1f %%\n", direction,
                P.deviation, 100. * P.unexplained / P.deviation, Q.deviation, 100. * Q.unexplained / Q.deviation);
    EXPECT_LT(P.unexplained, 0.1 * P.deviation);
    EXPECT_LT(Q.unexplained, 0.1 * Q.deviation);
  }
} // namespace

// The remaining difference of finite elements and closed form is mechanics that the closed form leaves out. Tolerance: fits 3
// %, fixed point exact, elements of half a millimetre in a contact of two.
TEST(Deviation, IsExplainedByBendingLayerAndCentreOfPressureOnModelA)
{
  expect_predicted(model_a(), 1);
  expect_predicted(model_a(), -1);
}

TEST(Deviation, IsExplainedByBendingLayerAndCentreOfPressureOnModelB)
{
  expect_predicted(model_b(), 1);
  expect_predicted(model_b(), -1);
}

TEST(Deviation, IsExplainedForAThinnerLever)
{
  Scene scene       = model_a();
  scene.lever.depth = 8.;
  expect_predicted(scene, 1);
  expect_predicted(scene, -1);
}
