// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/oscillation.h"

#include "analytic/ringing.h"
#include "report/console_summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  const double pi = std::acos(-1.);

  constexpr double quasi_static_P = 25.;
  constexpr double quasi_static_Q = -16.;
  constexpr double duration       = 5e-3; ///< of the reversals

  Drive there_and_back()
  {
    return Drive(DriveProfile::triangle, 0., 65., 112., 1., duration);
  }

  using Deviation = std::function<double(double)>;

  /// P is off by deviation(t), t from the end of the first reversal on, but never below 0; Q half of that the other way. Steps
  /// between 0.5 and 1.5 of `step`.
  std::vector<Row> rows_with(const Deviation &deviation, const Drive &drive = there_and_back(), const double step = 5e-5)
  {
    std::vector<Row> rows;
    const double begin = drive.reversals().front() + duration / 2.;
    double time        = 0.;
    for (unsigned int i = 0; time < drive.duration(); ++i, time += step * (1. + 0.5 * std::sin(i * i)))
    {
      Row row;
      row[Column::time]           = time;
      row[Column::x]              = drive.at(time).x;
      row[Column::P_quasi_static] = quasi_static_P;
      row[Column::Q_quasi_static] = quasi_static_Q;
      row[Column::P]              = std::max(quasi_static_P + (time < begin ? 0. : deviation(time - begin)), 0.);
      row[Column::Q]              = quasi_static_Q - (row[Column::P] - quasi_static_P) / 2.;
      row[Column::Q_support]      = quasi_static_Q;
      rows.push_back(row);
    }
    return rows;
  }

  Deviation sinusoid(const double amplitude, const double frequency, const double growth)
  {
    return [=](const double time) { return amplitude * std::exp(growth * time) * std::cos(2. * pi * frequency * time + 0.3); };
  }

  Oscillation find_oscillation(const std::vector<Row> &rows)
  {
    return oscillations(rows, there_and_back()).at(0);
  }

  Signal sampled(const Deviation &values, const double length, const double step)
  {
    Signal signal{ step, {} };
    for (unsigned int i = 0; i * step <= length; ++i)
      signal.values.push_back(values(i * step));
    return signal;
  }
} // namespace

TEST(Ringing, IsExactForOneSinusoidWhateverItsGrowthAndTheDriftBelow)
{
  for (const double frequency : { 45., 103.7, 290., 1234.5 })
    for (const double growth : { -60., -20., 0., 15. })
      for (const double length : { 0.06, 0.1 })
      {
        const auto wave  = sinusoid(8., frequency, growth);
        const auto drift = [&](const double time) { return wave(time) + 3. - 20. * time; };
        const auto found = ringing(sampled(drift, length, 1e-5), 0.02);
        EXPECT_NEAR(found.frequency, frequency, 1e-4 * frequency) << frequency << ' ' << growth << ' ' << length;
        // A slow wave that decays fast is short of periods above the drift.
        EXPECT_NEAR(found.growth_rate, growth, 0.3 + 0.01 * std::abs(growth)) << frequency << ' ' << growth << ' ' << length;
      }
}

TEST(Ringing, FindsNoneWhereThereIsNone)
{
  const std::vector<Deviation> smooth = { [](double) { return 0.; },
                                          [](double) { return 7.; },
                                          [](const double time) { return 3. - 50. * time; },
                                          [](const double time) { return 9. * std::exp(-80. * time); },
                                          [](const double time) { return 500. * time * time; },
                                          sinusoid(5., 12., 0.) };
  for (std::size_t i = 0; i < smooth.size(); ++i)
  {
    const auto found = ringing(sampled(smooth[i], 0.1, 1e-5), 0.02);
    EXPECT_TRUE(std::isnan(found.frequency)) << i << ": " << found.frequency;
    EXPECT_TRUE(std::isnan(found.growth_rate)) << i;
  }
  EXPECT_TRUE(std::isnan(ringing({}, 0.).frequency));
  EXPECT_TRUE(std::isnan(ringing({ 1e-5, { 1. } }, 0.).frequency));
  EXPECT_TRUE(std::isnan(ringing(sampled(sinusoid(0.01, 290., 0.), 0.1, 1e-5), 0.02).frequency));
}

