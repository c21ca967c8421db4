// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/slope.h"
#include "laws/friction.h"
#include "program/result_writer.h"
#include "program/run_by_formulas.h"
#include "report/brief_lines.h"
#include "report/report.h"
#include "scene/closed_form.h"
#include "scene/scene.h"

#include <cmath>
#include <iostream>

namespace sprag
{
  void run_slope(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    PhaseTimer timer;
    const auto sweep = slope_sweep(scene);
    ResultWriter writer(scene, options, timer, sweep.columns);
    for (const auto &row : sweep.rows)
      writer.append(row);
    const double mu                  = friction_coefficient(scene.friction, scene.drive.peak_speed()).coefficient;
    const std::vector<Entry> summary = { { "critical_inclination", std::atan(mu), "rad",
                                           "th0B = atan mu: steeper, Q helps the backward stroke" } };
    const auto end                   = writer.finish("completed", { summary }, warnings);
    if (options.verbose)
      print_summary(std::cout, end.summary);
    else if (!options.quiet)
      brief_line(std::cout, "critical inclination",
                 Known(end.summary).quantity("critical_inclination") + ": steeper, Q helps the backward stroke");
  }
} // namespace sprag
