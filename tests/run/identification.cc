// SPDX-License-Identifier: GPL-3.0-only
#include "base/errors.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "mpi_environment.h"
#include "results/hdf5.h"
#include "run/run.h"
#include "scene/closed_form.h"
#include "scene/held_slide.h"
#include "scene/scene.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Changes = std::vector<std::string>;

  class RunIdentification : public ::testing::Test
  {
  protected:
    const TemporaryFolder folder;
    const std::string output = (folder.path / "output").string();

    void SetUp() override
    {
      // The measurement is a run of model A without inertia.
      const auto device = read(
          { "Analysis/Type=quasi-static", "Analysis/Model=closed form", "Friction/Law=Coulomb", "Friction/Coefficient=0.73" });
      run(device, (folder.path / "measured").string());
    }

    Scene read(const Changes &changes) const
    {
      return read_scene(folder.write("scene.prm", ""), changes);
    }

    Scene identification(const Changes &more) const
    {
      Changes all = { "Analysis/Type=identification", "Friction/Law=Coulomb", "Friction/Coefficient=0.5",
                      "Identification/Table=measured/result.h5" };
      all.insert(all.end(), more.begin(), more.end());
      return read(all);
    }

    static Warnings run(const Scene &scene, const std::string &into)
    {
      Warnings warnings;
      carry_out(prepared(scene), { into, true }, warnings);
      return warnings;
    }
  };
} // namespace

TEST_F(RunIdentification, WritesTheSceneWithWhatItFound)
{
  const auto warnings = run(identification({ "Identification/Unknowns=mu, k, e, th0", "Rotational spring/Stiffness=6e4",
                                             "Geometry/Interface offset=45" }),
                            output);
  EXPECT_TRUE(warnings.empty());
  const auto found = read_scene(output + "/identified.prm", {});
  EXPECT_EQ(found.analysis.type, AnalysisType::quasi_static);
  EXPECT_NEAR(std::get<CoulombFriction>(found.friction.law).coefficient, 0.73, 1e-5);
  EXPECT_NEAR(found.spring.stiffness, 7.4e4, 1.);
  EXPECT_NEAR(found.geometry.interface_offset, 45.6, 1e-3);
  EXPECT_NEAR(found.geometry.pivot_height, 0., 1e-3);
  EXPECT_NEAR(kinematics(found.geometry, 0.).theta, 0.0560941, 1e-5);
  EXPECT_EQ(found.stability.ranges, "none"); // no noise, no interval
}

TEST_F(RunIdentification, WritesItsIntervalsAsRangesOfAVerdict)
{
  const auto find_ranges = [&](const Changes &changes)
  {
    run(shipped("identification-a", changes), output);
    return uncertain_ranges(read_scene(output + "/identified.prm", {})).value();
  };
  const auto ranges = find_ranges({ "Identification/Unknowns=mu, k, e, th0" });
  ASSERT_EQ(ranges.size(), 4u);
  EXPECT_EQ(ranges[0].name, "Friction/Coefficient");
  EXPECT_EQ(ranges[3].name, "Geometry/Pivot height");
  // k = 7.345e4 +- 1.6e3 N mm/rad
  EXPECT_EQ(ranges[1].name, "Rotational spring/Stiffness");
  EXPECT_NEAR(ranges[1].from, 7.184e4, 5.);
  EXPECT_NEAR(ranges[1].to, 7.506e4, 5.);
  // A rest angle of 1.7e-5 +- 3e-5 rad, where a scene admits none above 0.
  const auto preloaded = find_ranges({ "Identification/Unknowns=mu, k, rest" });
  ASSERT_EQ(preloaded.size(), 3u);
  EXPECT_EQ(preloaded[2].to, 0.);
  EXPECT_EQ(read_scene(output + "/identified.prm", {}).spring.rest_angle, 0.);
}

TEST_F(RunIdentification, WritesALawOfFrictionAsATable)
{
  run(identification({ "Identification/Unknowns=mu table", "Identification/Friction speeds=60, 80, 100, 120" }), output);
  const auto found = read_scene(output + "/identified.prm", {});
  EXPECT_TRUE(std::holds_alternative<TabulatedFriction>(found.friction.law));
  EXPECT_NEAR(closed_form(found, 30., 112.).mu, 0.73, 1e-3);
  EXPECT_TRUE(std::filesystem::exists(output + "/identified-friction.csv"));
}

TEST_F(RunIdentification, WarnsOfWhatTheDataCannotTell)
{
  const auto warnings =
      run(identification({ "Identification/Unknowns=mu table", "Identification/Friction speeds=100, 300, 400, 500" }), output);
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings.front().name, "indistinct_unknowns");
  EXPECT_NE(warnings.front().found.find("do not tell mu_at_500."), std::string::npos) << warnings.front().found;
}

TEST_F(RunIdentification, WarnsWhereTheModelDoesNotFollow)
{
  const auto warnings = run(identification({ "Identification/Unknowns=mu, k, e", "Geometry/Cylinder radius=58.5" }), output);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings.front().name, "model_does_not_follow");
  EXPECT_NE(warnings.front().found.find(" independent ones"), std::string::npos) << warnings.front().found;
  // The measured cylinder has 56 mm. To first order the scale of Q does to this stroke what a radius does.
  EXPECT_EQ(warnings.front().remedy.rfind("Check the scale of Q (by about 5.", 0), 0u) << warnings.front().remedy;
  EXPECT_NE(warnings.front().remedy.find("Geometry/Cylinder radius"), std::string::npos) << warnings.front().remedy;
}

TEST_F(RunIdentification, NamesForcesOfTheWrongSignOrExchanged)
{
  using Channels  = std::vector<ForceChannel>;
  const auto turn = [](const MeasuredForce force)
  {
    return [force](Channels &channels)
    {
      for (auto &channel : channels)
        for (double &value : channel.values)
          value *= channel.force == force ? -1. : 1.;
    };
  };
  const auto exchange = [](Channels &channels) { std::swap(channels.at(0).values, channels.at(1).values); };
  const std::vector<std::pair<std::function<void(Channels &)>, std::string>> mistakes = {
    { turn(MeasuredForce::normal), "Turn the sign of P" },
    { turn(MeasuredForce::drive), "Turn the sign of Q" },
    { exchange, "Exchange P and Q" },
  };
  for (const auto &[mistake, remedy] : mistakes)
  {
    Scene scene = identification({ "Identification/Unknowns=mu, k" });
    mistake(scene.identification.measured.channels);
    Warnings warnings;
    try
    {
      carry_out(prepared(scene), { output, true }, warnings);
    }
    catch (const AnalysisError &)
    {
      // The values found need not make a lever.
    }
    ASSERT_FALSE(warnings.empty()) << remedy;
    EXPECT_EQ(warnings.front().remedy.rfind(remedy, 0), 0u) << warnings.front().remedy;
  }
}

TEST_F(RunIdentification, KeepsWhyNothingWasFound)
{
  EXPECT_THROW(run(identification({ "Identification/Unknowns=mu", "Identification/Reversal window=64.9" }), output),
               AnalysisError);
  const auto status = hdf5::read_text(hdf5::open_file(output + "/result.h5"), "summary/status");
  EXPECT_NE(status.find("too few for 1 unknowns"), std::string::npos) << status;
  EXPECT_FALSE(std::filesystem::exists(output + "/identified.prm"));
}
