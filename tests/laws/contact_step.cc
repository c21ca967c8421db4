// SPDX-License-Identifier: GPL-3.0-only
#include "friction_of_point.h"

#include "laws/friction_law.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

using namespace sprag;

namespace
{
  constexpr double epsilon = std::numeric_limits<double>::epsilon();

  const NormalLaw linear = { 2000., 1. };
  const NormalLaw curved = { 11300., 1.5 };

  const FrictionLaw coulomb = { CoulombFriction{ 0.73 }, FrictionSpeed::sliding };
  const FrictionLaw cork    = { CorkOnAluminium{}, FrictionSpeed::sliding };

  FrictionLaw regularised(FrictionLaw law, const double speed)
  {
    law.regularisation_speed = speed;
    return law;
  }

  double energy(const NormalLaw &law, const double gap)
  {
    return gap < 0. ? law.stiffness * std::pow(-gap, law.exponent + 1.) / (law.exponent + 1.) : 0.;
  }

  double force(const NormalLaw &law, const double gap)
  {
    return gap < 0. ? law.stiffness * std::pow(-gap, law.exponent) : 0.;
  }

  struct History
  {
    double traction   = 0.;
    double slip_speed = 0.;
    double step       = 0.;
  };

  struct Friction
  {
    double traction, d_slip, d_pressure, mu, slip_speed, energy, dissipated, creep;
    bool slipping;
  };

  /// Friction of a point with one slip, in numbers.
  Friction end_friction(const History &history, const double stiffness, const double slip_change, const double pressure,
                        const FrictionLaw &law, const double dt)
  {
    using One = dealii::Tensor<1, 1>;
    const test::FrictionHistory<1> before{ One({ history.traction }), One({ history.slip_speed }), history.step };
    const auto friction = test::end_friction(before, stiffness, One({ slip_change }), pressure, law, dt);
    return { friction.traction[0], friction.d_slip[0][0], friction.d_pressure[0], friction.mu,      friction.slip_speed[0],
             friction.energy,      friction.dissipated,   friction.creep,         friction.slipping };
  }

  struct Spring
  {
    double begin, end, d_end, mean, d_mean, energy;
  };

  /// The spring over a step, in numbers.
  Spring mean_normal_force(const NormalLaw &law, const double gap_begin, const double gap_end)
  {
    const auto gap = variable<Dual<double, 1>>(gap_end, 0);
    const auto end = spring_force(law, gap), mean = mean_spring_force(law, gap_begin, gap);
    return { spring_force(law, gap_begin), end.v, end.d[0], mean.v, mean.d[0], spring_energy(law, gap_end) };
  }

  constexpr double stiffness = 1000.; ///< in stick [N/mm]
  constexpr double dt        = 5e-5;
  constexpr double pressure  = 20.;
  /// Sliding at 110 mm/s in the last step, of the same duration.
  const History sliding = { 14., 110., dt };

  double central(const std::function<double(double)> &f, const double at, const double h)
  {
    return (f(at + h) - f(at - h)) / (2. * h);
  }
} // namespace

TEST(MeanNormalForce, TimesTheChangeOfTheGapIsTheChangeOfTheEnergy)
{
  // To the round-off of the energies; where the change is small, of the force: 4 epsilon.
  for (const auto &law : { linear, curved })
    for (const double begin : { -0.02, -1e-3, -1e-6, 0., 1e-4, 0.03 })
      for (const double change : { 0.05, 0.011, 1e-3, 1.1e-5, 1e-6, 1e-9, 1e-12 })
        for (const double sign : { 1., -1. })
        {
          const double end  = begin + sign * change;
          const auto normal = mean_normal_force(law, begin, end);
          const double work = -normal.mean * (end - begin);
          // Simpson's rule over a change below 1e-3 of the penetration: 1e-12 / 2880 of its fourth derivative.
          EXPECT_NEAR(work, energy(law, end) - energy(law, begin),
                      4. * epsilon * (energy(law, begin) + energy(law, end)) + 4. * epsilon * normal.mean * change)
              << "gap " << begin << " to " << end;
          EXPECT_GE(normal.mean, 0.);
        }
}

