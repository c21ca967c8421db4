// SPDX-License-Identifier: GPL-3.0-only
#include "base/text.h"
#include "messages.h"
#include "results/hdf5.h"
#include "scene/base_motion.h"
#include "scene/damper.h"
#include "scene/scene.h"
#include "support/temporary_folder.h"

#include <cmath>

using namespace sprag;

namespace
{
  IsolationSettings make_base(const BaseMotionType type)
  {
    IsolationSettings settings;
    settings.base = type;
    return settings;
  }

  /// Differences of x, v and a over a short time against v, a and the jerk, relative to the largest of each.
  void expect_derivatives(const BaseMotion &motion, const double from, const double to)
  {
    const double h  = 1e-5;
    double scale[3] = { 0., 0., 0. }, error[3] = { 0., 0., 0. };
    std::size_t piece = 0;
    for (unsigned int i = 1; i < 400; ++i)
    {
      const double t = from + (to - from) * i / 400.;
      while (piece < motion.kinks.size() && motion.kinks[piece] <= t)
        ++piece;
      const bool near_kink =
          (piece < motion.kinks.size() && motion.kinks[piece] < t + h) || (piece > 0 && motion.kinks[piece - 1] > t - h);
      if (near_kink)
        continue;
      const auto before = motion.at(t - h, piece), now = motion.at(t, piece), behind = motion.at(t + h, piece);
      const double found[3]    = { (behind.x - before.x) / (2. * h), (behind.v - before.v) / (2. * h),
                                   (behind.a - before.a) / (2. * h) };
      const double expected[3] = { now.v, now.a, now.jerk };
      for (unsigned int k = 0; k < 3; ++k)
      {
        scale[k] = std::max(scale[k], std::abs(expected[k]));
        error[k] = std::max(error[k], std::abs(found[k] - expected[k]));
      }
    }
    for (unsigned int k = 0; k < 3; ++k)
      EXPECT_LE(error[k], 1e-5 * scale[k] + 1e-9) << k;
  }

  Samples sine_record(const double drift)
  {
    Samples record;
    for (unsigned int i = 0; i <= 2000; ++i)
    {
      const double t = 0.005 * i;
      record.at.push_back(t);
      record.values.push_back(100. * std::sin(2. * M_PI * t) + drift * (1. + t));
    }
    return record;
  }

  const Messages isolation    = { "Analysis/Type=isolation", "Isolation/Damper=constant friction" };
  const Messages record_scene = { "Analysis/Type=isolation", "Isolation/Damper=none", "Isolation/Base motion=record" };

  /// Returns the message about a file of these rows, without its folder.
  std::string find_message(const Messages &scene, const std::string &parameter, const std::string &text)
  {
    const TemporaryFolder folder;
    Messages overrides = scene;
    overrides.push_back(parameter + "=" + folder.write("table.csv", text));
    const auto said = thrown_text([&] { read_scene(folder.write("scene.prm", ""), overrides); });
    return said.empty() ? said : said.substr(said.find("table.csv") + 11);
  }
} // namespace

TEST(BaseMotion, RatesAreDerivatives)
{
  for (const auto type : { BaseMotionType::none, BaseMotionType::harmonic, BaseMotionType::sweep, BaseMotionType::shock })
    expect_derivatives(base_motion(make_base(type)), 0.01, 2.);
  auto settings  = make_base(BaseMotionType::sweep);
  settings.sweep = SweepForm::linear;
  expect_derivatives(base_motion(settings), 0.01, 20.);
  settings       = make_base(BaseMotionType::shock);
  settings.shock = ShockForm::step;
  expect_derivatives(base_motion(settings), 0.01, 2.);
  settings            = make_base(BaseMotionType::record);
  settings.base_table = sine_record(3.);
  expect_derivatives(base_motion(settings), 0.01, 11.);
  settings                   = make_base(BaseMotionType::random);
  settings.highest_frequency = 5.;
  expect_derivatives(base_motion(settings), 0.01, 19.);
}

TEST(BaseMotion, ASweepEndsAtItsFinalFrequency)
{
  for (const auto form : { SweepForm::linear, SweepForm::logarithmic })
  {
    auto settings     = make_base(BaseMotionType::sweep);
    settings.sweep    = form;
    const auto motion = base_motion(settings);
    // Between two zeros of x at the end lies half a period.
    double last = 0., before = 0.;
    for (double t = settings.duration - 0.3; t < settings.duration; t += 1e-5)
      if (motion.at(t, 0).x * motion.at(t + 1e-5, 0).x < 0.)
      {
        before = last;
        last   = t;
      }
    EXPECT_NEAR(0.5 / (last - before), settings.final_frequency, 0.02 * settings.final_frequency);
  }
}