// Friction that sticks only while it turns behind the reversal is no stick-slip, nor is one that is regularised, or that of a
// rest.
TEST(Oscillation, SticksAndSlipsWhereFrictionSticksAtTheEndOfTheWindow)
{
  const double turn = there_and_back().reversals().front();
  enum class Stick
  {
    again,
    at_the_turn,
    always,
    at_rest
  };
  for (const auto stick : { Stick::again, Stick::at_the_turn, Stick::always, Stick::at_rest })
  {
    auto rows = rows_with(sinusoid(3., 40., -2.));
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      auto &row                       = rows[i];
      const bool is_at_turn           = std::abs(row[Column::time] - turn) < 0.02;
      const bool is_stuck             = stick == Stick::always || (stick == Stick::at_the_turn ? is_at_turn : i % 5 == 0);
      const bool rests                = stick == Stick::at_rest && row[Column::time] > turn + 0.05;
      row[Column::v]                  = row[Column::time] < turn ? 112. : rests ? -5. : -112.;
      row[Column::mu]                 = 0.5;
      row[Column::normal_resultant]   = row[Column::P];
      row[Column::friction_resultant] = (is_stuck ? 0.3 : 0.5) * row[Column::P];
    }
    const auto found = find_oscillation(rows);
    EXPECT_EQ(found.verdict, stick == Stick::again ? Verdict::sticks_and_slips : Verdict::rings);
    EXPECT_NEAR(found.stick_share, stick == Stick::again ? 0.2 : 0., 0.02);
  }
}

TEST(Oscillation, FrequencyAndGrowthFromUnequalSteps)
{
  for (const double step : { 1e-5, 5e-5, 2e-4 })
    for (const double growth : { -100., -45., -5. })
    {
      const auto found = find_oscillation(rows_with(sinusoid(8., 290., growth), there_and_back(), step));
      EXPECT_NEAR(found.frequency, 290., 0.29) << step << ' ' << growth;
      EXPECT_NEAR(found.frequency_Q, 290., 0.29) << step << ' ' << growth;
      EXPECT_NEAR(found.growth_rate, growth, 0.01 * std::abs(growth)) << step;
      EXPECT_TRUE(std::isnan(found.frequency_Q_support));
    }
}

// It vibrates 15 times in 0.375 s, P as well, but for 0.1 s that rings more at 290 Hz.
TEST(Oscillation, FollowsASlowSupportForAsManyPeriods)
{
  const auto slow = sinusoid(2., 40., -0.1), fast = sinusoid(8., 290., -20.);
  auto rows             = rows_with([&](const double time) { return slow(time) + fast(time); });
  const double turn     = there_and_back().reversals().front() + duration / 2.;
  const auto found_with = [&](const double support_frequency)
  {
    for (auto &row : rows)
      if (row[Column::time] > turn)
      {
        row[Column::Q_support]            = quasi_static_Q + sinusoid(5., support_frequency, -0.1)(row[Column::time] - turn);
        row[Column::support_displacement] = 0.01 * row[Column::Q_support];
      }
    return find_oscillation(rows);
  };
  const auto found = found_with(40.);
  EXPECT_NEAR(found.window_end - found.window_begin, 15. / 40., 0.013);
  EXPECT_NEAR(found.frequency, 40., 0.1);
  EXPECT_NEAR(found.first_frequency, 290., 1.);
  EXPECT_NEAR(found.frequency_Q_support, 40., 0.1);
  EXPECT_NEAR(found_with(200.).frequency, 290., 1.);
}

