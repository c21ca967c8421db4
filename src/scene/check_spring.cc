#include "scene/check_parts.h"

#include "base/text.h"

#include <cmath>

namespace sprag
{
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
