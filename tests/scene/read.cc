// SPDX-License-Identifier: GPL-3.0-only
#include "input/read.h"
#include "laws/friction_law.h"

#include "scene/messages.h"
#include "scene/scene.h"
#include "support/params_folder.h"
#include "support/shipped.h"

#include <array>
#include <hdf5.h>

using namespace sprag;

namespace
{
  std::string written_hdf5(const std::string &name, const std::vector<std::pair<std::string, std::vector<double>>> &columns,
                           const int n_dimensions = 1)
  {
    const std::string path = (folder() / name).string();
    const hid_t file       = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    for (const auto &[column, values] : columns)
    {
      const std::array<hsize_t, 2> extents = { { values.size(), 1 } }; // as MATLAB writes vectors
      const hid_t space                    = H5Screate_simple(n_dimensions, extents.data(), nullptr);
      const hid_t dataset = H5Dcreate2(file, column.c_str(), H5T_NATIVE_FLOAT, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      H5Dclose(dataset);
      H5Sclose(space);
    }
    H5Fclose(file);
    return path;
  }
} // namespace

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
  const Scene scene = shipped("model-b", { "Friction/Law=Coulomb", "Contact/Penalty=500" });
  const Scene again = read_scene(written(parameters_text(scene)));
  EXPECT_EQ(parameters_text(again), parameters_text(scene));
  EXPECT_EQ(again.specified, scene.specified);
  EXPECT_EQ(again.geometry.cylinder_radius, 21.1);
  EXPECT_EQ(again.contact.penalty, 500.);
  EXPECT_TRUE(read_scene(written(default_parameters_text())).specified.empty());
  // The text of a scene stays where the program chooses, or where an auto that is the default is given.
  const Scene open = make_scene({ "Analysis/Model=auto", "Accuracy/Target=0.01", "Mesh/Face size=auto" });
  EXPECT_EQ(parameters_text(with_chosen(open, { "Analysis/Model=finite element", "Mesh/Face size=0.5", "Mesh/Degree=1" })),
            parameters_text(open));
  EXPECT_EQ(parameters_text(make_scene({ "Analysis/Model=auto", "Accuracy/Target=0.01" })), parameters_text(open));
}

TEST(ReadScene, PrintedParametersKeepTheTimeSteps)
{
  const std::vector<Messages> variants = { {}, { "Time/Step=1e-5" }, { "Time/Step=1e-5", "Time/Tolerance=1e-2" } };
  const std::vector<double> tolerances = { 5e-3, 0., 1e-2 };
  for (std::size_t i = 0; i < variants.size(); ++i)
  {
    const Scene scene = make_scene(variants[i]);
    const Scene again = read_scene(written(parameters_text(scene)));
    EXPECT_EQ(scene.time.tolerance, tolerances[i]);
    EXPECT_EQ(again.time.tolerance, tolerances[i]);
    EXPECT_EQ(parameters_text(again), parameters_text(scene));
  }
  EXPECT_EQ(make_scene({ "Time/Step=1e-5", "Time/Tolerance=auto" }).time.tolerance, 0.);
  EXPECT_EQ(make_scene({ "Time/Tolerance=0" }).time.tolerance, 0.);
  EXPECT_EQ(parameters_text(read_scene(written(default_parameters_text()))), default_parameters_text());
}

TEST(ReadScene, ReversalsTakeTimeInTransientAnalysesOnly)
{
  EXPECT_EQ(make_scene({ "Analysis/Type=transient" }).drive.reversal_duration(), 5e-3);
  EXPECT_EQ(make_scene({ "Analysis/Type=transient", "Drive/Profile=harmonic" }).drive.reversal_duration(), 0.);
  for (const std::string type : { "quasi-static", "slope", "contact law" })
    EXPECT_EQ(make_scene({ "Analysis/Type=" + type }).drive.reversal_duration(), 0.);

  EXPECT_EQ(find_mistakes({ "Analysis/Type=transient", "Drive/Stroke=0.4" }),
            (Messages{ "scene.prm: Drive/Reversal duration = 0.005: must be at most 0.00423278 s, or the ramps of speed do not "
                       "fit into the shortest stroke" }));
  EXPECT_TRUE(find_mistakes({ "Analysis/Type=transient", "Drive/Stroke=0.4", "Drive/Reversal duration=0.00423278" }).empty());
  EXPECT_TRUE(find_mistakes({ "Drive/Stroke=0.4" }).empty());
}

