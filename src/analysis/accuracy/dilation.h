// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"

#include <functional>
#include <vector>

namespace sprag
{
  /// The errors that time steps of finite length make in a vibration are these.
  struct Slowing
  {
    double frequency = 0.; ///< relative, as the fit of a sinusoid to P - P_quasi_static meets it: weighted by its square
    double P         = 0.; ///< largest change of P by the delay that has added up until then [N]
    double peak_step = 0.; ///< longest step up to the largest excess of P once friction has turned, the overshoot [s]
  };

  /// Looks at the rows between two times [s] in which P rings. `by_step` returns the relative slowing of that
  /// vibration in steps of a length [s].
  Slowing estimate_slowing(const std::vector<Row> &rows, double begin, double end, const std::function<double(double)> &by_step);

  /// Returns the largest change of P [N] per relative change of the frequency with which it rings between two times [s], up to
  /// the last row in which P is off P_quasi_static by at least a tenth of its largest distance: a vibration that runs slower by a
  /// small share d lags d (t - begin) behind. Without rows 0.
  double change_by_frequency(const std::vector<Row> &rows, double begin, double end);
} // namespace sprag