TEST(MeanNormalForce, DerivativesAgreeWithFiniteDifferencesHoweverSmallTheChange)
{
  // Central differences over h, 1e-4 of the penetration: h^2/6 of the third derivative is 1e-9 of the stiffness; round-off 4
  // epsilon of force over h 1e-11 of it, over the change of the gap where that is what the quotient divides by.
  for (const auto &law : { linear, curved })
    for (const double end : { -0.02, -0.003 })
      for (const double begin : { 0.02, -0.001, -0.018, end - 1e-4, end * (1. - 5e-3), end * (1. + 5e-4), end })
      {
        const double h         = 1e-4 * std::abs(end);
        const double scale     = law.exponent * force(law, end) / -end;
        const auto exact       = mean_normal_force(law, begin, end);
        const double round_off = 4. * epsilon * std::max(exact.begin, exact.end) / std::max(1e-3 * -end, std::abs(end - begin));
        const auto mean_at     = [&](const double gap) { return mean_normal_force(law, begin, gap).mean; };
        const auto end_at      = [&](const double gap) { return mean_normal_force(law, begin, gap).end; };
        EXPECT_NEAR(exact.d_mean, central(mean_at, end, h), 1e-8 * scale + round_off / 1e-4) << begin << ' ' << end;
        EXPECT_NEAR(exact.d_end, central(end_at, end, h), 1e-8 * scale) << begin << ' ' << end;
      }
}

TEST(EndDamping, ResistsBothWaysButNeverPulls)
{
  EXPECT_DOUBLE_EQ(dashpot_force(0.05, 20., -0.01, -30.), 1.5);
  EXPECT_DOUBLE_EQ(dashpot_force(0.05, 20., -0.01, 30.), -1.5);
  EXPECT_DOUBLE_EQ(dashpot_force(0.05, 20., -0.01, 1e4), -20.);
  EXPECT_EQ(dashpot_force(0.05, 0., 0.01, -30.), 0.);
  for (double rate = 0.; rate < 2e3; rate += 10.)
    EXPECT_GE(20. + dashpot_force(0.05, 20., -0.01, rate), 0.) << rate;
}

TEST(EndDamping, DerivativesAgreeWithFiniteDifferences)
{
  // Linear on both branches: round-off over h.
  for (const double rate : { -300., -1., 0., 30., 500. })
  {
    using N          = Dual<double, 2>;
    const auto exact = dashpot_force(0.05, variable<N>(20., 0), N{} - 0.01, variable<N>(rate, 1));
    EXPECT_NEAR(exact.d[1], central([](const double r) { return dashpot_force(0.05, 20., -0.01, r); }, rate, 0.1), 1e-12);
    EXPECT_NEAR(exact.d[0], central([=](const double n) { return dashpot_force(0.05, n, -0.01, rate); }, 20., 0.1), 1e-12);
  }
}

TEST(EndFriction, SlipsOnTheConeOfItsSpeedAtTheEnd)
{
  // Speeds of this step and the last extrapolated to its end: a way of its own to the same answer.
  for (const double sign : { 1., -1. })
  {
    const History history = { sign * 14., sign * 110., 2. * dt };
    const auto friction   = end_friction(history, stiffness, sign * 5.7e-3, pressure, cork, dt);
    const double mean     = (sign * 5.7e-3 - (friction.traction - history.traction) / stiffness) / dt;
    const double at_end   = mean + (mean - history.slip_speed) * dt / (dt + 2. * dt);
    EXPECT_TRUE(friction.slipping);
    // Round-off of the slip of 6e-3 mm over dt, 2e-14 mm/s, and of the return.
    EXPECT_NEAR(friction.slip_speed, mean, 1e-11);
    EXPECT_NEAR(friction.traction, sign * friction_coefficient(cork, std::abs(at_end)).coefficient * pressure, 1e-11);
  }
}

