// SPDX-License-Identifier: GPL-3.0-only
#include "input/read.h"
#include "scene/scene.h"
#include "support/shipped.h"
#include "verification/held_slides.h"
#include "verification/run_scene.h"

#include <algorithm>
#include <array>
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
    return shipped("stribeck-a", changes);
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
    const auto scene      = shipped("stability-a", { i == 0 ? "Analysis/Model=beam" : "Analysis/Model=condensed",
                                                     "Friction/Law=Stribeck", "Friction/Stribeck speed=10", "Drive/Speed=10",
                                                     "Stability/Position=65", "Stability/Direction=backward" });
    const auto eigenvalue = JudgedSlide(scene).stability.modes.front().mode.eigenvalue;
    growth[i]             = eigenvalue.real();
    frequency[i]          = eigenvalue.imag();
  }
  EXPECT_NEAR(growth[0], growth[1], 0.04 * growth[1]); // the mesh's own error is 2.3 %
  EXPECT_NEAR(frequency[0], frequency[1], 0.01 * frequency[1]);
  EXPECT_GT(growth[0], 230.);
}

// The orbit of an oscillator integrated here: the frame, a rigid lever that turns on it, a linear contact with a dashpot, the
// shear of the layer in series with slip, and mu that follows the speed of the faces over its memory.
namespace
{
  /// A closed orbit of frame and slip, from samples. A lap ends where the slip comes up to 12 mm/s.
  struct Orbit
  {
    double time = 0., slip = 0.;                ///< of the last sample
    double first = 0., last = 0.;               ///< ends of laps [s]
    double low = 1e9, high = -1e9, swings = 0.; ///< of the frame in a lap, and their differences' sum [mm]
    double slow_here = 0., slow = 0.;           ///< time below 2 mm/s in a lap and in all [s]
    double fastest = 0.;                        ///< slip [mm/s]
    int laps       = -1;

    void add(const double t, const double frame, const double speed)
    {
      constexpr double from = 1.4, to = 1.7; // transients have died out; x goes from 51 to 48 mm
      if (t > from && t < to)
      {
        if (slip < 12. && speed >= 12.)
        {
          last  = time + (t - time) * (12. - slip) / (speed - slip);
          first = ++laps == 0 ? last : first;
          swings += laps == 0 ? 0. : high - low;
          slow += laps == 0 ? 0. : slow_here;
          low = high = frame;
          slow_here  = 0.;
        }
        low     = std::min(low, frame);
        high    = std::max(high, frame);
        fastest = std::max(fastest, speed);
        slow_here += std::abs(speed) < 2. ? t - time : 0.;
      }
      time = t;
      slip = speed;
    }

    /// Returns period, swing, share of slow slip, and the fastest.
    std::array<double, 4> measures() const
    {
      return { { (last - first) / laps, swings / laps, slow / (last - first), fastest } };
    }
  };

  constexpr double normal_stiffness = 2000., shear_stiffness = 1000., contact_damping = 0.3, memory = 0.05;

  /// Frame, turn of the lever, their rates, the layer's shear and mu.
  using OscillatorState = std::array<double, 6>;

  /// The lever by the pivot's distance a from the cylinder's centre: gap a sin(theta) + e - R, foot of the normal at a
  /// cos(theta).
  struct Oscillator
  {
    static constexpr double R = 56., e = 45.6, l = 185.5, k = 7.40e4, J = 6.45, L = 210., axis = e + 1. + 10.;
    static constexpr double frame = 2e-3, lever = J / (L * L / 3. + axis * axis), m = frame + lever;
    const double dashpot = 2. * contact_damping * std::sqrt(normal_stiffness * J) / std::sqrt(130.5 * 130.5 - 10.4 * 10.4);
    const double support = 2. * 0.02 * std::sqrt(stiffness * m);
    const double drag    = 5e-4; ///< makes the slip's speed explicit: 1e-3 of friction [N s/mm]
    double P = 0., slip = 0., creep = 0.;