TEST(ReadScene, ScenesOfTheProgramAreFaultless)
{
  unsigned int n_scenes = 0;
  for (const auto &entry : std::filesystem::directory_iterator(params_folder()))
    if (entry.path().extension() == ".prm")
    {
      ++n_scenes;
      EXPECT_NO_THROW(read_scene(entry.path().string())) << entry.path();
    }
  EXPECT_GE(n_scenes, 12u);
}

TEST(ReadScene, AllMistakesAreFoundAtOnce)
{
  EXPECT_EQ(
      mistakes("subsection Geometry\n"
               "  set Cylinder radius = -56\n"
               "  set Pivot distance = 185.5 N\n"
               "end\n"
               "subsection Rotational spring\n"
               "  set Stifness = 1\n"
               "end\n"
               "subsection Drive\n"
               "  set Start = 70\n"
               "end\n",
               { "Lever/Material=neo-Hookean" }),
      (Messages{ "scene.prm:2: Geometry/Cylinder radius = -56: must be a number > 0 [mm]",
                 "scene.prm:3: Geometry/Pivot distance = 185.5 N: must be a number > 0 [mm]: 'N' has the dimension m.kg.s-2, mm "
                 "has the dimension m",
                 "scene.prm:6: Rotational spring/Stifness = 1: no such parameter; did you mean 'Stiffness'?",
                 "scene.prm: Drive/Stroke = 65: must be more than Start = 70 mm",
                 "--set: Lever/Material = neo-Hookean: neo-Hookean needs Analysis/Plane = strain or Analysis/Dimension = 3" }));
}

TEST(ReadScene, TablesMustBeReadable)
{
  EXPECT_EQ(find_mistakes({ "Friction/Law=table" }), (Messages{ "scene.prm: Friction/Table = : must name a file" }));
  expect_refused({ "Drive/Profile=table", "Drive/Table=none.csv" }, "none.csv: cannot be read");
  written("0, 0.3\n1, x\n2\n", "mu.csv");
  EXPECT_EQ(find_mistakes({ "Friction/Law=table", "Friction/Table=mu.csv" }),
            (Messages{ "--set: Friction/Table = mu.csv: mu.csv:2: 1, x: must be two numbers",
                       "--set: Friction/Table = mu.csv: mu.csv:3: 2: must be two numbers" }));
  written("0, 0\n1, 10\n1, 20\n2, -5\n", "x.csv");
  expect_refused({ "Drive/Profile=table", "Drive/Table=x.csv" },
                 "row 3: 1 follows 1: the first column must increase from row to row");
  written("0, 0\n1, 10\n2, -5\n3, 140\n", "x.csv");
  expect_refused({ "Drive/Profile=table", "Drive/Table=x.csv" },
                 "x must be >= 0 mm throughout, it falls to -5: levers stand on one side of x = 0 alone. Of a record about rest, "
                 "max(x, 0) moves those of one side, max(-x, 0) those opposite, |x| both in turn (Q then acts against the sign "
                 "of x); a record that counts from elsewhere needs an offset");
}

TEST(ReadScene, GuessesBringNoFurtherMistakes)
{
  // With the default radius in place of the misspelt one the pivot distance would be too small.
  EXPECT_EQ(find_mistakes({ "Geometry/Cylinder radus=20", "Geometry/Interface offset=0", "Geometry/Pivot distance=50" }).size(),
            1u);
}

