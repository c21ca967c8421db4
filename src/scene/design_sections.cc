// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "scene/section.h"
#include "scene/sections.h"

namespace sprag
{
  void add_design_parameters(Scene &scene, std::vector<Parameter> &all)
  {
    DesignSettings &settings = scene.design;
    Section section(all, "Design");
    section.text("Free", settings.free,
                 "List of SECTION/NAME = FROM ... TO, separated by semicolons: parameters that the lever is found by, and their "
                 "bounds");
    section.text("Demands", settings.demands,
                 "List separated by semicolons of QUANTITY <= VALUE, QUANTITY >= VALUE or QUANTITY = VALUE +- TOLERANCE; of a "
                 "quantity of params/design.md or a free parameter");
    section.text("Aim", settings.aim, "minimise QUANTITY or maximise QUANTITY");
    section.text("Second aim", settings.second_aim, "Likewise, for the front of both; empty: none");
    section.integer("Front points", settings.front_points, { 3., 200. }, "Of the front, ends included");
    section.text("Judges", settings.judges,
                 "What computes the lever found again: list of table (its levers' table in time), beam, condensed; or none");
    section.integer("Positions", settings.positions, { 2., 200. },
                    "x at which beam and condensed judge the slide both ways, equally apart up to the drive's largest");
    section.choice("Judge in time", settings.judges_in_time, { { "on", true }, { "off", false } },
                   "Whether the last of beam and condensed also follows the drive in time");
    section.integer("Rounds", settings.rounds, { 1., 20. },
                    "Levers proposed to each judge: from the second on the closed form is corrected by what the judge found");
    section.integer("Evaluations", settings.evaluations, { 100., 1e7 }, "Of the closed form in each global search");
    section.integer("Seed", settings.seed, { 0., 4294967295. }, "Of the global search; the same seed finds the same lever");
  }
} // namespace sprag
