// SPDX-License-Identifier: GPL-3.0-only
#include "fe/mesh/solid_file.h"
#include "fe/mesh/geometry_script.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"
#include "support/written.h"
#include "verification/solid_run.h"

#include <iomanip>
#include <sstream>

using namespace sprag;

namespace
{
  /// The script of the built-in lever with the scene's dimensions, extruded over the width from the middle to both sides.
  std::string extruded_lever(const Scene &scene)
  {
    const double room        = 0.1 * scene.geometry.cylinder_radius;
    const auto [first, last] = swept_contact(scene);
    std::ostringstream script;
    script << std::setprecision(17) << "face_size = " << scene.mesh.face_size << "; sweep_begin = " << first - room
           << "; sweep_end = " << last + room << ";\nInclude \"" << mesh_script("lever.geo") << "\";\n"
           << "metal_there[] = {bar[1]}; layer_there[] = {cork[1]}; hub_there[] = {hub[]};\n"
              "metals[] = {}; corks[] = {}; hubs[] = {};\n"
              "For side In {-1:1:2}\n"
              "  made[] = Extrude {0, 0, side * "
           << 0.5 * scene.lever.width << "} { Surface{metal_there[0]}; Layers{2}; Recombine; }; metals[] += made[1];\n"
           << "  made[] = Extrude {0, 0, side * " << 0.5 * scene.lever.width
           << "} { Surface{layer_there[0]}; Layers{2}; Recombine; }; corks[] += made[1];\n"
              "  For i In {0:#hub_there[] - 1}\n"
              "    made[] = Extrude {0, 0, side * "
           << 0.5 * scene.lever.width
           << "} { Surface{hub_there[i]}; Layers{2}; Recombine; }; hubs[] += made[1];\n"
              "  EndFor\n"
              "EndFor\n"
              "Coherence;\n"
              "Delete Physicals;\n"
              "Physical Volume(\"lever\") = {metals[]}; Physical Volume(\"layer\") = {corks[]}; Physical Volume(\"hub\") = "
              "{hubs[]};\n"
              "Physical Surface(\"friction face\") = Surface In BoundingBox {-0.001, offset - 0.001, -100, 1000, offset + 0.001, "
              "100};\n";
    return script.str();
  }
} // namespace

TEST(SolidFile, TheBuiltInLeverExtrudedInAFileGivesItsAnswer)
{
  Scene built_in              = solid_model_a(0.3);
  built_in.mesh.growth_across = 1.;
  Scene own                   = built_in;
  own.mesh.file               = written(extruded_lever(built_in), "solid.geo");
  ASSERT_TRUE(has_solid_file(own));
  const SolidRun expected(built_in), found(own); // a half and a whole
  for (const Column column : { Column::P, Column::Q, Column::theta, Column::friction_work, Column::largest_pressure })
    EXPECT_LT(difference(expected.rows, found.rows, column), 1e-6) << column_info(column).name;
}
