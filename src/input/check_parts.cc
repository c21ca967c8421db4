// SPDX-License-Identifier: GPL-3.0-only
#include "input/check.h"

#include "base/ranges.h"
#include "base/text.h"
#include "scene/analysis_use.h"
#include "scene/lever_shape.h"
#include "scene/mirrored_pair.h"
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

    using Names = std::vector<std::string>;

    const Names sweep = {
      // The contact's way along the lever depends on the geometry.
      "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot distance",
      // It depends on the ends of the drive too.
      "Drive/Start", "Drive/Stroke", "Drive/Profile", "Drive/Table"
    };

    void frame(const Scene &scene, Rules &rules)
    {
      const auto &frame      = scene.frame;
      const double shallow   = std::min(frame.tip_depth, scene.lever.depth);
      const double least     = frame_hub_radius + frame_wall;
      const double arm       = scene.lever.length - frame.root;
      const double rib_sum   = (frame.pockets + 1) * frame.rib;
      const std::string ribs = std::to_string(frame.pockets + 1) + (frame.pockets == 0 ? " rib of " : " ribs of ");
      rules.need(2. * frame.flange < shallow, "Lever frame/Flange", { "Lever frame/Tip depth", "Lever/Depth", "Lever/Outline" },
                 "must be less than half the arm's least depth, " + mm(shallow));
      rules.need(frame.web <= scene.lever.width, "Lever frame/Web", { "Lever/Width", "Lever/Outline" },
                 "must not be more than Lever/Width = " + mm(scene.lever.width));
      rules.need(frame.root > least, "Lever frame/Root", { "Lever/Outline" },
                 "must be more than " + mm(least) + ", radius and wall of the hub that the root is held by");
      rules.need(rib_sum < arm, "Lever frame/Pockets", { "Lever frame/Rib", "Lever frame/Root", "Lever/Length", "Lever/Outline" },
                 "must leave the pockets room: " + ribs + mm(frame.rib) + " are no shorter than the arm, " + mm(arm));
    }

    void sensors(const FrictionPlate &plate, Rules &rules)
    {
      rules.need(plate.sensors.size() >= 2, "Friction plate/Sensors", { "Friction plate/Type" },
                 "must be at least two, or the plate tilts");
      for (std::size_t i = 1; i < plate.sensors.size(); ++i)
        if (plate.sensors[i] < plate.sensors[i - 1] + plate.sensor_length)
          return rules.need(false, "Friction plate/Sensors", { "Friction plate/Sensor length", "Friction plate/Type" },
                            "must increase by at least Sensor length = " + mm(plate.sensor_length) +
                                " from one to the next: " + rounded_text(plate.sensors[i - 1]) + " and " + mm(plate.sensors[i]));
    }

    void on_plate(const FrictionPlate &plate, const std::string &parameter, const std::vector<double> &middles, Rules &rules)
    {
      for (const double middle : middles)
        if (middle < plate.begin + 0.5 * plate.sensor_length || middle > plate.end - 0.5 * plate.sensor_length)
          return rules.need(
              false, parameter,
              { "Friction plate/Begin", "Friction plate/End", "Friction plate/Sensor length", "Friction plate/Type" },
              "must lie on the plate with all its Sensor length = " + mm(plate.sensor_length) + ": " + mm(middle) +
                  " is no middle between Begin = " + mm(plate.begin) + " and End = " + mm(plate.end));
    }

    void plate(const Scene &scene, Rules &rules)
    {
      const auto &plate = scene.plate;
      rules.need(plate.end > plate.begin, "Friction plate/End", { "Friction plate/Begin", "Friction plate/Type" },
                 "must be more than Begin = " + mm(plate.begin));
      rules.need(plate.end <= scene.lever.length, "Friction plate/End", { "Lever/Length", "Friction plate/Type" },
                 "must not be more than Lever/Length = " + mm(scene.lever.length));
      if (scene.lever.outline == LeverOutline::frame)
        rules.need(plate.begin >= scene.frame.root, "Friction plate/Begin",
                   { "Lever frame/Root", "Friction plate/Type", "Lever/Outline" },
                   "must not be less than Lever frame/Root = " + mm(scene.frame.root));
      if (plate.end <= plate.begin)
        return;
      on_plate(plate, "Friction plate/Sensors", plate.sensors, rules);
      on_plate(plate, "Friction plate/Guide", { plate.guide }, rules);
    }

    /// Room for the width of the contact, which is below a millimetre each way.
    constexpr double margin = 2.;

    void check_frame_face(const Scene &scene, Rules &rules)
    {
      const double first = swept_contact(scene)[0];
      const double begin = friction_face(scene)[0];
      rules.need(begin <= first - margin, "Lever frame/Root", joined<std::string>({ "Lever frame/Rib", "Lever/Outline" }, sweep),
                 "must leave the contact its place: the friction face begins behind root and rib at " + mm(begin) +
                     ", and the cylinder comes as near as s = " + mm(first));
    }

    void root_beside_cylinder(const Scene &scene, Rules &rules)
    {
      const double radius   = scene.geometry.cylinder_radius;
      const double axis     = scene.geometry.interface_offset - radius;
      const double nearest  = std::max(axis, -frame_hub_radius - frame_wall);
      const double distance = std::hypot(swept_contact(scene)[0] - scene.frame.root, axis - nearest);
      rules.need(distance > radius, "Lever frame/Root", joined<std::string>({ "Lever/Outline" }, sweep),
                 "must leave room for the cylinder, whose axis comes as near to the root as " + mm(distance) +
                     " with R = " + mm(radius));
    }

    void check_plate_face(const Scene &scene, Rules &rules)
    {
      const auto [first, last] = swept_contact(scene);
      rules.need(scene.plate.begin <= first - margin, "Friction plate/Begin",
                 joined<std::string>({ "Friction plate/Type" }, sweep),
                 "must be at most " + mm(first - margin) + ": the cylinder comes as near to the pivot as s = " + mm(first));
      rules.need(scene.plate.end >= last + margin, "Friction plate/End", joined<std::string>({ "Friction plate/Type" }, sweep),
                 "must be at least " + mm(last + margin) + ": the cylinder goes as far as s = " + mm(last));
    }

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

    bool are_equal_levers(const MirroredPair &pair)
    {
      return pair.cylinder_offset == 0. && pair.friction_ratio == 1. && pair.spring_ratio == 1.;
    }

    void analysis(const Scene &scene, Rules &rules)
    {
      const auto reject = [&](const std::string &rule) {
        rules.need(false, "Mirrored pair/Type", { "Analysis/Type", "Analysis/Model", "Contact/Type", "Support/Type" }, rule);
      };
      const auto type  = scene.analysis.type;
      const auto model = scene.analysis.model;
      if (!runs_model(type))
        reject("must be half but in a quasi-static, transient, modal, stability, map or sprag-slip analysis");
      else if (type == AnalysisType::transient && (model == ModelType::closed_form || scene.contact.type == ContactType::ideal))
        reject("must be half with an ideal contact in time");
      else if (type == AnalysisType::quasi_static && scene.support.type == SupportType::sprung && model == ModelType::closed_form)
        reject("must be half on a sprung support in the closed form without inertia; with finite elements and in time it may be "
               "full");
    }

    /// Rules where a slide is held.
    void vibration(const Scene &scene, Rules &rules)
    {
      const auto &pair = scene.pair;
      rules.need(scene.analysis.model != ModelType::finite_element || are_equal_levers(pair),
                 std::string("Mirrored pair/") + (pair.cylinder_offset != 0.  ? "Cylinder offset"
                                                  : pair.friction_ratio != 1. ? "Friction ratio"
                                                                              : "Spring ratio"),
                 { "Mirrored pair/Type", "Analysis/Type", "Analysis/Model" },
                 "must leave the levers alike where a slide is held with finite elements; Analysis/Model = condensed takes "
                 "levers that differ");
      rules.need(scene.analysis.type != AnalysisType::modal || scene.stability.contact != HeldContact::open ||
                     pair.joint != SpringJoint::free,
                 "Stability/Contact", { "Mirrored pair/Type", "Mirrored pair/Joint", "Analysis/Type" },
                 "must not be open with Mirrored pair/Joint = free: nothing holds levers that swing together");
    }

    void joint(const Scene &scene, Rules &rules)
    {
      rules.need(scene.pair.contact_ratio == 1. || is_reduced(scene.analysis.model), "Mirrored pair/Contact ratio",
                 { "Mirrored pair/Type", "Analysis/Model" },
                 "must be 1 but with Analysis/Model = rigid or beam: both levers have one mesh, and the closed form has no "
                 "stiffness of the contact");
      const auto &leaf = scene.spring.leaf;
      const bool free  = scene.pair.joint == SpringJoint::free;
      const bool leafs = scene.spring.type == SpringType::leaf;
      const bool held  = leaf.axial == LeafAxial::held;
      rules.need(!free || scene.geometry.pivot_height == 0., "Geometry/Pivot height",
                 { "Mirrored pair/Type", "Mirrored pair/Joint" },
                 "must be 0 mm with Mirrored pair/Joint = free: the levers swing together about one axis");
      rules.need(!free || !leafs || (!held && leaf.end != LeafEnd::guided), held ? "Leaf spring/Axial" : "Leaf spring/Joint",
                 { "Mirrored pair/Type", "Mirrored pair/Joint", "Rotational spring/Type" },
                 std::string("must be ") + (held ? "free" : "clamped or pinned") +
                     " with Mirrored pair/Joint = free, which nothing but the springs holds");
      rules.need(!leafs || scene.pair.spring_ratio == 1., "Mirrored pair/Spring ratio", { "Rotational spring/Type" },
                 "must be 1 with leaf springs, whose inertia goes with their stiffness");
      rules.need(scene.pair.joint_mass <= 0. || leafs, "Mirrored pair/Joint mass", { "Rotational spring/Type" },
                 "must be 0 t with a torsional spring, which has no joint");
    }

    void offset(const Scene &scene, Rules &rules)
    {
      const Geometry &g    = scene.geometry;
      const double most    = g.cylinder_radius - g.interface_offset - g.pivot_height;
      const double largest = 0.5 * most;
      rules.need(most <= 0. || std::abs(scene.pair.cylinder_offset) <= largest, "Mirrored pair/Cylinder offset",
                 { "Mirrored pair/Type", "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot height" },
                 "must be at most (R - e - h)/2 = " + mm(largest) + " either way");
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

  void check_plate(const Scene &scene, const bool own_mesh, Rules &rules)
  {
    if (scene.lever.outline == LeverOutline::frame && !own_mesh)
      frame(scene, rules);
    if (scene.plate.type == PlateType::on_sensors)
      sensors(scene.plate, rules);
    if (scene.plate.type == PlateType::on_sensors && !own_mesh)
      plate(scene, rules);
  }

  void check_sweep(const Scene &scene, Rules &rules)
  {
    if (scene.lever.outline == LeverOutline::frame)
      root_beside_cylinder(scene, rules);
    if (scene.plate.type == PlateType::on_sensors)
      check_plate_face(scene, rules);
    else if (scene.lever.outline == LeverOutline::frame)
      check_frame_face(scene, rules);
  }

  void check_solid(const Scene &scene, Rules &rules)
  {
    what_there_is(scene, rules);
    cylinder_across(scene, rules);
    if (scene.plate.type == PlateType::on_sensors)
      sensors_at_sides(scene, rules);
  }

  void check_pair(const Scene &scene, Rules &rules)
  {
    if (count_levers(scene) == 1)
      return;
    analysis(scene, rules);
    if (holds_slide(scene.analysis.type))
      vibration(scene, rules);
    joint(scene, rules);
    offset(scene, rules);
  }
} // namespace sprag
