// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/sweep.h"

#include "base/errors.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace sprag
{
  namespace
  {
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

    /// Returns whether two slides have bitwise equal growth rates and forces. Slides that jam (NaN) never have.
    bool are_equal(const CheckedSlide &a, const CheckedSlide &b)
    {
      return a.growth_rate == b.growth_rate && a.P == b.P;
    }

    bool is_unstable(const SlideKind kind)
    {
      return kind == SlideKind::flutter || kind == SlideKind::divergence;
    }

    /// Returns the distance of the range's points; 0 of a single one.
    double range_spacing(const ParameterRange &range)
    {
      return range.points == 1 ? 0. : std::abs(range.to - range.from) / (range.points - 1);
    }

    /// Returns the number of x over the stroke: more for levers that check a slide in milliseconds.
    unsigned int points_along(const Scene &scene)
    {
      const bool is_cheap = scene.analysis.model != ModelType::finite_element && scene.analysis.dimension == 2;
      return is_cheap ? 33 : 9;
    }

    using Constants = std::vector<std::string>; ///< see CheckedSlide::constants

    std::vector<ParameterRange> constant_ranges(const Scene &scene)
    {
      return uncertain_ranges(scene).value_or(std::vector<ParameterRange>());
    }

    /// Returns overrides of the scene's own constants: none, and all combinations of the ends of Stability/Ranges.
    std::vector<Constants> combined_ends(const Scene &scene)
    {
      std::vector<Constants> result = { {} };
      const auto all                = constant_ranges(scene);
      for (unsigned int corner = 0; corner < 1u << all.size() && !all.empty(); ++corner)
      {
        result.emplace_back();
        for (std::size_t i = 0; i < all.size(); ++i)
          result.back().push_back(override_text(all[i].name, (corner >> i & 1u) == 0 ? all[i].from : all[i].to));
      }
      return result;
    }

    /// Returns the values inside one of Stability/Ranges at which slides are checked.
    std::vector<double> values_inside(const Scene &scene, const ParameterRange &range)
    {
      const unsigned int n = is_reduced(scene.analysis.model) ? 7 : 1;
      std::vector<double> result;
      for (unsigned int i = 1; i <= n; ++i)
        result.push_back(range.from + (range.to - range.from) * i / (n + 1.));
      return result;
    }

    /// Returns the constants with another value of one parameter.
    Constants replaced(Constants constants, const std::string &name, const double value)
    {
      const auto is_same = [&](const std::string &constant) { return constant.rfind(name + '=', 0) == 0; };
      constants.erase(std::remove_if(constants.begin(), constants.end(), is_same), constants.end());
      constants.push_back(override_text(name, value));
      return constants;
    }

    CriticalSearch slides_along(const Scene &scene, DynamicModel &model, const SearchEffort &effort)
    {
      const bool over_stroke = looks_over_stroke(scene);
      auto modes             = checked_modes(scene);
      modes.explained        = scene.pair.type == PairType::full; // whose motion() the modes say
      const auto check_at    = [&](const double x)
      {
        DrivePoint drive = held_drive(scene);
        drive.x          = x;
        auto slide       = checked_slide(check_slide(model, drive, modes), drive);
        if (over_stroke || !is_reduced(scene.analysis.model)) // where single modes would take long to follow
          slide.growth_rates.clear();
        return slide;
      };
      if (over_stroke)
        return search_kinds(stroke_range(scene, points_along(scene)), effort, check_at);
      const double x = held_drive(scene).x;
      return search_kinds({ "Stability/Position", x, x, 1 }, { 0., 0 }, check_at);
    }

    /// Returns the scene with a beam in place of a meshed bar, and the contact law of its layer.
    Scene beam_instead(const Scene &scene)
    {
      const auto law = face_law(scene);
      return prepared(variant(scene, { "Analysis/Model=beam", override_text("Contact/Stiffness", law.stiffness),
                                       override_text("Contact/Exponent", law.exponent) }));
    }

    /// Returns the middles of the intervals of one kind that, for a beam, are narrower than the spacing of the range's points.
    std::vector<double> beam_hints(const Scene &scene, const ParameterRange &range)
    {
      if (!is_meshed(scene.analysis.model) || scene.analysis.dimension == 3 || !scene.mesh.file.empty())
        return {};
      DynamicsMaker maker;
      const auto check_at = [&](const double value)
      { return sweep(beam_instead(variant(scene, { override_text(range.name, value) })), maker).worst(); };
      ParameterRange finer = range;
      finer.points         = 2 * range.points - 1;
      const auto found     = search_kinds(finer, { 0.01, 4 }, check_at);
      std::vector<double> hints;
      for (std::size_t i = 1; i < found.changes.size(); ++i)
        if (const double low = found.changes[i - 1].value, high = found.changes[i].value;
            std::abs(high - low) < range_spacing(range))
          hints.push_back(0.5 * (low + high));
      return hints;
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

    unsigned int rank(const SlideKind kind)
    {
      return kind == SlideKind::jammed ? 2 : is_unstable(kind) ? 1 : 0;
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
      const std::function<CheckedSlide(double)> &check_at;
      const std::function<void()> &value_tried;
      CriticalSearch result  = { range, {}, {}, {}, {}, {}, range_spacing(range) };
      std::vector<Tried> all = {}; ///< from one end of the range to the other

      void try_points(const std::vector<double> &hints)
      {
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
        { return tried.slide && all.front().slide && are_equal(*tried.slide, *all.front().slide); };
        result.has_effect = all.size() < 2 || !std::all_of(all.begin(), all.end(), is_as_first);
        for (std::size_t i = 1; i < all.size() && tolerance > 0.; ++i)
          narrow(all[i - 1], all[i], tolerance * std::abs(result.range.to - result.range.from));
        return result;
      }

      Tried checked_at(const double value)
      {
        Tried tried{ value, {} };
        try
        {
          tried.slide = check_at(value);
          result.growth.emplace_back(value, tried.slide->growth_rate);
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
        const bool worsens = is_worse(*high.slide, *low.slide);
        result.changes.push_back({ (worsens ? low : high).value, low.kind(), high.kind(), *(worsens ? high : low).slide,
                                   std::isnan(low.slide->mu) ? high.slide->mu : low.slide->mu });
      }
    };
  } // namespace

  const CheckedSlide &SweptSlides::worst(const Direction direction) const
  {
    const CheckedSlide *result = nullptr;
    for (const auto &swept : sweeps)
    {
      if (direction != Direction::both && swept.direction != direction)
        continue;
      if (!swept.along.not_checked.empty())
        throw AnalysisError(swept.along.reason);
      if (result == nullptr || is_worse(*swept.along.worst, *result))
        result = &*swept.along.worst;
    }
    return *result;
  }

  unsigned int SweptSlides::count_slides() const
  {
    unsigned int sum = 0;
    for (const auto &swept : sweeps)
      sum += swept.along.range.points + swept.along.more_values;
    return sum;
  }

  SweptSlides sweep(const Scene &scene, DynamicsMaker &maker, const bool in_full)
  {
    constexpr unsigned int island_steps = 4;
    constexpr double tolerance          = 2e-3;
    SweptSlides result;
    const auto add = [&](const Constants &constants, const std::vector<Direction> &directions)
    {
      Scene here          = constants.empty() ? scene : prepared(variant(scene, constants));
      const auto dynamics = maker.make(held_scene(here));
      for (const auto direction : directions)
      {
        here.stability.direction = direction;
        SweptDirection swept{ direction, constants,
                              slides_along(here, dynamics.model(), { in_full ? tolerance : 0., island_steps }) };
        if (swept.along.worst)
          swept.along.worst->constants = constants;
        result.sweeps.push_back(std::move(swept));
      }
    };
    for (const auto &constants : combined_ends(scene))
      add(constants, held_directions(scene));
    for (const auto &range : constant_ranges(scene))
    {
      std::map<Constants, std::vector<Direction>> worst_constants;
      for (const auto direction : held_directions(scene))
      {
        const auto fails = [&](const SweptDirection &swept)
        { return swept.direction == direction && !swept.along.not_checked.empty(); };
        if (std::any_of(result.sweeps.begin(), result.sweeps.end(), fails))
          continue;
        const CheckedSlide worst = result.worst(direction);
        if (in_full || worst.kind == SlideKind::stable)
          worst_constants[worst.constants].push_back(direction);
      }
      for (const auto &[constants, directions] : worst_constants)
        for (const double value : values_inside(scene, range))
          add(replaced(constants, range.name, value), directions);
    }
    return result;
  }

  std::vector<std::string> ranges_without_effect(const Scene &scene, const SweptSlides &swept)
  {
    const auto all          = constant_ranges(scene);
    const auto n_directions = held_directions(scene).size();
    // The scene's own constants stand before those of the corners.
    const auto worst = [&](const std::size_t corner, const std::size_t direction) -> const std::optional<CheckedSlide> &
    { return swept.sweeps[(1 + corner) * n_directions + direction].along.worst; };
    std::vector<std::string> result;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      bool all_equal = true;
      for (std::size_t corner = 0; corner < std::size_t(1) << all.size(); ++corner)
        for (std::size_t direction = 0; direction < n_directions; ++direction)
        {
          const auto &here = worst(corner, direction), &other_end = worst(corner ^ std::size_t(1) << i, direction);
          all_equal = all_equal && here && other_end && are_equal(*here, *other_end);
        }
      if (all_equal)
        result.push_back(all[i].name);
    }
    return result;
  }

  unsigned int least_slides(const Scene &scene, const bool inside)
  {
    auto sets = combined_ends(scene).size();
    for (const auto &range : constant_ranges(scene))
      sets += inside ? values_inside(scene, range).size() : 0;
    const auto n = static_cast<unsigned int>(sets * held_directions(scene).size());
    return n * (looks_over_stroke(scene) ? points_along(scene) : 1);
  }

  unsigned int expected_values_between(const Scene &scene)
  {
    return is_reduced(scene.analysis.model) && !looks_over_stroke(scene) ? 40 : 8; // each mode of single slides is followed
  }

  bool changes_mesh(const Scene &scene, const ParameterRange &range)
  {
    // Values inside the range, where a scene is admissible sooner than at its ends.
    const auto at = [&](const double share)
    { return variant(scene, { override_text(range.name, range.from + share * (range.to - range.from)) }); };
    try
    {
      return !share_mesh(at(0.5), at(0.25));
    }
    catch (const InputError &)
    {
      return false;
    }
  }

  CriticalSearch critical_values(const Scene &scene, const ParameterRange &range, const double tolerance, DynamicsMaker &maker,
                                 const std::function<void()> &tried)
  {
    const auto check_at = [&](const double value)
    { return sweep(prepared(variant(scene, { override_text(range.name, value) })), maker).worst(); };
    return search_kinds(range, { tolerance, is_reduced(scene.analysis.model) ? 14u : 5u }, check_at, beam_hints(scene, range),
                        tried);
  }

  bool is_worse(const CheckedSlide &a, const CheckedSlide &b)
  {
    return rank(a.kind) != rank(b.kind) ? rank(a.kind) > rank(b.kind) : a.growth_rate > b.growth_rate;
  }

  CriticalSearch search_kinds(const ParameterRange &range, const SearchEffort &effort,
                              const std::function<CheckedSlide(double)> &check_at, const std::vector<double> &hints,
                              const std::function<void()> &tried)
  {
    Search search{ range, check_at, tried };
    search.try_points(hints);
    search.look_for_islands(effort.island_steps);
    return search.found(effort.tolerance);
  }
} // namespace sprag
