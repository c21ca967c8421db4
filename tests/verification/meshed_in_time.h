// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/oscillation.h"
#include "fe/dynamics/dynamic_face_lever.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/statics/lever_properties.h"
#include "input/scene_key.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "support/made_mesh.h"
#include "verification/run_transient.h"

namespace sprag
{
  /// A run in time of the scene's meshed lever, condensed or not, in memory.
  inline TransientRun run_meshed_in_time(const Scene &scene)
  {
    const MadeMesh triangulation(scene);
    const ElasticBody<2> body(triangulation, lever_properties(scene).body);
    const double relaxation = contact_reference(scene).relaxation;
    const auto lever =
        scene.analysis.model == ModelType::condensed
            ? make_condensed_dynamics(scene, body, make_condensed_basis(scene, body_key(scene), body, true), relaxation)
            : make_finite_element_dynamics(scene, body, make_finite_element_basis(scene, body), relaxation);
    return run_in_time(*lever.model, scene);
  }

  inline TransientRun run_any_in_time(const Scene &scene)
  {
    const bool meshed = scene.analysis.model == ModelType::condensed || scene.analysis.model == ModelType::finite_element;
    return meshed ? run_meshed_in_time(scene) : run_in_time(scene);
  }

  /// Oscillation after the only reversal.
  inline Oscillation compute_oscillation(const Scene &scene, const TransientRun &run)
  {
    return oscillations(run.rows, scene.drive).front();
  }
} // namespace sprag
