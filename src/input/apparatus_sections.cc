// SPDX-License-Identifier: GPL-3.0-only
#include "input/section.h"
#include "input/sections.h"
#include "scene/scene.h"

namespace sprag
{
  namespace
  {
    void spring(Section section, RotationalSpring &settings)
    {
      section.choice("Type", settings.type);
      section.number("Stiffness", settings.stiffness, above(0.), "N mm/rad");
      section.number("Rest angle", settings.rest_angle, { -0.5, 0. }, "rad");
    }

    void leaf(Section section, LeafSpring &settings)
    {
      section.length("Length", settings.length);
      section.length("Thickness", settings.thickness);
      section.length("Width", settings.width);
      add_material(section, settings);
      add_plane(section, settings);
      section.choice("Joint", settings.end,
                     { { "clamped", LeafEnd::clamped }, { "pinned", LeafEnd::pinned }, { "guided", LeafEnd::guided } });
      section.choice("Axial", settings.axial);
      section.number("Clamp distance", settings.clamp_distance, at_least(0.), "mm");
      section.number("Sagitta", settings.sagitta, any_number(), "mm");
      section.length("Room", settings.room);
    }

    void lever_frame(Section section, LeverFrameShape &settings)
    {
      section.length("Tip depth", settings.tip_depth);
      section.length("Flange", settings.flange);
      section.number("Web", settings.web, at_least(0.), "mm");
      section.integer("Pockets", settings.pockets, { 0., 50. });
      section.length("Rib", settings.rib);
      section.length("Root", settings.root);
    }

    void friction_plate(Section section, FrictionPlate &settings)
    {
      section.choice("Type", settings.type);
      section.length("Begin", settings.begin);
      section.length("End", settings.end);
      section.length("Thickness", settings.thickness);
      section.length("Spacer", settings.spacer);
      add_material(section, settings);
      section.numbers("Sensors", settings.sensors, above(0.), "mm");
      section.length("Sensor length", settings.sensor_length);
      section.number("Sensor stiffness", settings.sensor_stiffness, above(0.), "N/mm");
      section.number_or_auto("Sensors across", settings.sensors_across, above(0.), "mm");
      section.length("Sensor width", settings.sensor_width);
      section.length("Guide", settings.guide);
      section.number("Guide stiffness", settings.guide_stiffness, above(0.), "N/mm");
    }

    void cylinder(Section section, Cylinder &settings)
    {
      section.choice("Type", settings.type);
      section.length("Inner radius", settings.inner_radius);
      add_material(section, settings);
      add_plane(section, settings);
      section.length("Face size", settings.face_size);
      section.number("Length", settings.length, at_least(0.), "mm");
      section.number("Position", settings.position, any_number(), "mm");
      section.number("Tilt", settings.tilt, { -0.1, 0.1 });
      section.number("Skew", settings.skew, { -0.1, 0.1 });
      section.number_or_auto("Tilt stiffness", settings.tilt_stiffness, above(0.), "N mm/rad");
      section.number_or_auto("Skew stiffness", settings.skew_stiffness, above(0.), "N mm/rad");
      section.number("Crown radius", settings.crown_radius, at_least(0.), "mm");
      section.number("Edge radius", settings.edge_radius, at_least(0.), "mm");
    }

    void mirrored_pair(Section section, MirroredPair &settings)
    {
      section.choice("Type", settings.type);
      section.choice("Joint", settings.joint);
      section.number("Joint mass", settings.joint_mass, at_least(0.), "t");
      section.number("Cylinder offset", settings.cylinder_offset, any_number(), "mm");
      section.number("Friction ratio", settings.friction_ratio, above(0.));
      section.number("Spring ratio", settings.spring_ratio, above(0.));
    }

    void calibration(Section section, CalibrationSettings &settings)
    {
      section.number_or_auto("Stiffness", settings.stiffness, above(0.), "N mm/rad");
      section.number_or_auto("Moment of inertia", settings.moment_of_inertia, above(0.), "t mm2");
      section.choice("Mass", settings.mass);
    }
  } // namespace

  void add_apparatus_parameters(Scene &scene, std::vector<Parameter> &all)
  {
    spring({ all, "Rotational spring" }, scene.spring);
    leaf({ all, "Leaf spring" }, scene.spring.leaf);
    mirrored_pair({ all, "Mirrored pair" }, scene.pair);
    lever_frame({ all, "Lever frame" }, scene.frame);
    friction_plate({ all, "Friction plate" }, scene.plate);
    cylinder({ all, "Cylinder" }, scene.cylinder);
    calibration({ all, "Calibration" }, scene.calibration);
  }
} // namespace sprag