TEST(Oscillation, WhatVibratesLosesContact)
{
  const auto found = find_oscillation(rows_with(sinusoid(40., 290., 0.)));
  EXPECT_EQ(found.verdict, Verdict::vibrates);
  EXPECT_NEAR(found.open_share, std::acos(25. / 40.) / pi, 2e-3);
  EXPECT_NEAR(found.frequency, 290., 0.29);
  EXPECT_NEAR(found.growth_rate, 0., 0.3);
  EXPECT_NEAR(found.overshoot_P, 40. / 25., 2e-3);
  EXPECT_NEAR(found.extent, 65., 0.1);
}

// The same lever ten times larger, of the same materials: all takes ten times as long.
TEST(Oscillation, LongPeriodsHaveTheVerdictOfShortOnes)
{
  const Drive slow(DriveProfile::triangle, 0., 65., 11.2, 1., 10. * duration);
  const auto found = [&](const double amplitude, const double growth)
  { return oscillations(rows_with(sinusoid(amplitude, 18., growth), slow, 5e-4), slow).at(0); };
  const auto grown = found(8., 3.); // opens where 8 exp(3 t) = 25, after 0.38 s
  EXPECT_EQ(grown.verdict, Verdict::vibrates);
  EXPECT_NEAR(grown.window_end - grown.window_begin, 15. / 18., 0.5 / 18.);
  const auto ringing = found(8., -1.);
  EXPECT_EQ(ringing.verdict, Verdict::rings);
  EXPECT_NEAR(ringing.frequency, 18., 0.018);
  EXPECT_NEAR(ringing.growth_rate, -1., 0.05);
  const auto decayed = found(8., -12.); // is 1.2 % of 25 after log(8/0.3)/12 s
  EXPECT_EQ(decayed.verdict, Verdict::decays);
  EXPECT_NEAR(decayed.window_end - decayed.window_begin, 15. / 18., 0.5 / 18.); // a sinusoid crosses zero for good
}

// A growing or decaying remainder below what counts is none.
TEST(Oscillation, VerdictsDoNotDependOnTheUnitOfForce)
{
  const std::pair<Deviation, Verdict> cases[] = { { sinusoid(40., 290., 0.), Verdict::vibrates },
                                                  { sinusoid(8., 290., -1.), Verdict::rings },
                                                  { sinusoid(8., 290., -60.), Verdict::decays },
                                                  { sinusoid(0.1, 290., 3.), Verdict::decays },
                                                  { sinusoid(1., 290., 15.), Verdict::grows } };
  for (const auto &[deviation, verdict] : cases)
    for (const double unit : { 1e-3, 1., 1e3 })
    {
      auto rows = rows_with(deviation);
      for (auto &row : rows)
        for (const auto column : { Column::P, Column::Q, Column::Q_support, Column::P_quasi_static, Column::Q_quasi_static })
          row[column] *= unit;
      const auto found = find_oscillation(rows);
      EXPECT_EQ(found.verdict, verdict) << enumerator_name(verdict) << ' ' << unit;
      EXPECT_NEAR(found.scale, unit * quasi_static_P, 1e-9 * unit);
    }
}

// Ringing at the speed over the face size, or twice that, which lasts; not if it decays as ringing does, nor elsewhere.
TEST(Oscillation, ElementsThatPassAreNoRinging)
{
  const auto with_speed = [](std::vector<Row> rows)
  {
    for (auto &row : rows)
      row[Column::s] = 120. + 113. * row[Column::time];
    return rows;
  };
  const auto found = [&](const double frequency, const double growth, const double face_size)
  { return oscillations(with_speed(rows_with(sinusoid(2., frequency, growth))), there_and_back(), face_size); };
  for (const auto &[frequency, face_size] : { std::pair<double, double>{ 227., 0.5 }, { 230., 1. } })
  {
    const auto mesh = found(frequency, -5., face_size);
    EXPECT_EQ(mesh[0].verdict, Verdict::elements_pass);
    EXPECT_NEAR(mesh[0].passing_frequency, 226., 1e-6);
    const auto warnings = element_passing_warnings(mesh, face_size);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].name, "element_passing");
    EXPECT_NE(warnings[0].found.find("226 Hz"), std::string::npos) << warnings[0].found;
  }
  for (const auto &lever : { found(227., -60., 0.5), found(290., -5., 0.5), found(227., -5., 0.) })
  {
    EXPECT_NE(lever[0].verdict, Verdict::elements_pass);
    EXPECT_TRUE(element_passing_warnings(lever, 0.5).empty());
  }
}

