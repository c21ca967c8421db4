// SPDX-License-Identifier: GPL-3.0-only
#include "input/check.h"

#include "scene/messages.h"
#include "scene/scene.h"

using namespace sprag;

namespace
{
  const Messages frame = { "Lever/Outline=frame" };
  const Messages plate = { "Friction plate/Type=on sensors" };
} // namespace

TEST(CheckPlate, DefaultsFitModelsAAndB)
{
  for (const Messages &model : { Messages{}, geometry_b })
    for (const Messages &parts : { frame, plate, Messages{ frame[0], plate[0] } })
      EXPECT_EQ(find_mistakes(parts, model), Messages{});
}

TEST(CheckPlate, FlangesMustLeaveRoomBetweenThem)
{
  expect_refused(frame, { "Lever frame/Flange=6" }, "must be less than half the arm's least depth, 12 mm");
  EXPECT_EQ(find_mistakes(frame, { "Lever/Depth=7" }),
            (Messages{ "scene.prm: Lever frame/Flange = 4: must be less than half the arm's least depth, 7 mm" }));
  EXPECT_EQ(find_mistakes({ "Lever frame/Flange=6" }), Messages{});
}

TEST(CheckPlate, TheWebIsNoWiderThanTheLever)
{
  expect_refused(frame, { "Lever frame/Web=41" }, "must not be more than Lever/Width = 40 mm");
  EXPECT_EQ(find_mistakes(frame, { "Lever frame/Web=40" }), Messages{});
}

TEST(CheckPlate, PocketsAndRibsMustFitTheArm)
{
  // 4 ribs of 45 mm are as long as the arm, 210 - 30.
  EXPECT_EQ(find_mistakes(frame, { "Lever frame/Rib=45" }),
            (Messages{ "scene.prm: Lever frame/Pockets = 3: must leave the pockets room: 4 ribs of 45 mm are no shorter than the "
                       "arm, 180 mm" }));
  EXPECT_EQ(find_mistakes(frame, { "Lever frame/Pockets=0" }), Messages{});
}

TEST(CheckPlate, TheRootHoldsItsHubAndLeavesRoomForTheCylinder)
{
  expect_refused(frame, { "Lever frame/Root=10" },
                 "must be more than 10 mm, radius and wall of the hub that the root is held by");
  // s = sqrt(120.5^2 - 10.4^2) = 120.05 mm at x = 65 mm; 64.2 mm from the root's edge the cylinder of 56 mm passes at less.
  const auto found = find_mistakes(frame, { "Lever frame/Root=64.5" });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("must leave room for the cylinder, whose axis comes as near to the root as 55.5"), std::string::npos)
      << found[0];
}

TEST(CheckPlate, TheContactStaysOnTheFaceOfTheFrame)
{
  const auto found =
      find_mistakes(frame, { "Geometry/Cylinder radius=21.1", "Geometry/Interface offset=0", "Geometry/Pivot distance=193.9",
                             "Drive/Stroke=150", "Lever frame/Root=15", "Lever frame/Rib=25" });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("the friction face begins behind root and rib at 40 mm"), std::string::npos) << found[0];
}

TEST(CheckPlate, SensorsMustBeTwoInOrderAndOnThePlate)
{
  expect_refused(plate, { "Friction plate/Sensors=105" }, "must be at least two, or the plate tilts");
  expect_refused(plate, { "Friction plate/Sensors=105, 110" },
                 "must increase by at least Sensor length = 6 mm from one to the next: 105 and 110 mm");
  EXPECT_EQ(find_mistakes(plate, { "Friction plate/Sensors=105, 111" }), Messages{});
  const std::string rule = "must lie on the plate with all its Sensor length = 6 mm: ";
  expect_refused(plate, { "Friction plate/Sensors=97, 150" }, rule + "97 mm is no middle between Begin = 95 mm and End = 205 mm");
  expect_refused(plate, { "Friction plate/Guide=203" }, rule + "203 mm is no middle between Begin = 95 mm and End = 205 mm");
}

TEST(CheckPlate, ThePlateLiesUnderTheContactAndBeforeTheTip)
{
  expect_refused(plate, { "Friction plate/End=211" }, "must not be more than Lever/Length = 210 mm");
  EXPECT_EQ(find_mistakes(plate, { "Friction plate/End=90" })[0],
            "--set: Friction plate/End = 90: must be more than Begin = 95 mm");
  // s = 120.05 mm at x = 65 mm and 185.21 mm at x = 0.
  const auto begin = find_mistakes(plate, { "Friction plate/Begin=119", "Friction plate/Sensors=130, 195" });
  ASSERT_EQ(begin.size(), 1u);
  EXPECT_EQ(begin[0], "--set: Friction plate/Begin = 119: must be at most 118.05 mm: the cylinder comes as near to the pivot as "
                      "s = 120.05 mm");
  const auto end = find_mistakes(plate, { "Friction plate/End=187", "Friction plate/Sensors=105, 180" });
  ASSERT_EQ(end.size(), 1u);
  EXPECT_EQ(end[0], "--set: Friction plate/End = 187: must be at least 187.208 mm: the cylinder goes as far as s = 185.208 mm");
  const auto root = find_mistakes({ frame[0], plate[0] }, { "Lever frame/Root=96" });
  ASSERT_EQ(root.size(), 2u);
  EXPECT_EQ(root[0], "scene.prm: Friction plate/Begin = 95: must not be less than Lever frame/Root = 96 mm");
}

TEST(CheckPlate, OnlyMeshesAreBuilt)
{
  const Messages wrong = { "Friction plate/Sensors=105", "Lever frame/Flange=6" };
  for (const std::string model : { "rigid", "beam", "closed form" })
    EXPECT_EQ(find_mistakes(transient(model), { frame[0], plate[0], wrong[0], wrong[1] }), Messages{}) << model;
}

TEST(CheckPlate, InThreeDimensionsSensorsLieOnTheirSideOfThePlate)
{
  const Messages solid = { plate[0], "Analysis/Dimension=3" };
  EXPECT_EQ(find_mistakes(solid), Messages{});
  EXPECT_EQ(find_mistakes(solid, { "Friction plate/Sensor width=20" }), Messages{});
  EXPECT_EQ(find_mistakes(solid, { "Friction plate/Sensors across=3" }), Messages{});
  expect_refused(solid, { "Friction plate/Sensor width=21" },
                 "must be at most half of Lever/Width = 40 mm, or left and right overlap");
  for (const std::string across : { "2.9", "17.1" })
    expect_refused(solid, { "Friction plate/Sensors across=" + across },
                   "must be 3 to 17 mm: with all its Sensor width = 6 mm each lies on its side of the middle and on the plate");
  EXPECT_EQ(find_mistakes(plate, { "Friction plate/Sensors across=30" }), Messages{});
  EXPECT_EQ(find_mistakes(solid, { "Analysis/Type=modal", "Analysis/Model=condensed" }), Messages{});
}
