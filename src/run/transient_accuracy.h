#pragma once

#include "analysis/accuracy/error_estimate.h"
#include "levers/dynamics.h"

namespace sprag
{
  /// Estimates the errors of a finished run in time, of P, overshoot, frequency and growth_rate of the ringing behind a reversal.
  ///
  /// The slide behind the first reversal is held, and the vibration of its frequency judged as vibration_accuracy() does: that
  /// gives the parts of mesh, penalty and modes. The part of the step is the slowing and the damping of the generalised-alpha
  /// method at the steps in which the run rings. A vibration that is too slow lags behind, the more the longer it rings: see
  /// change_by_frequency(). The overshoot is as wrong as the frequency, as an impact of given speed meets it with a force that
  /// goes with the frequency. Of reduced levers the step alone is told: what they leave out, only finite elements tell.
  ///
  /// Without estimates in words: drives without a reversal, contacts that open, slides that grow on their own.
  std::vector<ErrorEstimate> transient_accuracy(const Scene &scene, const MeshedDynamics &dynamics, const std::vector<Row> &rows,
                                                DynamicsMaker &maker);
} // namespace sprag