TEST(EndFriction, ExtrapolatesTheSlipSpeedToSecondOrder)
{
  // Slip x(t) = 100 t + 2e4 t^2 + 4e6 t^3 [mm, s] at constant pressure; the traction is compared with that at x'(t). Means over
  // steps h and h/2 extrapolated err by x''' h^2/4 of speed: halved steps, a quarter of the error.
  const auto error = [](const double h)
  {
    const auto way  = [](const double t) { return (100. + (2e4 + 4e6 * t) * t) * t; };
    const auto rate = [](const double t) { return 100. + (4e4 + 1.2e7 * t) * t; };
    const auto mean = [&](const double from, const double to) { return (way(to) - way(from)) / (to - from); };
    const double t  = 1e-3;
    // Rigid stick, so that the slip of the spring does not count.
    const double rigid  = 1e9;
    const double before = friction_coefficient(cork, rate(t)).coefficient * pressure;
    const auto friction = end_friction({ before, mean(t - 0.5 * h, t), 0.5 * h }, rigid, way(t + h) - way(t), pressure, cork, h);
    return friction.traction - friction_coefficient(cork, rate(t + h)).coefficient * pressure;
  };
  EXPECT_NEAR(error(1e-4) / error(5e-5), 4., 0.2);
  EXPECT_NEAR(error(5e-5) / error(2.5e-5), 4., 0.1);
  EXPECT_LT(std::abs(error(1e-4)), 1e-2);
}

TEST(EndFriction, DerivativesAgreeWithFiniteDifferencesInStickAndSlip)
{
  struct Point
  {
    History history;
    double slip;
    FrictionLaw law;
  };
  const Point points[] = { { { -3., 0., dt }, 5e-3, cork },
                           { sliding, 5.7e-3, coulomb },
                           { sliding, 5.7e-3, cork },
                           { sliding, -0.06, cork },
                           { { -14., -110., 2. * dt }, -5.7e-3, cork },
                           { {}, 0.03, cork },
                           { sliding, 2e-2, cork },
                           { sliding, 5.7e-3, regularised(cork, 1.) },
                           { sliding, 5.7e-3, regularised(coulomb, 50.) },
                           { {}, 1e-5, regularised(cork, 1.) },
                           { { -5., -80., dt }, 3e-5, regularised(cork, 10.) } };
  for (const auto &point : points)
  {
    const auto traction = [&](const double slip, const double p)
    { return end_friction(point.history, stiffness, slip, p, point.law, dt).traction; };
    const auto exact = end_friction(point.history, stiffness, point.slip, pressure, point.law, dt);
    // h^2/6 of the third derivative: mu is a parabola but for the return to the cone and the regularisation, p/(v_r dt)^3 = 2e14
    // N/mm^3: 1e-8 mm of slip make 3e-3 N/mm of up to 4e5. Round-off 1e-15 of 14 N over h.
    const double h     = 1e-8;
    const double scale = std::max(std::abs(exact.d_slip), stiffness);
    EXPECT_NEAR(exact.d_slip, central([&](const double s) { return traction(s, pressure); }, point.slip, h),
                1e-6 * scale + 1e-14 * pressure / h)
        << "slip " << point.slip;
    EXPECT_NEAR(exact.d_pressure, central([&](const double p) { return traction(point.slip, p); }, pressure, 1e-4), 1e-8)
        << "slip " << point.slip;
  }
}

