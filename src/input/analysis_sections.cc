// SPDX-License-Identifier: GPL-3.0-only
#include "input/sections.h"

#include "input/section.h"
#include "scene/scene.h"

namespace sprag
{
  namespace
  {
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
      section.integer("Spectrum lines", settings.spectrum_lines, { 1., 1e5 });
      section.integer("Seed", settings.seed, { 0., 4294967295. });
      section.text("Base table", settings.base_file, Rule::Kind::file);
      section.choice("Base unit", settings.unit,
                     { { "from file", AccelerationUnit::from_file },
                       { "mm/s2", AccelerationUnit::mm_s2 },
                       { "cm/s2", AccelerationUnit::cm_s2 },
                       { "m/s2", AccelerationUnit::m_s2 },
                       { "g", AccelerationUnit::g } });
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

  void add_analysis_parameters(Scene &scene, std::vector<Parameter> &all)
  {
    const Section isolation{ all, "Isolation" };
    table_and_damper(isolation, scene.isolation);
    base_motion(isolation, scene.isolation);
    motion(isolation, scene.isolation);
    design({ all, "Design" }, scene.design);
    identification({ all, "Identification" }, scene.identification);
  }
} // namespace sprag
