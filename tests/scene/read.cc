#include "scene/read.h"

#include "base/errors.h"
#include "base/parameters.h"
#include "scene/sections.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <sstream>

using namespace sprag;

namespace
{
  using Messages = std::vector<std::string>;

  std::filesystem::path folder()
  {
    const auto *const test = testing::UnitTest::GetInstance()->current_test_info();
    const auto result      = std::filesystem::path(testing::TempDir()) / "sprag" / test->test_suite_name() / test->name();
    std::filesystem::create_directories(result);
    return result;
  }

  std::string written(const std::string &text, const std::string &name = "scene.prm")
  {
    const auto file = (folder() / name).string();
    std::ofstream(file) << text;
    return file;
  }

  /// What is wrong with a scene, the folder of its file left out.
  Messages mistakes(const std::string &text, const Messages &overrides = {})
  {
    const std::string prefix = folder().string() + "/";
    Messages result;
    try
    {
      read_scene(written(text), overrides);
    }
    catch (const InputError &error)
    {
      for (auto message : error.messages)
      {
        for (auto found = message.find(prefix); found != std::string::npos; found = message.find(prefix))
          message.erase(found, prefix.size());
        result.push_back(message);
      }
    }
    return result;
  }

  /// Of the defaults with these overrides.
  Messages mistakes_of(const Messages &overrides)
  {
    return mistakes("", overrides);
  }

  std::filesystem::path scenes()
  {
    return std::filesystem::path(__FILE__).parent_path() / "../../params";
  }

