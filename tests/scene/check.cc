// SPDX-License-Identifier: GPL-3.0-only
#include "input/check.h"

#include "base/ranges.h"
#include "scene/messages.h"
#include "scene/scene.h"

using namespace sprag;

TEST(CheckScene, CylinderMustFitLeverAndPivot)
{
  expect_refused({ "Geometry/Interface offset=60" }, "must be less than Cylinder radius R = 56 mm");
  expect_refused({ "Geometry/Pivot distance=50" },
                 "must be more than Cylinder radius R = 56 mm, or the cylinder reaches the pivot");
  expect_refused({ "Geometry/Pivot height=10.4" }, "must be less than R - e = 10.4 mm, or theta_0 is not positive");
}

TEST(CheckScene, StrokeMustNotReachThePivot)
{
  expect_refused({ "Drive/Stroke=129.5" },
                 "x must stay below 129.5 mm, where the cylinder reaches the pivot: (l - x)^2 + h^2 = R^2");
  EXPECT_TRUE(find_mistakes({ "Drive/Stroke=129" }).empty());
  // sqrt(56^2 - 10^2) = 55.1 mm before the pivot
  EXPECT_EQ(find_mistakes({ "Drive/Stroke=131", "Geometry/Pivot height=10" }).size(), 1u);
  EXPECT_TRUE(find_mistakes({ "Drive/Stroke=130", "Geometry/Pivot height=10" }).empty());
}

TEST(CheckScene, LockingIsRefusedForTheClosedFormOnly)
{
  // Above mu = sqrt((2-eb)/eb) = 1.2067 model A locks before the cylinder reaches its pivot at x = 129.5.
  const Messages scene = { "Drive/Stroke=129", "Friction/Law=Coulomb", "Friction/Coefficient=1.3", "Analysis/Model=closed form" };
  const auto found     = find_mistakes(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rfind("--set: Drive/Stroke = 129: must not lock: moving back at x = 12", 0), 0u) << found[0];
  EXPECT_NE(found[0].find("mu e = 59.28 mm with mu = 1.3"), std::string::npos) << found[0];

  EXPECT_TRUE(find_mistakes({ scene[0], scene[1], scene[2] }).empty());
  EXPECT_TRUE(find_mistakes({ scene[0], scene[1], scene[3], "Friction/Coefficient=1.2" }).empty());
  EXPECT_TRUE(find_mistakes({ scene[0], scene[1], scene[2], scene[3], "Drive/Cycles=0.5" }).empty());
}

TEST(CheckScene, ContactMustLieOnTheLever)
{
  const auto found = find_mistakes({ "Lever/Length=180" });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(
      found[0],
      "--set: Lever/Length = 180: must be at least 187.208 mm: at x = 0 mm the cylinder touches the lever at s = 185.208 mm");
  EXPECT_TRUE(find_mistakes({ "Lever/Length=180", "Analysis/Model=closed form" }).empty());
  EXPECT_TRUE(find_mistakes({ "Lever/Length=180", "Drive/Start=20" }).empty());
}

