// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/statics/quasi_static.h"
#include "analytic/error_estimate.h"
#include "fe/fields/body_fields.h"
#include "fe/statics/static_lever.h"
#include "results/columns.h"

#include <functional>
#include <optional>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Largest von Mises stress in a state of a run, the cells at the hub left out.
  struct StressSample
  {
    double time  = 0.; ///< of the state [s]
    double lever = 0.; ///< [MPa]
    double layer = 0.; ///< [MPa]

    /// In the layer around the edges of the contact and beyond [MPa]. Behind a sliding contact the stress along the face rises
    /// steeply to a cusp, of which a finer mesh finds more.
    double layer_edge = 0.;
  };

  /// Looks at the fields of the state of a row too.
  void look_at(const BodyFields &fields, const std::vector<NodalField> &nodal, const Row &row, StressSample &sample);

  /// Returns how far the inertia of the levers changes P while they follow the drive, over the largest P of the rows: by the
  /// closed form J d^2(th)/dt^2 over the spring's moment (eq. 5 of the paper). The vibrations behind sudden reversals and at the
  /// start are none of it.
  double left_out_inertia(const Scene &scene, const std::vector<Row> &rows);

  /// Relative changes of the largest stress in lever and layer between two models.
  struct StressChanges
  {
    double lever;
    double layer;
    bool is_at_edge; ///< whether the layer's is all but reached where the contact ends, see StressSample
  };

  /// Some states of a run, as it or another model has them.
  struct TrialRows
  {
    std::vector<Row> slides;  ///< in full sliding
    std::vector<Row> passage; ///< see passage_rows()
  };

  /// Some states of a run, and what other models make of them in single steps from one to the next.
  struct TrialRuns
  {
    TrialRows run;
    TrialRows other; ///< on the mesh of with_compared_mesh() with the same penalty
    TrialRows soft;  ///< on the run's mesh with a third of the penalty; empty where the run augments and has the automatic
                     ///< tangential one
    std::vector<Row> longer_steps{};       ///< of the passage, on the other mesh by half as many steps
    std::optional<StressChanges> stress{}; ///< on the other mesh
    double pressure_with_stress = 0.;      ///< change of the pressure there in the states whose stress is known
  };

  /// `levers` is the run's model; it is left with its own penalties. `stresses` are those of the run.
  TrialRuns plane_trial_runs(const Scene &scene, StaticLever<2> &levers, const std::vector<Row> &rows,
                             const QuasiStaticSettings &settings, const std::vector<StressSample> &stresses);

  /// The same of a lever in three dimensions, without stresses. The first rank makes the other one alone, when the body's own
  /// factors are given back.
  TrialRuns solid_trial_runs(const Scene &scene, SolidBody &body, StaticLever<3> &lever, const std::vector<Row> &rows,
                             const QuasiStaticSettings &settings);

  /// Estimates the errors of a finished run without inertia, of P, Q, loop_area, largest_pressure, contact_width and
  /// both largest stresses.
  ///
  /// A few states of the run in full sliding are solved again by other models, which `run_trials` makes. What changes tells the
  /// run's own error by Richardson: forces converge with the second power of the size, degree 1 with the power 1.6, pressures
  /// with the third, all with the first power of 1/penalty. The loop area's part of the step is that of the trapezoidal rule,
  /// from every other row. Stresses are compared in the states whose fields were found and converge with the power of the size
  /// that the degree is; those of the layer are told to be no better than the pressure on it is there. The largest P and Q behind
  /// a reversal are compared over the rows of the passage through stick, and the largest pressure is told to be no better than
  /// the rows scatter. The part `stick` is what half as many steps through the passage change, as an error of first order does,
  /// where mu follows the speed; that of a corner between rows is at least as small. The lever's inertia, which such a run leaves
  /// out, is told apart, by the closed form: J d^2(th)/dt^2 over the spring's moment.
  std::vector<ErrorEstimate> quasi_static_accuracy(const Scene &scene, const std::vector<Row> &rows,
                                                   const std::function<TrialRuns()> &run_trials);
} // namespace sprag
