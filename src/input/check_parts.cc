// SPDX-License-Identifier: GPL-3.0-only
#include "input/check_parts.h"

#include "base/text.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// Young's modulus of the part that carries the friction face [MPa].
    double face_young_modulus(const Scene &scene)
    {
      if (scene.layer.thickness > 0.)
        return scene.layer.young_modulus;
      return scene.plate.type == PlateType::on_sensors ? scene.plate.young_modulus : scene.lever.young_modulus;
    }
  } // namespace

  double largest_penalty(const Scene &scene)
  {
    constexpr double over_cells = 250., over_layer = 1200., over_cells_without_layer = 100.;
    const double E = face_young_modulus(scene);
    const double t = scene.layer.thickness;
    const double h = scene.mesh.face_size;
    return t > 0. ? std::max(over_cells * E / h, over_layer * E / t) : over_cells_without_layer * E / h;
  }

  void check_penalty(const Scene &scene, Rules &rules)
  {
    const auto add =
        [&](const std::string &parameter, const std::optional<double> &value, const double largest, const std::string &effect)
    {
      rules.need(!value || *value <= largest, parameter,
                 { "Mesh/Face size", "Friction layer/Thickness", "Friction layer/Young's modulus", "Lever/Young's modulus",
                   "Friction plate/Young's modulus" },
                 "must be <= " + rounded_text(largest) + " N/mm3 for this layer and mesh: a stiffer one " + effect +
                     " lets Newton's method fail; leave it at auto");
    };
    const double largest = largest_penalty(scene);
    add("Contact/Penalty", scene.contact.penalty, largest,
        "moves P by less than 1e-4, lets single points carry the pressure and");
    add("Contact/Tangential penalty", scene.contact.tangential_penalty, 10. * largest, "moves Q by less than 1e-4 and");
  }

  void check_spring(const Scene &scene, Rules &rules)
  {
    const LeafSpring &leaf = scene.spring.leaf;
    if (scene.spring.type != SpringType::leaf)
      return;
    rules.need(leaf.clamp_distance + leaf.length <= leaf.room, "Leaf spring/Length",
               { "Rotational spring/Type", "Leaf spring/Clamp distance", "Leaf spring/Room" },
               "must be at most Room - Clamp distance = " + mm(leaf.room - leaf.clamp_distance) +
                   ", or the spring is longer than the pivot frame");
    rules.need(leaf.thickness <= 0.2 * leaf.length, "Leaf spring/Thickness", { "Rotational spring/Type", "Leaf spring/Length" },
               "must be at most a fifth of the length, " + mm(0.2 * leaf.length));
    rules.need(std::abs(leaf.sagitta) <= 0.25 * leaf.length, "Leaf spring/Sagitta",
               { "Rotational spring/Type", "Leaf spring/Length" },
               "must be at most a quarter of the length, " + mm(0.25 * leaf.length));
  }

  void check_cylinder(const Scene &scene, Rules &rules)
  {
    const auto &cylinder = scene.cylinder;
    if (cylinder.type == CylinderType::rigid)
      return;
    const double R = scene.geometry.cylinder_radius;
    rules.need(cylinder.inner_radius <= 0.95 * R, "Cylinder/Inner radius", { "Cylinder/Type", "Geometry/Cylinder radius" },
               "must be at most 0.95 R = " + mm(0.95 * R));
    rules.need(cylinder.face_size <= 0.1 * R, "Cylinder/Face size", { "Cylinder/Type", "Geometry/Cylinder radius" },
               "must be at most 0.1 R = " + mm(0.1 * R));
    rules.need(scene.mesh.degree >= 2, "Mesh/Degree", { "Cylinder/Type" },
               "must be 2 with an elastic cylinder: the corners of straight sides falsify the friction");
    rules.need(scene.lever.material == MaterialModel::linear, "Lever/Material", { "Cylinder/Type" },
               "must be linear with an elastic cylinder");
  }

  void check_calibration(const Scene &scene, Rules &rules)
  {
    rules.need(!scene.calibration.stiffness || scene.spring.type == SpringType::leaf, "Calibration/Stiffness",
               { "Analysis/Type", "Rotational spring/Type" }, "needs Rotational spring/Type = leaf, whose thickness is found");
    rules.need(scene.lever.material == MaterialModel::linear, "Lever/Material", { "Analysis/Type" },
               "must be linear where it is calibrated");
  }
} // namespace sprag
