// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/isolation.h"
#include "scene/scene.h"

#include <cmath>
#include <vector>

namespace sprag
{
  /// A table of 0.05 t on 2 N/mm with a damper and no motion of the base.
  inline Scene isolated(const DamperType damper)
  {
    Scene scene;
    scene.analysis.type       = AnalysisType::isolation;
    scene.analysis.model      = ModelType::closed_form;
    scene.isolation.damper    = damper;
    scene.isolation.mass      = 0.05;
    scene.isolation.stiffness = 2.;
    scene.isolation.base      = BaseMotionType::none;
    scene.isolation.duration  = 20.;
    return scene;
  }

  inline Scene shaken(const DamperType damper, const double frequency_ratio)
  {
    Scene scene                        = isolated(damper);
    scene.isolation.base               = BaseMotionType::harmonic;
    scene.isolation.base_frequency     = frequency_ratio * std::sqrt(2. / 0.05) / (2. * M_PI);
    scene.isolation.duration           = 400.;
    scene.isolation.end                = IsolationEnd::steady_state;
    scene.isolation.periodic_tolerance = 1e-11;
    return scene;
  }

  inline IsolationFindings compute_findings(const Scene &scene)
  {
    IsolationFindings found;
    run_isolation(scene, found, {});
    return found;
  }

  /// Instants at which the table turned or stopped.
  inline std::vector<TableState> find_turns(const Scene &scene)
  {
    std::vector<TableState> turns;
    IsolationFindings found;
    run_isolation(scene, found,
                  [&](const IsolatedTable &motion, const bool is_before)
                  {
                    if (is_before)
                      turns.push_back(motion.state());
                  });
    return turns;
  }
} // namespace sprag
