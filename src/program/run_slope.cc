// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/slope.h"
#include "laws/friction.h"
#include "program/result_writer.h"
#include "program/run_by_formulas.h"
#include "scene/closed_form.h"
#include "scene/scene.h"

#include <cmath>

namespace sprag
{
  void run_slope(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    PhaseTimer timer;
    const auto sweep = slope_sweep(scene);
    ResultWriter writer(scene, options, timer, sweep.columns);
    for (const auto &row : sweep.rows)
      writer.append(row);
    const double mu = friction_coefficient(scene.friction, scene.drive.peak_speed()).coefficient;
    writer.finish("completed", { { { "critical_inclination", std::atan(mu) } } }, warnings);
  }
} // namespace sprag
