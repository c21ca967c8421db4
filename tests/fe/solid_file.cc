// SPDX-License-Identifier: GPL-3.0-only
#include "fe/mesh/solid_file.h"

#include "base/errors.h"
#include "fe/body/body_properties.h"
#include "fe/mesh/lever_mesh.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/thrown.h"
#include "support/written.h"

#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Changes = std::vector<std::pair<std::string, std::string>>;

  /// A bar faced with a layer, of twelve and six hexahedra, with some of its script changed.
  Scene lever_scene(const Changes &changes = {})
  {
    std::string script = "Point(1) = {0, 45.6, -20}; Point(2) = {210, 45.6, -20};\n"
                         "Point(3) = {0, 46.6, -20}; Point(4) = {210, 46.6, -20};\n"
                         "Point(5) = {0, 66.6, -20}; Point(6) = {210, 66.6, -20};\n"
                         "Line(1) = {1, 2}; Line(2) = {3, 4}; Line(3) = {5, 6};\n"
                         "Line(4) = {1, 3}; Line(5) = {2, 4}; Line(6) = {3, 5}; Line(7) = {4, 6};\n"
                         "Curve Loop(1) = {1, 5, -2, -4}; Plane Surface(1) = {1};\n"
                         "Curve Loop(2) = {2, 7, -3, -6}; Plane Surface(2) = {2};\n"
                         "Transfinite Curve {1, 2, 3} = 4; Transfinite Curve {4, 5} = 2; Transfinite Curve {6, 7} = 3;\n"
                         "Transfinite Surface {1, 2}; Recombine Surface {1, 2};\n"
                         "a[] = Extrude {0, 0, 40} { Surface{1}; Layers{2}; Recombine; };\n"
                         "b[] = Extrude {0, 0, 40} { Surface{2}; Layers{2}; Recombine; };\n"
                         "Coherence;\n"
                         "Physical Surface(\"inside\") = {a[4]};\n"
                         "Physical Volume(\"layer\") = {a[1]};\n"
                         "Physical Volume(\"lever\") = {b[1]};\n"
                         "Physical Surface(\"friction face\") = {a[2]};\n"
                         "Physical Surface(\"hub\") = {b[5]};\n";
    for (const auto &[from, to] : changes)
    {
      const auto found = script.find(from);
      EXPECT_NE(found, std::string::npos) << from;
      script.replace(found, from.size(), to);
    }
    Scene scene              = model_a();
    scene.analysis.dimension = 3;
    scene.mesh.file          = written(script, "lever.geo");
    return scene;
  }

  std::vector<std::string> find_mistakes(const Scene &scene)
  {
    return without_folder(thrown_messages([&] { check_solid_file(scene); }));
  }

  void expect_mistake(const Changes &changes, const std::string &message)
  {
    const auto found = find_mistakes(lever_scene(changes));
    ASSERT_EQ(found.size(), 1u) << (found.empty() ? "" : found[1]);
    EXPECT_EQ(found[0], "lever.geo: " + message);
  }
} // namespace

TEST(SolidFile, KeepsItsGroups)
{
  const Scene scene = lever_scene();
  EXPECT_TRUE(has_solid_file(scene));
  dealii::Triangulation<3> triangulation;
  read_solid_file(scene, triangulation);
  std::map<unsigned int, double> volumes, sides;
  for (const auto &cell : triangulation.active_cell_iterators())
  {
    volumes[cell->material_id()] += cell->measure();
    for (const auto &side : cell->face_iterators())
      if (side->at_boundary())
        sides[side->boundary_id()] += side->measure();
  }
  EXPECT_EQ(triangulation.n_active_cells(), 18u);
  EXPECT_NEAR(volumes[material_id::layer], 210. * 40. * 1., 1e-6);
  EXPECT_NEAR(volumes[material_id::lever], 210. * 40. * 20., 1e-6);
  EXPECT_NEAR(sides[boundary_id::friction_face], 210. * 40., 1e-6);
  EXPECT_NEAR(sides[boundary_id::hub], 40. * 20., 1e-6);
}

TEST(SolidFile, CountsInThreeDimensionsAlone)
{
  Scene scene              = lever_scene();
  scene.analysis.dimension = 2;
  EXPECT_FALSE(has_solid_file(scene));
  Mesh plane;
  EXPECT_THROW(make_mesh(scene, plane), InputError);
  scene.analysis.dimension = 3;
  make_mesh(scene, plane);
  EXPECT_EQ(plane.n_active_cells(), 0u);
}