TEST(EndFriction, ClosesItsOwnLedger)
{
  // Mean traction times slip is what the spring takes up and friction dissipates, exactly.
  for (const auto &law : { coulomb, cork, regularised(cork, 1.), regularised(coulomb, 30.) })
  {
    History history;
    double before          = 0.;
    const double changes[] = { 1e-3, 4e-3, 6e-3, 5e-3, 1e-3, -2e-3, -0.02, -6e-3, 1e-4, 0.03 };
    const double loads[]   = { 20., 18., 22., 25., 3., 9., 20., 0., 8., 20. };
    for (unsigned int i = 0; i < std::size(changes); ++i)
    {
      const auto friction = end_friction(history, stiffness, changes[i], loads[i], law, dt);
      const double mean   = 0.5 * (history.traction + friction.traction);
      const double work   = mean * changes[i];
      EXPECT_NEAR(work, friction.dissipated + friction.energy - before, 1e-15) << i;
      history = { friction.traction, friction.slip_speed, dt };
      before  = friction.energy;
    }
  }
}

namespace
{
  const FrictionLaw falling{ StribeckFriction{ 0.9, 0.5, 60. } };

  double falling_mu(const double v)
  {
    return 0.5 + 0.4 * std::exp(-v / 60.);
  }

  test::FrictionHistory<1> next(const test::EndFriction<1> &friction, const double duration)
  {
    return { friction.traction, friction.slip_speed, duration, friction.slipping ? friction.mu : 0. };
  }

  /// A step of dy/dt = rate(t, y) by Runge-Kutta.
  template <class Rate>
  double runge_kutta(const Rate &rate, const double t, const double y, const double step)
  {
    const double k_1 = rate(t, y), k_2 = rate(t + 0.5 * step, y + 0.5 * step * k_1);
    const double k_3 = rate(t + 0.5 * step, y + 0.5 * step * k_2), k_4 = rate(t + step, y + step * k_3);
    return y + step / 6. * (k_1 + 2. * k_2 + 2. * k_3 + k_4);
  }
} // namespace

// dmu/dt = |v| (mu(v) - mu) / L along a speed v = 100 mm/s + 4e5 mm/s^2 t. It sticks under up to mu(0) p before, then mu begins
// at mu(0). Where in a step that is leaves an error which dies out over the memory length; a tenth of what mu(v) falls by in a
// step remains.
TEST(EndFriction, FallingFrictionFollowsTheSpeedOfTheFacesOverTheMemoryLength)
{
  constexpr double growth = 4e5, step = 2e-6;
  const auto v    = [](const double t) { return 100. + growth * t; };
  const auto rate = [&](const double t, const double mu) { return v(t) * (falling_mu(v(t)) - mu) / falling.memory_length; };
  test::FrictionHistory<1> history;
  double mu = falling_mu(0.), left = 0.;
  bool slides = false;
  for (unsigned int i = 0; i < 250; ++i)
  {
    const double t = i * step;
    const auto friction =
        test::end_friction<1>(history, stiffness, dealii::Tensor<1, 1>({ v(t + 0.5 * step) * step }), pressure, falling, step);
    if (!friction.slipping)
      EXPECT_LE(friction.traction[0], 0.9 * pressure);
    else if (!slides)
      EXPECT_GT(history.traction[0] + stiffness * v(t + 0.5 * step) * step, 0.9 * pressure);
    const double memories = v(t) * step / falling.memory_length;
    left                  = slides ? left * std::exp(-memories) : 0.4 * memories;
    if (slides)
      mu = runge_kutta(rate, t, mu, step);
    slides = friction.slipping;
    if (i > 180) // mu lags by some 20 mm/s
    {
      EXPECT_TRUE(friction.slipping);
      EXPECT_GT(mu, falling_mu(v(t + step) - 10.));
      EXPECT_NEAR(friction.mu, mu, left + 0.1 * (falling_mu(v(t)) - falling_mu(v(t + step))));
      EXPECT_NEAR(friction.traction[0], friction.mu * pressure, 1e-12);
    }
    history = next(friction, step);
  }
}

