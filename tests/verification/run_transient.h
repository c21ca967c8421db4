// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/transient/transient.h"
#include "model/lever/reduced_lever.h"
#include "scene/contact_estimates.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/scene_parts.h"

#include <memory>
#include <vector>

namespace sprag
{
  /// A run in time, in memory.
  struct TransientRun
  {
    std::vector<Row> rows;
    TransientReport report;
  };

  inline TransientRun run_in_time(DynamicModel &model, const Scene &scene)
  {
    const auto reference = contact_reference(scene);
    TransientRun run;
    run.report = run_transient(model, scene.drive, { scene.time, reference.P, reference.stiffness },
                               [&](const Motion &, const Row &row) { run.rows.push_back(row); });
    return run;
  }

  inline TransientRun run_in_time(const Scene &scene)
  {
    const auto model = make_reduced_lever(scene);
    return run_in_time(*model, scene);
  }

  /// Models A and B in time, reversals of 5 ms.
  inline Scene in_time(Scene scene, const ModelType model)
  {
    scene.analysis.type           = AnalysisType::transient;
    scene.analysis.model          = model;
    scene.drive                   = Drive(DriveProfile::triangle, 0., 65., 112., 1., 5e-3);
    scene.lever.moment_of_inertia = scene.geometry.interface_offset == 0. ? 6.86 : 6.45;
    return scene;
  }

  /// Every step of this duration [s].
  inline Scene with_fixed_step(Scene scene, const double step)
  {
    scene.time.step      = step;
    scene.time.tolerance = 0.;
    return scene;
  }

  inline Scene with_spectral_radius(Scene scene, const double radius)
  {
    scene.time.spectral_radius = radius;
    return scene;
  }

  /// No damping but friction's, which stays as it is.
  inline Scene undamped(Scene scene)
  {
    scene.lever.modal_damping = 0.;
    scene.contact.damping     = 0.;
    scene.support.damping     = 0.;
    return scene;
  }

  /// A lever of that depth with the contact law fitted to its finite elements.
  inline Scene with_lever(Scene scene, const double depth, const double stiffness, const double exponent)
  {
    scene.lever.depth       = depth;
    scene.contact.stiffness = stiffness;
    scene.contact.exponent  = exponent;
    return scene;
  }
} // namespace sprag
