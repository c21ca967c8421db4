// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/stability.h"
#include "analytic/isolation.h"
#include "base/errors.h"
#include "base/ranges.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "mpi_environment.h"
#include "report/report.h"
#include "run/design_checks.h"
#include "run/in_memory.h"
#include "run/run.h"
#include "scene/scene.h"
#include "support/find_value.h"
#include "support/temporary_folder.h"
#include "support/thrown.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  Scene design(const TemporaryFolder &folder, const std::vector<std::string> &changes)
  {
    std::vector<std::string> all = { "Analysis/Type=design" };
    all.insert(all.end(), changes.begin(), changes.end());
    return read_scene(folder.write("scene.prm", ""), all);
  }

  std::string read_output(const TemporaryFolder &folder)
  {
    return (folder.path / "output").string();
  }

  Warnings run_in(const TemporaryFolder &folder, const Scene &scene)
  {
    Warnings warnings;
    run_design(scene, { read_output(folder), true }, warnings);
    return warnings;
  }

  Scene best_scene(const TemporaryFolder &folder, const std::vector<std::string> &changes = {})
  {
    return read_scene(read_output(folder) + "/design-best.prm", changes);
  }

  SlideStability slide_at(const Scene &lever, const double x, const std::string &way, DynamicsMaker &maker)
  {
    return check_slide(prepared(variant(lever, { override_text("Stability/Position", x), "Stability/Direction=" + way })), maker);
  }

  std::vector<Entry> in_time(const Scene &lever)
  {
    InMemory in_memory = run_in_memory();
    Warnings warnings;
    carry_out(prepared(lever), make_options(in_memory), warnings);
    return in_memory.found.summary;
  }
} // namespace

TEST(RunDesign, WritesTheLeverAsASceneThatRuns)
{
  const TemporaryFolder folder;
  run_in(folder, design(folder, { "Design/Free=Rotational spring/Stiffness = 1e4 ... 2e5", "Design/Aim=minimise largest force",
                                  "Design/Demands=damping slope >= 0.12" }));
  const Scene best = best_scene(folder);
  EXPECT_EQ(best.analysis.type, AnalysisType::quasi_static);
  // It holds what the design was given and found, not all parameters.
  EXPECT_EQ(best.specified, (std::set<std::string>{ "Analysis/Model", "Analysis/Type", "Design/Aim", "Design/Demands",
                                                    "Design/Free", "Rotational spring/Stiffness" }));
  // Model A has 0.0898 N/mm with k = 7.4e4 N mm/rad.
  const double c = lever_quantities(best)[DesignQuantity::damping_slope];
  EXPECT_NEAR(c, 0.12, 1e-6);
  EXPECT_NEAR(best.spring.stiffness,
              7.4e4 * 0.12 /
                  lever_quantities(variant(best, { "Rotational spring/Stiffness=7.4e4" }))[DesignQuantity::damping_slope],
              1e-3 * best.spring.stiffness);
  const auto summary = in_time(variant(best, { "Analysis/Type=quasi-static" }));
  EXPECT_NEAR(find_value(summary, "representative_slope_forward") - find_value(summary, "representative_slope_backward"), 0.24,
              1e-5);
}

TEST(RunDesign, WithoutALeverTheNearestIsKept)
{
  const TemporaryFolder folder;
  const Scene scene = design(folder, { "Design/Free=Rotational spring/Stiffness = 1e4 ... 2e5",
                                       "Design/Demands=damping slope >= 0.12; largest force <= 5" });
  const auto text   = thrown_text<AnalysisError>([&] { run_in(folder, scene); });
  EXPECT_NE(text.find("Without 'damping slope >= 0.12' the others can be met"), std::string::npos) << text;
  EXPECT_NE(text.find("Without 'largest force <= 5' the others can be met"), std::string::npos) << text;
  EXPECT_TRUE(std::filesystem::exists(read_output(folder) + "/result.h5"));
  EXPECT_FALSE(std::filesystem::exists(read_output(folder) + "/design-best.prm"));
  EXPECT_NO_THROW(read_scene(read_output(folder) + "/design-nearest.prm"));
}

