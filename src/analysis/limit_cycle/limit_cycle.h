// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/limit_cycle/sprag_slip.h"

namespace sprag
{
  /// Means and amplitudes of a vibration about a held slide over a number of its periods.
  struct CycleWindow
  {
    double begin                 = 0.; ///< [s]
    double end                   = 0.; ///< [s]
    double amplitude_P           = 0.; ///< half of largest less smallest [N]
    double amplitude_indentation = 0.; ///< the same [mm]
    double mean_P                = 0.; ///< [N]
    double open_share            = 0.; ///< of the time, without contact
    double stick_share           = 0.; ///< of the time, with a point in contact that does not slide on with the cylinder
    double frequency             = 0.; ///< strongest line of P's spectrum [Hz]; NaN without one
  };

  enum class Settling
  {
    slide,     ///< back to the slide, or on its way there
    cycle,     ///< the same again in every window
    irregular, ///< a vibration that neither dies nor repeats itself
    undecided  ///< too small to tell what becomes of it
  };

  /// Returns "slide", "cycle" ...
  std::string settling_name(Settling settling);

  /// The vibration or slide that a motion about a held slide comes to.
  struct Settled
  {
    Settling kind = Settling::undecided;
    CycleWindow window;    ///< the last; of an irregular vibration over its last half
    double agreement = 0.; ///< relative difference of amplitude_P in the last two windows

    bool vibrates() const
    {
      return kind == Settling::cycle || kind == Settling::irregular;
    }
  };

  struct SettlingTimes
  {
    double period;   ///< of the slide's vibration [s]; a window has 20
    double shortest; ///< before anything is judged [s]
    double longest;  ///< before what there is has to do [s]
  };

  /// Amplitude of P over its mean below which a shrinking vibration is one that dies.
  constexpr double small_vibration = 1e-2;

  /// Goes on about a held slide until three windows agree, in amplitudes and frequency within 1 % and in the share of open time
  /// within 0.01, or the vibration is small and shrinks. Throws as HeldRun::step().
  Settled settle(HeldRun &run, const HeldSlide &slide, const SettlingTimes &times, const RowSink &sink);
} // namespace sprag
