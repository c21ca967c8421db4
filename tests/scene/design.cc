// SPDX-License-Identifier: GPL-3.0-only
#include "scene/design.h"
#include "messages.h"
#include "scene/scene.h"
#include "support/written.h"

using namespace sprag;

namespace
{
  Messages design(const Messages &more)
  {
    Messages all = { "Analysis/Type=design" };
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  DesignSettings read(const Messages &more)
  {
    return make_scene(design(more)).design;
  }
} // namespace

TEST(ReadDesign, TextsBecomeDemandsAndAims)
{
  const auto settings = read({ "Design/Free=Geometry/Cylinder radius = 20 ... 80; Rotational spring/Stiffness = 1e4 ... 2e5",
                               "Design/Demands=damping slope = 0.1 +- 0.001; largest  force <= 40; jamming margin > 0.3; "
                               "Geometry/Cylinder radius >= 30",
                               "Design/Aim=maximise Rotational spring/Stiffness", "Design/Second aim=minimise largest force",
                               "Design/Judges=condensed, beam" });
  ASSERT_EQ(settings.free_parameters.size(), 2u);
  EXPECT_EQ(settings.free_parameters[1].name, "Rotational spring/Stiffness");
  EXPECT_EQ(settings.free_parameters[1].from, 1e4);
  EXPECT_EQ(settings.free_parameters[1].to, 2e5);
  EXPECT_EQ(settings.free_parameters[1].unit, "N mm/rad");
  ASSERT_EQ(settings.demanded.size(), 4u);
  EXPECT_EQ(settings.demanded[0].kind, DemandKind::equal);
  EXPECT_EQ(settings.demanded[0].target, 0.1);
  EXPECT_EQ(settings.demanded[0].tolerance, 0.001);
  EXPECT_EQ(settings.demanded[1].term.quantity, DesignQuantity::largest_force);
  EXPECT_EQ(settings.demanded[1].kind, DemandKind::at_most);
  EXPECT_EQ(settings.demanded[1].text, "largest force <= 40");
  EXPECT_EQ(settings.demanded[2].kind, DemandKind::at_least);
  EXPECT_EQ(settings.demanded[3].term.quantity, DesignQuantity::parameter);
  EXPECT_EQ(settings.demanded[3].term.parameter, 0u);
  ASSERT_EQ(settings.aims.size(), 2u);
  EXPECT_TRUE(settings.aims[0].maximises);
  EXPECT_EQ(settings.aims[0].term.parameter, 1u);
  EXPECT_FALSE(settings.aims[1].maximises);
  // The cheaper check model comes first.
  EXPECT_EQ(settings.check_models, (std::vector<CheckModel>{ CheckModel::beam, CheckModel::condensed }));
}

TEST(ReadDesign, MistakesNameTheNearestWord)
{
  const auto expect_message = [](const std::string &setting, const std::string &message)
  {
    const auto all = mistakes("", design({ setting }));
    ASSERT_EQ(all.size(), 1u) << setting;
    EXPECT_NE(all.front().find(message), std::string::npos) << all.front();
  };
  expect_message("Design/Free=Geometry/Cylinder radios = 20 ... 80",
                 "'Geometry/Cylinder radios' is no parameter that can be free; did you mean 'Geometry/Cylinder radius'?");
  expect_message("Design/Free=Drive/Stroke = 20 ... 80", "'Drive/Stroke' is no parameter that can be free");
  expect_message("Design/Free=Lever/Depth = 5", "'Lever/Depth = 5' must have the form Section/Name = FROM ... TO");
  expect_message("Design/Free=Lever/Depth = 20 ... 5", "Lever/Depth must have bounds of which the second is larger");
  expect_message("Design/Free=Lever/Depth = -1 ... 5", "Lever/Depth = -1 must be a number > 0");
  expect_message("Design/Free=Lever/Depth = 1 ... 5; Lever/Depth = 1 ... 5", "Lever/Depth must be there once only");
  expect_message("Design/Free=", "must name a parameter and its bounds");
  expect_message("Design/Demands=damping slpe >= 0.1",
                 "'damping slpe' is neither a quantity nor a free parameter; did you mean 'damping slope'?");
  expect_message("Design/Demands=damping slope = 0.1", "'damping slope = 0.1' must have a value and a tolerance > 0 behind =");
  expect_message("Design/Demands=damping slope 0.1", "'damping slope 0.1' must have the form QUANTITY <= VALUE");
  expect_message("Design/Demands=damping slope >= 0.1 +- 0.01", "must have a single number at its end");
  expect_message("Design/Demands=damping slope >= 0.1 N", "0.1 N must be a number [N/mm]: 'N' has the dimension");
  expect_message("Design/Demands=growth rate <= 0", "must have beam where a growth rate is asked for");
  expect_message("Design/Aim=reduce largest force", "must be minimise QUANTITY or maximise QUANTITY");
  expect_message("Design/Tolerances=Lever/Width = 1 ... ", "must have the form Section/Name = FROM ... TO");
  expect_message("Design/Second aim=minimise largest forc", "did you mean 'largest force'?");
  expect_message("Design/Judges=beem", "'beem' is no judge beside others; did you mean 'beam'?");
  expect_message("Design/Judges=table", "table counts only where transmissibility or relative amplitude is asked for");
  expect_message("Analysis/Dimension=3", "must be 2 in a design");
  expect_message("Rotational spring/Type=leaf", "must be torsional in a design");
}

TEST(ReadDesign, QuantitiesOfTheTableNeedLevers)
{
  const Messages table_scene = design({ "Design/Demands=transmissibility <= 3", "Isolation/Damper=viscous" });
  const auto all             = mistakes("", table_scene);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NE(all.front().find("Isolation/Damper"), std::string::npos) << all.front();
  EXPECT_NE(mistakes("", design({ "Design/Demands=residual offset <= 1", "Isolation/Base motion=none" })), Messages());
  for (const std::string base : { "harmonic", "random" })
  {
    const auto moving = mistakes("", design({ "Design/Demands=residual offset <= 1", "Isolation/Base motion=" + base }));
    ASSERT_FALSE(moving.empty()) << base;
    EXPECT_NE(moving.front().find("must be none or record where a residual offset is asked for"), std::string::npos)
        << moving.front();
  }
  const auto record = written("time [s], acceleration [m/s2]\n0, 0\n0.1, 1\n0.2, -1\n1, 0\n", "record.csv");
  const auto ends   = [&](const std::string &duration)
  {
    return mistakes("", design({ "Design/Demands=residual offset <= 1", "Isolation/Base motion=record",
                                 "Isolation/Base table=" + record, "Isolation/Duration=" + duration }));
  };
  EXPECT_EQ(ends("1.1"), Messages());
  ASSERT_EQ(ends("0.9").size(), 1u);
  EXPECT_NE(ends("0.9").front().find("must be more than the 1 s of Base table"), std::string::npos) << ends("0.9").front();
}
