#pragma once

#include "analysis/accuracy/error_estimate.h"
#include "analysis/statics/quasi_static.h"
#include "fe/statics/lever_model.h"
#include "run/stress_sample.h"

namespace sprag
{
  /// Estimates the errors of a finished run without inertia, of P, Q, loop_area, largest_pressure, contact_width and
  /// largest_stress.
  ///
  /// A few states of the run in full sliding are solved again, in single steps from one to the next: on a mesh of twice the
  /// Mesh/Face size with the same penalty, and on the run's own mesh with a third of the penalty. What changes tells the run's
  /// own error by Richardson: forces converge with the second power of the size, degree 1 with the power 1.6, pressures with the
  /// third, all with the first power of 1/penalty. The loop area's part of the step is that of the trapezoidal rule, from every
  /// other row. Stresses are compared in the states whose fields were found and converge with the power of the size that the
  /// degree is; those of the layer are told to be no better than the pressure on it is there. The lever's inertia, which such a
  /// run leaves out, is told apart, by the closed form: J d^2(th)/dt^2 over the spring's moment.
  ///
  /// `levers` is the run's model; it is left with its own penalties. `stresses` are those of the run.
  std::vector<ErrorEstimate> quasi_static_accuracy(const Scene &scene, LeverModel &levers, const std::vector<Row> &rows,
                                                   const QuasiStaticSettings &settings,
                                                   const std::vector<StressSample> &stresses);
} // namespace sprag