TEST(RunDesign, ALeverThatFailsItsJudgesIsThatOfTheNearestRound)
{
  const TemporaryFolder folder;
  const Scene scene = design(folder, { "Lever/Depth=6", "Design/Free=Rotational spring/Stiffness = 1e4 ... 2e5",
                                       "Design/Judges=beam", "Design/Demands=largest force = 20 +- 1e-9",
                                       "Design/Aim=minimise largest force", "Design/Judge in time=off", "Design/Rounds=2" });
  const auto text   = thrown_text<AnalysisError>([&] { run_in(folder, scene); });
  EXPECT_NE(text.find("; that of round 2 misses them by the least, "), std::string::npos) << text;
  std::ifstream file(read_output(folder) + "/design-nearest.prm");
  std::string first_line;
  std::getline(file, first_line);
  EXPECT_NE(first_line.find("by the judge beam"), std::string::npos) << first_line;
}

TEST(RunDesign, AJudgeCorrectsTheClosedFormAtEachTolerance)
{
  const TemporaryFolder folder;
  // The closed form knows nothing of the depth: the beam alone sees that a thin lever damps less.
  run_in(folder, design(folder, { "Lever/Depth=8", "Design/Free=Rotational spring/Stiffness = 1e4 ... 5e5", "Design/Judges=beam",
                                  "Design/Demands=damping slope >= 0.1", "Design/Aim=minimise largest force",
                                  "Design/Tolerances=Lever/Depth = 7 ... 9; Rotational spring/Rest angle = -0.002 ... 0",
                                  "Design/Judge in time=off" }));
  // Slopes at x = 0 of the parabola through three slides of the thin beam.
  const auto damping = [&](const std::string &rest_angle)
  {
    const Scene thin = variant(best_scene(folder), { "Analysis/Type=stability", "Analysis/Model=beam", "Lever/Depth=7",
                                                     "Rotational spring/Rest angle=" + rest_angle });
    DynamicsMaker maker;
    const auto Q = [&](const double x, const Direction direction)
    {
      Scene held               = thin;
      held.stability.position  = x;
      held.stability.direction = direction;
      return check_slide(held, maker).slide->forces.Q;
    };
    const auto slope = [&](const Direction direction)
    { return (-2.5 * Q(2., direction) + 4. * Q(4., direction) - 1.5 * Q(6., direction)) / 2.; };
    return 0.5 * (slope(Direction::forward) - slope(Direction::backward));
  };
  const double worst = std::min(damping("0"), damping("-0.002"));
  EXPECT_GE(worst, 0.1 * (1. - 5e-3));
  EXPECT_LE(worst, 0.1 * (1. + 0.01));
}

// A base of 1 mm moves this table at some 25 mm/s, where the cork has four fifths of its mu at the drive's 112 mm/s.
TEST(RunDesign, TakesMuAtTheSpeedOfItsTable)
{
  const TemporaryFolder folder;
  const std::vector<std::string> changes = { "Isolation/Base amplitude=1",
                                             "Isolation/Base frequency=0.75",
                                             "Isolation/Duration=400",
                                             "Design/Free=Rotational spring/Stiffness = 1e4 ... 4e5",
                                             "Design/Demands=friction ratio = 0.3 +- 1e-4",
                                             "Design/Judges=none" };
  EXPECT_TRUE(run_in(folder, design(folder, changes)).empty());
  const Scene best = best_scene(folder, { "Analysis/Type=isolation", "Isolation/End=steady state" });
  IsolationFindings by_time;
  run_isolation(best, by_time, {});
  // Harmonic balance is 2.8 % off at most, the search ends within 1 %.
  const double speed = 2. * M_PI * 0.75 * by_time.relative_amplitude;
  EXPECT_NEAR(best.drive.peak_speed(), speed, 0.04 * speed);
  EXPECT_EQ(run_in(folder, design(folder, joined(changes, std::vector<std::string>{ "Drive/Speed=112" }))).front().name,
            "mu_of_one_speed");
}

