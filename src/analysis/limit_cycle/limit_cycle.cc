// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/limit_cycle/limit_cycle.h"

#include "analytic/ringing.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double window_periods = 20.;
    constexpr double round_off      = 1e-7; ///< of P over its mean, above which it vibrates
    constexpr double same           = 0.01; ///< relative difference of amplitudes that counts as none

    /// Returns the frequency of the strongest line in the spectrum of a signal that is sampled every `step` [s]. Where contact is
    /// lost the signal may cross its mean several times a period.
    double strongest_frequency(const std::vector<Sample> &signal, const double step, const double noise)
    {
      Signal values{ step, {} };
      for (const auto &sample : signal)
        values.values.push_back(sample.value);
      return ringing(values, noise).frequency;
    }

    double amplitude(const std::vector<Sample> &signal)
    {
      const auto [lowest, highest] =
          std::minmax_element(signal.begin(), signal.end(), [](const Sample &a, const Sample &b) { return a.value < b.value; });
      return 0.5 * (highest->value - lowest->value);
    }

    CycleWindow next_window(HeldRun &run, const HeldSlide &slide, const DrivePath &path, const double duration,
                            const RowSink &sink)
    {
      std::vector<Sample> P, indentation;
      double open = 0., stuck = 0., mean = 0.;
      const double begin = run.drive().time;
      const auto n       = static_cast<unsigned int>(std::ceil(duration / run.time_step() - 1e-6));
      for (unsigned int i = 0; i < n; ++i)
      {
        const Row &row = run.step(path);
        P.push_back({ row[Column::time], row[Column::P] });
        indentation.push_back({ row[Column::time], row[Column::indentation] });
        open += row[Column::P] == 0. ? 1. : 0.;
        stuck += run.slides(slide.speed) ? 0. : 1.;
        sink(row);
      }
      for (const auto &sample : P)
        mean += sample.value / n;
      const double frequency = strongest_frequency(P, run.time_step(), round_off * mean);
      return { begin, P.back().time, amplitude(P), amplitude(indentation), mean, open / n, stuck / n, frequency };
    }

    bool agree(const double a, const double b)
    {
      return std::abs(a - b) <= same * std::max(a, b);
    }

    bool agree(const CycleWindow &a, const CycleWindow &b)
    {
      return agree(a.amplitude_P, b.amplitude_P) && agree(a.amplitude_indentation, b.amplitude_indentation) &&
             !(std::abs(a.frequency - b.frequency) > same * std::max(a.frequency, b.frequency)) &&
             std::abs(a.open_share - b.open_share) <= same;
    }

    /// Mean of amplitudes over some windows.
    double mean_amplitude(const std::vector<CycleWindow> &windows, const std::size_t begin, const std::size_t end)
    {
      double sum = 0.;
      for (std::size_t i = begin; i < end; ++i)
        sum += windows[i].amplitude_P;
      return sum / static_cast<double>(end - begin);
    }

    /// All windows from `begin` on as one: the largest amplitudes, the frequency of the largest, the means of everything else.
    CycleWindow joined(const std::vector<CycleWindow> &windows, const std::size_t begin)
    {
      CycleWindow sum{ windows[begin].begin, windows.back().end };
      const double share = 1. / static_cast<double>(windows.size() - begin);
      for (std::size_t i = begin; i < windows.size(); ++i)
      {
        const auto &window = windows[i];
        if (window.amplitude_P >= sum.amplitude_P)
          sum.frequency = window.frequency;
        sum.amplitude_P           = std::max(sum.amplitude_P, window.amplitude_P);
        sum.amplitude_indentation = std::max(sum.amplitude_indentation, window.amplitude_indentation);
        sum.mean_P += share * window.mean_P;
        sum.open_share += share * window.open_share;
        sum.stick_share += share * window.stick_share;
      }
      return sum;
    }

    /// What the windows so far amount to; undecided while they do not.
    Settling judged(const std::vector<CycleWindow> &windows, const double P)
    {
      const std::size_t n = windows.size();
      if (n < 3)
        return Settling::undecided;
      const auto &before = windows[n - 2], &last = windows[n - 1];
      if (last.amplitude_P < small_vibration * P)
        return last.amplitude_P < before.amplitude_P ? Settling::slide : Settling::undecided;
      return agree(before, last) && agree(windows[n - 3], last) ? Settling::cycle : Settling::undecided;
    }

    /// At the end of the time: a large vibration stays unless its second half is clearly smaller than its first.
    Settling judged_at_last(const std::vector<CycleWindow> &windows, const double P)
    {
      const std::size_t n = windows.size();
      if (windows.back().amplitude_P < small_vibration * P || n < 4)
        return Settling::undecided;
      const double first  = mean_amplitude(windows, 0, n / 2);
      const double second = mean_amplitude(windows, n / 2, n);
      return second > 0.8 * first ? Settling::irregular : Settling::undecided;
    }
  } // namespace

  std::string settling_name(const Settling settling)
  {
    return std::vector<std::string>{ "slide", "cycle", "irregular", "undecided" }.at(static_cast<std::size_t>(settling));
  }

  Settled settle(HeldRun &run, const HeldSlide &slide, const SettlingTimes &times, const RowSink &sink)
  {
    const auto path    = held_path(run.drive(), slide);
    const double begin = run.drive().time;
    std::vector<CycleWindow> windows;
    Settled result;
    double passed = 0.;
    while (result.kind == Settling::undecided && passed < times.longest)
    {
      windows.push_back(next_window(run, slide, path, window_periods * times.period, sink));
      passed = windows.back().end - begin;
      if (passed >= times.shortest)
        result.kind = judged(windows, slide.forces.P);
    }
    if (result.kind == Settling::undecided)
      result.kind = judged_at_last(windows, slide.forces.P);
    result.window = result.kind == Settling::irregular ? joined(windows, windows.size() / 2) : windows.back();
    if (windows.size() > 1)
    {
      const double last = windows.back().amplitude_P, before = windows[windows.size() - 2].amplitude_P;
      result.agreement = std::abs(last - before) / std::max(last, before);
    }
    return result;
  }
} // namespace sprag
