// SPDX-License-Identifier: GPL-3.0-only
#include "fe/mesh/lever_mesh.h"

#include "base/errors.h"
#include "fe/body/body_properties.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/made_mesh.h"
#include "support/temporary_folder.h"
#include "support/thrown.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>

using namespace sprag;

namespace
{
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
    const MadeMesh triangulation(scene);
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

  constexpr double model_a_offset = 45.6;

  /// A lever with a frame or plate on the models' friction face.
  Scene built(const double offset, const LeverOutline outline, const PlateType plate)
  {
    Scene scene         = coarse_scene(offset, 1.);
    scene.lever.outline = outline;
    scene.plate.type    = plate;
    if (offset == 0.)
    {
      scene.geometry.cylinder_radius = 21.1;
      scene.geometry.pivot_distance  = 193.9;
    }
    return scene;
  }

  /// Area of the arm's metal between two xi and between two parts of its depth, flanges of given depth aside.
  double taper(const Scene &scene, const double from, const double to, const double flanges)
  {
    const auto depth = [&](const double xi)
    {
      const double way = (xi - scene.frame.root) / (scene.lever.length - scene.frame.root);
      return scene.lever.depth + way * (scene.frame.tip_depth - scene.lever.depth) - flanges;
    };
    return 0.5 * (to - from) * (depth(from) + depth(to));
  }

  double pocket_area(const Scene &scene)
  {
    const auto &frame   = scene.frame;
    const double pocket = (scene.lever.length - frame.root - (frame.pockets + 1) * frame.rib) / frame.pockets;
    double sum          = 0.;
    for (unsigned int i = 0; i < frame.pockets; ++i)
    {
      const double begin = frame.root + frame.rib + i * (pocket + frame.rib);
      sum += taper(scene, begin, begin + pocket, 2. * frame.flange);
    }
    return sum;
  }

  /// Metal of full width: the arm less its pockets, and the root around a hub of 5 mm with 10 mm from its axis to the outside.
  double frame_area(const Scene &scene, const double front)
  {
    const double arm  = taper(scene, scene.frame.root, scene.lever.length, 0.);
    const double root = (scene.frame.root + 10.) * (10. + std::max(front + scene.lever.depth, 10.));
    return arm - pocket_area(scene) + root - M_PI * 25.;
  }

  void expect_plate(const Scene &scene, const dealii::Triangulation<2> &triangulation)
  {
    const double back = scene.geometry.interface_offset + 1. + scene.plate.thickness;
    auto area         = areas(triangulation);
    EXPECT_NEAR(area[material_id::plate], 110. * 8., 1e-8);
    EXPECT_NEAR(area[material_id::layer], 110., 1e-8);
    const auto face = boundary(triangulation, boundary_id::friction_face);
    EXPECT_NEAR(face.begin, 95., 1e-9);
    EXPECT_NEAR(face.end, 205., 1e-9);
    const auto plate = boundary(triangulation, boundary_id::sensor_plate);
    EXPECT_NEAR(plate.length, 110., 1e-9);
    EXPECT_NEAR(plate.lowest, back, 1e-9);
    EXPECT_NEAR(plate.highest, back, 1e-9);
    const auto lever = boundary(triangulation, boundary_id::sensor_lever);
    EXPECT_LE(lever.begin, 95.);
    EXPECT_GE(lever.end, 205.);
    EXPECT_NEAR(lever.lowest, back + scene.plate.spacer, 1e-9);
    EXPECT_NEAR(lever.highest, back + scene.plate.spacer, 1e-9);
  }

  /// No smaller angle than this at any corner, and the finest cells where the cylinder sweeps.
  void expect_good_cells(const Scene &scene, const dealii::Triangulation<2> &triangulation)
  {
    const double smallest = std::sin(10. * M_PI / 180.);
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      EXPECT_GT(cell->measure(), 0.);
      const unsigned int around[] = { 0, 1, 3, 2 };
      for (unsigned int v = 0; v < 4; ++v)
      {
        const auto a = cell->vertex(around[(v + 3) % 4]) - cell->vertex(around[v]);
        const auto b = cell->vertex(around[(v + 1) % 4]) - cell->vertex(around[v]);
        EXPECT_GT((b[0] * a[1] - b[1] * a[0]) / (a.norm() * b.norm()), smallest) << cell->center();
      }
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() && face->boundary_id() == boundary_id::friction_face && face->center()[0] > 131. &&
            face->center()[0] < 184.)
        {
          EXPECT_LE(face->measure(), scene.mesh.face_size + 1e-9);
        }
    }
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

  /// Returns the message of make_mesh() about a user's file.
  std::string complaint(const std::string &script)
  {
    const TemporaryFolder folder;
    Scene scene     = coarse_scene(45.6, 0.);
    scene.mesh.file = folder.write("bar.geo", script);
    dealii::Triangulation<2> triangulation;
    const auto text = thrown_text([&] { make_mesh(scene, triangulation); });
    EXPECT_NE(text.find(scene.mesh.file), std::string::npos) << text;
    return text;
  }

  void expect_named(const std::string &message, const std::string &words)
  {
    EXPECT_NE(message.find(words), std::string::npos) << "in: " << message;
  }
} // namespace

