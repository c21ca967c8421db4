// SPDX-License-Identifier: GPL-3.0-only
#include "input/section.h"
#include "input/sections.h"
#include "scene/scene.h"

namespace sprag
{
  void add_identification_parameters(Scene &scene, std::vector<Parameter> &all)
  {
    IdentificationSettings &settings = scene.identification;
    Section section(all, "Identification");
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
    section.number_or_auto("Reversal window", settings.window, at_least(0.), "mm",
                           "Travel that is left out after the beginning and each reversal, where the lever vibrates; auto: from "
                           "the data, up to a quarter of each stroke");
    section.choice("Loss", settings.loss,
                   { { "least squares", IdentificationLoss::squares }, { "Huber", IdentificationLoss::huber } },
                   "Function of the residuals that is minimised; Huber's grows linearly beyond 1.345 standard deviations, so "
                   "that outliers hardly count");
    section.number("Confidence", settings.confidence, { 0.5, 0.9999 }, "", "Confidence level of the intervals");
  }
} // namespace sprag