  std::string content(const std::filesystem::path &file)
  {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
} // namespace

TEST(ReadScene, EmptyFileIsModelA)
{
  const Scene scene = read_scene(written(""));
  const Scene defaults;
  EXPECT_EQ(scene.geometry.interface_offset, defaults.geometry.interface_offset);
  EXPECT_EQ(scene.spring_stiffness, 7.4e4);
  EXPECT_EQ(scene.drive.duration(), Drive().duration());
  EXPECT_TRUE(std::holds_alternative<CorkOnAluminium>(scene.friction.law));
  EXPECT_FALSE(scene.contact.penalty);
  EXPECT_DOUBLE_EQ(scene.slope.maximum_inclination, defaults.slope.maximum_inclination);
  EXPECT_EQ(scene.slope.offset_ratios, defaults.slope.offset_ratios);
  EXPECT_EQ(scene.name, "scene");
}

TEST(ReadScene, EverySectionReachesTheScene)
{
  const Scene scene = read_scene(
      written(""), { "Analysis/Model=closed form", "Geometry/Pivot height=1.5", "Drive/Profile=harmonic", "Drive/Stroke=40",
                     "Friction/Law=Coulomb", "Friction/Coefficient=0.5", "Friction/Speed=drive", "Lever/Young's modulus=210000",
                     "Friction layer/Thickness=0", "Rotational spring/Stiffness=1e4", "Contact/Enforcement=augmented Lagrangian",
                     "Contact/Penalty=1234", "Mesh/Degree=1", "Output/Fields=none", "Slope/Sweep=inclination",
                     "Slope/Maximum inclination=45", "Slope/Offset ratios=0.1, 0.3" });
  EXPECT_EQ(scene.analysis.model, ModelType::closed_form);
  EXPECT_EQ(scene.geometry.pivot_height, 1.5);
  EXPECT_EQ(scene.drive.profile(), DriveProfile::harmonic);
  EXPECT_EQ(scene.drive.maximum(), 40.);
  EXPECT_EQ(std::get<CoulombFriction>(scene.friction.law).coefficient, 0.5);
  EXPECT_EQ(scene.friction.speed, FrictionSpeed::drive);
  EXPECT_EQ(scene.lever.young_modulus, 210000.);
  EXPECT_EQ(scene.layer.thickness, 0.);
  EXPECT_EQ(scene.spring_stiffness, 1e4);
  EXPECT_EQ(scene.contact.enforcement, Enforcement::augmented_lagrangian);
  EXPECT_EQ(scene.contact.penalty, 1234.);
  EXPECT_EQ(scene.mesh.degree, 1u);
  EXPECT_EQ(scene.output.fields, FieldOutput::none);
  EXPECT_EQ(scene.slope.sweep, SlopeSweep::inclination);
  EXPECT_DOUBLE_EQ(scene.slope.maximum_inclination, std::atan(1.));
  EXPECT_EQ(scene.slope.offset_ratios, (std::vector<double>{ 0.1, 0.3 }));
}

TEST(ReadScene, TablesAndMeshesLieRelativeToTheFile)
{
  written("time, x\n0, 0\n1, 30\n2, 30\n3, 0\n", "drive.csv");
  written("speed mu\n0 0.3\n10 0.5\n100 0.7\n200 0.7\n", "mu.csv");
  written("// a mesh", "lever.geo");
  const Scene scene = read_scene(written("subsection Drive\n set Profile = table\n set Table = drive.csv\nend\n"
                                         "subsection Friction\n set Law = table\n set Table = mu.csv\nend\n"
                                         "subsection Mesh\n set File = lever.geo\nend\n"));
  EXPECT_EQ(scene.drive.profile(), DriveProfile::table);
  EXPECT_EQ(scene.drive.reversals(), std::vector<double>{ 2. });
  EXPECT_EQ(friction_coefficient(scene.friction, 10.).coefficient, 0.5);
  EXPECT_EQ(scene.mesh.file, (folder() / "lever.geo").string());
}

TEST(ReadScene, PrintedParametersGiveTheSameScene)
{
  const Scene scene = read_scene((scenes() / "model-b.prm").string(), { "Friction/Law=Coulomb", "Contact/Penalty=500" });
  const Scene again = read_scene(written(scene.parameters_text));
  EXPECT_EQ(again.parameters_text, scene.parameters_text);
  EXPECT_EQ(again.geometry.cylinder_radius, 21.1);
  EXPECT_EQ(again.contact.penalty, 500.);
  EXPECT_TRUE(mistakes(default_parameters_text()).empty());
}

TEST(ReadScene, ScenesOfTheProgramAreFaultless)
{
  unsigned int n_scenes = 0;
  for (const auto &entry : std::filesystem::directory_iterator(scenes()))
    if (entry.path().extension() == ".prm")
    {
      ++n_scenes;
      EXPECT_NO_THROW(read_scene(entry.path().string())) << entry.path();
    }
  EXPECT_GE(n_scenes, 12u);
}

TEST(ReadScene, EveryParameterStandsInTheReadme)
{
  const std::string readme = content(scenes() / "README.md");
  SceneSettings defaults;
  for (const auto &parameter : scene_parameters(defaults))
  {
    const std::string rule = std::regex_replace(description(parameter.rule), std::regex("\\|"), "\\|");
    const std::string row  = "| " + parameter.section + " | " + parameter.name + " | " + parameter.default_value + " | " +
                            parameter.rule.unit + " | " + rule + " | " + parameter.meaning + " |";
    EXPECT_NE(readme.find(row), std::string::npos) << row;
  }
}

TEST(ReadScene, AllMistakesAreFoundAtOnce)
{
  EXPECT_EQ(mistakes("subsection Geometry\n"
                     "  set Cylinder radius = -56\n"
                     "  set Pivot distance = 185.5 mm\n"
                     "end\n"
                     "subsection Rotational spring\n"
                     "  set Stifness = 1\n"
                     "end\n"
                     "subsection Drive\n"
                     "  set Start = 70\n"
                     "end\n",
                     { "Lever/Material=neo-Hookean" }),
            (Messages{ "scene.prm:2: Geometry/Cylinder radius = -56: must be a number > 0 [mm]",
                       "scene.prm:3: Geometry/Pivot distance = 185.5 mm: must be a number > 0 and nothing else: "
                       "leave out 'mm', mm is meant",
                       "scene.prm:6: Rotational spring/Stifness = 1: no such parameter; did you mean 'Stiffness'?",
                       "scene.prm: Drive/Stroke = 65: must be more than Start = 70 mm",
                       "--set: Lever/Material = neo-Hookean: neo-Hookean needs Analysis/Plane = strain" }));
}

TEST(ReadScene, CylinderMustFitLeverAndPivot)
{
  EXPECT_EQ(mistakes_of({ "Geometry/Interface offset=60" }),
            (Messages{ "--set: Geometry/Interface offset = 60: must be less than Cylinder radius R = 56 mm" }));
  EXPECT_EQ(mistakes_of({ "Geometry/Pivot distance=50" }),
            (Messages{ "--set: Geometry/Pivot distance = 50: must be more than Cylinder radius R = 56 mm, "
                       "or the cylinder reaches the pivot" }));
  EXPECT_EQ(mistakes_of({ "Geometry/Pivot height=10.4" }),
            (Messages{ "--set: Geometry/Pivot height = 10.4: must be less than R - e = 10.4 mm, or theta_0 is not positive" }));
}

TEST(ReadScene, StrokeMustNotReachThePivot)
{
  EXPECT_EQ(mistakes_of({ "Drive/Stroke=129.5" }),
            (Messages{ "--set: Drive/Stroke = 129.5: x must stay below 129.5 mm, where the cylinder reaches the pivot: "
                       "(l - x)^2 + h^2 = R^2" }));
  EXPECT_TRUE(mistakes_of({ "Drive/Stroke=129" }).empty());
  // sqrt(56^2 - 10^2) = 55.1 mm before the pivot
  EXPECT_EQ(mistakes_of({ "Drive/Stroke=131", "Geometry/Pivot height=10" }).size(), 1u);
  EXPECT_TRUE(mistakes_of({ "Drive/Stroke=130", "Geometry/Pivot height=10" }).empty());
}

TEST(ReadScene, LockingIsRefusedForTheClosedFormOnly)
{
  // Above mu = sqrt((2-eb)/eb) = 1.2067 model A locks before the cylinder reaches its pivot at x = 129.5.
  const Messages scene = { "Drive/Stroke=129", "Friction/Law=Coulomb", "Friction/Coefficient=1.3", "Analysis/Model=closed form" };
  const auto found     = mistakes_of(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rfind("--set: Drive/Stroke = 129: must not lock: moving back at x = 12", 0), 0u) << found[0];
  EXPECT_NE(found[0].find("mu e = 59.28 mm with mu = 1.3"), std::string::npos) << found[0];

  EXPECT_TRUE(mistakes_of({ scene[0], scene[1], scene[2] }).empty());
  EXPECT_TRUE(mistakes_of({ scene[0], scene[1], scene[3], "Friction/Coefficient=1.2" }).empty());
  EXPECT_TRUE(mistakes_of({ scene[0], scene[1], scene[2], scene[3], "Drive/Cycles=0.5" }).empty());
}

TEST(ReadScene, ContactMustLieOnTheLever)
{
  const auto found = mistakes_of({ "Lever/Length=180" });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(
      found[0],
      "--set: Lever/Length = 180: must be at least 187.208 mm: at x = 0 mm the cylinder touches the lever at s = 185.208 mm");
  EXPECT_TRUE(mistakes_of({ "Lever/Length=180", "Analysis/Model=closed form" }).empty());
  EXPECT_TRUE(mistakes_of({ "Lever/Length=180", "Drive/Start=20" }).empty());
}

TEST(ReadScene, DriveMustMoveForward)
{
  EXPECT_EQ(mistakes_of({ "Drive/Stroke=0" }), (Messages{ "--set: Drive/Stroke = 0: must be a number > 0 [mm]" }));
  EXPECT_EQ(mistakes_of({ "Drive/Start=-1" }), (Messages{ "--set: Drive/Start = -1: must be a number >= 0 [mm]" }));
  EXPECT_EQ(mistakes_of({ "Drive/Start=20", "Drive/Stroke=10" }),
            (Messages{ "--set: Drive/Stroke = 10: must be more than Start = 20 mm" }));
}

TEST(ReadScene, WhatThisVersionCannotDoIsRefused)
{
  EXPECT_EQ(mistakes_of({ "Analysis/Dimension=3" }),
            (Messages{ "--set: Analysis/Dimension = 3: must be 2: this version solves 2D problems only" }));
  EXPECT_EQ(mistakes_of({ "Analysis/Minimum step=2" }),
            (Messages{ "--set: Analysis/Minimum step = 2: must not be more than Step = 1 mm" }));
  EXPECT_TRUE(mistakes_of({ "Lever/Material=neo-Hookean", "Analysis/Plane=strain" }).empty());
}

TEST(ReadScene, MaterialsMustBePossible)
{
  EXPECT_EQ(mistakes_of({ "Lever/Poisson's ratio=0.5", "Friction layer/Poisson's ratio=-1", "Friction/Coefficient=-0.1" }),
            (Messages{ "--set: Lever/Poisson's ratio = 0.5: must be a number > -1 and < 0.5",
                       "--set: Friction layer/Poisson's ratio = -1: must be a number > -1 and < 0.5",
                       "--set: Friction/Coefficient = -0.1: must be a number >= 0" }));
}

TEST(ReadScene, TablesMustBeReadable)
{
  EXPECT_EQ(mistakes_of({ "Friction/Law=table" }), (Messages{ "scene.prm: Friction/Table = : must name a file" }));
  EXPECT_EQ(mistakes_of({ "Drive/Profile=table", "Drive/Table=none.csv" }),
            (Messages{ "--set: Drive/Table = none.csv: none.csv: cannot be read" }));
  written("0, 0.3\n1, x\n2\n", "mu.csv");
  EXPECT_EQ(mistakes_of({ "Friction/Law=table", "Friction/Table=mu.csv" }),
            (Messages{ "--set: Friction/Table = mu.csv: mu.csv:2: 1, x: must be two numbers",
                       "--set: Friction/Table = mu.csv: mu.csv:3: 2: must be two numbers" }));
  written("0, 0\n1, 10\n1, 20\n2, -5\n", "x.csv");
  EXPECT_EQ(mistakes_of({ "Drive/Profile=table", "Drive/Table=x.csv" }),
            (Messages{ "--set: Drive/Table = x.csv: row 3: 1 follows 1: the first column must increase from row to row" }));
  written("0, 0\n1, 10\n2, -5\n3, 140\n", "x.csv");
  EXPECT_EQ(mistakes_of({ "Drive/Profile=table", "Drive/Table=x.csv" }),
            (Messages{ "--set: Drive/Table = x.csv: x must be >= 0 mm throughout, it falls to -5" }));
}

TEST(ReadScene, MeshFileMustBeOne)
{
  written("", "lever.stl");
  EXPECT_EQ(mistakes_of({ "Mesh/File=lever.stl" }), (Messages{ "--set: Mesh/File = lever.stl: must end in .geo or .msh" }));
  EXPECT_EQ(mistakes_of({ "Mesh/File=none.msh" }), (Messages{ "--set: Mesh/File = none.msh: cannot be read" }));
}

TEST(ReadScene, GuessesBringNoFurtherMistakes)
{
  // With the default radius in place of the misspelt one the pivot distance would be too small.
  EXPECT_EQ(mistakes_of({ "Geometry/Cylinder radus=20", "Geometry/Interface offset=0", "Geometry/Pivot distance=50" }).size(),
            1u);
}

TEST(ReadScene, UnreadableFileIsAllThatIsWrong)
{
  EXPECT_THROW(
      {
        try
        {
          read_scene("/nowhere/scene.prm");
        }
        catch (const InputError &error)
        {
          EXPECT_EQ(error.messages, (Messages{ "/nowhere/scene.prm: cannot be read" }));
          throw;
        }
      },
      InputError);
}