TEST(ReadScene, TablesMayBeHDF5)
{
  written_hdf5("drive.h5", { { "time", { 0., 1., 2., 3. } }, { "x", { 0., 30., 30., 0. } } });
  written_hdf5("mu.hdf5", { { "mu", { 0.25, 0.5, 0.75, 0.75 } }, { "speed", { 0., 10., 100., 200. } } });
  const Scene scene =
      make_scene({ "Drive/Profile=table", "Drive/Table=drive.h5", "Friction/Law=table", "Friction/Table=mu.hdf5" });
  EXPECT_EQ(scene.drive.reversals(), std::vector<double>{ 2. });
  EXPECT_EQ(scene.drive.maximum(), 30.);
  EXPECT_EQ(friction_coefficient(scene.friction, 10.).coefficient, 0.5);
  written_hdf5("matlab.h5", { { "Time", { 0., 1., 2., 3. } }, { "position", { 0., 30., 30., 0. } } }, 2);
  EXPECT_EQ(make_scene({ "Drive/Profile=table", "Drive/Table=matlab.h5" }).drive.maximum(), 30.);
}

TEST(ReadScene, UnitsOfTablesCount)
{
  written("x [m], t [ms]\n0, 0\n0.03, 1000\n0.03, 2000\n0, 3000\n", "drive.csv");
  const auto drive = make_scene({ "Drive/Profile=table", "Drive/Table=drive.csv" }).drive;
  EXPECT_NEAR(drive.maximum(), 30., 1e-12);
  EXPECT_NEAR(drive.duration(), 3., 1e-12);
  written("\u00B5 [-], v [cm/s]\n0.25, 0\n0.5, 1\n0.75, 10\n0.75, 20\n", "mu.csv");
  const auto friction = make_scene({ "Friction/Law=table", "Friction/Table=mu.csv" }).friction;
  EXPECT_EQ(friction_coefficient(friction, 10.).coefficient, 0.5);
}

TEST(ReadScene, HDF5TablesMustBeTables)
{
  const auto drive = [](const std::string &name)
  {
    testing::internal::CaptureStderr();
    const auto found = find_mistakes({ "Drive/Profile=table", "Drive/Table=" + name });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    return found;
  };
  EXPECT_EQ(drive("none.h5"), (Messages{ "--set: Drive/Table = none.h5: none.h5: cannot be read" }));
  written("0, 0\n1, 1\n", "text.h5");
  EXPECT_EQ(drive("text.h5"), (Messages{ "--set: Drive/Table = text.h5: text.h5: cannot be read as HDF5" }));
  written_hdf5("names.h5", { { "Zeit", { 0., 1. } }, { "Weg", { 0., 1. } } });
  EXPECT_EQ(drive("names.h5"), (Messages{ "--set: Drive/Table = names.h5: names.h5: has no column 'time': it has Weg, Zeit",
                                          "--set: Drive/Table = names.h5: names.h5: has no column 'x': it has Weg, Zeit" }));
  written_hdf5("uneven.h5", { { "time", { 0., 1., 2., 3. } }, { "x", { 0., 1., 2. } } });
  EXPECT_EQ(drive("uneven.h5"),
            (Messages{ "--set: Drive/Table = uneven.h5: uneven.h5: dataset 'x': must be as long as 'time'" }));
}

TEST(ReadScene, ParametersThatWouldNotCountAreRefused)
{
  expect_refused({ "Friction/Coefficient=0.5" }, "counts only with Friction/Law = Coulomb");
  EXPECT_EQ(mistakes("subsection Friction\n set Coefficient = 0.73\nend\n"),
            (Messages{ "scene.prm:2: Friction/Coefficient = 0.73: counts only with Friction/Law = Coulomb" }));
  EXPECT_EQ(find_mistakes({ "Friction/Table=mu.csv", "Drive/Table=x.csv" }),
            (Messages{ "--set: Drive/Table = x.csv: counts only with Drive/Profile = table",
                       "--set: Friction/Table = mu.csv: counts only with Friction/Law = table" }));
  expect_refused({ "Friction/Law=Coulomb", "Friction/Stribeck speed=20" }, "counts only with Friction/Law = Stribeck");
  // A printed scene names this default too, and it is accepted.
  EXPECT_TRUE(mistakes("subsection Friction\n set Law = cork on aluminium\n set Coefficient = 0.73\nend\n").empty());
}
