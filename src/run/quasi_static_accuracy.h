#pragma once

#include "analysis/accuracy/error_estimate.h"
#include "analysis/statics/quasi_static.h"
#include "fe/statics/lever_model.h"

namespace sprag
{
  /// Estimates the errors of a finished run without inertia, of P, Q, loop_area, largest_pressure and contact_width.
  ///
  /// A few states of the run in full sliding are solved again, in single steps from one to the next: on a mesh of twice the
  /// Mesh/Face size with the same penalty, and on the run's own mesh with a third of the penalty. What changes tells the run's
  /// own error by Richardson: forces converge with the second power of the size, degree 1 with the power 1.6, pressures with the
  /// third, all with the first power of 1/penalty. The loop area's part of the step is that of the trapezoidal rule, from every
  /// other row. Errors of the physics that a run without inertia leaves out are none of these.
  ///
  /// `levers` is the run's model; it is left with its own penalties.
  std::vector<ErrorEstimate> quasi_static_accuracy(const Scene &scene, LeverModel &levers, const std::vector<Row> &rows,
                                                   const QuasiStaticSettings &settings);
} // namespace sprag
