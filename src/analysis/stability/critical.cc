// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/critical.h"

#include "base/errors.h"
#include "levers/prepared_scene.h"
#include "scene/read.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    /// A value of the parameter and what the slide does there.
    struct Tried
    {
      double value = 0.;
      std::optional<SlideKind> kind; ///< none where the scene is not admitted
      double mu = std::numeric_limits<double>::quiet_NaN();
      std::string motion;
      double growth_rate = std::numeric_limits<double>::quiet_NaN();
      std::vector<double> growth_rates; ///< of the modes by increasing |lambda|
    };

    bool is_unstable(const SlideKind kind)
    {
      return kind == SlideKind::flutter || kind == SlideKind::divergence;
    }

    Tried attempt(const Scene &scene, const std::string &parameter, const double value, DynamicsMaker &maker)
    {
      Tried result;
      result.value = value;
      try
      {
        const auto found   = judge(prepared(variant(scene, { override_text(parameter, value) })), maker);
        result.kind        = found.kind;
        result.motion      = found.motion();
        result.growth_rate = found.growth_rate();
        for (const auto &mode : found.modes)
          result.growth_rates.push_back(mode.mode.eigenvalue.real());
        if (found.slide)
          result.mu = found.slide->mu;
      }
      catch (const InputError &)
      {
      }
      catch (const AnalysisError &)
      {
      }
      return result;
    }

    /// Whether a height's peak near the window's middle may be above 0: it may rise once more what it has fallen to a side.
    bool may_pass_zero(const std::array<double, 3> &height)
    {
      const double low = std::min(height[0], height[2]);
      return height[1] >= height[0] && height[1] >= height[2] && height[1] > low && 2. * height[1] - low > 0.;
    }

    class Search
    {
    public:
      Search(const Scene &scene_, const ParameterRange &range, DynamicsMaker &maker_)
          : scene(scene_)
          , maker(maker_)
      {
        result.range   = range;
        result.spacing = std::abs(range.to - range.from) / (range.points - 1);
      }

      void try_points(const std::function<void()> &point_done)
      {
        const auto &range = result.range;
        for (unsigned int i = 0; i < range.points; ++i)
        {
          all.push_back(judged(range.from + (range.to - range.from) * i / (range.points - 1)));
          if (!result.first)
            result.first = all.back().kind;
          point_done();
        }
      }

      /// Where a growth rate peaks among stable slides, or the largest has a dip among unstable ones, an island of the other kind
      /// may lie between the points.
      void look_for_islands(const unsigned int steps)
      {
        const std::vector<Tried> points = all;
        for (std::size_t i = 1; i + 1 < points.size(); ++i)
        {
          const std::array<Tried, 3> window = { { points[i - 1], points[i], points[i + 1] } };
          const auto &[low, middle, high]   = window;
          if (!middle.kind || low.kind != middle.kind || high.kind != middle.kind || *middle.kind == SlideKind::jammed)
            continue;
          if (is_unstable(*middle.kind))
          {
            climb(window, steps, [](const Tried &tried) { return -tried.growth_rate; });
            continue;
          }
          const std::size_t modes = std::min({ low.growth_rates.size(), middle.growth_rates.size(), high.growth_rates.size() });
          for (std::size_t k = 0; k < modes; ++k)
            climb(window, steps,
                  [k](const Tried &tried) { return k < tried.growth_rates.size() ? tried.growth_rates[k] : tried.growth_rate; });
        }
      }

      CriticalSearch found(const double tolerance)
      {
        for (std::size_t i = 1; i < all.size(); ++i)
          bisect(all[i - 1], all[i], tolerance * std::abs(result.range.to - result.range.from));
        return result;
      }

    private:
      const Scene &scene;
      DynamicsMaker &maker;
      CriticalSearch result;
      std::vector<Tried> all; ///< from one end of the range to the other

      Tried judged(const double value)
      {
        Tried tried = attempt(scene, result.range.name, value, maker);
        if (!tried.kind)
          result.not_judged.push_back(value);
        return tried;
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
      void climb(std::array<Tried, 3> window, const unsigned int steps, const std::function<double(const Tried &)> &height)
      {
        constexpr double share = 0.381966;
        for (unsigned int step = 0; step < steps; ++step)
        {
          auto &[low, middle, high] = window;
          if (!may_pass_zero({ { height(low), height(middle), height(high) } }))
            return;
          const bool upper  = std::abs(high.value - middle.value) > std::abs(middle.value - low.value);
          const auto &side  = upper ? high : low;
          const Tried added = judged(middle.value + share * (side.value - middle.value));
          if (!added.kind)
            return;
          insert(added);
          if (added.kind != middle.kind)
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

      void bisect(Tried low, Tried high, const double tolerance)
      {
        while (low.kind && high.kind && low.kind != high.kind && std::abs(high.value - low.value) > tolerance)
        {
          const Tried middle                     = judged(0.5 * (low.value + high.value));
          (middle.kind == low.kind ? low : high) = middle;
        }
        if (!low.kind || !high.kind || low.kind == high.kind)
          return;
        const auto &motion = is_unstable(*high.kind) ? high.motion : low.motion;
        result.changes.push_back(
            { 0.5 * (low.value + high.value), std::isnan(low.mu) ? high.mu : low.mu, *low.kind, *high.kind, motion });
      }
    };
  } // namespace

  CriticalSearch critical_values(const Scene &scene, const ParameterRange &range, const double tolerance, DynamicsMaker &maker,
                                 const std::function<void()> &point_done)
  {
    Search search(scene, range, maker);
    search.try_points(point_done);
    search.look_for_islands(is_reduced(scene.analysis.model) ? 14 : 5);
    return search.found(tolerance);
  }
} // namespace sprag
