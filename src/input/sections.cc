// SPDX-License-Identifier: GPL-3.0-only
#include "input/sections.h"

#include "base/ranges.h"
#include "input/section.h"
#include "scene/scene.h"

namespace sprag
{
  namespace
  {
    Choices<AnalysisType> make_types()
    {
      auto types          = enumerator_words<AnalysisType>();
      types.front().first = "quasi-static";
      return types;
    }

    const auto all_types = make_types();
    const Choices<AnalysisType> run_types(all_types.begin(), all_types.begin() + static_cast<int>(AnalysisType::map));

    void analysis(Section section, SceneSettings &input)
    {
      AnalysisSettings &settings = input.scene.analysis;
      section.choice("Type", settings.type, all_types);
      Choices<std::optional<ModelType>> models = { { "auto", std::nullopt } };
      for (const auto &model : enumerator_words<ModelType>())
        models.push_back(model);
      section.choice("Model", input.model, models);
      section.choice("Dimension", input.dimension, { { "auto", std::nullopt }, { "2", 2u }, { "3", 3u } });
      section.choice("Plane", settings.plane);
      section.choice("Solution", settings.solution);
      section.length("Step", settings.step);
      section.length("Minimum step", settings.minimum_step);
      section.number("Maximum deviation", settings.maximum_deviation, at_least(0.));
      section.number("Maximum energy residual", settings.maximum_residual, at_least(0.));
      section.choice("Warnings", settings.warnings);
    }

    void geometry(Section section, Geometry &settings)
    {
      section.length("Cylinder radius", settings.cylinder_radius);
      section.number("Interface offset", settings.interface_offset, at_least(0.), "mm");
      section.length("Pivot distance", settings.pivot_distance);
      section.number("Pivot height", settings.pivot_height, any_number(), "mm");
    }

    void drive(Section section, DriveSettings &settings)
    {
      section.choice("Profile", settings.profile);
      section.number("Start", settings.start, at_least(0.), "mm");
      section.length("Stroke", settings.stroke);
      section.number("Speed", settings.speed, above(0.), "mm/s");
      section.number("Cycles", settings.cycles, { 0., 1e5, false, true });
      section.number("Reversal duration", settings.reversal, at_least(0.), "s");
      auto table = section.only_with("Profile", "table");
      table.text("Table", settings.table, Rule::Kind::file);
      table.number("Smoothing", settings.smoothing, at_least(0.), "s");
    }

    void friction(Section section, FrictionSettings &settings, FrictionLaw &law)
    {
      section.choice("Law", settings.law);
      section.only_with("Law", "Coulomb").number("Coefficient", settings.coulomb.coefficient, at_least(0.));
      auto stribeck = section.only_with("Law", "Stribeck");
      stribeck.number("Static coefficient", settings.stribeck.at_rest, at_least(0.));
      stribeck.number("Kinetic coefficient", settings.stribeck.kinetic, at_least(0.));
      stribeck.number("Stribeck speed", settings.stribeck.speed, above(0.), "mm/s");
      stribeck.number("Stribeck exponent", settings.stribeck.exponent, at_least(1.));
      stribeck.number("Viscous coefficient", settings.stribeck.viscous, at_least(0.), "s/mm");
      section.only_with("Law", "table").text("Table", settings.table, Rule::Kind::file);
      section.choice("Speed", law.speed);
      section.number("Factor", law.factor, at_least(0.));
      section.number("Regularisation speed", law.regularisation_speed, at_least(0.), "mm/s");
      section.number("Memory length", law.memory_length, above(0.), "mm");
    }

    void lever(Section section, Lever &settings)
    {
      section.choice("Outline", settings.outline);
      section.length("Length", settings.length);
      section.length("Depth", settings.depth);
      section.length("Width", settings.width);
      add_material(section, settings);
      section.choice("Material", settings.material,
                     { { "linear", MaterialModel::linear }, { "neo-Hookean", MaterialModel::neo_hookean } });
      section.number("Moment of inertia", settings.moment_of_inertia, above(0.), "t mm2");
      section.choice("Inertia", settings.inertia);
      section.number("Hub inertia", settings.hub_inertia, at_least(0.), "t mm2");
      section.number("Tip mass", settings.tip_mass, at_least(0.), "t");
      section.number_or_auto("Neutral axis offset", settings.neutral_axis_offset, any_number(), "mm");
      const Interval share = { 0., 1., true, false };
      section.number("Modal damping", settings.modal_damping, share);
      section.number("Mass damping", settings.mass_damping, at_least(0.), "1/s");
      section.number("Stiffness damping", settings.stiffness_damping, at_least(0.), "s");
    }

