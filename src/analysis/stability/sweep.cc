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
#include <numeric>
#include <set>

namespace sprag
{
  namespace
  {
    CheckedSlide checked_slide(const SlideStability &found, const DrivePoint &drive)
    {
      CheckedSlide result;
      result.kind        = found.kind;
      result.growth_rate = found.growth_rate();
      result.error       = found.error;
      result.frequency   = found.frequency();
      result.uniqueness  = found.uniqueness();
      result.motion      = found.motion();
      result.drive       = drive;
      for (const auto &mode : found.modes)
        result.growth_rates.push_back(mode.mode.eigenvalue.real());
      if (found.beyond)
      {
        result.beyond_frequency   = mode_frequency(*found.beyond);
        result.beyond_growth_rate = found.beyond->mode.eigenvalue.real();
      }
      if (!found.slide)
        return result;
      result.mu = found.slide->mu;
      result.P  = found.slide->forces.P;
      return result;
    }

    /// Returns the number of x over the stroke: more for levers that check a slide in milliseconds. With little damping friction
    /// couples two vibrations over a twentieth of the stroke alone, which half as many would miss.
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

    /// Returns the values inside one of Stability/Ranges at which slides are checked: with a rigid lever or beam seven, in equal
    /// ratios where both ends are positive, else the middle and, of a range over more than a factor of four, the middle by ratio.
    std::vector<double> values_inside(const Scene &scene, const ParameterRange &range)
    {
      constexpr unsigned int intervals = 8;
      constexpr double wide            = 4.;
      const double low                 = std::min(range.from, range.to);
      const double high                = std::max(range.from, range.to);
      const auto rounded               = [](const double value) { return std::stod(rounded_text(value)); };
      const auto at_share              = [&](const double share)
      { return rounded(low > 0. ? low * std::pow(high / low, share) : low + (high - low) * share); };
      std::vector<double> result;
      if (is_reduced(scene.analysis.model))
        for (unsigned int i = 1; i < intervals; ++i)
          result.push_back(at_share(static_cast<double>(i) / intervals));
      else
      {
        result.push_back(rounded(0.5 * (low + high)));
        if (low > 0. && high > wide * low)
          result.push_back(at_share(0.5));
      }
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

    /// Returns the constants without those of damping, on which no equilibrium of a steady slide depends.
    Constants without_damping(Constants constants)
    {
      const auto damps = [](const std::string &constant)
      {
        const auto has_name = [&](const char *name) { return constant.rfind(std::string(name) + '=', 0) == 0; };
        return has_name("Contact/Damping") || has_name("Support/Damping") || has_name("Lever/Modal damping") ||
               has_name("Lever/Mass damping") || has_name("Lever/Stiffness damping");
      };
      constants.erase(std::remove_if(constants.begin(), constants.end(), damps), constants.end());
      return constants;
    }

    CriticalSearch slides_along(const Scene &scene, DynamicModel &model, const SearchEffort &effort,
                                SharedEquilibria::mapped_type &equilibria)
    {
      const bool over_stroke = looks_over_stroke(scene);
      const auto modes       = checked_modes(scene, true);
      const auto check_at    = [&](const double x)
      {
        DrivePoint drive = held_drive(scene);
        drive.x          = x;
        auto found       = equilibria.find({ drive.x, drive.v });
        if (found == equilibria.end())
          found = equilibria.emplace(std::make_pair(drive.x, drive.v), model.hold(drive, ContactFriction::sliding)).first;
        auto slide = checked_slide(check_slide(model, found->second, modes), drive);
        if (scene.analysis.model == ModelType::finite_element)
          equilibria.clear();                                 // they are large
        if (over_stroke || !is_reduced(scene.analysis.model)) // where single modes would take long to follow
          slide.growth_rates.clear();
        return slide;
      };
      if (over_stroke)
        return search_kinds(stroke_range(scene, points_along(scene)), effort, { check_at });
      const double x = held_drive(scene).x;
      return search_kinds({ "Stability/Position", x, x, 1 }, { 0., 0 }, { check_at });
    }

    /// Returns the scene with a beam in place of a meshed bar, and the contact law of its layer.
    Scene beam_instead(const Scene &scene)
    {
      const auto law = face_law(scene);
      return prepared(variant(scene, { "Analysis/Model=beam", override_text("Contact/Stiffness", law.stiffness),
                                       override_text("Contact/Exponent", law.exponent) }));
    }

    /// Returns the scene's own value within a range, and the middles of the intervals of one kind that, for a beam, are narrower
    /// than the spacing of the range's points.
    std::vector<double> find_hints(const Scene &scene, const ParameterRange &range)
    {
      std::vector<double> hints;
      const auto own = number_alone(scene.parameters->at(range.name));
      if (own && (*own - range.from) * (range.to - *own) > 0.)
        hints.push_back(*own);
      if (!is_meshed(scene.analysis.model) || scene.analysis.dimension == 3 || !scene.mesh.file.empty())
        return hints;
      DynamicsMaker maker;
      const auto check_at = [&](const double value)
      { return sweep(beam_instead(variant(scene, { override_text(range.name, value) })), maker).worst(); };
      ParameterRange finer = range;
      finer.points         = 2 * range.points - 1;
      const auto found     = search_kinds(finer, { 0.01, 4 }, { check_at });
      for (std::size_t i = 1; i < found.changes.size(); ++i)
        if (const double low = found.changes[i - 1].value, high = found.changes[i].value;
            std::abs(high - low) < 2. * found.spacing) // the range has half as many points
          hints.push_back(0.5 * (low + high));
      return hints;
    }

    /// The number of slides grows as the power of three.
    constexpr std::size_t most_shared_ranges = 3;

    /// Returns the largest growth rate at each x of a sweep's ranges, first one direction, then the other: NaN where it jams.
    std::vector<double> growth_along(const SweptSlides &swept)
    {
      std::vector<double> result;
      for (const auto &[direction, constants, along] : swept.sweeps)
        for (unsigned int i = 0; i < along.range.points; ++i)
        {
          const double x   = range_point(along.range, i);
          const auto found = std::find_if(along.growth.begin(), along.growth.end(),
                                          [&](const std::pair<double, double> &tried) { return tried.first == x; });
          result.push_back(found == along.growth.end() ? unknown : found->second);
        }
      return result;
    }

    void add_places(const SweptSlides &swept, const double value, std::vector<PlaceGrowth> &places)
    {
      std::map<std::pair<double, double>, double> largest; // by direction and x
      for (const auto &[direction, constants, along] : swept.sweeps)
        for (const auto &[x, rate] : along.growth)
        {
          double &here = largest.emplace(std::make_pair(direction == Direction::forward ? 1. : -1., x), rate).first->second;
          if (std::isnan(rate) || rate > here)
            here = rate;
        }
      for (const auto &[place, rate] : largest)
        places.push_back({ value, place.second, place.first, rate });
    }

    /// Returns weights of values at 0, 1/2 and 1 for a place between them: of a parabola, or of two straight lines.
    std::array<double, 3> interpolation_weights(const double t, const bool is_parabola)
    {
      if (is_parabola)
        return { { 2. * (t - 0.5) * (t - 1.), 4. * t * (1. - t), 2. * t * (t - 0.5) } };
      return { { std::max(0., 1. - 2. * t), 1. - std::abs(2. * t - 1.), std::max(0., 2. * t - 1.) } };
    }

    /// Returns the value at t, from 0 to 1 in each dimension, by the products of these weights in all dimensions.
    double interpolate(std::vector<double> values, const std::vector<double> &t, const bool is_parabola)
    {
      for (const double at : t)
      {
        const auto weights = interpolation_weights(at, is_parabola);
        for (std::size_t j = 0; j < values.size() / 3; ++j)
          values[j] = weights[0] * values[3 * j] + weights[1] * values[3 * j + 1] + weights[2] * values[3 * j + 2];
        values.resize(values.size() / 3);
      }
      return values.front();
    }

    using NodeGrowth = std::vector<std::vector<double>>; ///< [1/s] of all nodes, at each x first one way, then the other

    /// Returns the growth of slides for constants at the ends and in the middle of Stability/Ranges, which are at most
    /// most_shared_ranges. What stands out between these x counts at all of them. Adds to the number of slides.
    NodeGrowth node_growth(const Scene &scene, DynamicsMaker &maker, const std::optional<Direction> &direction,
                           unsigned int &slides)
    {
      const auto ranges         = constant_ranges(scene);
      const std::size_t n_nodes = std::size_t(std::lround(std::pow(3., ranges.size())));
      SharedEquilibria shared;
      NodeGrowth growth;
      double between = 0.;
      for (std::size_t node = 0; node < n_nodes; ++node)
      {
        SweepPart part{ false, Constants(), direction, &shared };
        for (std::size_t i = 0, place = node; i < ranges.size(); ++i, place /= 3)
          part.constants->push_back(
              override_text(ranges[i].name, ranges[i].from + 0.5 * (place % 3) * (ranges[i].to - ranges[i].from)));
        const auto swept = sweep(scene, maker, part);
        slides += swept.count_slides();
        const auto along = growth_along(swept);
        growth.resize(along.size(), std::vector<double>(n_nodes));
        for (std::size_t i = 0; i < along.size(); ++i)
          growth[i][node] = along[i];
        const auto at_points =
            std::accumulate(along.begin(), along.end(), unknown, [](double a, double b) { return std::fmax(a, b); });
        between = std::fmax(between, swept.worst().growth_rate - at_points);
      }
      double largest = 1.;
      for (const auto &at_x : growth)
        for (const double rate : at_x)
          largest = std::fmax(largest, std::abs(rate));
      for (auto &at_x : growth)
        for (double &rate : at_x)
          rate = std::isnan(rate) ? largest : rate + between;
      return growth;
    }

    /// Returns the share of the constants in n ranges for which all slides are stable. All values of a range are equally likely.
    /// Between its ends and middle growth at each x is the larger of a parabola and of straight lines, as the vibration that
    /// grows most may change between them.
    double stable_share(const NodeGrowth &growth, const std::size_t n)
    {
      constexpr std::array<unsigned int, most_shared_ranges + 1> n_samples = { { 1, 1000, 100, 27 } };
      const unsigned int samples                                           = n_samples[n];
      const std::size_t n_all                                              = std::size_t(std::lround(std::pow(samples, n)));
      std::size_t n_stable                                                 = 0;
      for (std::size_t sample = 0; sample < n_all; ++sample)
      {
        std::vector<double> t;
        for (std::size_t i = 0, place = sample; i < n; ++i, place /= samples)
          t.push_back((place % samples + 0.5) / samples);
        const auto is_stable = [&](const std::vector<double> &at_x)
        { return interpolate(at_x, t, true) <= 0. && interpolate(at_x, t, false) <= 0.; };
        n_stable += std::all_of(growth.begin(), growth.end(), is_stable) ? 1 : 0;
      }
      return static_cast<double>(n_stable) / static_cast<double>(n_all);
    }

    Direction slide_direction(const CheckedSlide &slide)
    {
      return slide.drive.v < 0. ? Direction::backward : Direction::forward;
    }

    /// Returns a slide that is stable where probable_share of the constants in Stability/Ranges are, in the direction in which
    /// fewer of them are. Adds to the number of slides.
    CheckedSlide check_most(const Scene &scene, DynamicsMaker &maker, unsigned int &slides,
                            const std::optional<Direction> &only = {})
    {
      const std::size_t n   = constant_ranges(scene).size();
      const auto directions = only ? std::vector<Direction>{ *only } : held_directions(scene);
      const auto all        = node_growth(scene, maker, only, slides);
      const auto n_rows     = static_cast<std::ptrdiff_t>(all.size() / directions.size());
      std::map<double, Direction> by_share;
      for (std::size_t i = 0; i < directions.size(); ++i)
      {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(i) * n_rows;
        by_share.emplace(stable_share({ first, first + n_rows }, n), directions[i]);
      }
      const double share = stable_share(all, n);
      CheckedSlide result;
      result.kind        = share >= probable_share ? SlideKind::stable : SlideKind::flutter;
      result.growth_rate = probable_share - share;
      result.drive.v     = by_share.begin()->second == Direction::backward ? -1. : 1.;
      return result;
    }

    /// Returns the value to which checks stay stable on the unstable side of a limit of stability, at most up to the next change.
    /// `known`: slides at values of the search, between which no others are tried.
    double stable_limit(const CriticalSearch &search, const CriticalValue &limit, ValueChecks checks,
                        std::map<double, CheckedSlide> known = {})
    {
      constexpr double tolerance = 6e-3; ///< over the range
      const auto &range          = search.range;
      const bool towards_to      = limit.below == SlideKind::stable;
      if (towards_to == (limit.above == SlideKind::stable))
        return unknown;
      const auto is_between = [](const double value, const double begin, const double end)
      { return (value - begin) * (end - value) > 0.; };
      double begin = limit.value, end = towards_to ? range.to : range.from;
      for (const auto &change : search.changes)
        if (is_between(change.value, limit.value, end))
          end = change.value;
      if (begin == end)
        return begin;
      known[begin].kind = SlideKind::stable;
      for (const auto &[value, slide] : known)
        if (slide.kind != SlideKind::stable && is_between(value, begin, end))
          end = value;
      for (const auto &[value, slide] : known)
        if (is_between(value, begin, end))
          begin = value;
      const double distance = std::abs(end - begin);
      const auto points     = 2 + static_cast<unsigned int>(distance / std::max(1.001 * search.spacing, tolerance * distance));
      const auto check_any  = checks.at;
      checks.at             = [&](const double value)
      {
        const auto found = known.find(value);
        return found != known.end() ? found->second : check_any(value);
      };
      const auto found = search_kinds({ range.name, begin, end, points },
                                      { tolerance * std::abs(range.to - range.from) / distance, 0, true }, checks);
      if (!found.changes.empty())
        return found.changes.front().value;
      return found.not_checked.empty() && found.first == SlideKind::stable ? end : begin;
    }
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

  SweptSlides sweep(const Scene &scene, DynamicsMaker &maker, const SweepPart &part)
  {
    constexpr unsigned int island_steps = 4;
    constexpr double tolerance          = 2e-3;
    SweptSlides result;
    SharedEquilibria own;
    auto &equilibria = part.shared != nullptr ? *part.shared : own;
    const auto add   = [&](const Constants &constants, const std::vector<Direction> &directions)
    {
      Scene here          = constants.empty() ? scene : prepared(variant(scene, constants));
      const auto dynamics = maker.make(held_scene(here));
      for (const auto direction : directions)
      {
        here.stability.direction = direction;
        SweptDirection swept{ direction, constants,
                              slides_along(here, dynamics.model(), { part.in_full ? tolerance : 0., island_steps },
                                           equilibria[without_damping(constants)]) };
        if (swept.along.worst)
          swept.along.worst->constants = constants;
        result.sweeps.push_back(std::move(swept));
      }
    };
    const auto directions = part.direction ? std::vector<Direction>{ *part.direction } : held_directions(scene);
    if (part.constants)
    {
      add(*part.constants, directions);
      return result;
    }
    for (const auto &constants : combined_ends(scene))
      add(constants, directions);
    for (const auto &range : constant_ranges(scene))
    {
      std::vector<Direction> stable; // the worst slide may lie inside
      std::set<Constants> lines;     // along which this range is looked at
      for (const auto direction : directions)
      {
        const auto fails = [&](const SweptDirection &swept)
        { return swept.direction == direction && !swept.along.not_checked.empty(); };
        if (std::any_of(result.sweeps.begin(), result.sweeps.end(), fails))
          continue;
        const CheckedSlide worst = result.worst(direction);
        if (!part.in_full && worst.kind != SlideKind::stable)
          continue;
        stable.push_back(direction);
        lines.insert(replaced(worst.constants, range.name, range.from));
      }
      if (stable.empty())
        continue;
      for (const auto &constants : combined_ends(scene))
        if (!constants.empty())
          lines.insert(replaced(constants, range.name, range.from));
      for (const auto &constants : lines)
        for (const double value : values_inside(scene, range))
          add(replaced(constants, range.name, value), stable);
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
    const auto ends = combined_ends(scene).size(); // with the scene's own
    auto sets       = ends;
    for (const auto &range : constant_ranges(scene))
      sets += inside ? ends / 2 * values_inside(scene, range).size() : 0;
    const auto n = static_cast<unsigned int>(sets * held_directions(scene).size());
    return n * (looks_over_stroke(scene) ? points_along(scene) : 1);
  }

  double searched_slides(const Scene &scene)
  {
    return std::sqrt(static_cast<double>(least_slides(scene)) * least_slides(scene, false));
  }

  SearchWork expected_work(const Scene &scene, const ParameterRange &range)
  {
    // Narrowing a change looks at one direction and one set of constants. A limit for the scene's own constants, or for most of
    // those in the ranges, is found by some six values; sets that differ in damping share equilibria.
    constexpr double narrowing = 8., limit_values = 6., shared = 0.7;
    const bool single_slides = is_reduced(scene.analysis.model) && !looks_over_stroke(scene);
    const double near_peaks  = single_slides ? 32. : 2.; // each mode of single slides is followed
    const double along       = looks_over_stroke(scene) ? points_along(scene) : 1.;
    const std::size_t n      = constant_ranges(scene).size();
    const bool has_share     = n > 0 && n <= most_shared_ranges;
    const double limits      = (n > 0 ? 1. : 0.) + (has_share ? shared * std::pow(3., n) : 0.);
    const auto directions    = static_cast<double>(held_directions(scene).size());
    SearchWork work;
    work.values = range.points + near_peaks + narrowing + limit_values * ((n > 0 ? 1. : 0.) + (has_share ? 1. : 0.));
    work.slides = searched_slides(scene) * (range.points + near_peaks + 1.) + narrowing * along +
                  limit_values * limits * directions * along;
    return work;
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
                                 const std::function<void(double)> &tried)
  {
    const auto at = [&](const double value) { return prepared(variant(scene, { override_text(range.name, value) })); };
    std::vector<PlaceGrowth> places;
    std::map<double, CheckedSlide> own;
    unsigned int slides = 0;
    const auto counted  = [&](SweptSlides swept)
    {
      slides += swept.count_slides();
      return swept;
    };
    ValueChecks checks;
    checks.at = [&](const double value)
    {
      const auto swept = counted(sweep(at(value), maker));
      auto worst       = swept.worst();
      own[value] =
          SweptSlides{ filtered(swept.sweeps, [](const SweptDirection &part) { return part.constants.empty(); }) }.worst();
      add_places(swept, value, places);
      return worst;
    };
    checks.alike = [&](const double value, const CheckedSlide &slide)
    {
      SweepPart part;
      part.constants = slide.constants;
      part.direction = slide_direction(slide);
      return counted(sweep(at(value), maker, part)).worst();
    };
    checks.tried = [&] { tried(slides); };
    auto result =
        search_kinds(range, { tolerance, is_reduced(scene.analysis.model) ? 14u : 5u }, checks, find_hints(scene, range));
    result.places        = std::move(places);
    const auto uncertain = constant_ranges(scene);
    const bool is_in_them =
        std::any_of(uncertain.begin(), uncertain.end(), [&](const auto &one) { return one.name == range.name; });
    if (uncertain.empty() || is_in_them)
      return result;
    ValueChecks own_checks, most_checks;
    own_checks.at     = [&](const double value) { return counted(sweep(at(value), maker, { false, Constants() })).worst(); };
    own_checks.alike  = checks.alike;
    own_checks.tried  = checks.tried;
    most_checks.at    = [&](const double value) { return check_most(at(value), maker, slides); };
    most_checks.alike = [&](const double value, const CheckedSlide &slide)
    { return check_most(at(value), maker, slides, slide_direction(slide)); };
    most_checks.tried = checks.tried;
    for (auto &change : result.changes)
    {
      change.own = stable_limit(result, change, own_checks, own);
      if (uncertain.size() <= most_shared_ranges)
        change.likely = stable_limit(result, change, most_checks);
    }
    return result;
  }
} // namespace sprag