TEST(CheckScene, WhatThisVersionCannotDoIsRefused)
{
  EXPECT_TRUE(find_mistakes({ "Analysis/Dimension=3" }).empty());
  EXPECT_EQ(find_mistakes({ "Analysis/Dimension=3", "Analysis/Type=stability" }).size(), 1u); // the model
  for (const std::string type : { "stability", "sprag slip", "map", "modal", "transient" })
    EXPECT_TRUE(find_mistakes({ "Analysis/Dimension=3", "Analysis/Type=" + type, "Analysis/Model=condensed" }).empty()) << type;
  EXPECT_EQ(find_mistakes({ "Analysis/Dimension=3", "Analysis/Type=contact law" }).size(), 2u); // type and model
  EXPECT_TRUE(find_mistakes({ "Analysis/Dimension=auto" }).empty());
  EXPECT_EQ(find_mistakes({ "Analysis/Dimension=auto", "Cylinder/Type=solid" }).size(), 1u);
  EXPECT_EQ(find_mistakes({ "Analysis/Dimension=auto", "Analysis/Type=modal", "Analysis/Model=condensed" }),
            (Messages{ "--set: Analysis/Dimension = auto: auto is for Analysis/Type = quasi-static, stability and transient" }));
  EXPECT_EQ(find_mistakes({ "Analysis/Dimension=3", "Analysis/Type=transient", "Analysis/Model=beam" }).size(), 1u);
  for (const std::string part : { "Lever/Tip mass=1e-5", "Rotational spring/Type=leaf" })
    EXPECT_TRUE(find_mistakes({ "Analysis/Dimension=3", "Analysis/Type=transient", "Analysis/Model=condensed", part }).empty())
        << part;
  EXPECT_EQ(find_mistakes({ "Analysis/Dimension=3", "Lever/Outline=frame", "Mirrored pair/Type=full", "Cylinder/Type=solid",
                            "Contact/Enforcement=augmented Lagrangian" })
                .size(),
            1u);
  expect_refused({ "Analysis/Dimension=3", "Mirrored pair/Type=full", "Cylinder/Skew stiffness=1e6" },
                 "must be auto between the levers of a full pair: an axis that yields to both is not looked at yet");
  EXPECT_EQ(
      find_mistakes({ "Analysis/Dimension=3", "Cylinder/Length=10", "Cylinder/Position=26", "Cylinder/Edge radius=6" }).size(),
      2u);
  const std::vector<std::string> equal = { "Analysis/Dimension=3", "Mesh/Growth across=1" }; // ten elements of 4 mm
  EXPECT_EQ(
      find_mistakes(joined(equal, { "Cylinder/Length=7.9" })),
      (Messages{ "--set: Cylinder/Length = 7.9: must cover at least 8 mm of the lever's width, two elements across, which are "
                 "4 mm wide under it: raise Mesh/Elements across, or lower Growth across" }));
  EXPECT_EQ(find_mistakes(joined(equal, { "Cylinder/Length=14", "Cylinder/Position=-20" })).size(), 1u); // covers 7
  EXPECT_TRUE(find_mistakes(joined(equal, { "Cylinder/Length=8" })).empty());
  EXPECT_TRUE(find_mistakes(joined(equal, { "Cylinder/Length=40", "Mesh/Elements across=1" })).empty());
  expect_refused({ "Analysis/Minimum step=2" }, "must not be more than Step = 1 mm");
  EXPECT_TRUE(find_mistakes({ "Lever/Material=neo-Hookean", "Analysis/Plane=strain" }).empty());
}

TEST(CheckScene, MeshFileMustBeOne)
{
  written("", "lever.stl");
  expect_refused({ "Mesh/File=lever.stl" }, "must end in .geo or .msh");
  expect_refused({ "Mesh/File=none.msh" }, "cannot be read");
}

TEST(CheckScene, PenaltiesThatNoContactConvergesWithAreRefused)
{
  const auto refusal = [](const std::string &largest)
  {
    return ": must be <= " + largest +
           " N/mm3 for this layer and mesh: a stiffer one moves P by less than 1e-4, lets single points carry the pressure and "
           "lets Newton's method fail; leave it at auto";
  };
  EXPECT_EQ(find_mistakes({ "Contact/Penalty=1e8" }), (Messages{ "--set: Contact/Penalty = 1e8" + refusal("24000") }));
  EXPECT_TRUE(find_mistakes({ "Contact/Penalty=24000" }).empty());
  EXPECT_TRUE(find_mistakes({ "Contact/Penalty=40000", "Mesh/Face size=0.125" }).empty());
  EXPECT_EQ(find_mistakes({ "Contact/Penalty=1e8", "Friction layer/Thickness=0" }),
            (Messages{ "--set: Contact/Penalty = 1e8" + refusal("2.8e+07") }));
  EXPECT_EQ(find_mistakes({ "Contact/Tangential penalty=4e5" }).size(), 1u);
  EXPECT_EQ(find_mistakes({ "Contact/Penalty=1e8", "Analysis/Type=stability", "Analysis/Model=condensed" }).size(), 1u);
  EXPECT_EQ(find_mistakes({ "Contact/Penalty=1e8", "Analysis/Type=contact law" }).size(), 1u);
  EXPECT_TRUE(find_mistakes({ "Contact/Penalty=1e8", "Analysis/Model=closed form" }).empty());
}

TEST(CheckScene, ModelsOfTheLeverNeedInertia)
{
  for (const std::string model : { "rigid", "beam", "condensed" })
  {
    EXPECT_EQ(find_mistakes({ "Analysis/Model=" + model }),
              (Messages{ "--set: Analysis/Model = " + model +
                         ": needs Analysis/Type = transient: without inertia there are closed form and finite element" }));
    EXPECT_TRUE(find_mistakes(transient(model)).empty());
    EXPECT_TRUE(find_mistakes({ "Analysis/Type=slope", "Analysis/Model=" + model }).empty());
    EXPECT_TRUE(find_mistakes({ "Analysis/Type=contact law", "Analysis/Model=" + model }).empty());
  }
  EXPECT_TRUE(find_mistakes(transient("closed form")).empty());
  EXPECT_TRUE(find_mistakes(transient("finite element")).empty());
}

