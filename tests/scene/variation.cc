// SPDX-License-Identifier: GPL-3.0-only
#include "input/variation.h"

#include "scene/messages.h"
#include "scene/scene.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <fstream>

using namespace sprag;

namespace
{
  const Messages study = { "Analysis/Type=study" };

  Messages values(const std::string &text)
  {
    const auto scene = make_scene({ "Analysis/Type=study", "Study/Vary=" + text });
    return scene.study.varied.front().values;
  }

  void expect_wrong(const std::string &setting, const Messages &messages)
  {
    Messages expected;
    for (const auto &message : messages)
      expected.push_back("--set: " + setting.substr(0, setting.find('=')) + " = " + setting.substr(setting.find('=') + 1) + ": " +
                         message);
    EXPECT_EQ(find_mistakes(study, { setting }), expected);
  }
} // namespace

TEST(Variation, ReadsListsAndRanges)
{
  EXPECT_EQ(values("Mesh/Face size = 0.5 , 1,auto"), (Messages{ "0.5", "1", "auto" }));
  EXPECT_EQ(values("Analysis/Model = beam, closed form"), (Messages{ "beam", "closed form" }));
  EXPECT_EQ(values("Lever/Depth = 0.1 ... 0.5 : 5"), (Messages{ "0.1", "0.2", "0.3", "0.4", "0.5" }));
  EXPECT_EQ(values("Lever/Depth = 3, 20 ... 10 : 3"), (Messages{ "3", "20", "15", "10" }));
  EXPECT_EQ(values("Lever/Depth = 0.01 ... 100 : 5 log"), (Messages{ "0.01", "0.1", "1", "10", "100" }));
  EXPECT_EQ(values("Mesh/Degree = 1 ... 2 : 2"), (Messages{ "1", "2" }));
}

TEST(Variation, NamesMayBeWrittenLooselyAsElsewhere)
{
  EXPECT_EQ(values(" Mesh/Face  size=1;; Mesh/Degree = 2; "), (Messages{ "1" }));
}

TEST(Variation, EveryMistakeIsTold)
{
  expect_wrong("Study/Vary=Lever/Dpth = 1; Depth = 2; Mesh/Degree = 1, 7; Mesh/Degree = 2; nonsense",
               { "'Lever/Dpth' is no parameter; did you mean 'Lever/Depth'?",
                 "'Depth' is no parameter; did you mean 'Lever/Depth'?", "Mesh/Degree = 7 must be an integer >= 1 and <= 2",
                 "Mesh/Degree must be there once only", "'nonsense' must have the form Section/Name = VALUES" });
  expect_wrong("Study/Vary=", { "must name a parameter and its values: Section/Name = VALUES" });
  expect_wrong("Study/Vary=Analysis/Type = transient; Map/Coarsest = 1; Output/Field interval = 2; Friction plate/Sensors = 1",
               { "Analysis/Type is Study/Type in a study", "Map/Coarsest belongs to no run of a study",
                 "Output/Field interval does not count: the runs of a study write no fields and estimate no errors",
                 "Friction plate/Sensors holds a list itself and cannot be varied" });
}

TEST(Variation, RangesThatAreNone)
{
  const std::string form =
      " must have the form FIRST ... LAST : NUMBER, with an integer >= 2, or FIRST ... LAST : NUMBER log between numbers > 0";
  for (const std::string range : { "1 ... 2", "1 ... 2 : 1", "1 ... 2 : 2.5", "1 ... x : 3", "... : 3", "1 ... 2 : 3 linear" })
    expect_wrong("Study/Vary=Lever/Depth = " + range, { "Lever/Depth = " + range + form });
  expect_wrong("Study/Vary=Geometry/Pivot height = -1 ... 2 : 4 log", { "Geometry/Pivot height = -1 ... 2 : 4 log" + form });
  expect_wrong("Study/Vary=Lever/Depth = 0 ... 2 : 3", { "Lever/Depth = 0 must be a number > 0 [mm]" });
  expect_wrong("Study/Vary=Mesh/Degree = 1 ... 2 : 3", { "Mesh/Degree = 1.5 must be an integer >= 1 and <= 2" });
}

