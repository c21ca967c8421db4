// SPDX-License-Identifier: GPL-3.0-only
#include "input/read.h"
#include "scene/scene.h"
#include "support/params_folder.h"
#include "verification/held_slides.h"
#include "verification/run_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

using namespace sprag;

// Model A on a soft frame, mu falling with speed. The frame vibrates so slowly that the lever follows without inertia: a mass on
// a spring and a dashpot that the paper's Q, by mu at the speed of slip, drags along.

namespace
{
  constexpr double place     = 50.;  ///< x of the cylinder [mm]
  constexpr double stiffness = 100.; ///< of the frame's sensor [N/mm]

  double mu(const double slip)
  {
    return 0.6 + 0.3 * std::exp(-slip / 30.);
  }

  double mu_rate(const double slip)
  {
    return -0.01 * std::exp(-slip / 30.);
  }

  /// Eqs. 8 to 12 with e = 45.6, R - e = 10.4, l = 185.5 mm and k = 7.40e4 N mm; `sign` that of the motion.
  struct Paper
  {
    double theta       = std::asin(10.4 / (185.5 - place));
    double s           = (185.5 - place) * std::cos(theta);
    double moment      = 7.40e4 * (theta - std::asin(10.4 / 185.5));
    double speed_ratio = std::cos(theta) - 45.6 * std::sin(theta) / s; ///< slip over the drive's speed

    double Q(const double coefficient, const double sign) const
    {
      return moment / (s + sign * coefficient * 45.6) * (std::sin(theta) + sign * coefficient * std::cos(theta));
    }

    /// Returns the decrease of the drag of falling friction with the frame's speed [N s/mm].
    double negative_damping(const double speed, const double sign) const
    {
      constexpr double h = 1e-5;
      const double at    = mu(speed_ratio * speed);
      return sign * (Q(at + h, sign) - Q(at - h, sign)) / (2. * h) * mu_rate(speed_ratio * speed) * speed_ratio;
    }
  };

  Scene scene_with(const std::vector<std::string> &changes)
  {
    return read_scene((params_folder() / "stribeck-a.prm").string(), changes);
  }

  /// c = -2 Re(lambda) K/|lambda|^2 of the frame [N s/mm], on a contact so stiff that the lever has nothing to follow with.
  double damping(const double speed, const double sign, const std::vector<std::string> &friction)
  {
    std::vector<std::string> changes = { "Analysis/Type=stability",
                                         "Stability/Position=50",
                                         "Contact/Stiffness=1e7",
                                         "Contact/Exponent=1",
                                         "Friction/Memory length=1e-4", // a lag of 4e-3 of a period at most
                                         "Drive/Speed=" + std::to_string(speed),
                                         std::string("Stability/Direction=") + (sign > 0. ? "forward" : "backward") };
    changes.insert(changes.end(), friction.begin(), friction.end());
    const auto frame = JudgedSlide(scene_with(changes)).stability.modes.front().mode.eigenvalue;
    return -2. * frame.real() * stiffness / std::norm(frame);
  }

  double damping(const double speed, const double sign)
  {
    return damping(speed, sign, {});
  }

  /// With mu frozen at its value: the dashpot's.
  double frozen_damping(const double speed, const double sign)
  {
    return damping(speed, sign,
                   { "Friction/Law=Coulomb", "Friction/Coefficient=" + std::to_string(mu(Paper().speed_ratio * speed)) });
  }
} // namespace

// The position changes Q, too: that is half a per cent of the sensor's stiffness.
TEST(Stribeck, FrameVibratesWhereFallingFrictionOutweighsItsDamping)
{
  const Paper paper;
  for (const double sign : { 1., -1. })
    for (const double speed : { 5., 20., 50., 100. })
    {
      const double expected = paper.negative_damping(speed, sign);
      EXPECT_NEAR(damping(speed, sign) - frozen_damping(speed, sign), expected, 1e-2 * std::abs(expected)) << sign * speed;
    }
  // Both are as large as 2 zeta sqrt(K m) = 0.0196, m = 2.4e-3 t of frame and lever, at 67.3 mm/s back and 39.7 forward.
  EXPECT_LT(damping(66., -1.), 0.);
  EXPECT_GT(damping(69., -1.), 0.);
  EXPECT_LT(damping(38.5, 1.), 0.);
  EXPECT_GT(damping(41., 1.), 0.);
}

