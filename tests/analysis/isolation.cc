// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/harmonic_balance.h"
#include "base/errors.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "support/isolated.h"

#include <gtest/gtest.h>

using namespace sprag;

// The table on its spring against exact solutions: Coulomb friction (Den Hartog 1931), friction proportional to displacement
// (Reid's damping), viscous damping, and a solution joined from exact pieces where friction stops the table.

namespace
{
  const double w_n = std::sqrt(2. / 0.05); ///< of isolated() [1/s]

  double base_frequency(const Scene &scene)
  {
    return 2. * M_PI * scene.isolation.base_frequency;
  }

  /// Constant friction on a base X sin(w t), each piece solved exactly: z = A cos(w_n t) + B sin(w_n t) + S sin(w t) - d F0/K.
  class ExactStops
  {
  public:
    explicit ExactStops(const Scene &scene)
        : m(scene.isolation.mass)
        , K(scene.isolation.stiffness)
        , F0(scene.isolation.friction_force)
        , X(scene.isolation.base_amplitude)
        , w(base_frequency(scene))
        , S(X * w * w / (K / m - w * w))
    {
    }

    /// Places at which the table stops, until a time.
    std::vector<double> stops(const double until)
    {
      std::vector<double> result;
      for (double t = 0.; t < until;)
      {
        t = release(t);
        t = slip_end(t);
        if (t < until)
          result.push_back(z);
      }
      return result;
    }

  private:
    const double m, K, F0, X, w, S;
    double z = 0.;
    int d    = 1;

    double needed(const double t) const
    {
      return m * X * w * w * std::sin(w * t) - K * z;
    }

    template <class Function>
    static double root(const Function &f, double from, double to)
    {
      for (unsigned int i = 0; i < 200; ++i)
      {
        const double middle          = 0.5 * (from + to);
        (f(middle) > 0. ? to : from) = middle;
      }
      return to;
    }

    double release(double t)
    {
      const double step = 1e-4 / w;
      while (std::abs(needed(t)) <= F0)
        t += step;
      const double at =
          std::abs(needed(t - step)) > F0 ? t : root([&](const double s) { return std::abs(needed(s)) - F0; }, t - step, t);
      d = needed(t) > 0. ? 1 : -1;
      return at;
    }

    double slip_end(const double begin)
    {
      const double n = std::sqrt(K / m), offset = -d * F0 / K;
      const double C = z - offset - S * std::sin(w * begin), D = -S * w * std::cos(w * begin) / n;
      const auto rate = [&](const double t)
      { return n * (D * std::cos(n * (t - begin)) - C * std::sin(n * (t - begin))) + S * w * std::cos(w * t); };
      const double step = 1e-3 / w;
      double t          = begin + step;
      while (d * rate(t) > 0.)
        t += step;
      t = root([&](const double s) { return -d * rate(s); }, t - step, t);
      z = offset + C * std::cos(n * (t - begin)) + D * std::sin(n * (t - begin)) + S * std::sin(w * t);
      return t;
    }
  };
} // namespace

TEST(Isolation, LinearFrictionDecaysByAFixedRatioAHalfCycle)
{
  for (const double gamma : { 0.05, 0.3, 0.8 })
  {
    Scene scene                          = isolated(DamperType::linear_friction);
    scene.isolation.friction_slope       = gamma * scene.isolation.stiffness;
    scene.isolation.initial_displacement = -40.;
    const double ratio                   = std::sqrt((1. - gamma) / (1. + gamma));
    const double half_period             = 0.5 * M_PI * (1. / std::sqrt(1. - gamma) + 1. / std::sqrt(1. + gamma)) / w_n;
    double z = -40., time = 0.;
    const auto turns = find_turns(scene);
    ASSERT_GT(turns.size(), 10u);
    for (const auto &turn : turns)
    {
      z *= -ratio;
      time += half_period;
      EXPECT_NEAR(turn.z / z, 1., 1e-9) << gamma;
      EXPECT_NEAR(turn.time / time, 1., 1e-10) << gamma;
    }
    EXPECT_LT(compute_findings(scene).energy_residual, 1e-11);
  }
}

