// SPDX-License-Identifier: GPL-3.0-only
#include "input/section.h"
#include "input/sections.h"
#include "scene/scene.h"

namespace sprag
{
  void add_design_parameters(Scene &scene, std::vector<Parameter> &all)
  {
    DesignSettings &settings = scene.design;
    Section section(all, "Design");
    section.text("Free", settings.free,
                 "Free parameters of the lever and their bounds: list of SECTION/NAME = FROM ... TO, separated by semicolons");
    section.text("Demands", settings.demands,
                 "Demands on a quantity of params/design.md or a free parameter: list of QUANTITY <= VALUE, QUANTITY >= VALUE or "
                 "QUANTITY = VALUE +- TOLERANCE, separated by semicolons");
    section.text("Aim", settings.aim, "Aim of the search: minimise QUANTITY or maximise QUANTITY");
    section.text("Second aim", settings.second_aim, "Second aim in the same form, for the front of both; empty: none");
    section.integer("Front points", settings.front_points, { 3., 200. }, "Points of the front, both ends included");
    section.text("Judges", settings.checks,
                 "Models that check the lever found: list of table (its levers' table in time), beam, condensed; or none");
    section.integer("Positions", settings.positions, { 2., 200. },
                    "Number of x at which beam and condensed judge the slide both ways, equally apart up to the drive's largest");
    section.choice("Judge in time", settings.checks_in_time, { { "on", true }, { "off", false } },
                   "on: the last of beam and condensed also follows the drive in time");
    section.integer("Rounds", settings.rounds, { 1., 20. },
                    "Levers proposed to each judge; from the second on the closed form is corrected by the judge's result");
    section.integer("Evaluations", settings.evaluations, { 100., 1e7 }, "Evaluations of the closed form in each global search");
    section.integer("Seed", settings.seed, { 0., 4294967295. }, "Seed of the global search; the same seed finds the same lever");
  }
} // namespace sprag