// A mesh has the shear of its layer, a beam a spring in its place. With a rigid stick the beam grows by 193 1/s.
TEST(Stribeck, ShearOfTheLayerFeedsABeamAsItFeedsAMesh)
{
  double growth[2], frequency[2];
  for (const unsigned int i : { 0, 1 })
  {
    const auto scene =
        read_scene((params_folder() / "stability-a.prm").string(),
                   { i == 0 ? "Analysis/Model=beam" : "Analysis/Model=condensed", "Friction/Law=Stribeck",
                     "Friction/Stribeck speed=10", "Drive/Speed=10", "Stability/Position=65", "Stability/Direction=backward" });
    const auto eigenvalue = JudgedSlide(scene).stability.modes.front().mode.eigenvalue;
    growth[i]             = eigenvalue.real();
    frequency[i]          = eigenvalue.imag();
  }
  EXPECT_NEAR(growth[0], growth[1], 0.04 * growth[1]); // the mesh's own error is 2.3 %
  EXPECT_NEAR(frequency[0], frequency[1], 0.01 * frequency[1]);
  EXPECT_GT(growth[0], 230.);
}

// Once it sticks the frame has the drive's speed v and lags by what static friction holds more than kinetic: the circle on which
// it then slips back, in displacement times omega over velocity, has a radius between v and the hypotenuse of both.
TEST(Stribeck, FrameSticksToTheCylinderAndSlipsBackAsFastAsItWasCarried)
{
  const Paper paper;
  constexpr double v     = 10.;
  constexpr double omega = 198.; // 31.5 Hz
  for (const std::string regularisation : { "0.2", "0" })
  {
    const auto run = run_in_time(scene_with({ "Friction/Regularisation speed=" + regularisation }));
    double slowest = 1e9, fastest = 0., stuck = 0., all = 0., pulled = 0.;
    for (const auto &row : run.rows)
      if (row[Column::time] > 1.4 && row[Column::time] < 1.6)
      {
        const double slip = -row[Column::v_rel];
        slowest           = std::min(slowest, slip);
        fastest           = std::max(fastest, slip);
        stuck += std::abs(slip) < 0.1 * v ? row[Column::time_step] : 0.;
        all += row[Column::time_step];
        pulled = std::max(pulled, std::abs(row[Column::friction_resultant]) / row[Column::normal_resultant]);
      }
    const double held = paper.Q(0.6, -1.) - paper.Q(0.9, -1.);
    // Without regularisation the layer's shear vibrates while it sticks, and static friction breaks it off.
    const bool sticks = regularisation == "0";
    EXPECT_GT(slowest, sticks ? -0.5 * v : -0.2) << regularisation;
    EXPECT_GT(fastest, 2. * paper.speed_ratio * v) << regularisation;
    EXPECT_LT(fastest, 1.05 * paper.speed_ratio * (v + std::hypot(v, held * omega / stiffness))) << regularisation;
    EXPECT_GT(stuck, (sticks ? 0.05 : 0.1) * all) << regularisation;
    EXPECT_LT(stuck, 0.5 * all) << regularisation;
    EXPECT_NEAR(pulled, 0.9, sticks ? 0.015 : 0.05) << regularisation;
  }
}

// Behind a reversal friction over pressure is mu at the speed of the faces, for a contact at a point and one on a mesh.
TEST(Stribeck, FrictionBehindAReversalIsThatOfTheSpeed)
{
  for (const std::string model : { "beam", "condensed" })
  {
    const auto scene =
        read_scene((params_folder() / "reversal-a.prm").string(),
                   { "Analysis/Model=" + model, "Friction/Law=Stribeck", "Friction/Static coefficient=0.9",
                     "Friction/Kinetic coefficient=0.5", "Friction/Stribeck speed=60", "Drive/Start=55", "Drive/Stroke=60" });
    double mean = 0., expected = 0., time = 0.;
    for (const auto &row : run_in_time(scene).rows)
      if (row[Column::v] < -100. && row[Column::x] < 58.)
      {
        const double share = std::abs(row[Column::friction_resultant]) / row[Column::normal_resultant];
        const double at    = 0.5 + 0.4 * std::exp(-std::abs(row[Column::v_rel]) / 60.);
        EXPECT_NEAR(share, at, 0.03) << model << " at " << row[Column::x];
        mean += share * row[Column::time_step];
        expected += at * row[Column::time_step];
        time += row[Column::time_step];
      }
    EXPECT_GT(time, 0.02);
    EXPECT_NEAR(mean / time, expected / time, 3e-3) << model;
  }
}