    void friction_layer(Section section, FrictionLayer &settings)
    {
      section.number("Thickness", settings.thickness, at_least(0.), "mm");
      add_material(section, settings);
      section.choice("Plane", settings.plane);
      section.number_or_auto("Strength", settings.strength, above(0.), "MPa");
    }

    void support(Section section, Support &settings)
    {
      section.choice("Type", settings.type);
      section.number("Mass", settings.mass, above(0.), "t");
      section.number("Stiffness", settings.stiffness, above(0.), "N/mm");
      section.number("Damping", settings.damping, { 0., 1., true, false });
    }

    void contact(Section section, SceneSettings &input)
    {
      ContactSettings &settings = input.scene.contact;
      section.choice("Enforcement", input.enforcement,
                     { { "auto", std::nullopt },
                       { "penalty", Enforcement::penalty },
                       { "augmented Lagrangian", Enforcement::augmented_lagrangian } });
      section.number_or_auto("Penalty", settings.penalty, above(0.), "N/mm3");
      section.number_or_auto("Tangential penalty", settings.tangential_penalty, above(0.), "N/mm3");
      section.length("Penetration tolerance", settings.penetration_tolerance);
      section.integer("Maximum augmentations", settings.maximum_augmentations, { 1., 1000. });
      section.choice("Type", settings.type);
      section.number("Stiffness", settings.stiffness, above(0.), "N/mm^n");
      section.number("Exponent", settings.exponent, { 1., 3. });
      section.number("Damping", settings.damping, { 0., 1., true, false });
      section.choice("Damping law", settings.damping_law);
      section.number_or_auto("Tangential stiffness", settings.tangential_stiffness, above(0.), "N/mm");
    }

    void time(Section section, TimeSettings &settings, std::optional<double> &tolerance)
    {
      section.number("Step", settings.step, above(0.), "s");
      section.number_or_auto("Tolerance", tolerance, at_least(0.));
      section.number("Spectral radius", settings.spectral_radius, { 0., 1. });
    }

    void condensed(Section section, CondensedSettings &settings)
    {
      section.integer("Modes", settings.modes, { 1., 1e4 });
      section.text("Cache", settings.cache);
    }

    void mesh(Section section, SceneSettings &input)
    {
      MeshSettings &settings = input.scene.mesh;
      section.number_or_auto("Face size", input.face_size, above(0.), "mm");
      section.number_or_auto("Faces in contact", input.faces_in_contact, { 0., 20. });
      section.integer("Degree", settings.degree, { 1., 2. });
      section.integer("Elements across", settings.elements_across, { 1., 200. });
      section.number("Growth across", settings.growth_across, { 1., 3. });
      section.text("File", settings.file, Rule::Kind::file);
    }

    void output(Section section, OutputSettings &settings)
    {
      section.choice("Fields", settings.fields);
      section.number_or_auto("Field interval", settings.field_interval, above(0.), "mm");
      section.choice("Errors", settings.errors, { { "on", true }, { "off", false } });
    }

    void slope(Section section, SlopeSettings &settings, double &maximum_inclination)
    {
      section.choice("Sweep", settings.sweep);
      section.integer("Number of points", settings.n_points, { 2., 1e6 });
      section.number("Maximum coefficient", settings.maximum_coefficient, above(0.));
      section.number("Maximum inclination", maximum_inclination, between(0., 90.), "deg");
      section.numbers("Offset ratios", settings.offset_ratios, { 0., 1., true, false });
    }

    void stability(Section section, StabilitySettings &settings)
    {
      section.number_or_auto("Position", settings.position, at_least(0.), "mm");
      section.choice("Direction", settings.direction);
      section.integer("Modes", settings.modes, { 1., 1000. });
      section.choice("Damping", settings.damping, { { "on", true }, { "off", false } });
      section.choice("Contact", settings.contact);
      section.text("Critical", settings.critical);
      section.text("Ranges", settings.ranges);
      section.choice("Roles", settings.roles, { { "on", true }, { "off", false } });
    }