TEST(BaseMotion, AShockEndsAtRestOrAtItsSpeed)
{
  auto settings    = make_base(BaseMotionType::shock);
  const auto pulse = base_motion(settings);
  const double w   = 2. * M_PI * settings.base_frequency;
  EXPECT_NEAR(pulse.at(0.25 / settings.base_frequency, 0).a, settings.base_amplitude * w * w, 1e-9);
  EXPECT_NEAR(pulse.at(pulse.end, 0).v, pulse.at(pulse.end, 1).v, 1e-9);
  EXPECT_NEAR(pulse.at(pulse.end, 0).x, pulse.at(pulse.end, 1).x, 1e-9);
  settings.shock  = ShockForm::step;
  const auto step = base_motion(settings);
  EXPECT_NEAR(step.at(step.end, 0).x, settings.base_amplitude, 1e-9);
  EXPECT_EQ(step.at(5., 1).x, settings.base_amplitude);
  EXPECT_EQ(step.at(5., 1).v, 0.);
}

TEST(BaseMotion, JumpsAreWhereTheAccelerationDoesNotGoOn)
{
  auto shock = make_base(BaseMotionType::shock);
  EXPECT_TRUE(base_motion(shock).jumps.empty());
  shock.shock = ShockForm::step;
  EXPECT_EQ(base_motion(shock).jumps, base_motion(shock).kinks);
  auto record       = make_base(BaseMotionType::record);
  record.base_table = { { 0., 1., 2., 3. }, { 0., 1., -1., 0. } };
  EXPECT_TRUE(base_motion(record).jumps.empty());
  record.base_table.values.back() = 1.;
  EXPECT_EQ(base_motion(record).jumps, std::vector<double>{ 3. });
}

TEST(BaseMotion, ARandomGroundHasItsRootMeanSquareAndItsSeed)
{
  auto settings          = make_base(BaseMotionType::random);
  settings.duration      = 100.;
  const auto compute_rms = [&]
  {
    const auto motion = base_motion(settings);
    double sum        = 0.;
    for (std::size_t i = 1; i < motion.kinks.size(); ++i)
      sum += std::pow(motion.at(motion.kinks[i], i).a, 2);
    return std::sqrt(sum / static_cast<double>(motion.kinks.size()));
  };
  EXPECT_NEAR(compute_rms(), settings.rms_acceleration, 0.02 * settings.rms_acceleration);
  const double first = base_motion(settings).at(0.3, 100).a;
  EXPECT_EQ(base_motion(settings).at(0.3, 100).a, first);
  settings.seed = 2;
  EXPECT_NE(base_motion(settings).at(0.3, 100).a, first);

  settings.spectrum   = BaseSpectrum::table;
  settings.base_table = { { 1., 2., 4., 8. }, { 5., 5., 5., 5. } };
  EXPECT_NEAR(compute_rms(), std::sqrt(5. * 7.), 0.03 * std::sqrt(35.));
  // The line in the logarithms is 320/f^2, whose integral is 280.
  settings.base_table = { { 1., 8. }, { 320., 5. } };
  EXPECT_NEAR(compute_rms(), std::sqrt(280.), 0.03 * std::sqrt(280.));
}

TEST(BaseMotion, KanaiTajimiIsWhiteNoiseFilteredByTheGround)
{
  EXPECT_EQ(kanai_tajimi(0., 2.5, 0.6), 1.);
  EXPECT_NEAR(kanai_tajimi(2.5, 2.5, 0.6), 1. + 1. / (4. * 0.36), 1e-12);
}

TEST(BaseMotion, DriftOfARecordIsTakenOff)
{
  auto settings           = make_base(BaseMotionType::record);
  settings.base_table     = sine_record(3.);
  const double with_drift = base_motion(settings).at(10., 1999).v;
  EXPECT_NEAR(with_drift, 3. * (10. + 50.), 0.1);
  settings.corrects_drift = true;
  const auto motion       = base_motion(settings);
  EXPECT_LT(std::abs(motion.at(10., 1999).v), 100. / M_PI);
  EXPECT_EQ(motion.at(10.5, 2000).a, 0.);
}

