// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/choice.h"

#include "base/phase_timer.h"
#include "estimate/expected_cost.h"
#include "input/read.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "support/shipped.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <tuple>

using namespace sprag;

namespace
{
  Scene asked(const std::string &name, std::vector<std::string> overrides)
  {
    overrides.push_back("Output/Fields=none");
    return shipped(name, overrides);
  }

  std::string chosen(const Choice &choice, const std::string &parameter)
  {
    for (const auto &setting : choice.settings)
      if (setting.parameter == parameter)
        return setting.value;
    return "";
  }

  double face_size(const Choice &choice)
  {
    return std::stod(chosen(choice, "Mesh/Face size"));
  }
} // namespace

TEST(Choice, ClosedFormServesWhereItsErrorIsAdmitted)
{
  const Scene scene = asked("model-a", { "Accuracy/Target=0.05", "Analysis/Model=auto" });
  const auto coarse = choose_settings(scene);
  EXPECT_EQ(chosen(coarse, "Analysis/Model"), "closed form");
  EXPECT_LE(coarse.error, 0.05);
  // Just behind the reversal, where P is largest, the closed form is 1.1 % off finite elements.
  const Scene peak = asked("model-a", { "Accuracy/Target=0.01", "Accuracy/Quantity=P", "Analysis/Model=auto" });
  EXPECT_EQ(chosen(choose_settings(peak), "Analysis/Model"), "finite element");
  const Scene pressure =
      asked("model-a", { "Accuracy/Target=0.05", "Analysis/Model=auto", "Accuracy/Quantity=largest_pressure" });
  EXPECT_EQ(chosen(choose_settings(pressure), "Analysis/Model"), "finite element");
}

TEST(Choice, FacesAndStepsShrinkWithTheTarget)
{
  const auto meeting = choose_without_inertia(asked("model-a", { "Accuracy/Target=1e-3" }));
  const auto loose = meeting(1e-2), tight = meeting(1e-4);
  EXPECT_GT(face_size(loose), face_size(tight));
  EXPECT_GT(std::stod(chosen(loose, "Analysis/Step")), 5. * std::stod(chosen(tight, "Analysis/Step")));
  EXPECT_LE(tight.error, 1e-4);
}

// A trial run of the run's own mesh doubles its cost.
TEST(Choice, TrialRunsAreOfMuchLongerFacesThanTheRun)
{
  std::vector<double> tried;
  const auto note = [&](const std::string &sentence, double)
  {
    tried.push_back(std::stod(sentence.substr(sentence.find("faces of ") + 9)));
    return true;
  };
  const auto choice = choose_settings(asked("model-b", { "Accuracy/Target=1e-3", "Accuracy/Quantity=largest_pressure" }), note);
  ASSERT_FALSE(tried.empty());
  EXPECT_GT(tried.back(), 1.5 * face_size(choice));
  for (std::size_t i = 1; i < tried.size(); ++i)
    EXPECT_LT(tried[i], 0.9 * tried[i - 1]);
  tried.clear();
  choose_settings(asked("model-b", { "Accuracy/Target=1e-3", "Accuracy/Quantity=largest_pressure", "Mesh/Face size=1" }), note);
  EXPECT_TRUE(tried.empty());
}

// The machine may be busier from one estimate to the next. The trial runs are part of what is paid.
TEST(Choice, BudgetIsKept)
{
  const auto choose = [](const Scene &scene)
  {
    const double since = PhaseTimer::cpu_seconds();
    auto choice        = choose_settings(scene);
    const double run   = expected_cost(with_settings(scene, choice.settings)).cpu_seconds;
    return std::make_tuple(std::move(choice), PhaseTimer::cpu_seconds() - since, run);
  };
  const auto [loose, trial_runs, run] = choose(asked("model-a", { "Accuracy/Target=0.01" }));
  const double budget                 = trial_runs + 1.5 * run;
  const auto [choice, spent, more] =
      choose(asked("model-a", { "Accuracy/Target=1e-5", "Accuracy/Budget=" + std::to_string(budget) }));
  EXPECT_LE(spent + more, 1.5 * budget);
  EXPECT_NE(choice.limit.find("Accuracy/Budget"), std::string::npos);
}

// A run of a study starts no program and leaves out for which damping its verdict holds. A start takes 0.2 s, the slide of a row
// 1 ms and its scene as much again: 1000 rows cost some 13 starts on any machine.
TEST(ExpectedCost, RowsOfAStudyDoNotStart)
{
  const auto cost = [](std::vector<std::string> changes)
  {
    changes.insert(changes.end(), { "Stability/Critical=none", "Stability/Roles=off" });
    return expected_cost(asked("stability-a", changes)).cpu_seconds;
  };
  const double rows =
      cost({ "Analysis/Type=study", "Study/Type=stability", "Study/Vary=Lever/Modal damping = 0.01 ... 0.02 : 1000" });
  EXPECT_GT(rows, 7. * cost({}));
  EXPECT_LT(rows, 25. * cost({}));
}