TEST(Oscillation, LivesUntilItsEnvelopeIsLow)
{
  const double lifetime = 0.27;
  const auto found =
      find_oscillation(rows_with([&](const double time) { return time < lifetime ? sinusoid(20., 290., 0.)(time) : 0.; }));
  EXPECT_NEAR(found.extent, 65. - there_and_back().at(found.window_begin + lifetime).x, 112. * 0.5 / 290.);
}

TEST(Oscillation, FrictionThatTurnsIsNoOvershoot)
{
  // 30 N are left from the stroke before, and the way down to 25 N is finished 4 ms after the turning point. Friction may stick
  // until then.
  const double turn    = there_and_back().reversals().front();
  const auto with_peak = [&](const double peak, const bool is_stuck = false)
  {
    auto rows = rows_with([](double) { return 0.; });
    for (auto &row : rows)
    {
      const double time               = row[Column::time] - turn;
      row[Column::mu]                 = 0.5;
      row[Column::normal_resultant]   = quasi_static_P;
      row[Column::friction_resultant] = (is_stuck && time > 0. && time < 4e-3 ? 0.1 : 0.5) * quasi_static_P;
      if (time >= 0.)
        row[Column::P] = quasi_static_P + (time < 4e-3 ? 30. * (1. - time / 4e-3) : time < 5e-3 ? -1. : time < 6e-3 ? peak : 0.);
    }
    return find_oscillation(rows).overshoot_P;
  };
  const double reversal_ended = 30. * (1. - duration / 2. / 4e-3);
  EXPECT_NEAR(with_peak(0.5), reversal_ended / quasi_static_P, 0.02);
  EXPECT_NEAR(with_peak(20.), 20. / quasi_static_P, 1e-12);
  EXPECT_NEAR(with_peak(0.5, true), 0.5 / quasi_static_P, 1e-12);
}

TEST(Oscillation, FirstPeakCountsWithinTheReversal)
{
  const double turn = there_and_back().reversals().front();
  auto rows         = rows_with([](double) { return 0.; });
  for (auto &row : rows)
    if (const double time = row[Column::time] - turn; time >= 0. && time < 2e-3)
      row[Column::P] = quasi_static_P + (time < 1e-3 ? -10. : 6.);
  EXPECT_NEAR(find_oscillation(rows).overshoot_P, 6. / quasi_static_P, 1e-12);
}

TEST(Oscillation, NothingToTell)
{
  const auto calm = find_oscillation(rows_with([](double) { return 0.; }));
  EXPECT_EQ(calm.verdict, Verdict::decays);
  EXPECT_EQ(calm.extent, 0.);
  EXPECT_EQ(calm.rms, 0.);
  EXPECT_TRUE(std::isnan(calm.frequency));

  auto unknown = rows_with([](double) { return 0.; });
  for (auto &row : unknown)
    row[Column::P_quasi_static] = row[Column::Q_quasi_static] = std::numeric_limits<double>::quiet_NaN();
  auto killed = rows_with([](double) { return 0.; });
  killed.resize(killed.size() / 4);
  for (const auto &rows : { unknown, killed, std::vector<Row>(), std::vector<Row>(1) })
  {
    const auto found = find_oscillation(rows);
    EXPECT_EQ(found.verdict, Verdict::unknown);
    for (const double value : { found.frequency, found.growth_rate, found.open_share, found.overshoot_P, found.overshoot_Q,
                                found.rms, found.rms_end, found.rms_Q, found.extent })
      EXPECT_TRUE(std::isnan(value));
  }
}

