// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "verification/run_transient.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr unsigned int finest = 32768; ///< steps of the reference

  /// From rest at x = 0 almost to the turn at 25 mm, in contact throughout. What the start excites is damped away soon.
  Scene smooth_scene(const Scene &paper, const ModelType model)
  {
    Scene scene               = in_time(paper, model);
    scene.drive               = Drive(DriveProfile::harmonic, 0., 25., 150., 0.45);
    scene.contact.damping     = 0.5;
    scene.lever.modal_damping = 0.5;
    return scene;
  }

  std::vector<Row> compute_rows(const Scene &scene, const unsigned int steps, const double spectral_radius)
  {
    const double step = scene.drive.duration() / steps;
    return run_in_time(with_spectral_radius(with_fixed_step(scene, step), spectral_radius)).rows;
  }

  /// Largest difference to the finest steps in the last six tenths of the time.
  double error(const std::vector<Row> &rows, const std::vector<Row> &reference, const Column column)
  {
    const std::size_t stride = (reference.size() - 1) / (rows.size() - 1);
    double largest           = 0.;
    for (std::size_t i = 4 * rows.size() / 10; i < rows.size(); ++i)
      largest = std::max(largest, std::abs(rows[i][column] - reference[i * stride][column]));
    return largest;
  }

  struct Orders
  {
    double P, theta;
  };

  /// From halving steps of that number.
  Orders orders(const Scene &scene, const std::vector<Row> &reference, const unsigned int steps, const double spectral_radius)
  {
    const auto coarse = compute_rows(scene, steps, spectral_radius);
    const auto fine   = compute_rows(scene, 2 * steps, spectral_radius);
    const auto order  = [&](const Column column)
    { return std::log2(error(coarse, reference, column) / error(fine, reference, column)); };
    return { order(Column::P), order(Column::theta) };
  }
} // namespace

// Problem 13. The reference errs by (1024/32768)^2 of the finer run's error, 0.1 %; terms of fourth order by (omega dt)^2 of the
// contact, 290 Hz, in steps of 0.2 ms: a tenth, the more so as the contact is damped heavily. Without algorithmic dissipation
// long steps keep the shortest bending waves of a beam ringing in P: there steps of 0.1 ms are needed, in which what is left of
// that ringing still falls faster than the error, of 1e-8.
TEST(TimeOrder, IsTwoWhateverTheSpectralRadius)
{
  for (const auto model : { ModelType::rigid, ModelType::beam })
    for (const auto &paper : { with_coulomb(model_a(), 0.73), model_a() })
    {
      const bool rings     = model == ModelType::beam;
      const Scene scene    = smooth_scene(paper, model);
      const auto reference = compute_rows(scene, finest, 1.);
      for (const double radius : { 1., 0.8, 0. })
      {
        const auto found = orders(scene, reference, 512, radius);
        EXPECT_NEAR(found.theta, 2., 0.1) << radius << rings;
        if (radius < 1. || !rings)
        {
          EXPECT_NEAR(found.P, 2., 0.1) << radius << rings;
        }
        RecordProperty((rings ? "beam_P_" : "rigid_P_") + std::to_string(radius), std::to_string(found.P));
      }
      if (rings)
      {
        EXPECT_GT(orders(scene, reference, 2048, 1.).P, 1.8);
      }
    }
}