TEST(CheckScene, TransientFiniteElementsAreLinear)
{
  for (const std::string model : { "condensed", "finite element" })
    EXPECT_EQ(find_mistakes(transient(model), { "Lever/Material=neo-Hookean", "Analysis/Solution=general",
                                                "Contact/Enforcement=augmented Lagrangian", "Lever/Neutral axis offset=3" }),
              (Messages{ "--set: Lever/Neutral axis offset = 3: must be auto, the finite elements have their own; only rigid and "
                         "beam take another",
                         "--set: Lever/Material = neo-Hookean: must be linear with Analysis/Type = transient",
                         "--set: Analysis/Solution = general: must be automatic with Analysis/Type = transient",
                         "--set: Contact/Enforcement = augmented Lagrangian: must be penalty with Analysis/Type = transient" }));
}

TEST(CheckScene, IdealContactNeedsARigidLever)
{
  const Messages ideal = { "Contact/Type=ideal" };
  for (const std::string model : { "beam", "condensed", "finite element" })
    EXPECT_EQ(find_mistakes(transient(model), ideal),
              (Messages{ "--set: Contact/Type = ideal: ideal needs Analysis/Model = rigid" }));
  EXPECT_TRUE(find_mistakes(transient("rigid"), ideal).empty());
  EXPECT_TRUE(find_mistakes(transient("closed form"), ideal).empty());
  EXPECT_EQ(find_mistakes(transient("rigid"), { "Contact/Type=ideal", "Support/Type=sprung" }),
            (Messages{ "--set: Contact/Type = ideal: ideal needs Support/Type = rigid" }));
  expect_refused(transient("rigid"), { "Contact/Type=ideal", "Drive/Reversal duration=0" },
                 "must be more than 0 s with Contact/Type = ideal, or P is infinite at a reversal");
  EXPECT_TRUE(
      find_mistakes(transient("rigid"), { "Contact/Type=ideal", "Drive/Reversal duration=0", "Drive/Profile=harmonic" }).empty());
  EXPECT_TRUE(find_mistakes(transient("rigid"), { "Drive/Reversal duration=0" }).empty());

  const Messages locking = { "Drive/Stroke=129", "Friction/Law=Coulomb", "Friction/Coefficient=1.3" };
  EXPECT_TRUE(find_mistakes(transient("rigid"), locking).empty());
  EXPECT_EQ(find_mistakes(transient("closed form"), locking).size(), 1u);
  EXPECT_EQ(find_mistakes({ "Analysis/Type=transient", "Analysis/Model=rigid", "Contact/Type=ideal" }, locking).size(), 1u);
}

TEST(CheckScene, SprungSupportNeedsADrive)
{
  expect_refused({ "Analysis/Type=contact law", "Support/Type=sprung" }, "must be rigid where the cylinder follows no drive");
  EXPECT_TRUE(find_mistakes({ "Support/Type=sprung" }).empty());
  expect_refused(transient("closed form"), { "Support/Type=sprung" },
                 "sprung needs an Analysis/Model other than closed form in time");
  EXPECT_TRUE(find_mistakes({ "Support/Mass=1" }).empty());
}

TEST(CheckScene, InertiaTimeAndLeverMustFit)
{
  // e_a = 45.6 + 1 + 10 mm
  EXPECT_EQ(find_mistakes(transient("rigid"), { "Lever/Tip mass=1e-3" }),
            (Messages{ "scene.prm: Lever/Moment of inertia = 6.45: must be more than that of tip mass, hub and leaf "
                       "spring alone, Tip mass (L^2 + e_a^2) + Hub inertia + J of the leaf = 47.3036 t mm2" }));
  EXPECT_TRUE(find_mistakes({ "Lever/Tip mass=1e-3" }).empty());
  expect_refused(transient("beam"), { "Time/Step=2" }, "must be less than the duration of the drive, 1.16478 s");
  for (const std::string model : { "rigid", "beam", "condensed", "finite element" })
    EXPECT_EQ(find_mistakes(transient(model), { "Lever/Length=180" }).size(), 1u);
  written("", "file");
  expect_refused(transient("condensed"), { "Condensed/Cache=file" }, "must be a folder");
}