TEST(Oscillation, OfTwoRowsAtATurningPointTheSecondCounts)
{
  const Drive instantaneous;
  const double turn = instantaneous.reversals().front();
  auto rows         = rows_with(sinusoid(8., 290., -45.));
  const auto after  = std::find_if(rows.begin(), rows.end(), [turn](const Row &row) { return row[Column::time] > turn; });
  Row at_turn       = *after;

  at_turn[Column::time] = turn;
  Row before            = at_turn;
  before[Column::P]     = quasi_static_P + 300.;
  rows.insert(after, { before, at_turn });
  EXPECT_LT(oscillations(rows, instantaneous).at(0).overshoot_P, 1.);
}

TEST(Oscillation, WindowEndsWhereTheNextReversalBegins)
{
  const Drive quick(DriveProfile::triangle, 0., 6.5, 112., 1.5, duration);
  const auto found = oscillations(rows_with(sinusoid(8., 290., -45.), quick), quick);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_DOUBLE_EQ(found[0].window_end, quick.reversals()[1] - duration / 2.);
  EXPECT_NEAR(found[1].window_end, quick.duration(), 1e-4);
  EXPECT_EQ(found[1].x, 0.);
  EXPECT_NEAR(found[0].frequency, 290., 0.29);
  EXPECT_NEAR(found[0].growth_rate, -45., 0.45);
  EXPECT_LE(found[0].extent, 6.5);
}

// 50 Hz, with a half of it after a period doubling, and two sines whose periods have no common multiple within the signal.
// Between values the interpolation errs by (omega step)^2 / 8 = 1e-4 of the amplitude.
TEST(Recurrence, IsThePeriodOfWhatRepeatsItself)
{
  const auto signal = [](const std::function<double(double)> &value)
  {
    Signal result{ 1.7e-4, {} };
    for (unsigned int i = 0; i < 2400; ++i)
      result.values.push_back(value(i * result.step));
    return result;
  };
  const auto wave   = [](const double frequency, const double t) { return std::sin(2. * M_PI * frequency * t); };
  const auto period = [&](const std::function<double(double)> &value) { return find_recurrence(signal(value)).time; };
  EXPECT_NEAR(period([&](const double t) { return 3. + wave(50., t) + 0.3 * wave(100., t); }), 0.02, 1e-6);
  EXPECT_NEAR(period([&](const double t) { return wave(50., t) + 0.1 * wave(25., t); }), 0.04, 1e-6);
  EXPECT_NEAR(period([&](const double t) { return std::max(0., wave(50., t) + 0.2 * wave(12.5, t)); }), 0.08, 1e-5);
  EXPECT_TRUE(std::isnan(period([&](const double t) { return wave(50., t) + 0.5 * wave(50. * std::sqrt(2.), t); })));
  EXPECT_TRUE(std::isnan(period([](const double) { return 2.; })));
}

TEST(Oscillation, IsToldWhereNoReversalIs)
{
  const auto swing = [](const Deviation &deviation)
  {
    const auto rows = rows_with(deviation);
    return largest_swing(rows, oscillations(rows, there_and_back()), duration);
  };
  const auto wave  = sinusoid(8., 290., 0.);
  const auto found = swing([&](const double time) { return time > 0.2 && time < 0.3 ? wave(time) : 0.; });
  EXPECT_NEAR(found.size, 8., 0.05);
  EXPECT_NEAR(found.x, 65. - 112. * 0.25, 112. * 0.06);
  const auto behind_a_reversal = swing([&](const double time) { return time < 0.09 ? wave(time) : 0.; });
  EXPECT_EQ(behind_a_reversal.size, 0.);
}