    void map(Section section, MapSettings &settings)
    {
      const auto axis = [&](const std::string &which, ParameterRange &range)
      {
        section.text(which + " parameter", range.name);
        section.number(which + " from", range.from, any_number(), "of " + which + " parameter");
        section.number(which + " to", range.to, any_number(), "of " + which + " parameter");
        section.integer(which + " points", range.points, { 2., 10000. });
      };
      axis("First", settings.first);
      axis("Second", settings.second);
      section.integer("Coarsest", settings.coarsest, { 1., 1024. });
      section.integer("Bisections", settings.bisections, { 0., 40. });
    }

    void study(Section section, StudySettings &settings)
    {
      section.choice("Type", settings.type, run_types);
      section.text("Vary", settings.vary);
      section.choice("Combine", settings.combine);
      section.text("Reference", settings.reference);
    }

    void sprag_slip(Section section, SpragSlipSettings &settings)
    {
      const Interval share = { 0., 1., false, false };
      section.number("Initial amplitude", settings.initial, share);
      section.number("Final amplitude", settings.final, share);
      section.integer("Steps per period", settings.steps_per_period, { 16., 1e5 });
      section.number("Longest growth", settings.longest_growth, above(0.), "s");
      section.number("Settling time", settings.settling, above(0.), "s");
      section.integer("Continuation", settings.continuation, { 0., 1000. });
      section.number_or_auto("Turn", settings.turn, at_least(0.), "mm");
    }

    void accuracy(Section section, AccuracySettings &settings)
    {
      section.number("Target", settings.target, { 0., 0.5 });
      section.text("Quantity", settings.quantity);
      section.number("Budget", settings.budget, at_least(0.), "s");
    }

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
      section.choice("Plane", settings.plane);
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
      section.choice("Plane", settings.plane);
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
      section.number("Contact ratio", settings.contact_ratio, above(0.));
    }

    void calibration(Section section, CalibrationSettings &settings)
    {
      section.number_or_auto("Stiffness", settings.stiffness, above(0.), "N mm/rad");
      section.number_or_auto("Moment of inertia", settings.moment_of_inertia, above(0.), "t mm2");
      section.choice("Mass", settings.mass);
    }

    void table_and_damper(Section section, IsolationSettings &settings)
    {
      section.number("Mass", settings.mass, above(0.), "t");
      section.number("Stiffness", settings.stiffness, above(0.), "N/mm");
      section.integer("Levers", settings.levers, { 1., 1000. });
      section.choice("Damper", settings.damper);
      section.number("Friction force", settings.friction_force, at_least(0.), "N");
      section.number("Friction slope", settings.friction_slope, at_least(0.), "N/mm");
      section.number("Viscous coefficient", settings.viscous_coefficient, at_least(0.), "N s/mm");
      section.number("Lever ratio", settings.lever_ratio, at_least(0.));
      section.number("Friction arm ratio", settings.friction_arm_ratio, at_least(0.));
      section.text("Loop table", settings.loop_file, Rule::Kind::file);
    }

    void base_motion(Section section, IsolationSettings &settings)
    {
      section.choice("Base motion", settings.base);
      section.length("Base amplitude", settings.base_amplitude);
      section.number("Base frequency", settings.base_frequency, above(0.), "Hz");
      section.number("Final frequency", settings.final_frequency, above(0.), "Hz");
      section.choice("Sweep", settings.sweep);
      section.choice("Shock", settings.shock);
      section.choice("Base spectrum", settings.spectrum,
                     { { "Kanai-Tajimi", BaseSpectrum::kanai_tajimi }, { "table", BaseSpectrum::table } });
      section.number("Base acceleration", settings.rms_acceleration, above(0.), "mm/s2");
      section.number("Ground frequency", settings.ground_frequency, above(0.), "Hz");
      section.number("Ground damping", settings.ground_damping, above(0.));
      section.number("Lowest frequency", settings.lowest_frequency, above(0.), "Hz");
      section.number("Highest frequency", settings.highest_frequency, above(0.), "Hz");
      section.number_or_auto("Spectrum lines", settings.spectrum_lines, { 1., 1e5 });
      section.integer("Seed", settings.seed, { 0., 4294967295. });
      section.text("Base table", settings.base_file, Rule::Kind::file);
      const Choices<std::string> units = {
        { "from file", "" }, { "mm/s2", "mm/s2" }, { "cm/s2", "cm/s2" }, { "m/s2", "m/s2" }, { "g", "g" }
      };
      section.choice("Base unit", settings.unit, units);
      section.choice("Drift correction", settings.corrects_drift, { { "off", false }, { "on", true } });
    }

