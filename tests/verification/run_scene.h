// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/statics/quasi_static.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/statics/static_lever.h"
#include "mpi_environment.h"
#include "report/report.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/made_mesh.h"
#include "support/scene_parts.h"

#include <cmath>
#include <vector>

namespace sprag
{
  /// The scene's quasi-static finite-element run in memory. Appends its rows, which stay if the run fails, and returns the
  /// stiffness in stick at the first reversal [N/mm].
  inline double run_scene(const Scene &scene, std::vector<Row> &rows)
  {
    const MadeMesh triangulation(scene);
    StaticLever<2> model(triangulation, scene);
    return run_quasi_static(model, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
                            [&](const State &, const Row &row, const Evaluation &)
                            {
                              rows.push_back(row);
                              add_closed_form(scene, rows.back());
                            });
  }

  inline std::vector<Row> run_scene(const Scene &scene)
  {
    std::vector<Row> rows;
    run_scene(scene, rows);
    return rows;
  }

  inline Scene with_face_size(Scene scene, const double face_size)
  {
    scene.mesh.face_size = face_size;
    return scene;
  }

  inline Scene with_step(Scene scene, const double step)
  {
    scene.analysis.step = step;
    return scene;
  }

  inline Scene with_augmented_lagrangian(Scene scene)
  {
    scene.contact.enforcement = Enforcement::augmented_lagrangian;
    return scene;
  }

  /// Lever and friction layer so much stiffer.
  inline Scene with_stiffness(Scene scene, const double factor)
  {
    scene.lever.young_modulus *= factor;
    scene.layer.young_modulus *= factor;
    return scene;
  }
} // namespace sprag
