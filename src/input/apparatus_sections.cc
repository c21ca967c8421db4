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
      section.choice("Type", settings.type, { { "torsional", SpringType::torsional }, { "leaf", SpringType::leaf } },
                     "torsional: one number at the hub; leaf: a leaf spring of finite elements");
      section.number("Stiffness", settings.stiffness, above(0.), "N mm/rad",
                     "k, moment over the lever's rotation; that of a leaf spring follows from its dimensions");
      section.number("Rest angle", settings.rest_angle, { -0.5, 0. }, "rad",
                     "Turn of the lever from x = 0 at which the spring has no moment; below 0 a preload presses at x = 0");
    }

    void leaf(Section section, LeafSpring &settings)
    {
      section.length("Length", settings.length, "Distance from the clamp in the hub to the spring joint, at rest");
      section.length("Thickness", settings.thickness, "Thickness in the plane");
      section.length("Width", settings.width, "Width out of plane");
      add_material(section, settings, " of the leaf spring");
      add_plane(
          section, settings,
          "Plane stress for a beam, strain for a plate much wider than long, 1/(1 - nu^2) times as stiff; others lie between");
      section.choice(
          "Joint", settings.end,
          { { "clamped", LeafEnd::clamped }, { "pinned", LeafEnd::pinned }, { "guided", LeafEnd::guided } },
          "Support of the far end: it neither turns nor moves across, turns only, or moves across only (4, 3 and 1 times EI/L)");
      section.choice("Axial", settings.axial, { { "free", LeafAxial::free }, { "held", LeafAxial::held } },
                     "Motion of the joint along the spring: free as between mirrored levers, or held");
      section.number("Clamp distance", settings.clamp_distance, at_least(0.), "mm", "Distance from the pivot back to the clamp");
      section.number("Sagitta", settings.sagitta, any_number(), "mm",
                     "Sagitta of the unloaded spring, an arc; positive: away from the cylinder; 0: straight");
      section.length("Room", settings.room, "Distance from the pivot back to the end of the pivot frame");
    }

    void lever_frame(Section section, LeverFrameShape &settings)
    {
      section.length("Tip depth", settings.tip_depth, "Depth of the arm at its tip; at its root it is Lever/Depth");
      section.length("Flange", settings.flange, "Depth of each of the two flanges");
      section.number("Web", settings.web, at_least(0.), "mm", "Width of the web in the pockets, out of plane; 0: holes");
      section.integer("Pockets", settings.pockets, { 0., 50. }, "Number of pockets between the flanges, one after another");
      section.length("Rib", settings.rib, "Length of full width between pockets and at the ends of the arm");
      section.length("Root", settings.root, "Length along the lever of part 2b, which the pivot carries");
    }

    void friction_plate(Section section, FrictionPlate &settings)
    {
      section.choice("Type", settings.type, { { "none", PlateType::none }, { "on sensors", PlateType::on_sensors } },
                     "none: the friction layer is on the lever; on sensors: it is on a plate of its own held by force sensors");
      section.length("Begin", settings.begin, "Begin of plate and layer, from the pivot along the lever");
      section.length("End", settings.end, "End of plate and layer, from the pivot along the lever");
      section.length("Thickness", settings.thickness, "Thickness of the metal");
      section.length("Spacer", settings.spacer, "Distance between plate and lever");
      add_material(section, settings, " of the metal");
      section.numbers("Sensors", settings.sensors, above(0.), "mm",
                      "Middles of the force sensors, from the pivot along the lever");
      section.length("Sensor length", settings.sensor_length, "Length along the lever over which each sensor presses");
      section.number(
          "Sensor stiffness", settings.sensor_stiffness, above(0.), "N/mm",
          "Stiffness of each sensor, normal to the plate; in three dimensions of the left and the right one of a place together");
      section.number_or_auto("Sensors across", settings.sensors_across, above(0.), "mm",
                             "Distance of the middles of the left and the right sensor of a place from the middle of the width, "
                             "in three dimensions; auto: flush with the plate's sides");
      section.length("Sensor width", settings.sensor_width, "Width over which each sensor presses, in three dimensions");
      section.length("Guide", settings.guide, "Middle of the linear guide, from the pivot along the lever");
      section.number("Guide stiffness", settings.guide_stiffness, above(0.), "N/mm",
                     "Stiffness of the guide along the plate; in three dimensions across it too, and spread over the width");
    }

    void cylinder(Section section, Cylinder &settings)
    {
      section.choice("Type", settings.type, { { "rigid", CylinderType::rigid }, { "solid", CylinderType::solid } },
                     "rigid: a circle; solid: finite elements on a rigid core or shaft");
      section.length("Inner radius", settings.inner_radius, "Radius of the rigid core or shaft of a solid cylinder");
      add_material(section, settings, " of the cylinder");
      add_plane(section, settings, "Plane stress or strain of an elastic cylinder, which is wide");
      section.length("Face size", settings.face_size, "Element length on the face that touches the lever");
      section.number("Length", settings.length, at_least(0.), "mm",
                     "Length of the cylinder in three dimensions; 0: longer than the lever is wide");
      section.number("Position", settings.position, any_number(), "mm",
                     "Distance of the cylinder's middle across the width from the lever's middle, in three dimensions");
      section.number("Tilt", settings.tilt, { -0.1, 0.1 }, "",
                     "Slope of the axis towards the lever in three dimensions, 1 at 45 degrees");
      section.number("Skew", settings.skew, { -0.1, 0.1 }, "", "Slope of the axis along x, in three dimensions");
      section.number_or_auto("Tilt stiffness", settings.tilt_stiffness, above(0.), "N mm/rad",
                             "Stiffness of the shaft against the contact's moment about the cylinder's middle, which turns the "
                             "axis beyond Tilt, in three dimensions; auto: fixed");
      section.number_or_auto("Skew stiffness", settings.skew_stiffness, above(0.), "N mm/rad",
                             "Stiffness of the shaft against turning beyond Skew, in three dimensions; auto: fixed");
      section.number("Crown radius", settings.crown_radius, at_least(0.), "mm",
                     "Radius of a barrel along the axis, in three dimensions; 0: straight");
      section.number("Edge radius", settings.edge_radius, at_least(0.), "mm",
                     "Radius of the rounding at both ends, in three dimensions; 0: sharp");
    }

    void mirrored_pair(Section section, MirroredPair &settings)
    {
      section.choice("Type", settings.type, { { "half", PairType::half }, { "full", PairType::full } },
                     "half: one lever stands for both; full: both levers");
      section.choice("Joint", settings.joint, { { "free", SpringJoint::free }, { "held", SpringJoint::held } },
                     "Spring joint of a full pair; free: carried by the two springs alone, which let both levers swing together; "
                     "held: by the pivot frame");
      section.number("Joint mass", settings.joint_mass, at_least(0.), "t", "Mass of the spring joint between leaf springs");
      section.number("Cylinder offset", settings.cylinder_offset, any_number(), "mm",
                     "Distance of the cylinder's path from the mirror plane, towards the first lever");
      section.number("Friction ratio", settings.friction_ratio, above(0.), "", "mu of the second lever over that of the first");
    }

    void calibration(Section section, CalibrationSettings &settings)
    {
      section.number_or_auto("Stiffness", settings.stiffness, above(0.), "N mm/rad",
                             "k to be met by the leaf spring's thickness; auto: the leaf as it is");
      section.number_or_auto("Moment of inertia", settings.moment_of_inertia, above(0.), "t mm2",
                             "J to be met by added mass, densities as built; auto: as it is");
      section.choice("Mass", settings.mass, { { "hub", AddedMass::hub }, { "tip", AddedMass::tip } },
                     "Place of the added mass: Lever/Hub inertia or Lever/Tip mass");
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
