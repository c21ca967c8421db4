// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/error_estimate.h"
#include "run/quasi_static_probes.h"

#include <functional>

namespace sprag
{
  struct Scene;

  /// Estimates the errors of a finished run without inertia, of P, Q, loop_area, largest_pressure, contact_width and
  /// largest_stress.
  ///
  /// A few states of the run in full sliding are solved again by other models, which `probe` makes. What changes tells the run's
  /// own error by Richardson: forces converge with the second power of the size, degree 1 with the power 1.6, pressures with the
  /// third, all with the first power of 1/penalty. The loop area's part of the step is that of the trapezoidal rule, from every
  /// other row. Stresses are compared in the states whose fields were found and converge with the power of the size that the
  /// degree is; those of the layer are told to be no better than the pressure on it is there. The largest P and Q behind a
  /// reversal are compared over the rows of the passage through stick, and the largest pressure is told to be no better than the
  /// rows scatter. The lever's inertia, which such a
  /// run leaves out, is told apart, by the closed form: J d^2(th)/dt^2 over the spring's moment.
  std::vector<ErrorEstimate> quasi_static_accuracy(const Scene &scene, const std::vector<Row> &rows,
                                                   const std::function<Probes()> &probe);
} // namespace sprag