TEST(RunDesign, TheTableInTimeCorrectsTheHarmonicBalanceSlow)
{
  const TemporaryFolder folder;
  const std::vector<std::string> table = { "Isolation/Base amplitude=5",
                                           "Isolation/Base frequency=0.75",
                                           "Isolation/Duration=100",
                                           "Design/Free=Rotational spring/Stiffness = 1e4 ... 4e5",
                                           "Design/Aim=minimise largest force",
                                           "Design/Evaluations=200" };
  const auto design_with = [&](const std::vector<std::string> &changes) { return design(folder, joined(table, changes)); };
  EXPECT_TRUE(run_in(folder, design_with({ "Design/Judges=table", "Design/Demands=transmissibility = 3 +- 0.01" })).empty());
  const auto fundamental = [&](const Scene &lever)
  {
    IsolationFindings found;
    run_isolation(lever, found, {});
    return found.fundamental;
  };
  const Scene best = best_scene(folder, { "Analysis/Type=isolation", "Isolation/End=steady state" });
  EXPECT_NEAR(fundamental(best), 3., 0.01);
  // One harmonic alone would lead to another lever.
  DesignSettings asking;
  asking.demanded = { { { DesignQuantity::transmissibility, 0 }, DemandKind::equal, 3., 0.01, {} } };
  DesignQuantities by_one_harmonic;
  add_table_quantities(best, asking, by_one_harmonic);
  EXPECT_GT(by_one_harmonic[DesignQuantity::transmissibility], 3.1);
  // A beam that bends leads to another lever than the one that the table passed.
  const auto warnings =
      run_in(folder, design_with({ "Design/Judges=table, beam", "Design/Demands=transmissibility <= 5; largest force >= 27",
                                   "Lever/Depth=6", "Lever/Moment of inertia=6.45", "Design/Judge in time=off" }));
  EXPECT_EQ(count_text(warnings), "1 warning: judged_another_lever");
}

TEST(RunDesign, ThinnestStableLeverIsAtTheEdgeOfStability)
{
  const TemporaryFolder folder;
  // It grows fastest near x = 30 mm, far from Design/Positions.
  run_in(folder, design(folder, { "Design/Free=Lever/Depth = 3 ... 20", "Design/Judges=beam", "Design/Demands=growth rate <= 0",
                                  "Design/Aim=minimise Lever/Depth", "Design/Judge in time=off", "Design/Positions=2",
                                  "Design/Evaluations=100" }));
  const double depth = best_scene(folder).lever.depth;
  DynamicsMaker maker(false);
  const auto worst = [&](const double beam_depth)
  {
    double growth = -1e30;
    for (double x = 2.5; x < 66.; x += 2.5)
      for (const std::string way : { "forward", "backward" })
        growth = std::max(growth, slide_at(best_scene(folder, { "Analysis/Type=stability", "Analysis/Model=beam",
                                                                override_text("Lever/Depth", beam_depth) }),
                                           x, way, maker)
                                      .growth_rate());
    return growth;
  };
  EXPECT_LE(worst(depth), 0.);
  EXPECT_GT(worst(0.99 * depth), 0.);
}

TEST(RunDesignSlow, LeverIsConfirmedInTimeAndStableAtAllX)
{
  const TemporaryFolder folder;
  std::vector<std::string> changes = { "Condensed/Cache=" + (folder.path / "cache").string() };
  changes.insert(changes.end(),
                 { "Design/Free=Geometry/Cylinder radius = 20 ... 80; Geometry/Interface offset = 0 ... 60; Geometry/Pivot "
                   "distance = 100 ... 250; Rotational spring/Stiffness = 1e4 ... 2e5",
                   "Design/Demands=damping slope = 0.089 +- 0.0005; slope ratio = 1 +- 0.02; jamming margin >= 0.5; nonlinearity "
                   "<= 0.25; largest pressure <= 0.8; growth rate <= 0",
                   "Design/Aim=minimise Geometry/Pivot distance", "Design/Judges=beam, condensed" });
  run_in(folder, design(folder, changes));
  const auto model = [&](const std::string &type) {
    return best_scene(folder, { "Analysis/Type=" + type, "Analysis/Model=condensed", "Output/Fields=none" });
  };
  DynamicsMaker maker(false);
  const Scene held = model("stability");
  for (unsigned int i = 1; i <= 13; ++i)
    for (const std::string way : { "forward", "backward" })
      EXPECT_EQ(slide_at(held, 5. * i, way, maker).kind, SlideKind::stable) << 5. * i << ' ' << way;
  EXPECT_LE(find_value(in_time(model("transient")), "largest_pressure"), 0.8);
}