// The layer takes the part dt/dt / k of the speed v = 100 mm/s + 4e5 mm/s^2 t, which its faces then do not slide by:
//   dmu/dt = v_f (mu(v_f) - mu) / L,   v_f = v - p (dmu/dt) / k.
TEST(EndFriction, FallingFrictionFollowsTheSpeedBehindTheShearOfALayer)
{
  constexpr double growth = 4e5, step = 2e-6, soft = 100. * pressure; // p over 0.01 mm
  const auto v    = [](const double t) { return 100. + growth * t; };
  const auto rate = [&](const double t, const double mu)
  {
    double result = 0.;
    for (unsigned int i = 0; i < 40; ++i)
    {
      const double face = v(t) - pressure * result / soft;
      result            = face * (falling_mu(face) - mu) / falling.memory_length;
    }
    return result;
  };
  test::FrictionHistory<1> history;
  double mu             = falling_mu(100.);
  history.traction[0]   = mu * pressure;
  history.slip_speed[0] = 100.;
  history.step          = step;
  history.mu            = mu;
  const auto at         = [&](const double slip, const double p)
  { return test::end_friction<1>(history, soft, dealii::Tensor<1, 1>({ slip }), p, falling, step, true); };
  for (unsigned int i = 0; i < 100; ++i)
  {
    const double t = i * step, slip = v(t + 0.5 * step) * step;
    const auto friction = at(slip, pressure);
    mu                  = runge_kutta(rate, t, mu, step);
    ASSERT_TRUE(friction.slipping);
    EXPECT_NEAR(friction.mu, mu, 0.1 * (falling_mu(v(t)) - falling_mu(v(t + step)))) << i;
    EXPECT_NEAR(friction.traction[0], friction.mu * pressure, 1e-11);
    const double h = 1e-3 * slip, dp = 1e-4 * pressure;
    EXPECT_NEAR(friction.d_slip[0][0] * 2. * h, at(slip + h, pressure).traction[0] - at(slip - h, pressure).traction[0],
                1e-4 * std::abs(friction.d_slip[0][0]) * h);
    EXPECT_NEAR(friction.d_pressure[0] * 2. * dp, at(slip, pressure + dp).traction[0] - at(slip, pressure - dp).traction[0],
                1e-4 * std::abs(friction.d_pressure[0]) * dp);
    history = next(friction, step);
  }
}

// A layer of k = 30 p/mm lets slip run away from stick, as 0.4 p / L = 40 p/mm. The slip s that it releases is so fast that mu(v)
// is 0.5 throughout: k (s_trial - s) = (0.5 + 0.4 exp(-s/L)) p. Then at 1 mm/s mu comes back to mu(v) over the path of the faces.
TEST(EndFriction, SlipThatRunsAwayEndsAtTheSamePlaceInStepsOfAnyDuration)
{
  constexpr double soft = 30. * pressure, past = 1e-4, slow = 1.;
  const double length = falling.memory_length;
  const auto root     = [](const auto &f, double a, double b) // f(a) > 0 > f(b)
  {
    for (unsigned int i = 0; i < 100; ++i)
      (f(0.5 * (a + b)) > 0. ? a : b) = 0.5 * (a + b);
    return a;
  };
  const double s      = root([&](const double x) { return 0.9 + 30. * (past - x) - 0.5 - 0.4 * std::exp(-x / length); }, 0., 0.1);
  const double lowest = 0.5 + 0.4 * std::exp(-s / length);
  const auto mu_behind = [&](const double path)
  { return falling_mu(slow) + (lowest - falling_mu(slow)) * std::exp(-path / length); };
  for (const double duration : { 1e-7, 1e-8, 1e-9 })
  {
    test::FrictionHistory<1> history{ dealii::Tensor<1, 1>({ 0.9 * pressure }), {}, duration, 0. };
    const auto step = [&](const double slip, const double time)
    {
      const auto found = test::end_friction<1>(history, soft, dealii::Tensor<1, 1>({ slip }), pressure, falling, time, true);
      history          = next(found, time);
      return found;
    };
    EXPECT_NEAR(step(past, duration).traction[0], lowest * pressure, 1e-9 * pressure) << duration;
    for (unsigned int i = 1; i <= 60; ++i)
    {
      const double at   = 2e-4 * i; // path = at - (mu - lowest) p/k
      const double path = root([&](const double x) { return at - (mu_behind(x) - lowest) / 30. - x; }, 0., at);
      const double mu   = step(2e-4, 2e-4 / slow).mu;
      EXPECT_NEAR(mu, mu_behind(path), 0.01 * (0.9 - lowest)) << duration << " " << i;
    }
  }
}