TEST(Mesh, BuiltInLeverHasItsPartsAtFullSize)
{
  for (const double offset : { 0., model_a_offset })
    for (const double layer : { 0., 1. })
      expect_built_in(offset, layer);
}

TEST(Mesh, PlateLiesFreeBeforeTheBar)
{
  for (const double offset : { 0., model_a_offset })
  {
    const auto scene = built(offset, LeverOutline::bar, PlateType::on_sensors);
    const MadeMesh triangulation(scene);
    auto area = areas(triangulation);
    EXPECT_NEAR(area[material_id::lever], 210. * 20., 1e-8);
    EXPECT_NEAR(area[material_id::hub], 10. * (20. + offset + 1. + 8. + 6.), 1e-8);
    expect_plate(scene, triangulation);
    expect_good_cells(scene, triangulation);
  }
}

TEST(Mesh, FrameHasRootArmAndWebs)
{
  for (const double offset : { 0., 4., model_a_offset })
  {
    const auto scene = built(offset, LeverOutline::frame, PlateType::none);
    const MadeMesh triangulation(scene);
    auto area = areas(triangulation);
    // The hub's circle is a polygon of 30 sides and more.
    EXPECT_NEAR(area[material_id::lever], frame_area(scene, offset + 1.), 0.8);
    EXPECT_NEAR(area[material_id::web], pocket_area(scene), 1e-8);
    EXPECT_NEAR(area[material_id::layer], 174., 1e-8);
    const auto face = boundary(triangulation, boundary_id::friction_face);
    EXPECT_NEAR(face.begin, 36., 1e-9);
    EXPECT_NEAR(face.end, 210., 1e-9);
    EXPECT_NEAR(face.lowest, offset, 1e-9);
    const auto hub = boundary(triangulation, boundary_id::hub);
    EXPECT_NEAR(hub.length, 2. * M_PI * 5., 0.3);
    EXPECT_NEAR(hub.begin, -5., 0.1);
    EXPECT_NEAR(hub.highest, 5., 0.1);
    expect_good_cells(scene, triangulation);
  }
}

TEST(Mesh, FrameCarriesAPlate)
{
  for (const double offset : { 0., model_a_offset })
  {
    const auto scene = built(offset, LeverOutline::frame, PlateType::on_sensors);
    const MadeMesh triangulation(scene);
    EXPECT_NEAR(areas(triangulation)[material_id::lever], frame_area(scene, offset + 15.), 0.8);
    expect_plate(scene, triangulation);
    expect_good_cells(scene, triangulation);
  }
}

TEST(Mesh, FrameWithoutPocketsIsSolid)
{
  auto scene            = built(0., LeverOutline::frame, PlateType::none);
  scene.frame.pockets   = 0;
  scene.frame.flange    = 1.5;
  scene.lever.depth     = 5.;
  scene.frame.tip_depth = 4.;
  const MadeMesh triangulation(scene);
  auto area = areas(triangulation);
  EXPECT_EQ(area.count(material_id::web), 0u);
  EXPECT_NEAR(area[material_id::lever], 180. * 4.5 + 40. * 20. - M_PI * 25., 0.8);
  expect_good_cells(scene, triangulation);
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
  const MadeMesh triangulation(scene);
  EXPECT_EQ(triangulation.n_active_cells(), 2u);
  EXPECT_NEAR(areas(triangulation)[material_id::layer], 200., 1e-9);
  EXPECT_NEAR(areas(triangulation)[material_id::lever], 3800., 1e-9);
  EXPECT_NEAR(boundary(triangulation, boundary_id::hub).length, 20., 1e-9);
  EXPECT_NEAR(boundary(triangulation, boundary_id::friction_face).length, 200., 1e-9);
}

TEST(Mesh, WhatIsWrongWithAFileIsNamed)
{
  const std::string lever = "lever", face = "friction face", hub = "hub";
  const std::vector<std::pair<std::string, std::vector<std::string>>> wrong = {
    { bar(lever, "frictionface", hub), { "no physical curve 'friction face'", "'frictionface'" } },
    { bar("leever", face, hub), { "unknown physical surface 'leever'", "no physical surface 'lever'" } },
    { bar("", "", ""), { "'friction face'", "'lever'", "'hub'" } },
    { bar(lever, face, hub, 45.6, 210., ""), { "quadrilaterals", "Recombine" } },
    { bar(lever, face, hub, 40.), { "Geometry/Interface offset", "40", "45.6" } },
    { bar(lever, face, hub, 45.6, 150.), { "150", "sweeps" } },
    { bar("plate", face, hub), { "has a surface 'plate', but Friction plate/Type = none" } },
  };
  for (const auto &[text, all_words] : wrong)
  {
    const auto message = complaint(text);
    for (const auto &words : all_words)
      expect_named(message, words);
  }
}

