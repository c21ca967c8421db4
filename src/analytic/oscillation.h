// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "base/unknown.h"
#include "results/result_file.h"
#include "results/warning.h"
#include "scene/drive.h"

#include <string>
#include <vector>

namespace sprag
{
  /// Classifies the vibration after a reversal:
  /// - unknown: fewer than two rows in the window;
  /// - vibrates: rms over 8 % of P without inertia, and the contact is open for more than 1 % of the time;
  /// - sticks_and_slips: none of these, and friction sticks twice or more and for more than 1 % of the last half
  ///   of the window, at more than a tenth of the drive's largest speed;
  /// - elements_pass: the ripple of elements under the contact remains, see Oscillation::passing_frequency;
  /// - grows: none of these, the envelope grows and the remainder at the end is over 1.2 % of P without inertia;
  /// - decays: none of these, the remainder is at most 1.2 % of P without inertia, or 0.1 % of the run's; never open;
  /// - rings: none of these, it decays, but not within the window.
  SPRAG_ENUMERATION(Verdict, unknown, vibrates, sticks_and_slips, elements_pass, grows, decays, rings)

  constexpr double least_window = 0.1; ///< behind a reversal [s]

  /// The vibration after a reversal of the drive, measured by how far P, Q and Q_support are off the values without inertia.
  ///
  /// The window begins at the end of the reversal, half its duration after the turning point. It is 0.1 s long, and longer for a
  /// slow vibration: until P has met its value without inertia thirty times, as in 15 periods, or has decayed. On a sprung
  /// support it lasts as long for Q_support, and for P where that comes to vibrate with a slower support. It ends earlier where
  /// the next reversal begins or the rows end. All times of rows are taken as they come, unequally spaced. A value that does not
  /// follow from the rows is NaN.
  ///
  /// Overshoot: largest excess of a force over its quasi-static value in the direction of that value, relative to the largest
  /// quasi-static value of the window; 0 if there is none. It counts up to the end of the window and from where the force first
  /// meets its quasi-static value after the turning point: before that friction is still on its way from one direction to the
  /// other. It counts at the latest from where the reversal has ended and friction slides again.
  struct Oscillation
  {
    double time         = unknown; ///< of the turning point [s]
    double x            = unknown; ///< of the turning point [mm]
    double window_begin = unknown; ///< [s]
    double window_end   = unknown; ///< [s]
    Verdict verdict     = Verdict::unknown;

    double overshoot_P         = unknown;
    double overshoot_Q         = unknown;
    double overshoot_Q_support = unknown; ///< against the quasi-static Q
    double frequency           = unknown; ///< of P [Hz], dominant in the window; NaN without oscillation
    double first_frequency     = unknown; ///< of P before it vibrates with a slower support, else `frequency` [Hz]
    double frequency_Q         = unknown; ///< [Hz]
    double frequency_Q_support = unknown; ///< [Hz]
    double growth_rate         = unknown; ///< of the envelope of P in the window [1/s], negative: decays
    double open_share          = unknown; ///< of the window with P = 0
    double stick_share         = unknown; ///< of the last half of the window, in which friction is less than in sliding
    double rms                 = unknown; ///< of P less its quasi-static value over the window [N]
    double rms_end             = unknown; ///< the same over the last tenth of the window [N]
    double scale               = unknown; ///< largest |P| without inertia in the window, to which verdicts refer [N]
    double rms_Q               = unknown; ///< of Q less its quasi-static value over the window [N]
    double rms_Q_support       = unknown; ///< of Q_support less the quasi-static Q over the window [N]

    /// The frequency at which elements of the friction face pass under the contact [Hz], if `frequency` is that or twice that,
    /// within 4 %, and more than a tenth of the rms over the window is left at its end; else NaN.
    double passing_frequency = unknown;

    /// Travel from the turning point until P stays within 5 % of its largest distance from the quasi-static value after the
    /// reversal, or within 0.1 % of the largest P; at most to the beginning of the next reversal or the end of the rows [mm].
    double extent = unknown;

    double lever = unknown; ///< whose it is, of a pair: 1 or 2
  };

  /// Measures the oscillation after each reversal of the drive, of a pair that of the lever whose verdict is the worse one, then
  /// that with the larger rms. `face_size` is that of the elements along the friction face [mm],
  /// 0 where there are none or it is unknown.
  std::vector<Oscillation> oscillations(const std::vector<Row> &rows, const Drive &drive, double face_size = 0.);

  /// The largest vibration of P elsewhere than in the windows behind reversals.
  struct Swing
  {
    double size = 0.; ///< half the difference of P less its value without inertia between a maximum and the minimum beside it [N]
    double x    = unknown; ///< there [mm]
    double scale = 0.;     ///< largest P without inertia of its lever [N]
  };

  /// Finds it, of a pair that of the lever which swings more; `reversals` are those of oscillations().
  Swing largest_swing(const std::vector<Row> &rows, const std::vector<Oscillation> &reversals, double reversal_duration);

  /// Returns the entries of that: swing_P and, where it is more than 5 % of the largest P without inertia, a sentence.
  std::vector<Entry> swing_entries(const Swing &swing);

  /// Warns of ringing that the mesh makes, not the lever.
  Warnings element_passing_warnings(const std::vector<Oscillation> &oscillations, double face_size);

  /// Returns the entries of /summary: reversal_1_verdict, reversal_1_frequency, ... for every reversal.
  std::vector<Entry> oscillation_entries(const std::vector<Oscillation> &oscillations);
} // namespace sprag
