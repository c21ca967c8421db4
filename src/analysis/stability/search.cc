// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/search.h"

#include "base/errors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sprag
{
  namespace
  {
    struct Tried
    {
      double value = 0.;
      std::optional<CheckedSlide> slide; ///< none where it cannot be checked

      SlideKind kind() const
      {
        return slide->kind;
      }
    };

    unsigned int rank(const SlideKind kind)
    {
      return kind == SlideKind::jammed ? 2 : is_unstable(kind) ? 1 : 0;
    }

    using Window = std::array<Tried, 3>;
    using Height = std::function<double(const Tried &)>;

    /// Returns whether a height's peak near the window's middle may be above 0. It may rise once more what it has fallen to a
    /// side.
    bool may_pass_zero(const std::array<double, 3> &height)
    {
      const double low = std::min(height[0], height[2]);
      return height[1] >= height[0] && height[1] >= height[2] && height[1] > low && 2. * height[1] - low > 0.;
    }

    class Search
    {
    public:
      Search(const ParameterRange &range, const std::function<CheckedSlide(double)> &check_at_,
             const std::function<void()> &value_tried_)
          : check_at(check_at_)
          , value_tried(value_tried_)
      {
        result.range   = range;
        result.spacing = range_spacing(range);
      }

      void try_points(const std::vector<double> &hints)
      {
        const auto &range = result.range;
        for (unsigned int i = 0; i < range.points; ++i)
          all.push_back(
              checked_at(range.points == 1 ? range.from : range.from + (range.to - range.from) * i / (range.points - 1)));
        for (const double hint : hints)
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
        { return tried.slide && all.front().slide && is_alike(*tried.slide, *all.front().slide); };
        result.has_effect = all.size() < 2 || !std::all_of(all.begin(), all.end(), is_as_first);
        for (std::size_t i = 1; i < all.size() && tolerance > 0.; ++i)
          narrow(all[i - 1], all[i], tolerance * std::abs(result.range.to - result.range.from));
        return result;
      }

    private:
      const std::function<CheckedSlide(double)> &check_at;
      const std::function<void()> &value_tried;
      CriticalSearch result;
      std::vector<Tried> all; ///< from one end of the range to the other

      Tried checked_at(const double value)
      {
        Tried tried{ value, {} };
        try
        {
          tried.slide = check_at(value);
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
        value_tried();
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

      /// Golden sections, until the kind is another one.
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
      /// which halves the bracket.
      void narrow(Tried low, Tried high, const double tolerance)
      {
        const auto growth = [](const Tried &tried) { return tried.slide ? tried.slide->growth_rate : 0.; };
        double at_low = growth(low), at_high = growth(high);
        for (unsigned int step = 1; low.slide && high.slide && low.kind() != high.kind(); ++step)
        {
          const double width = std::abs(high.value - low.value);
          if (width <= tolerance)
            break;
          const double least   = 1e-3 * std::max(std::abs(at_low), std::abs(at_high));
          const bool has_chord = at_low * at_high < 0. && std::min(std::abs(at_low), std::abs(at_high)) > least;
          const double inside  = std::min(0.5, 0.45 * tolerance / width);
          const double share   = has_chord && step % 3 != 0 ? std::clamp(at_low / (at_low - at_high), inside, 1. - inside) : 0.5;
          const Tried middle   = checked_at(low.value + share * (high.value - low.value));
          const bool moves_low = middle.slide && middle.kind() == low.kind();
          (moves_low ? low : high)       = middle;
          (moves_low ? at_low : at_high) = growth(middle);
          (moves_low ? at_high : at_low) *= 0.5;
        }
        if (!low.slide || !high.slide || low.kind() == high.kind())
          return;
        result.changes.push_back({ 0.5 * (low.value + high.value), low.kind(), high.kind(),
                                   is_worse(*high.slide, *low.slide) ? *high.slide : *low.slide,
                                   std::isnan(low.slide->mu) ? high.slide->mu : low.slide->mu });
      }
    };
  } // namespace

  CheckedSlide checked_slide(const SlideStability &found, const DrivePoint &drive)
  {
    CheckedSlide result;
    result.kind        = found.kind;
    result.growth_rate = found.growth_rate();
    result.frequency   = found.frequency();
    result.uniqueness  = found.uniqueness();
    result.motion      = found.motion();
    result.drive       = drive;
    for (const auto &mode : found.modes)
      result.growth_rates.push_back(mode.mode.eigenvalue.real());
    if (!found.slide)
      return result;
    result.mu = found.slide->mu;
    result.P  = found.slide->forces.P;
    return result;
  }

  bool is_worse(const CheckedSlide &a, const CheckedSlide &b)
  {
    return rank(a.kind) != rank(b.kind) ? rank(a.kind) > rank(b.kind) : a.growth_rate > b.growth_rate;
  }

  bool is_alike(const CheckedSlide &a, const CheckedSlide &b)
  {
    return a.growth_rate == b.growth_rate && a.P == b.P;
  }

  CriticalSearch search_kinds(const ParameterRange &range, const SearchEffort &effort,
                              const std::function<CheckedSlide(double)> &check_at, const std::vector<double> &hints,
                              const std::function<void()> &tried)
  {
    Search search(range, check_at, tried);
    search.try_points(hints);
    search.look_for_islands(effort.island_steps);
    return search.found(effort.tolerance);
  }
} // namespace sprag
