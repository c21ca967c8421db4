#include "scene/check_spring.h"

#include "base/text.h"

#include <cmath>

namespace sprag
{
  using Violations = std::vector<Violation>;

  Violations spring_violations(const Scene &scene)
  {
    const LeafSpring &leaf = scene.spring.leaf;
    if (scene.spring.type != SpringType::leaf)
      return {};
    Violations result;
    const double end = leaf.clamp_distance + leaf.length;
    if (end > leaf.room)
      result.push_back({ "Leaf spring/Length",
                         { "Rotational spring/Type", "Leaf spring/Clamp distance", "Leaf spring/Room" },
                         "must be at most Room - Clamp distance = " + rounded_text(leaf.room - leaf.clamp_distance) +
                             " mm, or the spring is longer than the pivot frame" });
    if (leaf.thickness > 0.2 * leaf.length)
      result.push_back({ "Leaf spring/Thickness",
                         { "Rotational spring/Type", "Leaf spring/Length" },
                         "must be at most a fifth of the length, " + rounded_text(0.2 * leaf.length) + " mm" });
    if (std::abs(leaf.sagitta) > 0.25 * leaf.length)
      result.push_back({ "Leaf spring/Sagitta",
                         { "Rotational spring/Type", "Leaf spring/Length" },
                         "must be at most a quarter of the length, " + rounded_text(0.25 * leaf.length) + " mm" });
    return result;
  }

  Violations cylinder_violations(const Scene &scene)
  {
    const auto &cylinder = scene.cylinder;
    if (cylinder.type == CylinderType::rigid)
      return {};
    Violations result;
    const double R = scene.geometry.cylinder_radius;
    if (cylinder.inner_radius > 0.95 * R)
      result.push_back({ "Cylinder/Inner radius",
                         { "Cylinder/Type", "Geometry/Cylinder radius" },
                         "must be at most 0.95 R = " + rounded_text(0.95 * R) + " mm" });
    if (cylinder.face_size > 0.1 * R)
      result.push_back({ "Cylinder/Face size",
                         { "Cylinder/Type", "Geometry/Cylinder radius" },
                         "must be at most 0.1 R = " + rounded_text(0.1 * R) + " mm" });
    if (scene.mesh.degree < 2)
      result.push_back({ "Mesh/Degree",
                         { "Cylinder/Type" },
                         "must be 2 with an elastic cylinder: the corners of straight sides falsify the friction" });
    if (scene.lever.material != MaterialModel::linear)
      result.push_back({ "Lever/Material", { "Cylinder/Type" }, "must be linear with an elastic cylinder" });
    return result;
  }

  Violations calibration_violations(const Scene &scene)
  {
    Violations result;
    if (scene.calibration.stiffness && scene.spring.type != SpringType::leaf)
      result.push_back({ "Calibration/Stiffness",
                         { "Analysis/Type", "Rotational spring/Type" },
                         "needs Rotational spring/Type = leaf, whose thickness is found" });
    if (scene.lever.material != MaterialModel::linear)
      result.push_back({ "Lever/Material", { "Analysis/Type" }, "must be linear where it is calibrated" });
    return result;
  }
} // namespace sprag
