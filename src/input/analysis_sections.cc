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
      section.number("Mass", settings.mass, above(0.), "t", "m, mass of the table");
      section.number("Stiffness", settings.stiffness, above(0.), "N/mm", "K, stiffness of the restoring spring");
      section.integer("Levers", settings.levers, { 1., 1000. }, "n, number of levers of the damper for each sign of z");
      section.choice("Damper", settings.damper,
                     { { "lever", DamperType::lever },
                       { "constant friction", DamperType::constant_friction },
                       { "linear friction", DamperType::linear_friction },
                       { "Beucke", DamperType::beucke },
                       { "restoring lever", DamperType::restoring_lever },
                       { "viscous", DamperType::viscous },
                       { "loop", DamperType::loop },
                       { "none", DamperType::none } },
                     "Damper of the table: the levers of this scene; friction F0; friction c |z|; viscous, constant and linear "
                     "friction; a friction lever that the restoring spring presses; viscous; Q over |z| from a file; none");
      section.number("Friction force", settings.friction_force, at_least(0.), "N", "F0 of constant friction and Beucke");
      section.number("Friction slope", settings.friction_slope, at_least(0.), "N/mm", "c of linear friction and Beucke");
      section.number("Viscous coefficient", settings.viscous_coefficient, at_least(0.), "N s/mm", "d of viscous and Beucke");
      section.number("Lever ratio", settings.lever_ratio, at_least(0.), "",
                     "r of the restoring lever: arm of the spring over arm of the normal force");
      section.number("Friction arm ratio", settings.friction_arm_ratio, at_least(0.), "",
                     "q of the restoring lever: arm of friction over arm of the normal force");
      section.text("Loop table", settings.loop_file,
                   "File with the columns x [mm] and Q [N]: rows out from x = 0 and back, relative to the folder of this one",
                   Rule::Kind::file);
    }

    void base_motion(Section section, IsolationSettings &settings)
    {
      section.choice("Base motion", settings.base,
                     { { "none", BaseMotionType::none },
                       { "harmonic", BaseMotionType::harmonic },
                       { "sweep", BaseMotionType::sweep },
                       { "shock", BaseMotionType::shock },
                       { "random", BaseMotionType::random },
                       { "record", BaseMotionType::record } },
                     "x_b of the base: none, X sin(2 pi f t), the same with a frequency that changes, one pulse, a random "
                     "acceleration, or one from a file");
      section.length("Base amplitude", settings.base_amplitude, "X of a harmonic motion, a sweep and a shock");
      section.number("Base frequency", settings.base_frequency, above(0.), "Hz",
                     "f of a harmonic motion and a shock, which takes 1/(2 f), and at the beginning of a sweep");
      section.number("Final frequency", settings.final_frequency, above(0.), "Hz", "Frequency at the end of a sweep");
      section.choice("Sweep", settings.sweep, { { "linear", SweepForm::linear }, { "logarithmic", SweepForm::logarithmic } },
                     "Growth of the frequency, by equal differences or by equal ratios in equal times");
      section.choice("Shock", settings.shock, { { "half sine", ShockForm::half_sine }, { "step", ShockForm::step } },
                     "Half a sine of acceleration with the peak X (2 pi f)^2, or a rise of the displacement to X along half a "
                     "cosine");
      section.choice("Base spectrum", settings.spectrum,
                     { { "Kanai-Tajimi", BaseSpectrum::kanai_tajimi }, { "table", BaseSpectrum::table } },
                     "Spectrum of a random acceleration: ground that filters white noise, or from Base table");
      section.number("Base acceleration", settings.rms_acceleration, above(0.), "mm/s2",
                     "Root mean square of a Kanai-Tajimi acceleration between its lowest and highest frequency");
      section.number("Ground frequency", settings.ground_frequency, above(0.), "Hz", "f_g, ground frequency of Kanai-Tajimi");
      section.number("Ground damping", settings.ground_damping, above(0.), "", "zeta_g, ground damping ratio of Kanai-Tajimi");
      section.number("Lowest frequency", settings.lowest_frequency, above(0.), "Hz", "Lowest frequency of a random acceleration");
      section.number("Highest frequency", settings.highest_frequency, above(0.), "Hz",
                     "Highest frequency of a random acceleration, more than the lowest");
      section.integer("Spectrum lines", settings.spectrum_lines, { 1., 1e5 }, "Number of sines in a random acceleration");
      section.integer("Seed", settings.seed, { 0., 4294967295. }, "Seed of the phases; the same gives the same motion");
      section.text("Base table", settings.base_file,
                   "File with the columns time [s] and acceleration of a record, or frequency [Hz] and density, unit squared per "
                   "Hz, of a spectrum, relative to the folder of this one",
                   Rule::Kind::file);
      section.choice(
          "Base unit", settings.unit,
          { { "from file", AccelerationUnit::from_file },
            { "mm/s2", AccelerationUnit::mm_s2 },
            { "cm/s2", AccelerationUnit::cm_s2 },
            { "m/s2", AccelerationUnit::m_s2 },
            { "g", AccelerationUnit::g } },
          "Unit of the acceleration in Base table; from file: in brackets in its header, as 'time [s], acceleration [m/s2]'");
      section.choice("Drift correction", settings.corrects_drift, { { "off", false }, { "on", true } },
                     "on: a line is subtracted from the record's acceleration so that its velocity has no trend");
    }

    void motion(Section section, IsolationSettings &settings)
    {
      section.number("Initial displacement", settings.initial_displacement, any_number(), "mm", "z at the beginning");
      section.number("Initial velocity", settings.initial_velocity, any_number(), "mm/s", "z' at the beginning");
      section.number("Duration", settings.duration, above(0.), "s", "Duration of the run, or longest time to a steady state");
      section.choice("End", settings.end,
                     { { "duration", IsolationEnd::duration }, { "steady state", IsolationEnd::steady_state } },
                     "duration: the run goes on to Duration; steady state: with a harmonic base it ends once periods repeat");
      section.number("Periodic tolerance", settings.periodic_tolerance, { 0., 0.1, false, true }, "",
                     "Remaining distance to the steady state, over the amplitude, at which it counts as reached");
      section.number("Tolerance", settings.tolerance, { 1e-14, 1e-3 }, "",
                     "Error of a step in time, over the amplitude; events are met to round-off whatever it is");
      section.number_or_auto("Output step", settings.output_step, above(0.), "s",
                             "Time between rows of the table, which events have too; auto: a hundredth of the natural period, a "
                             "tenth of the base's shortest or the record's own, whichever is least");
    }

    void design(Section section, DesignSettings &settings)
    {
      section.text("Free", settings.free,
                   "Free parameters of the lever and their bounds: list of SECTION/NAME = FROM ... TO, separated by semicolons");
      section.text(
          "Demands", settings.demands,
          "Demands on a quantity of params/design.md or a free parameter: list of QUANTITY <= VALUE, QUANTITY >= VALUE or "
          "QUANTITY = VALUE +- TOLERANCE, separated by semicolons");
      section.text("Aim", settings.aim, "Aim of the search: minimise QUANTITY or maximise QUANTITY");
      section.text("Second aim", settings.second_aim, "Second aim in the same form, for the front of both; empty: none");
      section.integer("Front points", settings.front_points, { 3., 200. }, "Points of the front, both ends included");
      section.text("Judges", settings.checks,
                   "Models that check the lever found: list of table (its levers' table in time), beam, condensed; or none");
      section.integer(
          "Positions", settings.positions, { 2., 200. },
          "Number of x at which beam and condensed judge the slide both ways, equally apart up to the drive's largest");
      section.choice("Judge in time", settings.checks_in_time, { { "on", true }, { "off", false } },
                     "on: the last of beam and condensed also follows the drive in time");
      section.integer("Rounds", settings.rounds, { 1., 20. },
                      "Levers proposed to each judge; from the second on the closed form is corrected by the judge's result");
      section.integer("Evaluations", settings.evaluations, { 100., 1e7 }, "Evaluations of the closed form in each global search");
      section.integer("Seed", settings.seed, { 0., 4294967295. },
                      "Seed of the global search; the same seed finds the same lever");
    }

    void identification(Section section, IdentificationSettings &settings)
    {
      section.text(
          "Table", settings.table,
          "Measured stroke: columns time or x or both, and any of P, Q and sensor_1 ... sensor_n or sensor_sum, with units "
          "in brackets in the header, as in 'time [s], Q [N]', or a result.h5; relative to the folder of this file",
          Rule::Kind::file);
      section.text("Forces", settings.forces, "Forces that are used: list of P, Q, sensors; auto: all in the table");
      section.text(
          "Unknowns", settings.unknowns,
          "Unknowns to be found: mu, mu polynomial, mu table or friction factor, and any of k, e, th0, offsets (of each "
          "force), rest (the spring's rest angle), lag (of all forces behind x); they start from the values of this scene");
      section.numbers("Friction speeds", settings.friction_speeds, at_least(0.), "mm/s",
                      "Speeds at which mu table has its values, increasing, at least 4");
      section.number_or_auto(
          "Reversal window", settings.window, at_least(0.), "mm",
          "Travel that is left out after the beginning and each reversal, where the lever vibrates; auto: from "
          "the data, up to a quarter of each stroke");
      section.choice("Loss", settings.loss,
                     { { "least squares", IdentificationLoss::squares }, { "Huber", IdentificationLoss::huber } },
                     "Function of the residuals that is minimised; Huber's grows linearly beyond 1.345 standard deviations, so "
                     "that outliers hardly count");
      section.number("Confidence", settings.confidence, { 0.5, 0.9999 }, "", "Confidence level of the intervals");
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