TEST(Isolation, ConstantFrictionLeavesTheOffsetOfTheHalfCycles)
{
  for (const double force : { 1., 3., 7.3, 11., 40. })
    for (const double z0 : { 50., -31.7 })
    {
      Scene scene                          = isolated(DamperType::constant_friction);
      scene.isolation.friction_force       = force;
      scene.isolation.initial_displacement = z0;
      scene.isolation.duration             = 40.;
      const double K = scene.isolation.stiffness, y0 = std::abs(z0);
      const double n      = std::ceil((y0 * K / force - 1.) / 2.);
      const double offset = (z0 > 0. ? 1. : -1.) * std::pow(-1., n) * (y0 - 2. * n * force / K);
      const auto found    = compute_findings(scene);
      EXPECT_EQ(found.turns, n);
      EXPECT_EQ(found.stops, 1u);
      EXPECT_TRUE(found.rests);
      EXPECT_NEAR(found.residual_offset, offset, 1e-10);
      EXPECT_EQ(found.residual_amplitude, 0.);
      EXPECT_NEAR(found.dissipated, 0.5 * K * (z0 * z0 - offset * offset), 1e-8);
    }
}

TEST(Isolation, ConstantFrictionIsLockedUpToTheForceOfTheBase)
{
  for (const double r : { 0.3, 1., 2.5 })
  {
    Scene scene                    = shaken(DamperType::constant_friction, r);
    const double limit             = scene.isolation.stiffness * scene.isolation.base_amplitude * r * r;
    scene.isolation.friction_force = limit * (1. + 1e-9);
    auto found                     = compute_findings(scene);
    EXPECT_EQ(found.largest_displacement, 0.);
    EXPECT_NEAR(found.peak, 1., 1e-9);
    EXPECT_NEAR(found.fundamental, 1., 1e-9);
    EXPECT_NEAR(found.rms, 1., 1e-9);
    EXPECT_TRUE(found.is_steady);
    scene.isolation.friction_force = limit * (1. - 1e-6);
    found                          = compute_findings(scene);
    EXPECT_GT(found.largest_displacement, 0.);
    EXPECT_GT(found.stops, 0u);
  }
}

TEST(Isolation, SteadyStatesWithoutStopsAreDenHartogs)
{
  for (const auto &[r, share] : std::vector<std::pair<double, double>>{ { 0.6, 0.3 }, { 0.9, 0.5 }, { 1.3, 0.5 }, { 2., 0.3 } })
  {
    Scene scene                    = shaken(DamperType::constant_friction, r);
    const double static_amplitude  = scene.isolation.base_amplitude * r * r; // of a force m w^2 X
    scene.isolation.friction_force = share * scene.isolation.stiffness * static_amplitude;
    const double V = 1. / (1. - r * r), beta = 1. / r;
    const double U        = beta * std::sin(M_PI * beta) / (1. + std::cos(M_PI * beta));
    const double expected = static_amplitude * std::sqrt(V * V - share * share * U * U);
    const auto found      = compute_findings(scene);
    EXPECT_TRUE(found.is_steady) << r;
    EXPECT_EQ(found.stops_a_period, 0.) << r;
    EXPECT_NEAR(found.relative_amplitude / expected, 1., 1e-9) << r;
    EXPECT_LT(found.energy_residual, 1e-11);
  }
}

TEST(Isolation, StopsUnderAHarmonicBaseAreThoseOfExactPieces)
{
  for (const double r : { 0.21, 0.35, 0.7 })
  {
    Scene scene                    = shaken(DamperType::constant_friction, r);
    scene.isolation.end            = IsolationEnd::duration;
    scene.isolation.duration       = 12. / scene.isolation.base_frequency;
    scene.isolation.friction_force = 0.6 * scene.isolation.stiffness * scene.isolation.base_amplitude * r * r;
    const auto expected            = ExactStops(scene).stops(scene.isolation.duration);
    const auto turns               = find_turns(scene);
    ASSERT_EQ(turns.size(), expected.size()) << r;
    ASSERT_GT(turns.size(), 20u);
    for (std::size_t i = 0; i < turns.size(); ++i)
      EXPECT_NEAR(turns[i].z, expected[i], 1e-9 * scene.isolation.base_amplitude) << r << ' ' << i;
    EXPECT_EQ(compute_findings(scene).stops > 20, r < 0.5) << r;
  }
}