    OscillatorState rate(const double t, const OscillatorState &y)
    {
      const auto [u, theta, u_rate, theta_rate, shear, friction] = y;
      const double v = -10., a = l - (55. + v * (t - 1.)) + u, s = a * std::cos(theta), h = a * std::sin(theta);
      const double depth = R - e - h, approach = (v - u_rate) * std::sin(theta) - s * theta_rate;
      P              = depth > 0. ? std::max(0., normal_stiffness * depth + dashpot * approach) : 0.;
      slip           = (v - u_rate) * std::cos(theta) + (h - R) * theta_rate;
      const double F = shear_stiffness * shear, beyond = std::abs(F) - friction * P;
      creep                 = beyond > 0. ? std::copysign(beyond / drag, F) : 0.;
      const double force    = P * std::sin(theta) + F * std::cos(theta) - support * u_rate - stiffness * u;
      const double moment   = P * s + F * (R - h) - k * (theta - std::asin((R - e) / l));
      const double coupling = lever * (0.5 * L * std::sin(theta) + axis * std::cos(theta));
      const double det      = m * J - coupling * coupling;
      return { { u_rate, theta_rate, (J * force - coupling * moment) / det, (m * moment - coupling * force) / det, slip - creep,
                 -std::abs(creep) / memory * (friction - mu(std::abs(creep))) } };
    }

    /// Integrates the orbit that begins with a slide back at x = 55 mm on a frame that is not yet displaced.
    Orbit orbit()
    {
      constexpr double dt = 5e-7;
      OscillatorState y   = { { 0., std::asin((R - e) / 130.5) - 5e-5, 0., 0., 0., mu(10.) } };
      rate(1., y);
      y[4]             = -y[5] * P / shear_stiffness;
      const auto moved = [](OscillatorState from, const OscillatorState &by, const double time)
      {
        for (std::size_t i = 0; i < from.size(); ++i)
          from[i] += time * by[i];
        return from;
      };
      Orbit result;
      for (unsigned int i = 0; i * dt < 0.7; ++i)
      {
        const double t = 1. + i * dt;
        const auto a = rate(t, y), b = rate(t + dt / 2., moved(y, a, dt / 2.)), c = rate(t + dt / 2., moved(y, b, dt / 2.)),
                   d = rate(t + dt, moved(y, c, dt));
        y            = moved(moved(moved(moved(y, a, dt / 6.), b, dt / 3.), c, dt / 3.), d, dt / 6.);
        rate(t + dt, y);
        y[5] = creep == 0. ? mu(0.) : y[5];
        result.add(t + dt, y[0], -slip);
      }
      return result;
    }
  };
} // namespace

// Four other beginnings of the oscillator and a drag of two fifths move its period by 6e-4, its swing by 9e-4, the share of slow
// slip by 2e-3 and the fastest slip by 2e-3. With a memory of 0.01 mm the swing is 6 % less.
TEST(Stribeck, FrameGoesTheOrbitOfAnOscillatorIntegratedByItself)
{
  const auto run =
      run_in_time(scene_with({ "Contact/Stiffness=2000", "Contact/Exponent=1", "Contact/Damping=0.3",
                               "Contact/Tangential stiffness=1000", "Friction/Memory length=0.05", "Time/Tolerance=1e-3" }));
  Orbit found;
  for (const auto &row : run.rows)
    found.add(row[Column::time], row[Column::support_displacement], -row[Column::v_rel]);
  const auto by_run = found.measures(), own = Oscillator().orbit().measures();
  const double tolerance[] = { 2e-3, 3e-3, 1e-2, 3e-3 };
  for (std::size_t i = 0; i < own.size(); ++i)
    EXPECT_NEAR(by_run[i], own[i], tolerance[i] * own[i]) << i;
  EXPECT_GT(own[2], 0.1);
}

// Behind a reversal friction over pressure is mu at the speed of the faces, for a contact at a point and one on a mesh.
TEST(Stribeck, FrictionBehindAReversalIsThatOfTheSpeed)
{
  for (const std::string model : { "beam", "condensed" })
  {
    const auto scene = shipped("reversal-a", { "Analysis/Model=" + model, "Friction/Law=Stribeck",
                                               "Friction/Static coefficient=0.9", "Friction/Kinetic coefficient=0.5",
                                               "Friction/Stribeck speed=60", "Drive/Start=55", "Drive/Stroke=60" });
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