// Behind the layer of a lever at 80 mm/s, L = 1 um: a step covers four memory lengths. From a step at 31 mm/s with mu = 0.61 the
// slide comes to mu(80) = 0.507 and stays there: it does not jump to and fro with each step.
TEST(EndFriction, SlideBehindALayerSettlesAfterAJump)
{
  FrictionLaw steep{ StribeckFriction{ 0.9, 0.5, 20. } };
  steep.memory_length   = 1e-3;
  constexpr double soft = 47. * pressure, speed = 80., step = 4.8e-5;
  test::FrictionHistory<1> history{ dealii::Tensor<1, 1>({ 0.61 * pressure }), dealii::Tensor<1, 1>({ 31. }), step, 0.61 };
  for (unsigned int i = 0; i < 20; ++i)
  {
    const auto found = test::end_friction<1>(history, soft, dealii::Tensor<1, 1>({ speed * step }), pressure, steep, step, true);
    EXPECT_LT(found.mu, 0.55) << i;
    if (i > 5)
      EXPECT_NEAR(found.mu, 0.5 + 0.4 * std::exp(-speed / 20.), 1e-3) << i;
    history = next(found, step);
  }
}

// One step of stick behind a slide at 100 mm/s, whose mu is 0.576: then static friction, 0.9, holds a load that grows slowly.
TEST(EndFriction, StickForgetsTheSlideBeforeIt)
{
  for (const bool is_layer : { false, true })
  {
    const double kinetic = falling_mu(100.) * pressure, slip = 0.02 * pressure / stiffness;
    test::FrictionHistory<1> history{ dealii::Tensor<1, 1>({ kinetic }), dealii::Tensor<1, 1>({ 100. }), dt, falling_mu(100.) };
    for (unsigned int i = 0; i < 16; ++i)
    {
      const double duration = i == 0 ? dt : 1e6 * slip; // at 1e-6 mm/s
      const auto friction   = test::end_friction<1>(history, stiffness, dealii::Tensor<1, 1>({ i == 0 ? -slip : slip }), pressure,
                                                  falling, duration, is_layer);
      EXPECT_FALSE(friction.slipping) << is_layer << i;
      EXPECT_NEAR(friction.traction[0], kinetic + (i - 1.) * 0.02 * pressure, 1e-12);
      history = next(friction, duration);
    }
  }
}

TEST(EndFriction, LosesItsTractionWhereTheContactOpens)
{
  const auto friction = end_friction(sliding, stiffness, 5e-3, 0., cork, dt);
  EXPECT_EQ(friction.traction, 0.);
  EXPECT_EQ(friction.energy, 0.);
  EXPECT_EQ(friction.slip_speed, 0.);
  EXPECT_FALSE(friction.slipping);
  // The spring's energy is dissipated with the slip.
  EXPECT_DOUBLE_EQ(friction.dissipated, 0.5 * 14. * (5e-3 + 14. / stiffness));
}

TEST(EndFriction, RegularisedLawCreepsBelowItsSpeedAndTellsHowFar)
{
  const auto law   = regularised(coulomb, 1.);
  const auto creep = end_friction({}, stiffness, 2e-5, pressure, law, dt); // 0.4 mm/s
  EXPECT_DOUBLE_EQ(creep.creep, 2e-5);
  EXPECT_NEAR(creep.traction, 0.73 * pressure * 0.4 / std::hypot(0.4, 1.), 1e-13);
  EXPECT_EQ(creep.energy, 0.);
  EXPECT_EQ(end_friction({}, stiffness, 2e-4, pressure, law, dt).creep, 0.);
}
