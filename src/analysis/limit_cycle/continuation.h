// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/limit_cycle/sprag_slip.h"

#include <optional>

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
    double period                = 0.; ///< after which P is the same again [s]; NaN if it never is
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
    double shortest; ///< before anything is checked [s]
    double longest;  ///< before what there is has to do [s]
  };

  /// Amplitude of P over its mean below which a shrinking vibration is one that dies.
  constexpr double small_vibration = 1e-2;

  /// Goes on about a held slide until P comes back to itself and three windows agree, in amplitudes and frequency within 1 % and
  /// in the share of open time within 0.01, or the vibration is small and shrinks. Throws as HeldRun::step().
  Settled settle(HeldRun &run, const HeldSlide &slide, const SettlingTimes &times, const RowSink &sink);

  /// The slide and the vibrations found at one x.
  struct ContinuationPoint
  {
    SlideStability slide; ///< checked there
    double x = 0.;        ///< [mm]
    Settled away;         ///< the vibration carried along, or what a large kick of the slide leads to
    Settled back;         ///< the slide, perturbed a little, or a vibration carried along

    /// Returns whether there is a slide to vibrate about.
    bool holds() const
    {
      return slide.kind != SlideKind::jammed;
    }

    /// Returns whether a stable slide and a vibration both live there.
    bool coexist() const
    {
      return slide.kind == SlideKind::stable && (away.vibrates() || back.vibrates());
    }
  };

  /// Places at which a stable slide and a vibration live side by side [mm], `from` < `to`.
  struct Coexistence
  {
    double from;
    double to;
  };

  /// Follows vibrations and slides from one x to the next, away from the start and back. The centre moves at the drive's speed at
  /// most, the slip goes on at that of the slides.
  class Continuation
  {
  public:
    /// Perturbations of a slide over its penetration.
    static constexpr double small_kick = 1e-3;
    static constexpr double large_kick = 3.;

    /// Bisections of the interval in which a vibration that was carried along dies.
    static constexpr unsigned int bisections = 3;

    /// Starts at `drive`; `modes` is that of check_slide(). The run must begin at the slide
    /// or vibration there.
    Continuation(DynamicModel &model, HeldRun &run, const DrivePoint &drive, const SettlingTimes &times,
                 const CheckedModes &modes, const SpragSlipSettings &settings);

    /// Goes to `turn` [mm] in the scene's number of intervals, finds where the vibration dies on the way, and returns. `done` is
    /// called after each x. What is finished can be asked for after an exception too. Throws as HeldRun::step() and
    /// check_slide().
    void go(const SlideStability &slide, const Settled &start, double turn, const std::function<void()> &done);

    /// Returns the points visited so far, from the start to the turn.
    const std::vector<ContinuationPoint> &points() const
    {
      return visited;
    }

    /// Finds the longest interval in which a stable slide and a vibration were both found. It ends where the slide loses its
    /// stability, to within 1e-3 mm, or at the last x at which the vibration was found; none if there is no such x.
    std::optional<Coexistence> coexistence();

  private:
    /// The last x, of those visited, at which the vibration carried away lived, and its state there.
    struct Alive
    {
      std::size_t point;
      RunState state;
    };

    ContinuationPoint checked(double x);
    Settled settled(const ContinuationPoint &point);
    Settled kicked(const ContinuationPoint &point, double amplitude);
    Settled carried(const ContinuationPoint &from, const ContinuationPoint &to);
    void go_away(double turn, const std::function<void()> &done);
    void find_death(const std::function<void()> &done);
    void go_back(const std::function<void()> &done);
    double stability_limit(double stable, double unstable);

    DynamicModel &model;
    HeldRun &run;
    const DrivePoint drive;
    const CheckedModes modes;
    const SpragSlipSettings &settings;
    const SettlingTimes times;
    std::vector<ContinuationPoint> visited;
    std::optional<Alive> last_alive;
  };
} // namespace sprag