TEST(IsolationInput, WhatCannotBeIsRefused)
{
  EXPECT_EQ(find_mistakes(isolation), Messages{});
  EXPECT_EQ(find_mistakes({ "Analysis/Type=isolation", "Analysis/Model=beam" }), Messages{});
  expect_refused({ "Analysis/Type=isolation", "Analysis/Model=rigid" }, { "Contact/Type=ideal" },
                 "must be compliant with Isolation/Damper = lever and a model in time");
  expect_refused({ "Analysis/Type=isolation", "Analysis/Model=beam" }, { "Isolation/Initial displacement=-70" },
                 "must be less than Drive/Stroke = 65 mm either way, for which the levers are made");
  EXPECT_EQ(find_mistakes(isolation, { "Isolation/Base motion=none" }),
            Messages{ "scene.prm: Isolation/Initial displacement = 0: must not be 0 mm with Base motion = none and no Initial "
                      "velocity: nothing moves" });
  EXPECT_EQ(find_mistakes(isolation, { "Isolation/Base motion=record" }),
            Messages{ "scene.prm: Isolation/Base table = : must name a file" });
  EXPECT_EQ(find_mistakes(isolation, { "Isolation/Damper=loop" }),
            Messages{ "scene.prm: Isolation/Loop table = : must name a file" });
  expect_refused(isolation, { "Isolation/Mass=0" }, "must be a number > 0 [t]");
  expect_refused(isolation, { "Isolation/Base motion=shock", "Isolation/End=steady state" },
                 "must be duration but with Base motion = harmonic");
  expect_refused(isolation, { "Isolation/Base motion=random", "Isolation/Highest frequency=0.1" },
                 "must be more than Lowest frequency = 0.2 Hz");
}

TEST(IsolationInput, LeversThatEndOrLockAtTheBeginningAreRefused)
{
  const Messages levers = { "Analysis/Type=isolation", "Analysis/Model=closed form" };
  expect_refused(levers, { "Isolation/Initial displacement=-130" },
                 "must be less than 129.5 mm either way, where the cylinder reaches the lever's pivot, or would slide the other "
                 "way along the lever");
  expect_refused(levers, { "Friction/Law=Coulomb", "Friction/Coefficient=1.6", "Isolation/Initial displacement=120" },
                 "must not be where the damper locks: friction holds the table there whatever pulls it back");
}

TEST(IsolationInput, TheUnitOfARecordScalesIt)
{
  const TemporaryFolder folder;
  const auto file = folder.write("record.csv", "time [s]; acceleration [g]\n0;0\n1;0.5\n2;0.5\n3;0\n");
  const auto scene =
      read_scene(folder.write("scene.prm", ""), { "Analysis/Type=isolation", "Isolation/Damper=none",
                                                  "Isolation/Base motion=record", "Isolation/Base table=" + file });
  EXPECT_NEAR(scene.isolation.base_table.values[1], 4903.325, 1e-9);
  EXPECT_NEAR(base_motion(scene.isolation).at(1., 0).v, 0.5 * 4903.325, 1e-9);
}

namespace
{
  /// Writes a record of four rows as HDF5, with the units given.
  std::string record_with_units(const TemporaryFolder &folder, const std::string &time_unit, const std::string &acceleration_unit)
  {
    const std::string path = folder.path / "record.h5";
    const auto file        = hdf5::create_file(path);
    const auto write       = [&](const std::string &name, const std::vector<double> &values, const std::string &unit)
    {
      const auto dataset = hdf5::write_dataset(file, name, values);
      if (!unit.empty())
        hdf5::write_attribute(dataset, "unit", unit);
    };
    write("time", { 0., 1., 2., 3. }, time_unit);
    write("acceleration", { 0., 0.5, 0.5, 0. }, acceleration_unit);
    return path;
  }

  /// The acceleration in the second row, or what is said about the file.
  std::string read_with_units(const std::string &time_unit, const std::string &acceleration_unit,
                              const std::string &base_unit = "")
  {
    const TemporaryFolder folder;
    Messages overrides = record_scene;
    overrides.push_back("Isolation/Base table=" + record_with_units(folder, time_unit, acceleration_unit));
    if (!base_unit.empty())
      overrides.push_back("Isolation/Base unit=" + base_unit);
    try
    {
      return number_text(read_scene(folder.write("scene.prm", ""), overrides).isolation.base_table.values[1]);
    }
    catch (const InputError &error)
    {
      return error.messages.front();
    }
  }
} // namespace

