// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/transient/transient.h"

#include "model/lever/reduced_lever.h"
#include "scene/scene.h"
#include "scenes.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Returns the decay of the log amplitude per radian of q'' = -q in time, from the energy over many steps.
  double damping_in_time(const double spectral_radius, const double angle)
  {
    const auto w = generalised_alpha(spectral_radius, angle);
    double q = 1., v = 0., a = -1.;
    const auto steps = static_cast<unsigned int>(200. / angle);
    for (unsigned int i = 0; i < steps; ++i)
    {
      // (1 - alpha_m) a_1 + alpha_m a + (1 - alpha_f) q_1 + alpha_f q = 0.
      const double drift = q + w.dt * v + w.dt * w.dt * (0.5 - w.beta) * a;
      const double left  = 1. - w.alpha_m + (1. - w.alpha_f) * w.beta * w.dt * w.dt;
      const double next  = -(w.alpha_m * a + (1. - w.alpha_f) * drift + w.alpha_f * q) / left;
      q                  = drift + w.dt * w.dt * w.beta * next;
      v += w.dt * ((1. - w.gamma) * a + w.gamma * next);
      a = next;
    }
    return -0.5 * std::log(q * q + v * v) / (steps * angle);
  }

  Scene light_rigid_lever()
  {
    Scene scene                   = model_a();
    scene.analysis.type           = AnalysisType::transient;
    scene.analysis.model          = ModelType::rigid;
    scene.contact.stiffness       = 9541.32;
    scene.contact.exponent        = 1.45485;
    scene.lever.moment_of_inertia = 6.45e-3;
    scene.drive                   = Drive(DriveProfile::triangle, 45., 65., 112., 1., 5e-3);
    return scene;
  }
} // namespace

// Central differences and the trapezoidal rule (spectral radius 1): tan(w dt/2) = angle/2 of the undamped oscillator.
TEST(AlgorithmicSlowing, IsThatOfTheTrapezoidalRule)
{
  for (const double angle : { 0.01, 0.1, 0.5 })
    EXPECT_NEAR(algorithmic_slowing(1., angle), 1. - 2. * std::atan(0.5 * angle) / angle, 1e-9);
  EXPECT_DOUBLE_EQ(algorithmic_slowing(0.8, 0.), 0.);
  EXPECT_GT(algorithmic_slowing(0.8, 0.1), algorithmic_slowing(1., 0.1));
}

TEST(GrowingModes, AlgorithmicDampingIsThatOfTheStep)
{
  EXPECT_NEAR(algorithmic_damping(1., 0.3), 0., 1e-12);
  for (const double radius : { 0., 0.5, 0.8 })
    for (const double angle : { 0.1, 0.4, 1. })
      EXPECT_NEAR(algorithmic_damping(radius, angle), damping_in_time(radius, angle),
                  0.01 * damping_in_time(radius, angle) + 2e-4)
          << radius << ' ' << angle;
  EXPECT_NEAR(algorithmic_damping(0.8, 0.1) / algorithmic_damping(0.8, 0.05), 8., 0.1);
}

TEST(GrowingModes, LongestStepLeavesNineTenthsOfTheGrowth)
{
  const GrowingMode mode{ 60., 112., 200., 1e4 };
  const double omega = 2. * M_PI * mode.frequency;
  const double step  = longest_step({ mode }, 0.8);
  EXPECT_NEAR(algorithmic_damping(0.8, omega * step) * omega, 0.1 * mode.growth_rate, 1e-3);
  EXPECT_NEAR(longest_step({ { 60., 112., 6e4, 1e4 } }, 0.8), 1. / omega, 1e-12);
  EXPECT_EQ(longest_step({ mode, { 60., 112., 200., 1e3 } }, 0.8), step);
  EXPECT_TRUE(std::isinf(longest_step({}, 0.8)));
}

TEST(GrowingModes, OfALightLeverTheContactsForward)
{
  const Scene light = light_rigid_lever();
  const auto found  = growing_modes(*make_reduced_lever(light), light.drive);
  ASSERT_GE(found.size(), 2u);
  for (const auto &mode : found)
  {
    EXPECT_GT(mode.v, 0.);
    EXPECT_NEAR(mode.frequency, 10900., 1000.);
    EXPECT_NEAR(mode.growth_rate, 650., 250.);
  }
  Scene heavy                   = light;
  heavy.lever.moment_of_inertia = 6.45;
  EXPECT_TRUE(growing_modes(*make_reduced_lever(heavy), heavy.drive).empty());
}

TEST(GrowingModes, AFixedStepThatHidesOneIsToldWithNumbers)
{
  const std::vector<GrowingMode> modes = { { 55., 112., 100., 2e3 }, { 60., 112., 700., 1e4 } };
  const auto found                     = hidden_vibration_warnings(modes, { 5e-5, 0., 0.8 });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "hidden_vibration");
  for (const std::string part : { "60 mm", "10000 Hz", "700 1/s", "5e-05 s" })
    EXPECT_NE(found[0].found.find(part), std::string::npos) << found[0].found;
  EXPECT_NE(found[0].effect.find("3183.1 Hz"), std::string::npos) << found[0].effect;
  EXPECT_TRUE(hidden_vibration_warnings(modes, { 5e-5, 5e-3, 0.8 }).empty());
  EXPECT_TRUE(hidden_vibration_warnings(modes, { longest_step(modes, 0.8), 0., 0.8 }).empty());
  EXPECT_TRUE(hidden_vibration_warnings({}, { 5e-5, 0., 0.8 }).empty());
}