TEST(Isolation, ViscousDampingHasTheTransmissibilityOfTheBooks)
{
  for (const double r : { 0.5, 1., 1.8 })
  {
    const double zeta                   = 0.15;
    Scene scene                         = shaken(DamperType::viscous, r);
    scene.isolation.viscous_coefficient = 2. * zeta * scene.isolation.mass * w_n;
    const double q                      = std::pow(2. * zeta * r, 2);
    const double expected               = std::sqrt((1. + q) / (std::pow(1. - r * r, 2) + q));
    const auto found                    = compute_findings(scene);
    EXPECT_NEAR(found.fundamental, expected, 1e-9);
    EXPECT_NEAR(found.rms, expected, 1e-9);
    EXPECT_NEAR(found.peak, expected, 1e-6);
    const auto balance = harmonic_balance(isolation_system(scene), scene.isolation.base_amplitude, base_frequency(scene));
    ASSERT_EQ(balance.size(), 1u);
    EXPECT_NEAR(balance.front().transmissibility, expected, 1e-10);
  }
}

TEST(Isolation, HarmonicBalanceOfLinearFrictionIsThatOfALossFactor)
{
  const double gamma = 0.4, eta = 2. * gamma / M_PI;
  for (const double r : { 0.5, 1., 1.8 })
  {
    Scene scene                    = shaken(DamperType::linear_friction, r);
    scene.isolation.friction_slope = gamma * scene.isolation.stiffness;
    const auto balance = harmonic_balance(isolation_system(scene), scene.isolation.base_amplitude, base_frequency(scene));
    ASSERT_EQ(balance.size(), 1u);
    const double expected = std::sqrt((1. + eta * eta) / (std::pow(1. - r * r, 2) + eta * eta));
    EXPECT_NEAR(balance.front().transmissibility, expected, 1e-9);
    EXPECT_NEAR(compute_findings(scene).fundamental / expected, 1., 0.15); // which one harmonic is worth
  }
}

TEST(Isolation, HarmonicBalanceTakesASpringInTheDamperAsOneBesideIt)
{
  Scene scene                    = shaken(DamperType::linear_friction, 1.8);
  const double k                 = 0.3 * scene.isolation.stiffness;
  scene.isolation.friction_slope = 0.4 * scene.isolation.stiffness;
  auto system                    = isolation_system(scene);
  const auto motions  = [&] { return harmonic_balance(system, scene.isolation.base_amplitude, base_frequency(scene)); };
  const auto expected = motions();
  system.stiffness -= k;
  system.damper.resistance = [k, friction = system.damper.resistance](const double y, const double speed, const int away)
  {
    auto result = friction(y, speed, away);
    result.force += k * y;
    return result;
  };
  const auto found = motions();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found.front().amplitude, expected.front().amplitude, 1e-9 * expected.front().amplitude);
  EXPECT_NEAR(found.front().transmissibility, expected.front().transmissibility, 1e-9);
}

TEST(Isolation, LeversMeetTheLinearLawWhereZIsSmall)
{
  Scene scene            = isolated(DamperType::lever);
  scene.friction.law     = CoulombFriction{ 0.73 };
  scene.isolation.levers = 3;
  const double forward   = representative_slope(scene.geometry, scene.spring.stiffness, 0.73, 1);
  const double backward  = representative_slope(scene.geometry, scene.spring.stiffness, 0.73, -1);
  EXPECT_NEAR(forward, 0.0804711777, 1e-9);
  const double c = 1.5 * (forward - backward), k_e = 1.5 * (forward + backward);
  const auto damper = make_damper(scene);
  const double y    = 1e-6;
  EXPECT_NEAR(damper.resistance(y, 1., 1).force, (k_e + c) * y, 1e-6 * c * y);
  EXPECT_NEAR(damper.resistance(y, 1., -1).force, (k_e - c) * y, 1e-6 * c * y);

  // Out and back the slopes differ: one half cycle shrinks by the root of their ratio.
  scene.isolation.initial_displacement = 1e-4;
  const double K = scene.isolation.stiffness, ratio = std::sqrt((K + k_e - c) / (K + k_e + c));
  const auto turns = find_turns(scene);
  ASSERT_GT(turns.size(), 5u);
  EXPECT_NEAR(turns[0].z / -1e-4, ratio, 1e-5);
  EXPECT_NEAR(turns[1].z / turns[0].z, -ratio, 1e-5);
}