    void motion(Section section, IsolationSettings &settings)
    {
      section.number("Initial displacement", settings.initial_displacement, any_number(), "mm");
      section.number("Initial velocity", settings.initial_velocity, any_number(), "mm/s");
      section.number("Duration", settings.duration, above(0.), "s");
      section.choice("End", settings.end);
      section.number("Periodic tolerance", settings.periodic_tolerance, { 0., 0.1, false, true });
      section.number("Tolerance", settings.tolerance, { 1e-14, 1e-3 });
      section.number_or_auto("Output step", settings.output_step, above(0.), "s");
    }

    void design(Section section, DesignSettings &settings)
    {
      section.text("Free", settings.free);
      section.text("Demands", settings.demands);
      section.text("Aim", settings.aim);
      section.text("Second aim", settings.second_aim);
      section.text("Tolerances", settings.tolerances);
      section.integer("Front points", settings.front_points, { 3., 200. });
      section.text("Judges", settings.checks);
      section.integer("Positions", settings.positions, { 2., 200. });
      section.choice("Judge in time", settings.checks_in_time, { { "on", true }, { "off", false } });
      section.integer("Rounds", settings.rounds, { 1., 20. });
      section.integer("Evaluations", settings.evaluations, { 100., 1e7 });
      section.integer("Seed", settings.seed, { 0., 4294967295. });
    }

    void identification(Section section, IdentificationSettings &settings)
    {
      section.text("Table", settings.table, Rule::Kind::file);
      section.text("Forces", settings.forces);
      section.text("Unknowns", settings.unknowns);
      section.numbers("Friction speeds", settings.friction_speeds, at_least(0.), "mm/s");
      section.number_or_auto("Reversal window", settings.window, at_least(0.), "mm");
      section.choice("Loss", settings.loss);
      section.number("Confidence", settings.confidence, { 0.5, 0.9999 });
    }
  } // namespace

  const Choices<PageCells> &materials()
  {
    static const auto all = joined({ { "none", {} } }, page_table("material").rows);
    return all;
  }

  std::string to_word(const AnalysisType type)
  {
    return word_for(all_types, type);
  }

  std::vector<Parameter> scene_parameters(SceneSettings &settings)
  {
    Scene &scene = settings.scene;
    std::vector<Parameter> all;
    all.reserve(256); // more than there are, so that none moves
    analysis({ all, "Analysis" }, settings);
    geometry({ all, "Geometry" }, scene.geometry);
    drive({ all, "Drive" }, settings.drive);
    friction({ all, "Friction" }, settings.friction, scene.friction);
    lever({ all, "Lever" }, scene.lever);
    friction_layer({ all, "Friction layer" }, scene.layer);
    spring({ all, "Rotational spring" }, scene.spring);
    leaf({ all, "Leaf spring" }, scene.spring.leaf);
    mirrored_pair({ all, "Mirrored pair" }, scene.pair);
    lever_frame({ all, "Lever frame" }, scene.frame);
    friction_plate({ all, "Friction plate" }, scene.plate);
    cylinder({ all, "Cylinder" }, scene.cylinder);
    calibration({ all, "Calibration" }, scene.calibration);
    support({ all, "Support" }, scene.support);
    contact({ all, "Contact" }, settings);
    time({ all, "Time" }, scene.time, settings.time_tolerance);
    mesh({ all, "Mesh" }, settings);
    condensed({ all, "Condensed" }, scene.condensed);
    output({ all, "Output" }, scene.output);
    slope({ all, "Slope" }, scene.slope, settings.maximum_inclination);
    stability({ all, "Stability" }, scene.stability);
    map({ all, "Map" }, scene.map);
    study({ all, "Study" }, scene.study);
    sprag_slip({ all, "Sprag slip" }, scene.sprag_slip);
    const Section isolation{ all, "Isolation" };
    table_and_damper(isolation, scene.isolation);
    base_motion(isolation, scene.isolation);
    motion(isolation, scene.isolation);
    design({ all, "Design" }, scene.design);
    identification({ all, "Identification" }, scene.identification);
    accuracy({ all, "Accuracy" }, scene.accuracy);
    return all;
  }
} // namespace sprag
