// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/kind_search.h"

#include "base/errors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sprag
{
  namespace
  {
    bool is_unstable(const SlideKind kind)
    {
      return kind == SlideKind::flutter || kind == SlideKind::divergence;
    }

    /// Returns the distance of the range's points; 0 of a single one.
    double range_spacing(const ParameterRange &range)
    {
      return range.points == 1 ? 0. : std::abs(range.to - range.from) / (range.points - 1);
    }

    /// Holds a value of the parameter and the slide there.
    struct Tried
    {
      double value = 0.;
      std::optional<CheckedSlide> slide; ///< none where it cannot be checked

      SlideKind kind() const
      {
        return slide->kind;
      }
    };

    unsigned int rank(const CheckedSlide &slide)
    {
      if (slide.kind == SlideKind::jammed)
        return 3;
      if (!is_decided({ slide.growth_rate, 2. * M_PI * slide.frequency }, slide.error))
        return 1;
      return is_unstable(slide.kind) ? 2 : 0;
    }

    using Window = std::array<Tried, 3>;
    using Height = std::function<double(const Tried &)>;

    /// Returns whether the height may exceed 0 near the window's middle: its peak is bounded by as much above the middle as the
    /// lower side lies below.
    bool may_pass_zero(const std::array<double, 3> &height)
    {
      const double low = std::min(height[0], height[2]);
      return height[1] >= height[0] && height[1] >= height[2] && height[1] > low && 2. * height[1] - low > 0.;
    }

    struct Search
    {
      const ParameterRange &range;
      const ValueChecks &checks;
      CriticalSearch result  = { range, {}, {}, {}, {}, {}, range_spacing(range) };
      std::vector<Tried> all = {}; ///< from one end of the range to the other

      void try_points(const std::vector<double> &hints, const bool first_change)
      {
        for (unsigned int i = 0; i < range.points; ++i)
        {
          all.push_back(checked_at(range_point(range, i)));
          if (first_change && (!all.back().slide || all.back().kind() != all.front().kind()))
            break;
        }
        for (const double hint : hints)
          if (std::none_of(all.begin(), all.end(), [hint](const Tried &tried) { return tried.value == hint; }))
            insert(checked_at(hint));
        if (const auto found = std::find_if(all.begin(), all.end(), [](const Tried &tried) { return tried.slide.has_value(); });
            found != all.end())
          result.first = found->kind();
      }

      /// Looks for islands of the other kind between the points. One may lie where a growth rate peaks among stable slides, or
      /// where the largest has a dip among unstable ones.
      void look_for_islands(const unsigned int steps)
      {
        const std::vector<Tried> points = all;
        for (std::size_t i = 1; i + 1 < points.size(); ++i)
        {
          const Window window             = { { points[i - 1], points[i], points[i + 1] } };
          const auto &[low, middle, high] = window;
          const bool are_checked          = low.slide && middle.slide && high.slide;
          if (!are_checked || low.kind() != middle.kind() || high.kind() != middle.kind() || middle.kind() == SlideKind::jammed)
            continue;
          if (is_unstable(middle.kind()))
          {
            climb(window, steps, [](const Tried &tried) { return -tried.slide->growth_rate; });
            continue;
          }
          const auto count_modes  = [](const Tried &tried) { return std::max<std::size_t>(1, tried.slide->growth_rates.size()); };
          const std::size_t modes = std::min({ count_modes(low), count_modes(middle), count_modes(high) });
          for (std::size_t k = 0; k < modes; ++k)
            climb(window, steps,
                  [k](const Tried &tried)
                  {
                    const auto &rates = tried.slide->growth_rates;
                    return k < rates.size() ? rates[k] : tried.slide->growth_rate;
                  });
        }
      }

      CriticalSearch found(const double tolerance)
      {
        const auto is_as_first = [&](const Tried &tried)
        { return tried.slide && all.front().slide && are_equal(*tried.slide, *all.front().slide); };
        result.has_effect   = all.size() < 2 || !std::all_of(all.begin(), all.end(), is_as_first);
        const Tried *before = nullptr;
        for (const auto &tried : all)
          if (tried.slide && tolerance > 0.)
          {
            if (before != nullptr)
              narrow(*before, tried, tolerance * std::abs(result.range.to - result.range.from));
            before = &tried;
          }
        return result;
      }

      Tried checked_at(const double value)
      {
        const auto tried = checked_alike(value, checks.at);
        if (tried.slide)
          result.growth.emplace_back(value, tried.slide->growth_rate);
        return tried;
      }

      /// Checks a value that may have worse slides than those that `check` looks at.
      Tried checked_alike(const double value, const std::function<CheckedSlide(double)> &check)
      {
        Tried tried{ value, {} };
        try
        {
          tried.slide = check(value);
          if (!result.worst || is_worse(*tried.slide, *result.worst))
            result.worst = tried.slide;
        }
        catch (const InputError &error)
        {
          pass_over(value, error.what());
        }
        catch (const AnalysisError &error)
        {
          pass_over(value, error.what());
        }
        checks.tried();
        return tried;
      }

      void pass_over(const double value, const std::string &reason)
      {
        result.not_checked.push_back(value);
        result.reason = reason;
      }

      void insert(const Tried &tried)
      {
        const bool rising = result.range.to > result.range.from;
        const auto place =
            std::find_if(all.begin(), all.end(),
                         [&](const Tried &other) { return rising ? other.value > tried.value : other.value < tried.value; });
        all.insert(place, tried);
        ++result.more_values;
      }

      /// Climbs the height by golden sections until the kind changes.
      void climb(Window window, const unsigned int steps, const Height &height)
      {
        constexpr double share = 0.381966;
        for (unsigned int step = 0; step < steps; ++step)
        {
          auto &[low, middle, high] = window;
          if (!may_pass_zero({ { height(low), height(middle), height(high) } }))
            return;
          const bool upper  = std::abs(high.value - middle.value) > std::abs(middle.value - low.value);
          const auto &side  = upper ? high : low;
          const Tried added = checked_at(middle.value + share * (side.value - middle.value));
          if (!added.slide)
            return;
          insert(added);
          if (added.kind() != middle.kind())
            return;
          const bool higher = height(added) > height(middle);
          if (upper)
            (higher ? low : high) = higher ? middle : added;
          else
            (higher ? high : low) = higher ? middle : added;
          if (higher)
            middle = added;
        }
      }

      /// Narrows a change by bisection or, between growth rates of both signs, by regula falsi (Illinois), every third step of
      /// which halves the bracket. It ends at a value that cannot be checked.
      void narrow_bracket(Tried &low, Tried &high, const double tolerance, const std::function<Tried(double)> &check)
      {
        double at_low = low.slide->growth_rate, at_high = high.slide->growth_rate;
        for (unsigned int step = 1; low.kind() != high.kind(); ++step)
        {
          const double width = std::abs(high.value - low.value);
          if (width <= tolerance)
            break;
          const double least   = 1e-3 * std::max(std::abs(at_low), std::abs(at_high));
          const bool has_chord = at_low * at_high < 0. && std::min(std::abs(at_low), std::abs(at_high)) > least;
          const double inside  = std::min(0.5, 0.45 * tolerance / width);
          const double share   = has_chord && step % 3 != 0 ? std::clamp(at_low / (at_low - at_high), inside, 1. - inside) : 0.5;
          const Tried middle   = check(low.value + share * (high.value - low.value));
          if (!middle.slide)
            return;
          const bool moves_low           = middle.kind() == low.kind();
          (moves_low ? low : high)       = middle;
          (moves_low ? at_low : at_high) = middle.slide->growth_rate;
          (moves_low ? at_high : at_low) *= 0.5;
        }
      }

      /// Narrows the limit of stability by the slides that are like the worst of the unstable side, and checks all where that is.
      /// If another is unstable there, it goes on with slides like that.
      void narrow_limit(Tried &low, Tried &high, const double tolerance)
      {
        while (std::abs(high.value - low.value) > tolerance)
        {
          Tried near = low, far = high;
          auto &stable                = low.kind() == SlideKind::stable ? near : far;
          const auto worst            = *(low.kind() == SlideKind::stable ? far : near).slide;
          const double checked_stable = stable.value;
          narrow_bracket(near, far, tolerance,
                         [&](const double value)
                         { return checked_alike(value, [&](const double same) { return checks.alike(same, worst); }); });
          if (stable.value != checked_stable)
            stable = checked_at(stable.value);
          if (!stable.slide)
            return;
          if (stable.kind() == SlideKind::stable)
          {
            low  = near;
            high = far;
            return;
          }
          (low.kind() == SlideKind::stable ? high : low) = stable;
        }
      }

      /// Locates the changes between two values of different kinds: of another kind found between them both limits. Where values
      /// between cannot be checked, a change is known no better than these.
      void narrow(const Tried &begin, const Tried &end, const double tolerance)
      {
        if (begin.kind() == end.kind())
          return;
        Tried low = begin, high = end;
        if (checks.alike && (low.kind() == SlideKind::stable) != (high.kind() == SlideKind::stable))
          narrow_limit(low, high, tolerance);
        else
          narrow_bracket(low, high, tolerance, [&](const double value) { return checked_at(value); });
        narrow(begin, low, tolerance);
        const bool worsens = is_worse(*high.slide, *low.slide);
        result.changes.push_back({ (worsens ? low : high).value, low.kind(), high.kind(), *(worsens ? high : low).slide,
                                   std::isnan(low.slide->mu) ? high.slide->mu : low.slide->mu });
        narrow(high, end, tolerance);
      }
    };
  } // namespace

  double range_point(const ParameterRange &range, const unsigned int i)
  {
    return range.points == 1 ? range.from : range.from + (range.to - range.from) * i / (range.points - 1);
  }

  bool are_equal(const CheckedSlide &a, const CheckedSlide &b)
  {
    return a.growth_rate == b.growth_rate && a.P == b.P;
  }

  bool is_worse(const CheckedSlide &a, const CheckedSlide &b)
  {
    return rank(a) != rank(b) ? rank(a) > rank(b) : a.growth_rate > b.growth_rate;
  }

  CriticalSearch search_kinds(const ParameterRange &range, const SearchEffort &effort, const ValueChecks &checks,
                              const std::vector<double> &hints)
  {
    Search search{ range, checks };
    search.try_points(hints, effort.first_change);
    search.look_for_islands(effort.island_steps);
    return search.found(effort.tolerance);
  }
} // namespace sprag