TEST(IsolationInput, ARecordInHdf5HasTheUnitOfItsDataset)
{
  EXPECT_EQ(read_with_units("s", "m/s^2"), "500");
  EXPECT_EQ(read_with_units("", "mm/s^2"), "0.5");
  EXPECT_EQ(read_with_units("s", "", "cm/s2"), "5");
  EXPECT_EQ(read_with_units("ms", "inch/s2"), "12.7");
  EXPECT_NE(read_with_units("s", "inch/s2", "m/s2").find("its unit is inch/s2, which Isolation/Base unit contradicts"),
            std::string::npos);
  EXPECT_EQ(read_with_units("s", "m/s^2", "m/s2"), "500");
  EXPECT_NE(read_with_units("s", "").find("the unit of the acceleration is not known"), std::string::npos);
  EXPECT_NE(read_with_units("s", "m/s^2", "g").find("its unit is m/s^2, which Isolation/Base unit contradicts"),
            std::string::npos);
  EXPECT_NE(read_with_units("mm", "m/s^2").find("'mm' has the dimension m, s has the dimension s"), std::string::npos);
}

TEST(IsolationInput, TablesThatCannotBeAreRefused)
{
  const auto says = [](const std::string &said, const std::string &part)
  { EXPECT_NE(said.find(part), std::string::npos) << said; };
  const Messages random = { "Analysis/Type=isolation", "Isolation/Damper=none", "Isolation/Base motion=random",
                            "Isolation/Base spectrum=table", "Isolation/Base unit=m/s2" };
  says(find_message(random, "Isolation/Base table", "1,1\n2,-1\n3,1\n4,1\n"), "row 2: density -1: must be >= 0");
  says(find_message(random, "Isolation/Base table", "1,0\n2,0\n3,0\n4,0\n"), "must have a density above 0");
  says(find_message(random, "Isolation/Base table", "1,0\n3,0\n2,0\n4,0\n"),
       "row 3: frequency 2: must be more than in the row before");
  says(find_message(random, "Isolation/Base table", "100,1\n200,1\n300,1\n400,1\n"), "must have densities between");
  const Messages record = { "Analysis/Type=isolation", "Isolation/Damper=none", "Isolation/Base motion=record",
                            "Isolation/Base unit=m/s2" };
  says(find_message(record, "Isolation/Base table", "1,1\n2,1\n3,1\n4,1\n"), "row 1: time 1 s: must be 0");
  const Messages loop = { "Analysis/Type=isolation", "Isolation/Damper=loop" };
  says(find_message(loop, "Isolation/Loop table", "0,0\n1,1\n2,2\n3,3\n"), "on the way back: must have at least 4 rows");
  says(find_message(loop, "Isolation/Loop table", "0,0\n1,1\n2,2\n3,3\n2,4\n1,3\n0,1\n"), "dissipates nothing");
  says(find_message(loop, "Isolation/Loop table", "0,0\n1,1\n2,2\n3,3\n2,-2\n1,-1\n0.5,0\n"), "must be 0 at the end");
  EXPECT_EQ(find_message(loop, "Isolation/Loop table", "0,0\n1,1\n2,2\n3,3\n2,-2\n1,-1\n0,0\n"), "");
  EXPECT_EQ(find_message(loop, "Isolation/Loop table", "0,0\n1,1\n2,2\n3,3\n3,-3\n2,-2\n1,-1\n0,0\n"), "");
  says(find_message(loop, "Isolation/Loop table", "0,0\n1,1\n2,2\n3,3\n3,0\n3,-3\n2,-2\n1,-1\n0,0\n"),
       "does not change steadily");
  const Messages one  = { loop[0], loop[1], "Isolation/Levers=1" };
  const Messages four = { loop[0], loop[1], "Isolation/Levers=4" };
  EXPECT_EQ(find_message(one, "Isolation/Loop table", "0,0\n1,1\n2,2\n3,3\n2,-2\n1,-1\n0,0\n"), "");
  says(find_message(four, "Isolation/Loop table", "0,0\n1,1\n2,2\n3,3\n2,-2\n1,-1\n0,0\n"),
       "must be 1 or left out with Isolation/Damper = loop");
}
