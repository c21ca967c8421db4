// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/unknown.h"

#include <vector>

namespace sprag
{
  /// Values at equal steps of time.
  struct Signal
  {
    double step = 0.; ///< [s]
    std::vector<double> values;
  };

  /// The strongest sinusoid in a signal. NaN where there is none: less than two periods, nothing above the noise, or no peak in
  /// the spectrum next to what is constant or drifts.
  struct Ringing
  {
    double frequency   = unknown; ///< [Hz]
    double growth_rate = unknown; ///< of the envelope [1/s], negative: decays
  };

  /// The shortest time after which a signal is the same again; NaN where it never is.
  struct Recurrence
  {
    double time   = unknown; ///< [s]
    double change = unknown; ///< root mean square of what is not the same, over that of the signal
  };

  /// Finds it up to half of the signal's length, with a change of less than 2 %. Between values the signal is taken as linear.
  Recurrence find_recurrence(const Signal &signal);

  /// Finds the ringing between the first and the last value further than `noise` from the signal's linear trend. Frequency: peak
  /// of the spectrum, refined by a least-squares fit of one exponentially growing or decaying sinusoid. Growth: log-linear fit of
  /// the half ranges of successive periods, so that neither harmonics nor a slow drift matter.
  Ringing ringing(const Signal &signal, double noise);
} // namespace sprag
