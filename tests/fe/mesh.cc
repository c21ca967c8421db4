#include "fe/mesh.h"

#include "base/errors.h"
#include "fe/body_properties.h"
#include "scenes.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <unistd.h>

using namespace sprag;

namespace
{
  /// A folder that is gone with its owner.
  class TemporaryFolder
  {
  public:
    TemporaryFolder()
        : path(std::filesystem::temp_directory_path() / ("sprag-test-mesh-" + std::to_string(::getpid())))
    {
      std::filesystem::create_directories(path);
    }
    TemporaryFolder(const TemporaryFolder &)            = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;
    ~TemporaryFolder()
    {
      std::filesystem::remove_all(path);
    }

    std::string write(const std::string &name, const std::string &text) const
    {
      std::ofstream(path / name) << text;
      return path / name;
    }

    const std::filesystem::path path;
  };

  Scene coarse_scene(const double offset, const double layer)
  {
    Scene scene                     = model_a();
    scene.mesh.face_size            = 2.;
    scene.geometry.interface_offset = offset;
    scene.layer.thickness           = layer;
    return scene;
  }

  std::map<unsigned int, double> areas(const dealii::Triangulation<2> &triangulation)
  {
    std::map<unsigned int, double> result;
    for (const auto &cell : triangulation.active_cell_iterators())
      result[cell->material_id()] += cell->measure();
    return result;
  }

  struct Line
  {
    double length  = 0.;
    double begin   = 1e300;
    double end     = -1e300;
    double lowest  = 1e300;
    double highest = -1e300;
  };

  Line boundary(const dealii::Triangulation<2> &triangulation, const dealii::types::boundary_id id)
  {
    Line line;
    for (const auto &face : triangulation.active_face_iterators())
      if (face->at_boundary() && face->boundary_id() == id)
      {
        line.length += face->measure();
        for (unsigned int v = 0; v < 2; ++v)
        {
          line.begin   = std::min(line.begin, face->vertex(v)[0]);
          line.end     = std::max(line.end, face->vertex(v)[0]);
          line.lowest  = std::min(line.lowest, face->vertex(v)[1]);
          line.highest = std::max(line.highest, face->vertex(v)[1]);
        }
      }
    return line;
  }

  // Areas and lengths are sums of rounded coordinates of 200 mm, written with 16 digits.
  void expect_built_in(const double offset, const double layer)
  {
    const auto scene = coarse_scene(offset, layer);
    dealii::Triangulation<2> triangulation;
    make_mesh(scene, triangulation);
    auto area = areas(triangulation);
    EXPECT_NEAR(area[material_id::lever], 210. * 20., 1e-8);
    EXPECT_NEAR(area[material_id::layer], 210. * layer, 1e-8);
    EXPECT_NEAR(area[material_id::hub], 10. * (20. + layer + offset), 1e-8);
    const auto face = boundary(triangulation, boundary_id::friction_face);
    EXPECT_NEAR(face.length, 210., 1e-9);
    EXPECT_NEAR(face.begin, 0., 1e-9);
    EXPECT_NEAR(face.lowest, offset, 1e-9);
    EXPECT_NEAR(face.highest, offset, 1e-9);
    for (const auto &cell : triangulation.active_cell_iterators())
      EXPECT_GT(cell->measure(), 0.);
  }

  /// A plain bar on a curve `hub` whose lower side lies at `offset`, from `begin` to `begin` + 200 mm; names as given.
  std::string bar(const std::string &surface, const std::string &face, const std::string &hub, const double offset = 45.6,
                  const double length = 210., const std::string &options = "Recombine Surface {1};\n")
  {
    const std::string l = std::to_string(length);
    const std::string e = std::to_string(offset);
    const std::string t = std::to_string(offset + 20.);
    return "Point(1) = {0, " + e + ", 0};\nPoint(2) = {" + l + ", " + e + ", 0};\nPoint(3) = {" + l + ", " + t +
           ", 0};\nPoint(4) = {0, " + t +
           ", 0};\nLine(1) = {1, 2};\nLine(2) = {2, 3};\nLine(3) = {3, 4};\nLine(4) = {4, 1};\n"
           "Curve Loop(1) = {1, 2, 3, 4};\nPlane Surface(1) = {1};\n"
           "Transfinite Curve {1, 3} = 43;\nTransfinite Curve {2, 4} = 5;\nTransfinite Surface {1};\n" +
           options + (surface.empty() ? "" : "Physical Surface(\"" + surface + "\") = {1};\n") +
           (face.empty() ? "" : "Physical Curve(\"" + face + "\") = {1};\n") +
           (hub.empty() ? "" : "Physical Curve(\"" + hub + "\") = {4};\n");
  }

  /// What make_mesh() says about a user's file.
  std::string complaint(const std::string &text, const std::string &name = "bar.geo")
  {
    const TemporaryFolder folder;
    Scene scene     = coarse_scene(45.6, 0.);
    scene.mesh.file = folder.write(name, text);
    dealii::Triangulation<2> triangulation;
    try
    {
      make_mesh(scene, triangulation);
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find(scene.mesh.file), std::string::npos) << error.what();
      return error.what();
    }
    return "";
  }

  void expect_named(const std::string &message, const std::string &words)
  {
    EXPECT_NE(message.find(words), std::string::npos) << "in: " << message;
  }
} // namespace

TEST(Mesh, BuiltInLeverHasItsPartsAtFullSize)
{
  expect_built_in(45.6, 1.);
}

