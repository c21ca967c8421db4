// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/statics/quasi_static.h"
#include "fe/solid/static_lever.h"
#include "run/stress_comparison.h"

namespace sprag
{
  struct Scene;

  /// Some states of a run in full sliding, and what other models make of them in single steps from one to the next.
  struct Probes
  {
    std::vector<Row> run;
    std::vector<Row> coarse;  ///< on a mesh of twice the Mesh/Face size with the same penalty, in space of twice the width too
    std::vector<Row> soft;    ///< on the run's mesh with a third of the penalty; empty where the run augments and has the
                              ///< automatic tangential one
    std::vector<Row> passage; ///< passage_rows() of the run
    std::vector<Row> coarse_passage;       ///< the same rows on the coarser mesh
    std::vector<Row> soft_passage;         ///< and with the softer penalty
    std::optional<StressChanges> stress{}; ///< on the coarser mesh
    double pressure_with_stress = 0.;      ///< change of the pressure there in the states whose stress is known
  };

  /// `levers` is the run's model; it is left with its own penalties. `stresses` are those of the run.
  Probes plane_probes(const Scene &scene, StaticLever<2> &levers, const std::vector<Row> &rows,
                      const QuasiStaticSettings &settings, const std::vector<StressSample> &stresses);

  /// The same of a lever in three dimensions, without stresses. The first rank makes the coarser one alone, when the body's own
  /// factors are given back.
  Probes solid_probes(const Scene &scene, SolidBody &body, StaticLever<3> &lever, const std::vector<Row> &rows,
                      const QuasiStaticSettings &settings);
} // namespace sprag