TEST(Mesh, PlateThatTheFileLacksIsNamed)
{
  const TemporaryFolder folder;
  Scene scene      = coarse_scene(45.6, 0.);
  scene.plate.type = PlateType::on_sensors;
  scene.mesh.file  = folder.write("bar.geo", bar("lever", "friction face", "hub"));
  dealii::Triangulation<2> triangulation;
  const auto text = thrown_text([&] { make_mesh(scene, triangulation); });
  expect_named(text, "Friction plate/Type = on sensors, but there is no physical surface 'plate'");
  expect_named(text, "'sensor plate'");
  expect_named(text, "'sensor lever'");
}

namespace
{
  /// A layer of 1 mm and a bar that are drawn by themselves, `gap` apart, with nodes along each; `hub` lists its curves.
  std::string two_parts(const unsigned int along_layer, const unsigned int along_lever, const double gap, const std::string &hub)
  {
    const std::string bottom = std::to_string(46.6 + gap);
    return "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 45.6, 0, 210, 1};\nRectangle(2) = {0, " + bottom +
           ", 0, 210, 20};\nTransfinite Curve {1, 3} = " + std::to_string(along_layer) +
           ";\nTransfinite Curve {5, 7} = " + std::to_string(along_lever) +
           ";\nTransfinite Curve {2, 4} = 2;\nTransfinite Curve {6, 8} = 3;\nTransfinite Surface {1, 2};\n"
           "Recombine Surface {1, 2};\nPhysical Surface(\"layer\") = {1};\nPhysical Surface(\"lever\") = {2};\n"
           "Physical Curve(\"friction face\") = {1};\nPhysical Curve(\"hub\") = {" +
           hub + "};\n";
  }
} // namespace

TEST(Mesh, PartsThatTouchAndShareNoNodesAreRefused)
{
  const auto twins = complaint(two_parts(43, 43, 0., "4, 8"));
  expect_named(twins, "86 nodes lie on a side of an element that they are no corners of");
  expect_named(twins, "touches");
  expect_named(complaint(two_parts(43, 22, 0., "4, 8")), "65 nodes lie on a side");
}

TEST(Mesh, PartsThatNothingHoldsAreNamed)
{
  expect_named(complaint(two_parts(43, 43, 0.5, "8")), "the part of 'layer' with an element at (2.5, 46.1) mm floats");
  expect_named(complaint(two_parts(43, 43, 0.5, "4, 8")), "shares no side of an element with 'lever'");
}

TEST(Mesh, FrictionFaceWithAGapUnderTheContactIsRefused)
{
  const std::string split =
      "Point(5) = {140, 45.6, 0}; Point(6) = {160, 45.6, 0};\nLine(1) = {1, 5}; Line(5) = {5, 6}; Line(6) = "
      "{6, 2};\nTransfinite Curve {1, 6} = 20; Transfinite Curve {5} = 5;\n";
  std::string text = bar("lever", "friction face", "hub");
  text.replace(text.find("Line(1) = {1, 2};\n"), 18, split);
  text.replace(text.find("{1, 2, 3, 4};\nPlane"), 12, "{1, 5, 6, 2, 3, 4}");
  text.replace(text.find("Curve {1, 3} = 43"), 17, "Curve {3} = 43");
  text.replace(text.find("Surface {1};\nRec"), 11, "Surface {1} = {1, 2, 3, 4}");
  text.replace(text.find("\"friction face\") = {1}"), 22, "\"friction face\") = {1, 6}");
  expect_named(complaint(text), "lacks a piece from 140 to 160 mm from the pivot, but the contact sweeps");
}

TEST(Mesh, BodyOnTheCylindersSideIsRefused)
{
  std::string text = bar("lever", "friction face", "hub", 25.6);
  text.replace(text.find("\"friction face\") = {1}"), 22, "\"friction face\") = {3}");
  expect_named(complaint(text), "the body lies on the cylinder's side of 'friction face'");
}

TEST(Mesh, CurveInTwoGroupsIsRefused)
{
  expect_named(complaint(bar("lever", "friction face", "hub") + "Physical Curve(\"hub\") += {1};\n"),
               "the physical groups 'friction face' and 'hub' have elements in common");
}