TEST(Mesh, BuiltInLeverWithoutOffsetHasNoArm)
{
  expect_built_in(0., 1.);
}

TEST(Mesh, BuiltInLeverWithoutLayerIsBareMetal)
{
  expect_built_in(45.6, 0.);
  expect_built_in(0., 0.);
}

TEST(Mesh, BuiltInLeverHasTheFaceSizeWhereTheCylinderSweeps)
{
  const auto scene = coarse_scene(45.6, 1.);
  dealii::Triangulation<2> triangulation;
  make_mesh(scene, triangulation);
  unsigned int n_fine = 0;
  for (const auto &face : triangulation.active_face_iterators())
    if (face->at_boundary() && face->boundary_id() == boundary_id::friction_face && face->center()[0] > 121. &&
        face->center()[0] < 184.)
    {
      EXPECT_LE(face->measure(), 2. + 1e-9);
      ++n_fine;
    }
  EXPECT_GE(n_fine, 31u);
}

TEST(Mesh, UsersGeometryIsMeshed)
{
  const TemporaryFolder folder;
  Scene scene     = coarse_scene(45.6, 0.);
  scene.mesh.file = folder.write("bar.geo", bar("lever", "friction face", "hub"));
  dealii::Triangulation<2> triangulation;
  make_mesh(scene, triangulation);
  EXPECT_EQ(triangulation.n_active_cells(), 42u * 4u);
  EXPECT_NEAR(areas(triangulation)[material_id::lever], 4200., 1e-8);
  EXPECT_NEAR(boundary(triangulation, boundary_id::friction_face).length, 210., 1e-9);
  EXPECT_NEAR(boundary(triangulation, boundary_id::hub).length, 20., 1e-9);
}

TEST(Mesh, UsersMeshIsTakenAsItIs)
{
  const TemporaryFolder folder;
  Scene scene     = coarse_scene(10., 0.);
  scene.mesh.file = folder.write("two.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                                            "$PhysicalNames\n4\n1 11 \"friction face\"\n1 12 \"hub\"\n2 21 \"lever\"\n"
                                            "2 22 \"layer\"\n$EndPhysicalNames\n"
                                            "$Nodes\n6\n1 0 10 0\n2 200 10 0\n3 200 11 0\n4 0 11 0\n5 200 30 0\n6 0 30 0\n"
                                            "$EndNodes\n$Elements\n5\n1 1 2 11 1 1 2\n2 1 2 12 4 4 1\n3 1 2 12 5 6 4\n"
                                            "4 3 2 22 1 1 2 3 4\n5 3 2 21 2 4 3 5 6\n$EndElements\n");
  dealii::Triangulation<2> triangulation;
  make_mesh(scene, triangulation);
  EXPECT_EQ(triangulation.n_active_cells(), 2u);
  EXPECT_NEAR(areas(triangulation)[material_id::layer], 200., 1e-9);
  EXPECT_NEAR(areas(triangulation)[material_id::lever], 3800., 1e-9);
  EXPECT_NEAR(boundary(triangulation, boundary_id::hub).length, 20., 1e-9);
  EXPECT_NEAR(boundary(triangulation, boundary_id::friction_face).length, 200., 1e-9);
}

TEST(Mesh, MissingFrictionFaceIsNamedAndTheCurvesFoundAreListed)
{
  const auto message = complaint(bar("lever", "frictionface", "hub"));
  expect_named(message, "no physical curve 'friction face'");
  expect_named(message, "'frictionface'");
}

TEST(Mesh, MissingHubIsNamed)
{
  expect_named(complaint(bar("lever", "friction face", "")), "'hub'");
}

TEST(Mesh, UnknownSurfaceIsNamedWithTheKnownOnes)
{
  const auto message = complaint(bar("leever", "friction face", "hub"));
  expect_named(message, "unknown physical surface 'leever'");
  expect_named(message, "no physical surface 'lever'");
}

TEST(Mesh, EverythingMissingIsSaidAtOnce)
{
  const auto message = complaint(bar("", "", ""));
  expect_named(message, "'friction face'");
  expect_named(message, "'lever'");
  expect_named(message, "'hub'");
}

TEST(Mesh, TrianglesAreRefusedWithTheRemedy)
{
  const auto message = complaint(bar("lever", "friction face", "hub", 45.6, 210., ""));
  expect_named(message, "quadrilaterals");
  expect_named(message, "Recombine");
}

TEST(Mesh, FaceOffTheScenesInterfaceIsRefusedWithBothNumbers)
{
  const auto message = complaint(bar("lever", "friction face", "hub", 40.));
  expect_named(message, "Geometry/Interface offset");
  expect_named(message, "40");
  expect_named(message, "45.6");
}

TEST(Mesh, FaceThatTheContactLeavesIsRefusedWithBothSpans)
{
  const auto message = complaint(bar("lever", "friction face", "hub", 45.6, 150.));
  expect_named(message, "150");
  expect_named(message, "sweeps");
}

TEST(Mesh, MissingFileIsNamed)
{
  Scene scene     = coarse_scene(45.6, 0.);
  scene.mesh.file = "/nowhere/lever.geo";
  dealii::Triangulation<2> triangulation;
  EXPECT_THROW(make_mesh(scene, triangulation), InputError);
}

TEST(Mesh, FileThatIsNoGeometryIsNamed)
{
  EXPECT_NE(complaint("Point(1) = {0, 0\nno geometry;\n"), "");
  EXPECT_NE(complaint("nothing\n", "bar.msh"), "");
}