TEST(SolidFile, OtherElementsAreCounted)
{
  const std::string way = ", but must be made of hexahedra with 8 nodes; in a .geo extrude surfaces of quadrilaterals in layers: "
                          "'Recombine Surface {s}; Extrude {0, 0, 40} { Surface{s}; Layers{10}; Recombine; }', or use "
                          "'Transfinite Volume' and 'Recombine Surface'";
  const auto found      = find_mistakes(lever_scene({ { "Layers{2}; Recombine;", "" }, { "Layers{2}; Recombine;", "" } }));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find(" elements 'Tetrahedron 4'"), std::string::npos) << found[0];
  EXPECT_EQ(found[0].substr(found[0].find(", but must")), way);
  expect_mistake({ { "Recombine Surface {1, 2};", "" } }, "the mesh has 36 elements 'Prism 6'" + way);
}

TEST(SolidFile, AFaceThatIsNotFlatIsRefusedWithWhatItIsOff)
{
  expect_mistake({ { "Point(2) = {210, 45.6", "Point(2) = {210, 45.8" } },
                 "the surface 'friction face' is not flat: its nodes lie at y = 45.6 to 45.8 mm, 0.2 mm apart; all must lie at "
                 "Geometry/Interface offset = 45.6 mm");
  expect_mistake({ { "Point(1) = {0, 45.6", "Point(1) = {0, 45" }, { "Point(2) = {210, 45.6", "Point(2) = {210, 45" } },
                 "the surface 'friction face' lies at y = 45 mm, but Geometry/Interface offset = 45.6");
}

TEST(SolidFile, LinesOfNodesGoAlongTheAxes)
{
  const auto found = find_mistakes(lever_scene({ { "{0, 0, 40}", "{5, 0, 40}" }, { "{0, 0, 40}", "{5, 0, 40}" } }));
  ASSERT_EQ(found.size(), 1u);
  const std::string rule = "lever.geo: the sides of cells on 'friction face' must be rectangles in lines along x and z, from end "
                           "to end: the one at x = ";
  EXPECT_EQ(found[0].substr(0, rule.size()), rule);
}

TEST(SolidFile, ItsWidthIsTheLeversAboutTheMiddle)
{
  Changes half, shifted;
  for (unsigned int i = 0; i < 6; ++i)
    shifted.push_back({ ", -20}", ", 0}" });
  half = shifted;
  for (unsigned int i = 0; i < 2; ++i)
    half.push_back({ "{0, 0, 40}", "{0, 0, 20}" });
  const std::string rule  = "mm, but z counts from the middle of Lever/Width = 40: -20 to 20 mm";
  const std::string whole = "; give the whole lever: of a mesh of one's own no half is solved";
  expect_mistake(half, "the surface 'friction face' spans z = 0 to 20 " + rule + whole);
  expect_mistake(shifted, "the surface 'friction face' spans z = 0 to 40 " + rule + whole);
  expect_mistake({ { "{0, 0, 40}", "{0, 0, 30}" }, { "{0, 0, 40}", "{0, 0, 30}" } },
                 "the surface 'friction face' spans z = -20 to 10 " + rule);
}

TEST(SolidFile, MissingGroupsAreNamedWithTheNearest)
{
  expect_mistake({ { "\"friction face\"", "\"frictionface\"" } },
                 "no physical surface 'friction face', where the cylinder slides (surfaces found: 'frictionface', 'hub', "
                 "'inside'); did you mean 'frictionface'?");
  const auto found = find_mistakes(lever_scene({ { "\"lever\"", "\"Lever\"" }, { "\"hub\"", "\"clamp\"" } }));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0],
            "lever.geo: unknown physical volume 'Lever': volumes are 'lever', 'plate', 'layer' and 'hub' (all but 'lever' "
            "optional)");
  EXPECT_EQ(found[1],
            "lever.geo: no physical volume 'lever', the metal (volumes found: 'Lever', 'layer'); did you mean 'Lever'?");
  EXPECT_EQ(found[2], "lever.geo: no physical surface 'hub', which carries the lever on its pivot, nor a volume 'hub' (surfaces "
                      "found: 'clamp', 'friction face', 'inside')");
  Scene plate      = lever_scene();
  plate.plate.type = PlateType::on_sensors;
  EXPECT_EQ(find_mistakes(plate).size(), 3u);
}

// A tenth of a micrometre apart: nearer than nodes are meant to be.
TEST(SolidFile, PartsThatTouchAndShareNoNodesAreRefused)
{
  const auto found = find_mistakes(
      lever_scene({ { "Line(1)", "Point(7) = {0, 46.6001, -20}; Point(8) = {210, 46.6001, -20}; Line(8) = {7, 8};\nLine(1)" },
                    { "Line(6) = {3, 5}; Line(7) = {4, 6}", "Line(6) = {7, 5}; Line(7) = {8, 6}" },
                    { "Curve Loop(2) = {2,", "Curve Loop(2) = {8," },
                    { "Curve {1, 2, 3}", "Curve {1, 2, 3, 8}" } }));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NE(found[0].find("24 nodes lie on a side of an element that they are no corners of"), std::string::npos) << found[0];
  EXPECT_NE(found[1].find("the part of 'layer'"), std::string::npos) << found[1];
  EXPECT_NE(found[1].find("floats"), std::string::npos) << found[1];
}
