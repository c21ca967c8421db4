// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"

#include <functional>
#include <vector>

namespace sprag
{
  /// Errors of a vibration due to finite time steps.
  struct StepErrors
  {
    double frequency = 0.; ///< relative; mean over time after P - P_quasi_static first changes sign, weighted by its size
    double P         = 0.; ///< max |d(P - P_quasi_static)/dt| times the delay accumulated since the overshoot [N]
    double peak_step = 0.; ///< longest step up to the overshoot, the largest excess of P after friction has turned [s]
  };

  /// Estimates the errors from the rows between two times [s], in which P rings. `frequency_error` returns the relative decrease
  /// of the vibration's frequency by steps of a length [s]; the delay is the sum of frequency_error dt.
  StepErrors estimate_step_errors(const std::vector<Row> &rows, double begin, double end,
                                  const std::function<double(double)> &frequency_error);

  /// Returns the largest change of P [N] per relative change of the frequency with which it rings after `begin` [s],
  ///   max |d(P - P_quasi_static)/dt| (t - time of the overshoot),
  /// up to the last row before `end` in which |P - P_quasi_static| is at least a tenth of its maximum; 0 without rows.
  double change_by_frequency(const std::vector<Row> &rows, double begin, double end);
} // namespace sprag