// Constant mu: the force depends on z and its direction alone, so that work gives each turn from the one before.
TEST(Isolation, APreloadHoldsTheTableAsFarOffAsItsWorkLeavesIt)
{
  Scene scene                          = isolated(DamperType::lever);
  scene.friction.law                   = CoulombFriction{ 0.73 };
  scene.isolation.levers               = 1;
  scene.spring.rest_angle              = -0.01;
  scene.isolation.initial_displacement = 60.;
  const double R = 56., e = 45.6, l = 185.5, k = 7.4e4, mu = 0.73, K = 2., theta_0 = std::asin((R - e) / l);
  // Those for z > 0 press to z = -40, as far as their springs' rest, those for z < 0 to 40.
  const auto levers = [&](const double x, const int direction)
  {
    const double theta = std::asin((R - e) / (l - x)), s = (l - x) * std::cos(theta);
    const double P = std::max(0., k * (theta - theta_0 + 0.01)) / (s + direction * mu * e);
    return P * (std::sin(theta) + direction * mu * std::cos(theta));
  };
  const auto force = [&](const double z, const int direction) { return K * z + levers(z, direction) - levers(-z, -direction); };
  const double spacing = 1e-3; // the trapezoidal rule's step [mm]
  double z             = 60.;
  int direction        = -1;
  std::vector<double> turns;
  while (direction * force(z, direction) < 0.)
  {
    // Over the last step the work is a parabola's.
    double work = 0., next = 0.;
    for (;; z += direction * spacing, work = next)
    {
      next = work - spacing * 0.5 * direction * (force(z, direction) + force(z + direction * spacing, direction));
      if (next < 0.)
        break;
    }
    z += direction * work / (direction * force(z, direction));
    turns.push_back(z);
    direction = -direction;
  }
  const auto found = compute_findings(scene);
  ASSERT_EQ(found.turns, turns.size());
  EXPECT_TRUE(found.rests);
  EXPECT_GT(std::abs(found.residual_offset), 0.1);
  EXPECT_NEAR(found.residual_offset, turns.back(), 1e-5);
  EXPECT_LT(found.energy_residual, 1e-8);
  const auto by_run = find_turns(scene);
  for (std::size_t i = 0; i < turns.size(); ++i)
    EXPECT_NEAR(by_run[i].z, turns[i], 1e-5);
}

TEST(Isolation, ARestoringLeverIsLinearFriction)
{
  Scene scene                        = isolated(DamperType::restoring_lever);
  scene.friction.law                 = CoulombFriction{ 0.5 };
  scene.isolation.lever_ratio        = 0.4;
  scene.isolation.friction_arm_ratio = 0.;
  const auto damper                  = make_damper(scene);
  EXPECT_NEAR(damper.resistance(7., 3., 1).force, 0.5 * 0.4 * 2. * 7., 1e-12);
  EXPECT_NEAR(damper.resistance(7., 3., -1).force, -0.5 * 0.4 * 2. * 7., 1e-12);
  scene.isolation.friction_arm_ratio = 0.6;
  EXPECT_NEAR(make_damper(scene).resistance(7., 3., 1).force, 2.8 / 1.3, 1e-12);
  EXPECT_NEAR(make_damper(scene).resistance(7., 3., -1).force, -2.8 / 0.7, 1e-12);
}

// Exact: sqrt(int S |H|^2 / int S) over the band.
TEST(Isolation, TheIntervalOfARandomBaseHasTheValueOfItsSpectrum)
{
  Scene scene                         = isolated(DamperType::viscous);
  scene.isolation.stiffness           = 1.1;
  scene.isolation.viscous_coefficient = 0.015;
  scene.isolation.base                = BaseMotionType::random;
  scene.isolation.tolerance           = 1e-8;
  scene.isolation.duration            = 200.;
  double through = 0., all = 0.;
  for (double f = 0.2; f < 20.; f += 1e-3)
  {
    const double w = 2. * M_PI * f, S = kanai_tajimi(f, 2.5, 0.6), damping = std::pow(0.015 * w, 2);
    through += S * (1.1 * 1.1 + damping) / (std::pow(1.1 - 0.05 * w * w, 2) + damping);
    all += S;
  }
  const double exact   = std::sqrt(through / all);
  unsigned int covered = 0;
  double width         = 0.;
  for (scene.isolation.seed = 1; scene.isolation.seed <= 8; ++scene.isolation.seed)
  {
    const auto found = compute_findings(scene);
    covered += found.rms_low <= exact && exact <= found.rms_high;
    width += (found.rms_high - found.rms_low) / 8.;
  }
  EXPECT_GE(covered, 7u);
  EXPECT_LT(width, 0.6 * exact); // seeds scatter by 0.07 of it
}

