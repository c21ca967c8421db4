// SPDX-License-Identifier: GPL-3.0-only
#include "input/check_parts.h"

#include "base/text.h"
#include "scene/analysis_use.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"

#include <cmath>

namespace sprag
{
  namespace
  {
    void what_there_is(const Scene &scene, Rules &rules)
    {
      const std::string in_plane = ": in three dimensions there is no other yet";
      const auto need            = [&](const bool kept, const std::string &parameter, const std::string &word)
      { rules.need(kept, parameter, { "Analysis/Dimension" }, "must be " + word + in_plane); };
      const auto &analysis = scene.analysis;
      const auto type      = analysis.type == AnalysisType::study ? scene.study.type : analysis.type;
      const bool is_static = type == AnalysisType::quasi_static;
      need(runs_model(type) || type == AnalysisType::isolation,
           analysis.type == AnalysisType::study ? "Study/Type" : "Analysis/Type",
           "quasi-static, modal, stability, sprag-slip, map, transient or isolation");
      if (is_static)
        need(analysis.model == ModelType::finite_element, "Analysis/Model", "finite element without inertia");
      else
        need(analysis.model == ModelType::condensed, "Analysis/Model", "condensed with inertia");
      need(type != AnalysisType::isolation || scene.isolation.damper == DamperType::lever, "Isolation/Damper", "lever");
      need(analysis.solution == Solution::automatic, "Analysis/Solution", "automatic");
      need(scene.cylinder.type == CylinderType::rigid, "Cylinder/Type", "rigid");
      rules.need(scene.pair.type == PairType::half || !scene.cylinder.has_free_axis(),
                 scene.cylinder.tilt_stiffness ? "Cylinder/Tilt stiffness" : "Cylinder/Skew stiffness",
                 { "Mirrored pair/Type", "Analysis/Dimension" },
                 "must be auto between the levers of a full pair: an axis that yields to both is not looked at yet");
    }

    void cylinder_across(const Scene &scene, Rules &rules)
    {
      const auto &cylinder = scene.cylinder;
      const double half    = 0.5 * scene.lever.width;
      if (cylinder.length > 0.)
      {
        rules.need(std::abs(cylinder.position) < half + 0.5 * cylinder.length, "Cylinder/Position", { "Cylinder/Length" },
                   "must leave a part of the cylinder over the lever, " + mm(-half) + " to " + mm(half) + " from its middle");
        rules.need(cylinder.edge_radius <= 0.5 * cylinder.length, "Cylinder/Edge radius", { "Cylinder/Length" },
                   "must be at most half of Length = " + mm(cylinder.length));
        if (scene.mesh.file.empty())
        {
          const auto too_short = cylinder_too_short(scene, planes_across(scene));
          rules.need(too_short.empty(), "Cylinder/Length", { "Mesh/Elements across", "Mesh/Growth across", "Lever/Width" },
                     too_short);
        }
      }
      else
        rules.need(cylinder.edge_radius == 0., "Cylinder/Edge radius", { "Cylinder/Length" },
                   "must be 0 where Length = 0: the ends then lie beyond the lever");
    }

    void sensors_at_sides(const Scene &scene, Rules &rules)
    {
      const auto &plate   = scene.plate;
      const double half   = 0.5 * scene.lever.width;
      const double middle = sensors_across(scene), zeta = 0.5 * plate.sensor_width;
      const double small = 1e-9 * half;
      rules.need(plate.sensor_width <= half + small, "Friction plate/Sensor width", { "Lever/Width", "Friction plate/Type" },
                 "must be at most half of Lever/Width = " + mm(scene.lever.width) + ", or left and right overlap");
      if (plate.sensor_width <= half + small)
        rules.need(middle - zeta >= -small && middle + zeta <= half + small, "Friction plate/Sensors across",
                   { "Friction plate/Sensor width", "Lever/Width", "Friction plate/Type" },
                   "must be " + rounded_text(zeta) + " to " + mm(half - zeta) + ": with all its Sensor width = " +
                       mm(plate.sensor_width) + " each lies on its side of the middle and on the plate");
    }
  } // namespace

  void check_solid(const Scene &scene, Rules &rules)
  {
    what_there_is(scene, rules);
    cylinder_across(scene, rules);
    if (scene.plate.type == PlateType::on_sensors)
      sensors_at_sides(scene, rules);
  }
} // namespace sprag