TEST(Variation, ListsAndGridsThatCannotBe)
{
  expect_refused(study, { "Study/Combine=list", "Study/Vary=Lever/Depth = 1, 2; Lever/Width = 1, 2, 3" },
                 "must give each parameter as many values with Combine = list: Lever/Depth has 2, Lever/Width has 3");
  expect_wrong("Study/Vary=Lever/Depth = 1 ... 2 : 1000; Lever/Width = 1 ... 2 : 1000",
               { "makes 1e+06 runs, of which a study may have 20000" });
}

TEST(Variation, OfAReference)
{
  const auto scene =
      make_scene({ "Analysis/Type=study", "Study/Reference=Mesh/Face size = 0.1; Friction plate/Sensors = 105, 135" });
  ASSERT_EQ(scene.study.reference_values.size(), 2u);
  EXPECT_EQ(scene.study.reference_values[1].values, (Messages{ "105, 135" }));
  expect_wrong("Study/Reference=Mesh/Face size = 1, 2",
               { "Mesh/Face size = 1, 2 must be auto or a number > 0 and nothing else" });
  expect_wrong("Study/Vary=Lever/Depth = 1 N ... 2 N : 3",
               { "Lever/Depth = 1 N ... 2 N : 3 must be a number > 0 [mm]: 'N' has the "
                 "dimension m.kg.s-2, mm has the dimension m" });
  EXPECT_EQ(find_mistakes({ "Analysis/Type=study", "Study/Type=slope", "Study/Reference=Lever/Depth = 1" }).size(), 1u);
}

TEST(Variation, AUnitBehindTheLastNumberIsThatOfAll)
{
  EXPECT_EQ(values("Lever/Depth = 1 cm, 20 mm"), (Messages{ "10", "20" }));
  EXPECT_EQ(values("Lever/Depth = 1, 2 cm"), (Messages{ "10", "20" }));
  EXPECT_EQ(values("Lever/Depth = 1 ... 2 cm : 3"), (Messages{ "10", "15", "20" }));
  EXPECT_EQ(values("Lever/Depth = 1 ... 2 : 3, 3 cm"), (Messages{ "10", "15", "20", "30" }));
  EXPECT_EQ(values("Mesh/Face size = 1, 2 cm, auto"), (Messages{ "10", "20", "auto" }));
  for (const std::string list : { "1 cm, 20", "1 cm ... 20 : 3", "1 mm, 2, 3 cm" })
    expect_wrong("Study/Vary=Lever/Depth = " + list,
                 { "Lever/Depth = " + list +
                   " has numbers with and without unit: each must have one, or the last alone, whose unit is that of all" });
}

TEST(Variation, ADecimalCommaIsRefused)
{
  expect_wrong("Study/Vary=Lever/Depth = 10,5", { "Lever/Depth = 10,5 must be '10, 5' for a list, or '10.5'" });
  expect_wrong("Study/Vary=Lever/Depth = 1,5 ... 3 : 4",
               { "Lever/Depth = 1,5 ... 3 : 4 must be '1, 5 ... 3 : 4' for a list, or '1.5 ... 3 : 4'" });
  EXPECT_EQ(values("Analysis/Model = beam,rigid"), (Messages{ "beam", "rigid" }));
}

TEST(Variation, ItsOwnSceneIsNotChecked)
{
  // Each run gives a length of its own.
  EXPECT_TRUE(find_mistakes({ "Analysis/Type=study", "Lever/Length=10", "Study/Vary=Lever/Length = 210, 250" }).empty());
}

TEST(Variation, FilesAreThoseBesideTheScene)
{
  const TemporaryFolder folder;
  const std::string table = folder.path / "mu.csv";
  std::ofstream(table) << "0,0.4\n50,0.5\n100,0.6\n200,0.7\n";
  const std::string file = folder.path / "scene.prm";
  std::ofstream(file)
      << "subsection Analysis\n  set Type = study\nend\nsubsection Study\n  set Vary = Friction/Table = mu.csv\nend\n";
  const Scene scene = read_scene(file);
  EXPECT_EQ(scene.study.varied.front().values, Messages{ table });
  EXPECT_EQ(scene.parameters->at("Study/Vary"), "Friction/Table = " + table);
}
