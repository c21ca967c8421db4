// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/limit_cycle/limit_cycle.h"

#include "analytic/ringing.h"
#include "base/least_squares.h"
#include "base/ranges.h"
#include "base/unknown.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace sprag
{
  namespace
  {
    constexpr double window_periods = 20.;
    constexpr double least_ringing  = 1e-7; ///< of P over its mean, above which it vibrates
    constexpr double same           = 0.01; ///< relative difference of amplitudes that counts as none
    constexpr double leaving        = 1.5;  ///< ratio of the period_change of a window to that of the one before

    double amplitude(const std::vector<Sample> &signal)
    {
      const auto [lowest, highest] =
          std::minmax_element(signal.begin(), signal.end(), [](const Sample &a, const Sample &b) { return a.value < b.value; });
      return 0.5 * (highest->value - lowest->value);
    }

    CycleWindow next_window(HeldRun &run, const HeldSlide &slide, const DrivePath &path, const double duration,
                            const RowSink &sink)
    {
      struct NormalForce
      {
        double slide_P;
        std::vector<Sample> samples = {};
        double open                 = 0.;
      };
      std::vector<NormalForce> levers = { { slide.forces.P } };
      if (slide.second)
        levers.push_back({ slide.second->P });
      std::vector<Sample> indentation;
      double stuck = 0., mean = 0.;
      const double begin = run.drive().time;
      const auto n       = static_cast<unsigned int>(std::ceil(duration / run.dt - 1e-6));
      for (unsigned int i = 0; i < n; ++i)
      {
        const Row &row = run.step(path);
        for (unsigned int lever = 0; lever < levers.size(); ++lever)
        {
          const double P = row.lever_value(Column::P, lever);
          levers[lever].samples.push_back({ row[Column::time], P });
          levers[lever].open += P == 0. ? 1. : 0.;
        }
        indentation.push_back({ row[Column::time], row[Column::indentation] });
        stuck += run.slides(slide.speed) ? 0. : 1.;
        sink(row);
      }
      const bool second_moves_more   = levers.size() == 2 && amplitude(levers[1].samples) > amplitude(levers[0].samples);
      const auto &[slide_P, P, open] = levers[second_moves_more ? 1 : 0];
      Signal signal{ run.dt, {} };
      for (const auto &sample : P)
      {
        mean += sample.value / n;
        signal.values.push_back(sample.value);
      }
      const auto recurrence = find_recurrence(signal);
      // P may cross its mean several times a period if contact is lost. Its frequency is that of the strongest line.
      return { begin,
               P.back().time,
               amplitude(P),
               slide_P,
               amplitude(indentation),
               open / n,
               stuck / n,
               ringing(signal, least_ringing * mean).frequency,
               recurrence.time,
               recurrence.change };
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
        {
          sum.slide_P   = window.slide_P;
          sum.frequency = window.frequency;
          sum.period    = window.period;
        }
        sum.amplitude_P           = std::max(sum.amplitude_P, window.amplitude_P);
        sum.amplitude_indentation = std::max(sum.amplitude_indentation, window.amplitude_indentation);
        sum.open_share += share * window.open_share;
        sum.stick_share += share * window.stick_share;
      }
      return sum;
    }

    bool is_small(const CycleWindow &window)
    {
      return window.amplitude_P < small_vibration * window.slide_P;
    }

    /// Checks the windows so far: a slide, a cycle, or undecided as long as the last ones differ.
    Settling checked(const std::vector<CycleWindow> &windows)
    {
      const std::size_t n = windows.size();
      if (n < 3)
        return Settling::undecided;
      const auto &before = windows[n - 2], &last = windows[n - 1];
      if (is_small(last))
        return last.amplitude_P < before.amplitude_P ? Settling::slide : Settling::undecided;
      // A cycle that is about to double its period repeats itself worse and worse.
      const bool leaves  = last.period_change > leaving * before.period_change;
      const bool repeats = last.period > 0. && !leaves && agree(before, last) && agree(windows[n - 3], last);
      return repeats ? Settling::cycle : Settling::undecided;
    }

    /// Decides at the end of the time: a large vibration stays unless its second half is clearly smaller than its first.
    Settling checked_at_last(const std::vector<CycleWindow> &windows)
    {
      const std::size_t n = windows.size();
      if (is_small(windows.back()) || n < 4)
        return Settling::undecided;
      const double first  = mean_amplitude(windows, 0, n / 2);
      const double second = mean_amplitude(windows, n / 2, n);
      return second > 0.8 * first ? Settling::irregular : Settling::undecided;
    }

    constexpr double limit_accuracy = 1e-3; ///< of x [mm]

    /// Returns how long the centre takes from one slide to the next where it never exceeds the drive's speed [s].
    double path_duration(const HeldSlide &from, const HeldSlide &to)
    {
      constexpr double peak_over_mean = 1.875; ///< of the speed, see moving_path()
      return peak_over_mean * std::abs(to.drive.x - from.drive.x) / std::abs(from.drive.v);
    }

    constexpr double settled_after = 2.; ///< periods left out of the fit: what the mode's first steps excite beside it

    bool oscillates(const Eigenmode &mode)
    {
      return mode.mode.eigenvalue.imag() > smallest_growth * std::abs(mode.mode.eigenvalue);
    }

    double mode_period(const Eigenmode &mode)
    {
      const auto lambda = mode.mode.eigenvalue;
      return 2. * M_PI / (oscillates(mode) ? lambda.imag() : std::abs(lambda));
    }

    /// Says when the signal has grown or decayed by a factor, from its sizes half a period long.
    struct AmplitudeWatch
    {
      const double half_period;
      const double aim; ///< the factor
      double end   = 0.;
      double size  = 0.;
      double first = 0.;

      bool reached(const Sample &sample)
      {
        size = std::max(size, std::abs(sample.value));
        if (sample.time < end)
          return false;
        if (end == 0.)
          end = sample.time;
        end += half_period;
        if (first == 0.)
          first = size;
        const double ratio = size / first;
        size               = 0.;
        return aim > 1. ? ratio >= aim : ratio <= aim;
      }
    };

    std::vector<Sample> compute_amplitudes(const std::vector<Sample> &signal, const bool oscillating)
    {
      if (oscillating)
        return compute_envelope(signal);
      std::vector<Sample> result;
      for (const auto &sample : signal)
        if (sample.value != 0.)
          result.push_back({ sample.time, std::abs(sample.value) });
      return result;
    }

    /// Returns the lever, 0 or 1, that a mode bends and turns more.
    unsigned int moving_lever(const ModeShape &shape)
    {
      const auto size   = [](const double value) { return value; };
      const auto motion = [&](const ModeShape::LeverShape &lever)
      { return std::hypot(largest(lever.across[0], size), largest(lever.across[1], size)); };
      constexpr double tie = 1e-6;
      return shape.levers.size() == 2 && motion(shape.levers[1]) > (1. + tie) * motion(shape.levers[0]) ? 1 : 0;
    }

    void fit(const std::vector<Sample> &signal, const Eigenmode &mode, const double at_start, Growth &growth)
    {
      growth.sizes     = compute_amplitudes(signal, oscillates(mode));
      growth.envelope  = fit_exponential(growth.sizes);
      growth.frequency = oscillates(mode) ? fit_frequency(crossings(signal)) : unknown;
      for (auto &size : growth.sizes)
        size.value *= at_start / growth.envelope.amplitude;
    }

    /// Vertex of the parabola through three samples, the middle one not smaller than its neighbours.
    Sample vertex(const Sample &before, const Sample &middle, const Sample &after)
    {
      const double h0     = middle.time - before.time;
      const double h1     = after.time - middle.time;
      const double rise   = (middle.value - before.value) / h0;
      const double fall   = (after.value - middle.value) / h1;
      const double bend   = (fall - rise) / (h0 + h1);
      const double slope  = (rise * h1 + fall * h0) / (h0 + h1);
      const double offset = bend < 0. ? -slope / (2. * bend) : 0.;
      return { middle.time + offset, middle.value + 0.5 * slope * offset };
    }

    Sample sized(const Sample &sample)
    {
      return { sample.time, std::abs(sample.value) };
    }

    bool changes_sign(const Sample &a, const Sample &b)
    {
      return (a.value < 0.) != (b.value < 0.);
    }
  } // namespace

  Settled settle(HeldRun &run, const HeldSlide &slide, const SettlingTimes &times, const RowSink &sink)
  {
    const auto path    = held_path(run.drive(), slide);
    const double begin = run.drive().time;
    std::vector<CycleWindow> windows;
    Settled result;
    double passed          = 0.;
    constexpr double looks = 1.5; ///< of the shortest time, as windows of a cycle scatter
    while (result.kind == Settling::undecided && passed < std::max(times.longest, looks * times.shortest))
    {
      windows.push_back(next_window(run, slide, path, window_periods * times.period, sink));
      passed = windows.back().end - begin;
      if (passed >= times.shortest)
        result.kind = checked(windows);
    }
    if (result.kind == Settling::undecided)
      result.kind = checked_at_last(windows);
    result.window = result.kind == Settling::irregular ? joined(windows, windows.size() / 2) : windows.back();
    if (windows.size() > 1)
    {
      const double last = windows.back().amplitude_P, before = windows[windows.size() - 2].amplitude_P;
      result.agreement = std::abs(last - before) / std::max(last, before);
    }
    return result;
  }

  std::vector<ErrorEstimate> estimate_cycle_errors(DynamicModel &model, const HeldRun &run, const HeldSlide &slide,
                                                   const Settled &settled, const double period)
  {
    const auto errors = [](const std::string &unknown, const std::array<double, 3> &found = {})
    {
      const auto error = [&](const std::string &quantity, const double value)
      {
        const ErrorPart part{ "step", value, "Try twice the Sprag slip/Steps per period." };
        return ErrorEstimate{ quantity, "it", unknown.empty() ? std::vector{ part } : std::vector<ErrorPart>(), unknown };
      };
      return std::vector{ error("cycle_amplitude_P", found[0]), error("cycle_frequency", found[1]),
                          error("cycle_vibrations", found[2]) };
    };
    if (settled.kind == Settling::slide)
      return {};
    if (settled.kind != Settling::cycle)
      return errors(
          "No estimate: P does not repeat itself. Four times the Sprag slip/Steps per period show what the steps change.");
    constexpr double steps_in_one = 2.;
    constexpr double approach     = 0.5; ///< windows in which the motion comes to the cycle of the shorter steps
    const double change_to_error  = 1. + finer_share(steps_in_one, 1.);
    HeldRun finer(model, run.dt / steps_in_one);
    finer.spectral_radius = run.spectral_radius;
    finer.resume(run.state());
    const auto path   = held_path(run.drive(), slide);
    const auto window = [&](const double share)
    { return next_window(finer, slide, path, share * window_periods * period, [](const Row &) {}); };
    window(approach);
    const auto found = window(1.);
    if (!(found.period > 0.))
      return errors(
          "No estimate: P does not repeat itself in steps of half the length. Try four times the Sprag slip/Steps per period.");
    const auto relative = [&](double CycleWindow::*member)
    { return change_to_error * std::abs(found.*member / settled.window.*member - 1.); };
    return errors("", { { relative(&CycleWindow::amplitude_P), relative(&CycleWindow::frequency),
                          std::abs(found.vibrations() / settled.window.vibrations() - 1.) } });
  }

  Continuation::Continuation(DynamicModel &dynamic_model, HeldRun &held_run, const DrivePoint &start,
                             const SettlingTimes &settling_times, const CheckedModes &checked_modes,
                             const SpragSlipSettings &sprag_slip)
      : model(dynamic_model)
      , run(held_run)
      , drive(start)
      , modes(checked_modes)
      , settings(sprag_slip)
      , times(settling_times)
  {
  }

  ContinuationPoint Continuation::checked(const double x)
  {
    DrivePoint there = drive;
    there.x          = x;
    ContinuationPoint point;
    point.slide = check_slide(model, there, modes);
    point.x     = x;
    return point;
  }

  Settled Continuation::settled(const ContinuationPoint &point)
  {
    return settle(run, *point.slide.slide, times, [](const Row &) {});
  }

  Settled Continuation::kicked(const ContinuationPoint &point, const double amplitude)
  {
    const auto &slide = *point.slide.slide;
    run.begin(model.perturbed(slide, watched_mode(point.slide), amplitude * slide.penetration));
    return settled(point);
  }

  Settled Continuation::carried(const ContinuationPoint &from, const ContinuationPoint &to)
  {
    const auto &begin  = *from.slide.slide;
    const auto &end    = *to.slide.slide;
    const double until = run.drive().time + path_duration(begin, end);
    const auto path    = moving_path(run.drive(), begin, end, path_duration(begin, end));
    while (run.drive().time < until)
      run.step(path);
    return settled(to);
  }

  void Continuation::go_away(const double turn, const std::function<void()> &done)
  {
    for (unsigned int i = 1; i <= settings.continuation; ++i)
    {
      auto point         = checked(drive.x + (turn - drive.x) * i / settings.continuation);
      const auto &last   = visited.back();
      const bool carries = point.holds() && last.away.vibrates();
      const auto at_last = run.state();
      if (carries)
        point.away = carried(last, point);
      if (point.holds() && !point.away.vibrates())
        point.away = kicked(point, large_kick);
      if (carries && !point.away.vibrates())
        last_alive = Alive{ visited.size() - 1, at_last };
      visited.push_back(std::move(point));
      done();
    }
  }

  void Continuation::find_death(const std::function<void()> &done)
  {
    if (!last_alive)
      return;
    auto &[alive, state] = *last_alive;
    for (unsigned int i = 0; i < bisections; ++i)
    {
      auto middle = checked(0.5 * (visited[alive].x + visited[alive + 1].x));
      if (!middle.holds())
        return;
      run.resume(state);
      middle.away       = carried(visited[alive], middle);
      const bool living = middle.away.vibrates();
      visited.insert(visited.begin() + static_cast<std::ptrdiff_t>(alive) + 1, std::move(middle));
      if (living)
      {
        state = run.state();
        ++alive;
      }
      done();
    }
  }

  void Continuation::go_back(const std::function<void()> &done)
  {
    for (std::size_t i = visited.size(); i-- > 0;)
    {
      auto &point = visited[i];
      if (!point.holds())
        continue;
      if (i + 1 < visited.size() && visited[i + 1].back.vibrates())
        point.back = carried(visited[i + 1], point);
      if (!point.back.vibrates())
        point.back = kicked(point, small_kick);
      done();
    }
  }

  void Continuation::go(const SlideStability &slide, const Settled &start, const double turn, const std::function<void()> &done)
  {
    ContinuationPoint first;
    first.slide = slide;
    first.x     = drive.x;
    first.away  = start;
    visited     = { first };
    go_away(turn, done);
    find_death(done);
    go_back(done);
  }

  double Continuation::stability_limit(double stable, double unstable)
  {
    while (std::abs(stable - unstable) > limit_accuracy)
    {
      const double middle                                                   = 0.5 * (stable + unstable);
      (checked(middle).slide.kind == SlideKind::stable ? stable : unstable) = middle;
    }
    return stable;
  }

  std::optional<Coexistence> Continuation::coexistence()
  {
    std::optional<Coexistence> longest;
    const auto length = [](const Coexistence &stretch) { return std::abs(stretch.to - stretch.from); };
    const auto end_at = [&](const std::size_t inside, const std::size_t outside)
    {
      const bool loses_stability =
          outside < visited.size() && visited[outside].holds() && visited[outside].slide.kind != SlideKind::stable;
      return loses_stability ? stability_limit(visited[inside].x, visited[outside].x) : visited[inside].x;
    };
    for (std::size_t i = 0; i < visited.size(); ++i)
    {
      const std::size_t begin = i;
      while (i < visited.size() && visited[i].coexist())
        ++i;
      if (i == begin)
        continue;
      Coexistence found{ end_at(begin, begin - 1), end_at(i - 1, i) };
      if (found.from > found.to)
        std::swap(found.from, found.to);
      if (!longest || length(found) > length(*longest))
        longest = found;
    }
    return longest;
  }

  const Eigenmode &watched_mode(const SlideStability &stability)
  {
    if (stability.kind != SlideKind::stable)
      return stability.worst_mode();
    // Without damping none decays: the lowest then, which comes first.
    const Eigenmode *slowest = nullptr;
    for (const auto &mode : stability.modes)
    {
      const double round_off = smallest_growth * std::abs(mode.mode.eigenvalue);
      const auto rate        = [](const Eigenmode &other) { return other.mode.eigenvalue.real(); };
      if (oscillates(mode) && (slowest == nullptr || rate(mode) > rate(*slowest) + round_off))
        slowest = &mode;
    }
    return slowest != nullptr ? *slowest : stability.worst_mode();
  }

  double choose_step(const Eigenmode &mode, const SpragSlipSettings &settings)
  {
    return mode_period(mode) / settings.steps_per_period;
  }

  CycleSteps choose_cycle_steps(const SlideStability &stability, const SpragSlipSettings &settings)
  {
    const double step = choose_step(watched_mode(stability), settings);
    double slowest    = 0.;
    for (const auto &mode : stability.modes)
      if (oscillates(mode))
        slowest = std::max(slowest, mode_period(mode));
    if (stability.kind != SlideKind::divergence || slowest == 0.)
      return { step * settings.steps_per_period, step };
    constexpr double steps_in_one = 4.;
    return { slowest, slowest / settings.steps_per_period / steps_in_one };
  }

  Growth measure_growth(DynamicModel &model, const SlideStability &stability, const SpragSlipSettings &settings, HeldRun &run,
                        const RowSink &sink)
  {
    const auto &slide     = *stability.slide;
    const auto &mode      = watched_mode(stability);
    const bool grows      = stability.kind != SlideKind::stable;
    const double at_start = grows ? settings.initial : settings.final;
    const double at_end   = grows ? settings.final : settings.initial;
    const double period   = mode_period(mode);
    const auto lever      = moving_lever(model.mode_shape(mode));
    const double slide_P  = lever == 1 ? slide.second->P : slide.forces.P;

    Growth growth;
    growth.eigenvalue = mode.mode.eigenvalue;
    run.begin(model.perturbed(slide, mode, at_start * slide.penetration));
    const auto path    = held_path(run.drive(), slide);
    const double begin = run.drive().time;
    AmplitudeWatch watch{ 0.5 * period, at_end / at_start };
    // Fast modes ring from the start, in turns from step to step and for long: means of two steps are free of them.
    std::vector<Sample> signal;
    double from = 0.;
    for (double time = 0.; !growth.reached && growth.slid && time < settings.longest_growth;)
    {
      const Row &row = run.step(path);
      sink(row);
      time            = row[Column::time] - begin;
      const double P  = row.lever_value(Column::P, lever);
      const double to = P - slide_P;
      growth.reached  = watch.reached({ time, to });
      growth.slid     = run.slides(slide.speed) && P > 0.;
      if (time > settled_after * period)
        signal.push_back({ time - 0.5 * run.dt, 0.5 * (from + to) });
      from = to;
    }
    fit(signal, mode, at_start, growth);
    return growth;
  }

  std::vector<Sample> compute_envelope(const std::vector<Sample> &signal)
  {
    std::vector<Sample> result;
    std::size_t largest = 0;
    bool inside         = false;
    for (std::size_t i = 1; i < signal.size(); ++i)
    {
      if (changes_sign(signal[i - 1], signal[i]))
      {
        if (inside)
          result.push_back(vertex(sized(signal[largest - 1]), sized(signal[largest]), sized(signal[largest + 1])));
        inside  = true;
        largest = i;
      }
      else if (std::abs(signal[i].value) > std::abs(signal[largest].value))
        largest = i;
    }
    return result;
  }

  std::vector<double> crossings(const std::vector<Sample> &signal)
  {
    std::vector<double> result;
    for (std::size_t i = 1; i < signal.size(); ++i)
    {
      const auto &a = signal[i - 1];
      const auto &b = signal[i];
      if (changes_sign(a, b))
        result.push_back(a.time + (b.time - a.time) * a.value / (a.value - b.value));
    }
    return result;
  }

  ExponentialFit fit_exponential(const std::vector<Sample> &sizes)
  {
    if (sizes.size() < 3)
      return { unknown, unknown, unknown };
    const auto times      = mapped(sizes, &Sample::time);
    const auto logarithms = mapped(sizes, [](const Sample &size) { return std::log(size.value); });
    const auto line       = fitted_line(times, logarithms);
    double squares        = 0.;
    for (std::size_t i = 0; i < times.size(); ++i)
      squares += std::pow(logarithms[i] - line.at(times[i]), 2);
    return { line.slope, std::exp(line.at(0.)), std::sqrt(squares / static_cast<double>(sizes.size())) };
  }

  double fit_frequency(const std::vector<double> &times)
  {
    if (times.size() < 3)
      return unknown;
    std::vector<double> numbers(times.size());
    std::iota(numbers.begin(), numbers.end(), 0.);
    return 0.5 / fitted_line(numbers, times).slope;
  }
} // namespace sprag
