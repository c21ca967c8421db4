// SPDX-License-Identifier: GPL-3.0-only
#include "input/check_parts.h"

#include "base/append.h"
#include "base/text.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    using Names = std::vector<std::string>;

    const Names sweep = {
      // The contact's way along the lever depends on the geometry.
      "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot distance",
      // So do the ends of the drive.
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
  } // namespace

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
} // namespace sprag
