// SPDX-License-Identifier: GPL-3.0-only
#include "input/own_units.h"

#include "input/read.h"
#include "scene/held_slide.h"
#include "scene/messages.h"
#include "scene/scene.h"

#include <cmath>

using namespace sprag;

namespace
{
  const Messages map = { "Analysis/Type=map", "Analysis/Model=beam", "Map/First to=120 %", "Map/Second parameter=Lever/Depth",
                         "Map/Second to=25 mm" };

  /// One message, which begins so.
  void expect_message(const Messages &overrides, const std::string &beginning)
  {
    const auto found = find_mistakes(overrides);
    ASSERT_EQ(found.size(), 1u) << beginning;
    EXPECT_EQ(found[0].substr(0, beginning.size()), beginning);
  }

  Messages with(Messages all, const std::string &one)
  {
    all.push_back(one);
    return all;
  }
} // namespace

TEST(OwnUnits, EndsOfAMapHaveThatOfItsParameter)
{
  const auto scene = make_scene(with(map, "Map/Second from=0.3 cm"));
  EXPECT_DOUBLE_EQ(scene.map.second.from, 3.);
  EXPECT_DOUBLE_EQ(scene.map.second.to, 25.);
  EXPECT_DOUBLE_EQ(scene.map.first.to, 1.2);
  EXPECT_EQ(scene.parameters->at("Map/Second from"), "3");
  EXPECT_NE(parameters_text(scene).find("given as 0.3 cm"), std::string::npos);
  expect_message(with(map, "Map/Second from=3 N"), "--set: Map/Second from = 3 N: must be a number [mm]: 'N' has");
}

TEST(OwnUnits, StiffnessOfTheContactFollowsItsExponent)
{
  const auto stiffness = [](const std::string &value, const std::string &exponent)
  {
    return make_scene({ "Analysis/Type=transient", "Analysis/Model=rigid", "Contact/Stiffness=" + value,
                        "Contact/Exponent=" + exponent })
        .contact.stiffness;
  };
  EXPECT_DOUBLE_EQ(stiffness("2 kN/mm^n", "1.5"), 2000.);
  EXPECT_DOUBLE_EQ(stiffness("2 kN/mm^1.5", "1.5"), 2000.);
  EXPECT_DOUBLE_EQ(stiffness("2 kN/mm", "1"), 2000.);
  EXPECT_NEAR(stiffness("2 MN/m^n", "1.5"), 2e6 / std::pow(1000., 1.5), 1e-9);
  for (const std::string wrong : { "2 kN/mm", "2 kN/mm^2", "2 kg/mm^1.5", "2 kN", "-2 kN/mm^n" })
    expect_message({ "Analysis/Type=transient", "Analysis/Model=rigid", "Contact/Exponent=1.5", "Contact/Stiffness=" + wrong },
                   "--set: Contact/Stiffness = " + wrong + ": must be a number > 0 [N/mm^n]");
}

TEST(OwnUnits, EndsOfASearchHaveThatOfItsParameter)
{
  const auto searches = [](const std::string &text)
  {
    return critical_searches(make_scene({ "Analysis/Type=stability", "Analysis/Model=beam", "Stability/Critical=" + text }))
        .value();
  };
  const auto found = searches("Rotational spring/Stiffness 10 200 N m/rad; Lever/Depth 3mm 2.5 cm; Friction/Factor 50 % 200 %");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].name, "Rotational spring/Stiffness");
  EXPECT_DOUBLE_EQ(found[0].from, 1e4);
  EXPECT_DOUBLE_EQ(found[0].to, 2e5);
  EXPECT_DOUBLE_EQ(found[1].from, 3.);
  EXPECT_DOUBLE_EQ(found[1].to, 25.);
  EXPECT_DOUBLE_EQ(found[2].from, 0.5);
  for (const std::string wrong :
       { "Lever/Depth 3 N 20 mm", "Lever/Depth 3 mm", "Lever/Depth mm 3 20", "Lever/Depth 3 mm 20", "Friction/Factor 0.5 200 %" })
    EXPECT_EQ(find_mistakes({ "Analysis/Type=stability", "Analysis/Model=beam", "Stability/Critical=" + wrong }).size(), 1u)
        << wrong;
}

TEST(OwnUnits, BoundsAndDemandsOfADesignHaveThoseOfTheirQuantities)
{
  const auto scene   = make_scene({ "Analysis/Type=design", "Design/Free=Rotational spring/Stiffness = 10 ... 200 N m/rad",
                                    "Design/Demands=damping slope = 0.1 kN/m +- 1 N/m; Rotational spring/Stiffness <= 0.1 kN m/rad",
                                    "Design/Aim=minimise largest force" });
  const auto &design = scene.design;
  ASSERT_EQ(design.free_parameters.size(), 1u);
  EXPECT_DOUBLE_EQ(design.free_parameters[0].from, 1e4);
  EXPECT_DOUBLE_EQ(design.free_parameters[0].to, 2e5);
  ASSERT_EQ(design.demanded.size(), 2u);
  EXPECT_DOUBLE_EQ(design.demanded[0].target, 0.1);
  EXPECT_DOUBLE_EQ(design.demanded[0].tolerance, 1e-3);
  EXPECT_DOUBLE_EQ(design.demanded[1].target, 1e5);
  const auto narrow = make_scene({ "Analysis/Type=design", "Design/Demands=damping slope = 80 +- 1 N/m" });
  EXPECT_DOUBLE_EQ(narrow.design.demanded[0].target, 0.08);
  expect_message({ "Analysis/Type=design", "Design/Demands=damping slope = 80 N/m +- 1" },
                 "--set: Design/Demands = damping slope = 80 N/m +- 1: 'damping slope = 80 N/m +- 1': 80 N/m and 1 has numbers");
  expect_message({ "Analysis/Type=design", "Design/Demands=slope ratio = 1 +- 25 %" },
                 "--set: Design/Demands = slope ratio = 1 +- 25 %: 'slope ratio = 1 +- 25 %': 1 and 25 % has numbers");
  expect_message({ "Analysis/Type=design", "Design/Free=Lever/Depth = 1 cm ... 25" },
                 "--set: Design/Free = Lever/Depth = 1 cm ... 25: 'Lever/Depth': 1 cm and 25 has numbers");
  expect_message(
      { "Analysis/Type=design", "Design/Demands=damping slope = 0.1 MPa +- 1 MPa" },
      "--set: Design/Demands = damping slope = 0.1 MPa +- 1 MPa: 'damping slope = 0.1 MPa +- 1 MPa': 0.1 MPa must be a number "
      "[N/mm]: 'MPa' has");
}