// Bases with 5, 20 and 40 modes of model A took 0.13, 0.62 and 0.92 s; a run counts these once beside its steps or slides.
TEST(ExpectedCost, ModesOfABasisCount)
{
  const auto count = [](const std::string &name, const unsigned int modes)
  {
    std::vector<std::string> changes{ "Analysis/Model=condensed", "Condensed/Modes=" + std::to_string(modes) };
    if (name == "stability-a")
      changes.insert(changes.end(), { "Stability/Critical=none", "Stability/Roles=off" });
    return counted_work(asked(name, changes), { { "iterations", 5000. } });
  };
  for (const std::string name : { "reversal-a", "stability-a" })
  {
    const double few = count(name, 5), usual = count(name, 20), many = count(name, 40);
    EXPECT_GT(usual, 1.2 * few);
    EXPECT_NEAR((many - usual) / (usual - few), 20. / 15., 1e-6);
  }
}

// A search looks at 5 slides of each value where the ends of its ranges flutter, else at 33. The limits of stability with the
// scene's constants and with most of those in the ranges take one and some six slides of six values.
TEST(ExpectedCost, SearchesMayLookInsideRangesOrNot)
{
  const std::string ranges = "Stability/Ranges=Contact/Damping 0.01 0.1; Friction/Factor 0.8 1.2";
  const auto slides        = [&](const std::string &critical)
  {
    const double without = expected_cost(asked("stability-a", { ranges, "Stability/Critical=none" })).cpu_seconds;
    return expected_cost(asked("stability-a", { ranges, "Stability/Critical=" + critical })).cpu_seconds / without;
  };
  // A search tries 82 values and narrows one; beside it there are a start of 0.2 s and 25 slides of 0.25 ms.
  const double searched = 82. * std::sqrt(5. * 33.) + 8. + 6. * (1. + 0.7 * 9.);
  EXPECT_NEAR(slides("Lever/Depth 4 6"), 1. + searched / 825., 0.1);
}

TEST(Choice, ABeamServesWhereCoarse)
{
  const Scene scene = asked("reversal-a", { "Accuracy/Target=0.2", "Analysis/Model=auto" });
  EXPECT_EQ(chosen(choose_settings(scene), "Analysis/Model"), "beam");
  const Scene finer = asked("reversal-a", { "Accuracy/Target=0.01", "Analysis/Model=auto" });
  const auto choice = choose_settings(finer);
  EXPECT_EQ(chosen(choice, "Analysis/Model"), "condensed");
  EXPECT_NEAR(std::stod(chosen(choice, "Time/Tolerance")), 0.002, 1e-9);
}

namespace
{
  /// On a coarse mesh and a short way, to be cheap.
  Choice dimension_for(std::vector<std::string> overrides)
  {
    for (const char *const cheap : { "Analysis/Dimension=auto", "Mesh/Face size=4", "Mesh/Elements across=4", "Drive/Stroke=20" })
      overrides.emplace_back(cheap);
    return choose_settings(asked("solid-tilted-a", overrides));
  }
} // namespace

TEST(Choice, ThreeDimensionsAreTakenWhereThePlaneIsOffByMoreThanIsAskedForSlow)
{
  EXPECT_EQ(chosen(dimension_for({}), "Analysis/Dimension"), "2");
  EXPECT_EQ(chosen(dimension_for({ "Cylinder/Length=22" }), "Analysis/Dimension"), "2"); // P and Q alone
  const std::string pressure = "Accuracy/Quantity=largest_pressure";
  EXPECT_EQ(chosen(dimension_for({ pressure }), "Analysis/Dimension"), "3");
  EXPECT_EQ(chosen(dimension_for({ pressure, "Cylinder/Tilt=1e-7", "Accuracy/Target=0.2" }), "Analysis/Dimension"), "2");
}

TEST(Choice, InThreeDimensionsTheRestIsChosenByThePlane)
{
  const auto choice = dimension_for({ "Accuracy/Quantity=largest_pressure", "Accuracy/Target=0.05" });
  EXPECT_EQ(chosen(choice, "Analysis/Dimension"), "3");
  EXPECT_NE(chosen(choice, "Analysis/Step"), "");
}

TEST(Choice, ASlideOfAThinLeverTakesThreeDimensionsForItsGrowthSlow)
{
  std::vector<std::string> cheap = { "Analysis/Dimension=auto", "Mesh/Elements across=2", "Mesh/Face size=4" };
  const auto choice              = choose_settings(asked("solid-stability-a", cheap));
  ASSERT_EQ(choice.settings.size(), 1u);
  EXPECT_EQ(choice.settings.front().value, "3");
  EXPECT_NE(choice.settings.front().reason.find("growth_rate"), std::string::npos);
  cheap.push_back("Accuracy/Quantity=frequency");
  EXPECT_EQ(chosen(choose_settings(asked("solid-stability-a", cheap)), "Analysis/Dimension"), "2");
}
