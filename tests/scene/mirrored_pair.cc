// SPDX-License-Identifier: GPL-3.0-only
#include "scene/mirrored_pair.h"

#include "scene/messages.h"
#include "scene/scene.h"
#include "scenes.h"

using namespace sprag;

namespace
{
  const Messages full    = { "Mirrored pair/Type=full" };
  const Messages held    = { "Mirrored pair/Type=full", "Mirrored pair/Joint=held" };
  const Messages in_time = { "Mirrored pair/Type=full", "Analysis/Type=transient", "Analysis/Model=beam" };
  const Messages leaf    = { "Mirrored pair/Type=full", "Rotational spring/Type=leaf" };
} // namespace

TEST(MirroredPair, ModelsAAndBMayBeFull)
{
  for (const Messages &model : { Messages{}, geometry_b })
    for (const Messages &pair : { full, held, in_time, leaf })
      EXPECT_EQ(find_mistakes(pair, model), Messages{});
  EXPECT_EQ(find_mistakes({ "Mirrored pair/Cylinder offset=40" }), Messages{}) << "counts in a full pair alone";
}

TEST(MirroredPair, AFreeJointNeedsOneAxisAndSpringsThatItCanFollow)
{
  expect_refused(full, { "Geometry/Pivot height=2" },
                 "must be 0 mm with Mirrored pair/Joint = free: the levers swing together about one axis");
  EXPECT_EQ(find_mistakes(held, { "Geometry/Pivot height=2" }), Messages{});
  expect_refused(leaf, { "Leaf spring/Axial=held" },
                 "must be free with Mirrored pair/Joint = free, which nothing but the springs holds");
  expect_refused(leaf, { "Leaf spring/Joint=guided" },
                 "must be clamped or pinned with Mirrored pair/Joint = free, which nothing but the springs holds");
  EXPECT_EQ(find_mistakes(leaf, { "Mirrored pair/Joint=held", "Leaf spring/Axial=held" }), Messages{});
}

TEST(MirroredPair, OnlyLeafSpringsHaveAJointWithMass)
{
  expect_refused(full, { "Mirrored pair/Joint mass=1e-4" }, "must be 0 t with a torsional spring, which has no joint");
  EXPECT_EQ(find_mistakes(leaf, { "Mirrored pair/Joint mass=1e-4" }), Messages{});
}

TEST(MirroredPair, OnlyReducedLeversHaveContactsThatDiffer)
{
  expect_refused(full, { "Mirrored pair/Contact ratio=2" },
                 "must be 1 but with Analysis/Model = rigid or beam: both levers have one mesh, and the closed form has no "
                 "stiffness of the contact");
  EXPECT_EQ(find_mistakes(in_time, { "Mirrored pair/Contact ratio=2" }), Messages{});
}

TEST(MirroredPair, TheCylinderStaysBetweenTheLevers)
{
  // (R - e)/2 = 5.2 mm.
  expect_refused(in_time, { "Mirrored pair/Cylinder offset=5.3" }, "must be at most (R - e - h)/2 = 5.2 mm either way");
  EXPECT_EQ(find_mistakes(in_time, { "Mirrored pair/Cylinder offset=-1" }), Messages{});
}

TEST(MirroredPair, AnalysesThatTakeHalfOfItSaySo)
{
  expect_refused({ "Analysis/Type=contact law" }, full,
                 "must be half but in a quasi-static, transient, modal, stability, map or sprag-slip analysis");
}

TEST(MirroredPair, EachLeverStandsInItsOwnMirroredAxes)
{
  Scene pair                = model_a();
  pair.pair.type            = PairType::full;
  pair.pair.cylinder_offset = 0.3;
  pair.pair.friction_ratio  = 0.8;
  EXPECT_EQ(count_levers(pair), 2u);
  EXPECT_EQ(lever_device(pair, 0).geometry.pivot_height, -0.3);
  EXPECT_EQ(lever_device(pair, 1).geometry.pivot_height, 0.3);
  EXPECT_EQ(lever_device(pair, 0).friction.factor, 1.);
  EXPECT_EQ(lever_device(pair, 1).friction.factor, 0.8);
  EXPECT_EQ(rest_inclination(pair), rest_inclination(model_a()));
  pair.pair.type = PairType::half;
  EXPECT_EQ(lever_device(pair, 1).geometry.pivot_height, 0.);
  EXPECT_FALSE(swings(pair));
}