// A viscous table at rest has no offset. With a damping of zeta successive turns are -r apart, r = exp(-pi zeta/sqrt(1 -
// zeta^2)).
TEST(Isolation, ATableThatSwingsAtTheEndLeavesNoOffsetButABound)
{
  Scene scene                          = isolated(DamperType::viscous);
  scene.isolation.viscous_coefficient  = 0.05;
  scene.isolation.initial_displacement = 60.;
  scene.isolation.duration             = 3.;
  const auto found                     = compute_findings(scene);
  const auto &table                    = scene.isolation;
  const double zeta                    = 0.5 * table.viscous_coefficient / std::sqrt(table.stiffness * table.mass);
  const double r                       = std::exp(-M_PI * zeta / std::sqrt(1. - zeta * zeta));
  EXPECT_NEAR(std::abs(found.residual_offset) / found.residual_amplitude, (1. - r) / (1. + r), 1e-6);
}

TEST(Isolation, ALoopOfLinearFrictionIsLinearFriction)
{
  Scene scene                          = isolated(DamperType::linear_friction);
  scene.isolation.friction_slope       = 0.5;
  scene.isolation.initial_displacement = 30.;
  const auto expected                  = find_turns(scene);
  scene.isolation.damper               = DamperType::loop;
  for (double y = 0.; y <= 40.; y += 8.)
  {
    for (auto *travel : { &scene.isolation.loop.out, &scene.isolation.loop.back })
      travel->at.push_back(y);
    scene.isolation.loop.out.values.push_back(0.5 * y);
    scene.isolation.loop.back.values.push_back(-0.5 * y);
  }
  const auto turns = find_turns(scene);
  ASSERT_EQ(turns.size(), expected.size());
  for (std::size_t i = 0; i < turns.size(); ++i)
    EXPECT_NEAR(turns[i].z / expected[i].z, 1., 1e-9);
  EXPECT_LT(compute_findings(scene).energy_residual, 1e-10);
}

TEST(Isolation, LeversThatEndOrLockStopTheRunAndKeepWhatWasFound)
{
  Scene scene                    = shaken(DamperType::lever, 1.);
  scene.isolation.base_amplitude = 60.;
  IsolationFindings found;
  EXPECT_THROW(run_isolation(scene, found, {}), AnalysisError);
  EXPECT_GT(found.time, 0.1);
  EXPECT_NEAR(found.largest_displacement, make_damper(scene).reach, 1e-6);

  scene                                = isolated(DamperType::lever);
  scene.isolation.initial_displacement = 0.;
  scene.isolation.initial_velocity     = 900.;
  scene.friction.law                   = CoulombFriction{ 1.6 };
  IsolationFindings locked;
  EXPECT_THROW(run_isolation(scene, locked, {}), AnalysisError);
  EXPECT_GT(locked.largest_displacement, 110.);
}

// Rows every hundredth of the natural period, 10 ms, would fold the upper half of a record of 500 Hz onto the lower one.
TEST(Isolation, RowsAreAsFineAsTheRecord)
{
  auto settings = isolated(DamperType::linear_friction).isolation;
  EXPECT_NEAR(output_step(settings), std::min(0.01 * 2. * M_PI / w_n, 0.1 / settings.base_frequency), 1e-12);
  settings.base = BaseMotionType::record;
  for (unsigned int i = 0; i <= 1000; ++i)
  {
    settings.base_table.at.push_back(2e-3 * i);
    settings.base_table.values.push_back(std::sin(0.1 * i));
  }
  EXPECT_NEAR(output_step(settings), 2e-3, 1e-12);
}
