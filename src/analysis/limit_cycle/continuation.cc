// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/limit_cycle/continuation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sprag
{
  namespace
  {
    constexpr double limit_accuracy = 1e-3; ///< of x [mm]

    /// So that the centre never exceeds the drive's speed.
    double duration_of(const HeldSlide &from, const HeldSlide &to)
    {
      constexpr double peak_of_mean = 1.875; ///< of the speed, see moving_path()
      return peak_of_mean * std::abs(to.drive.x - from.drive.x) / std::abs(from.drive.v);
    }
  } // namespace

  Continuation::Continuation(DynamicModel &dynamic_model, HeldRun &held_run, const DrivePoint &start, const double period,
                             const unsigned int n_modes, const SpragSlipSettings &sprag_slip)
      : model(dynamic_model)
      , run(held_run)
      , drive(start)
      , modes(n_modes)
      , settings(sprag_slip)
      , times{ period, sprag_slip.settling, std::max(sprag_slip.settling, sprag_slip.longest_growth) }
  {
  }

  ContinuationPoint Continuation::judged(const double x)
  {
    DrivePoint there = drive;
    there.x          = x;
    ContinuationPoint point;
    point.slide = judge(model, there, modes);
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
    run.begin(model.perturbed(slide, watched_mode(point.slide), amplitude * slide.overlap));
    return settled(point);
  }

  Settled Continuation::carried(const ContinuationPoint &from, const ContinuationPoint &to)
  {
    const auto &begin  = *from.slide.slide;
    const auto &end    = *to.slide.slide;
    const double until = run.drive().time + duration_of(begin, end);
    const auto path    = moving_path(run.drive(), begin, end, duration_of(begin, end));
    while (run.drive().time < until)
      run.step(path);
    return settled(to);
  }

  void Continuation::go_away(const double turn, const std::function<void()> &done)
  {
    for (unsigned int i = 1; i <= settings.continuation; ++i)
    {
      auto point         = judged(drive.x + (turn - drive.x) * i / settings.continuation);
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
      auto middle = judged(0.5 * (visited[alive].x + visited[alive + 1].x));
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
      const double middle                                                  = 0.5 * (stable + unstable);
      (judged(middle).slide.kind == SlideKind::stable ? stable : unstable) = middle;
    }
    return stable;
  }

  std::optional<Coexistence> Continuation::coexistence()
  {
    std::optional<Coexistence> longest;
    const auto length = [](const Coexistence &of) { return std::abs(of.to - of.from); };
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
} // namespace sprag
