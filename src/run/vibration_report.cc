// SPDX-License-Identifier: GPL-3.0-only
#include "run/vibration_report.h"

#include "base/ranges.h"
#include "base/text.h"
#include "report/summary_lines.h"
#include "results/page_tables.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <ostream>

namespace sprag
{
  namespace
  {
    /// Returns whether they are of a lever in three dimensions.
    bool is_solid(const std::vector<Eigenmode> &modes)
    {
      return !modes.empty() && !std::isnan(modes.front().across.plane);
    }

    /// Returns true if these are the modes of two levers.
    bool is_pair(const std::vector<Eigenmode> &modes)
    {
      return !modes.empty() && !std::isnan(modes.front().symmetry);
    }

    std::string cell(const double value, const int width)
    {
      return ' ' + padded(std::isnan(value) ? "-" : four_digits(std::abs(value) < 1e-6 ? 0. : value), width - 1);
    }

    /// A part of a mode's potential energy.
    struct EnergyPart
    {
      std::string column; ///< printed
      std::string name;   ///< in /modes, behind energy_
      double EnergyShares::*share;
    };

    const std::vector<EnergyPart> energy_parts = { { "spring", "rotation", &EnergyShares::rotation },
                                                   { "lever", "bending", &EnergyShares::bending },
                                                   { "support", "support", &EnergyShares::support },
                                                   { "contact", "contact", &EnergyShares::contact } };

    /// Returns the parts of energy that are 5e-4 or more in one of the modes.
    std::vector<EnergyPart> energy_columns(const std::vector<Eigenmode> &modes)
    {
      auto columns            = energy_parts;
      const auto says_nothing = [&](const EnergyPart &column)
      {
        return std::none_of(modes.begin(), modes.end(),
                            [&](const Eigenmode &mode) { return std::abs(mode.energy.*column.share) >= 5e-4; });
      };
      columns.erase(std::remove_if(columns.begin(), columns.end(), says_nothing), columns.end());
      return columns;
    }

    /// A part of a mode's growth rate [1/s].
    struct GrowthPart
    {
      std::string cause; ///< printed
      int width;         ///< of its printed column
      std::string name;  ///< in /modes, behind growth_by_
      double GrowthShares::*share;
    };

    const std::vector<GrowthPart> growth_parts = {
      { "friction on rotation", 10, "friction_rotation", &GrowthShares::friction_rotation },
      { "friction on bending", 11, "friction_bending", &GrowthShares::friction_bending },
      { "friction on the support", 10, "friction_support", &GrowthShares::friction_support },
      { "friction by velocities", 12, "friction_speed", &GrowthShares::friction_speed },
      { "contact damping", 10, "contact_damping", &GrowthShares::contact_damping },
      { "structural damping", 11, "structure_damping", &GrowthShares::structure_damping }
    };

    /// Names the part that feeds a mode most and the part that damps it most.
    std::array<std::string, 2> extremes(const GrowthShares &growth)
    {
      const auto [least, most] =
          std::minmax_element(growth_parts.begin(), growth_parts.end(),
                              [&](const auto &a, const auto &b) { return growth.*a.share < growth.*b.share; });
      const auto text = [&](const GrowthPart &part) { return part.cause + ' ' + four_digits(growth.*part.share); };
      return { { growth.*most->share > 0. ? text(*most) : "-", growth.*least->share < 0. ? text(*least) : "-" } };
    }

    std::string describe_motion(const Eigenmode::AcrossShares &across)
    {
      if (across.plane > 0.5)
        return "in the plane";
      return across.twisting > across.sideways ? "twisting" : "sideways";
    }

    using ModeValue = std::function<double(const Eigenmode &)>;

    void append_numbers(const std::vector<Eigenmode> &modes, Group &group)
    {
      const auto add = [&](const std::string &name, const ModeValue &value)
      { group.datasets.push_back(make_dataset(modes, page_column("modes", name), value)); };
      add("frequency", mode_frequency);
      add("growth_rate", [](const auto &mode) { return mode.mode.eigenvalue.real(); });
      // A table on a page cannot hold the bars.
      group.datasets.push_back(make_dataset(modes, { "damping_ratio", "1", "-Re lambda / |lambda|" },
                                            [](const auto &mode)
                                            { return -mode.mode.eigenvalue.real() / std::abs(mode.mode.eigenvalue); }));
      add("kind", [](const auto &mode) { return static_cast<double>(classify(mode)); });
      add("residual", [](const auto &mode) { return mode.mode.residual; });
      if (is_pair(modes))
        add("mirroring", [](const auto &mode) { return mode.symmetry; });
      if (is_solid(modes))
      {
        add("plane", [](const auto &mode) { return mode.across.plane; });
        add("twisting", [](const auto &mode) { return mode.across.twisting; });
        add("sideways", [](const auto &mode) { return mode.across.sideways; });
      }
      for (const auto &part : energy_parts)
        add("energy_" + part.name, [&](const auto &mode) { return mode.energy.*part.share; });
      for (const auto &part : growth_parts)
        add("growth_by_" + part.name, [&](const auto &mode) { return mode.growth.*part.share; });
    }

    void append_shapes(const std::vector<Eigenmode> &modes, const Dynamics &dynamics, Group &group)
    {
      std::vector<double> xi;
      std::map<std::string, std::vector<double>> values;
      const std::array<std::string, 2> part = { { "real", "imaginary" } };
      for (const auto &mode : modes)
      {
        const auto shape = dynamics.mode_shape(mode);
        xi               = shape.xi;
        for (unsigned int i = 0; i < 2; ++i)
        {
          const auto add = [&](const std::string &name, const std::vector<double> &more)
          { append(values[name + part[i]], more); };
          const auto complex_part = [i](const std::complex<double> &value) { return i == 0 ? value.real() : value.imag(); };
          for (std::size_t lever = 0; lever < shape.levers.size(); ++lever)
          {
            const std::string lever_suffix = lever == 0 ? "_" : "_2_";
            add("along" + lever_suffix, shape.levers[lever].along[i]);
            add("across" + lever_suffix, shape.levers[lever].across[i]);
            if (!shape.levers[lever].sideways[i].empty())
              add("sideways" + lever_suffix, shape.levers[lever].sideways[i]);
            add("rotation" + lever_suffix, { complex_part(shape.levers[lever].rotation) });
          }
          add("support_", { complex_part(shape.support) });
        }
      }
      group.datasets.push_back({ page_column("modes", "xi"), xi, {} });
      for (const auto &[name, numbers] : values)
      {
        const bool has_points  = name.front() == 'a' || name.rfind("sideways", 0) == 0;
        const std::string unit = name[0] == 'r' ? "rad" : "mm";
        group.datasets.push_back(
            { { name, unit, has_points ? "displacement of the points in lever axes, modes x points" : "in the modes" },
              numbers,
              has_points ? std::vector<std::size_t>{ modes.size(), xi.size() } : std::vector<std::size_t>{} });
      }
    }

    /// A stretch of x whose slides are of one kind, other than stable.
    struct UnstableStretch
    {
      double from, to; ///< [mm]
    };

    std::vector<UnstableStretch> unstable_stretches(const CriticalSearch &along)
    {
      std::vector<UnstableStretch> result;
      double from      = along.range.from;
      auto kind        = along.first;
      const auto close = [&](const double to)
      {
        if (kind && *kind != SlideKind::stable)
          result.push_back({ from, to });
      };
      for (const auto &change : along.changes)
      {
        close(change.value);
        from = change.value;
        kind = change.above;
      }
      close(along.range.to);
      return result;
    }

    /// Joins stretches of several sets of constants that share places, by increasing x.
    std::vector<UnstableStretch> joined(std::vector<UnstableStretch> stretches)
    {
      for (auto &stretch : stretches)
        if (stretch.from > stretch.to)
          std::swap(stretch.from, stretch.to);
      std::sort(stretches.begin(), stretches.end(), [](const auto &a, const auto &b) { return a.from < b.from; });
      std::vector<UnstableStretch> result;
      for (const auto &stretch : stretches)
        if (result.empty() || stretch.from > result.back().to)
          result.push_back(stretch);
        else
          result.back().to = std::max(result.back().to, stretch.to);
      return result;
    }

    /// Returns "14.66 to 18.21 mm, 56.3 to 65 mm", rounded outwards.
    std::string to_text(const std::vector<UnstableStretch> &stretches)
    {
      const auto text = [](const UnstableStretch &stretch)
      { return four_digits(rounded_to(stretch.from, false)) + " to " + with_unit(rounded_to(stretch.to, true), "mm"); };
      return boost::algorithm::join(mapped(stretches, text), ", ");
    }

    /// Returns "stable from 3.94 mm with the scene's constants, stable from 4.1 mm with 95 % of those in the ranges"; empty
    /// without ranges.
    std::string limits_text(const CriticalSearch &search, const CriticalValue &critical, const bool upward)
    {
      const auto &range = search.range;
      const auto text   = [&](const double value, const std::string &constants)
      {
        if (std::isnan(value))
          return std::string();
        const bool everywhere = value == (upward ? std::min(range.from, range.to) : std::max(range.from, range.to));
        const bool up_to_next =
            std::any_of(search.changes.begin(), search.changes.end(),
                        [&](const CriticalValue &other) { return &other != &critical && other.value == value; });
        const std::string limit =
            (upward ? "stable from " : "stable up to ") + with_unit(rounded_to(value, upward), parameter_unit(range.name));
        return (everywhere ? "stable throughout" : up_to_next ? "no limit here" : limit) + " with " + constants;
      };
      const auto own    = text(critical.own, "the scene's constants");
      const auto likely = text(critical.likely, four_digits(100. * probable_share) + " % of those in the ranges");
      return own.empty() ? "" : own + (likely.empty() ? "" : ", " + likely);
    }

    /// Returns "flutter, stable from 4.3 mm (worst forward at x = 40 mm)".
    std::string verdicts_text(const CriticalSearch &search, const bool is_worst)
    {
      const auto &range     = search.range;
      const auto unit       = parameter_unit(range.name);
      const auto &unchecked = search.not_checked;
      std::string text      = range.name + " from " + four_digits(range.from) + " to " + with_unit(range.to, unit) + ": " +
                         (search.first ? kind_name(*search.first) : "cannot be judged");
      for (const auto &critical : search.changes)
      {
        const bool is_friction = range.name == "Friction/Factor" && !std::isnan(critical.mu);
        // The value that is printed must lie on the better side as well.
        const bool upward   = (critical.above < critical.below) == (range.to > range.from);
        const double value  = rounded_to(critical.value, upward);
        const bool is_known = !(critical.error > 0.5 * std::abs(critical.value));
        text += ", " + std::string(is_known ? "" : "undecided, ") + kind_name(critical.above) + " from " +
                (std::isnan(critical.error) || !is_known
                     ? with_unit(value, unit)
                     : four_digits(value) + " +- " + formatted("%.2g", critical.error) + (unit == "1" ? "" : ' ' + unit)) +
                (is_friction ? " (mu = " + four_digits(rounded_to(critical.mu, upward)) + ")" : "") +
                (critical.worse.motion.empty() ? "" : " (" + critical.worse.motion + ")");
        std::vector<std::string> more;
        if (is_worst && range.name != "Stability/Position")
          more.push_back(std::string("worst ") + (critical.worse.drive.v < 0. ? "backward" : "forward") +
                         " at x = " + with_unit(critical.worse.drive.x, "mm"));
        if (const auto limits = limits_text(search, critical, upward); !limits.empty())
          more.push_back(limits);
        if (!more.empty())
          text += " (" + boost::algorithm::join(more, "; ") + ")";
      }
      text += std::string(search.first && search.changes.empty() ? " throughout" : "") +
              (search.has_effect ? "" : ", without effect");
      if (search.first && !unchecked.empty())
      {
        const auto [least, most] = std::minmax_element(unchecked.begin(), unchecked.end());
        text += "; cannot be judged at " + (*least < *most ? four_digits(*least) + " to " : "") + with_unit(*most, unit) +
                (*least < *most ? " (" + std::to_string(unchecked.size()) + " values)" : "") + ", as " +
                search.reason.substr(0, search.reason.find('\n'));
      }
      return text;
    }
  } // namespace

  void print_modes(std::ostream &stream, const std::vector<Eigenmode> &modes)
  {
    if (modes.empty())
      return;
    const auto columns = energy_columns(modes);
    stream << "  frequency [Hz]";
    for (const auto &column : columns)
      stream << padded(column.column + " [%]", 13);
    stream << (is_pair(modes) ? "    mirroring [1]" : "") << (is_solid(modes) ? "  motion" : "") << "\n";
    for (const auto &mode : modes)
    {
      stream << cell(mode_frequency(mode), 16);
      for (const auto &column : columns)
        stream << cell(std::round(1000. * mode.energy.*column.share) / 10., 13);
      stream << (is_pair(modes) ? cell(mode.symmetry, 17) : "") << (is_solid(modes) ? "  " + describe_motion(mode.across) : "")
             << '\n';
    }
  }

  void print_growth(std::ostream &stream, const std::vector<Eigenmode> &modes)
  {
    if (modes.empty())
      return;
    stream << "\n  frequency    growth  kind        growth [1/s] by friction on               friction's   damping of\n"
           << "       [Hz]     [1/s]               rotation    bending   support  velocities   contact  structure\n";
    for (const auto &mode : modes)
    {
      std::string kind = "  " + kind_name(classify(mode));
      kind.resize(13, ' ');
      stream << cell(mode_frequency(mode), 11) << cell(mode.mode.eigenvalue.real(), 10) << kind;
      for (const auto &part : growth_parts)
        stream << cell(mode.growth.*part.share, part.width);
      stream << '\n';
    }
  }

  void print_growing(std::ostream &stream, std::vector<Eigenmode> modes)
  {
    constexpr std::size_t most_modes = 3;
    const auto more = [](const Eigenmode &a, const Eigenmode &b) { return a.mode.eigenvalue.real() > b.mode.eigenvalue.real(); };
    std::stable_sort(modes.begin(), modes.end(), more);
    modes.resize(std::min(modes.size(), most_modes));
    stream << "  growth [1/s]  frequency [Hz]  fed most by [1/s]               damped most by [1/s]\n";
    for (const auto &mode : modes)
    {
      const auto [fed, damped] = extremes(mode.growth);
      stream << cell(mode.mode.eigenvalue.real(), 14) << cell(mode_frequency(mode), 16) << "  " << padded(fed, -32) << damped
             << '\n';
    }
  }

  bool grows(const Eigenmode &mode)
  {
    return mode.mode.eigenvalue.real() > smallest_growth * std::abs(mode.mode.eigenvalue);
  }

  SlideKind classify(const Eigenmode &mode)
  {
    if (!grows(mode))
      return SlideKind::stable;
    return mode.mode.eigenvalue.imag() > 0. ? SlideKind::flutter : SlideKind::divergence;
  }

  std::vector<Eigenmode> reported(const std::vector<Eigenmode> &modes, const unsigned int number)
  {
    std::vector<Eigenmode> result;
    unsigned int oscillating = 0;
    for (const auto &mode : modes)
    {
      const bool oscillates = mode.mode.eigenvalue.imag() > 0.;
      if (grows(mode) || (oscillates && oscillating < number))
        result.push_back(mode);
      oscillating += oscillates ? 1 : 0;
    }
    return result;
  }

  Group mode_group(const std::vector<Eigenmode> &modes, const Dynamics &dynamics)
  {
    Group group{ "modes", {} };
    append_numbers(modes, group);
    if (!modes.empty())
      append_shapes(modes, dynamics, group);
    return group;
  }

  std::vector<Entry> sweep_entries(const SweptSlides &swept)
  {
    const auto &x             = swept.sweeps.front().along.range;
    std::vector<Entry> result = { { "looked_from", std::min(x.from, x.to) },
                                  { "looked_to", std::max(x.from, x.to) },
                                  { "slides_looked_at", static_cast<double>(swept.count_slides()) } };
    if (const auto &constants = swept.worst().constants; !constants.empty())
      result.push_back({ "worst_constants", boost::algorithm::join(constants, ", ") });
    for (const auto &[direction, way] :
         { std::pair<Direction, std::string>{ Direction::forward, "forward" }, { Direction::backward, "backward" } })
    {
      double growth     = std::nan("");
      bool is_looked_at = false;
      std::vector<UnstableStretch> unstable;
      for (const auto &swept_direction : swept.sweeps)
      {
        if (swept_direction.direction != direction)
          continue;
        is_looked_at = true;
        growth       = std::fmax(growth, swept_direction.along.worst->growth_rate);
        append(unstable, unstable_stretches(swept_direction.along));
      }
      unstable = joined(std::move(unstable));
      if (is_looked_at)
        result.push_back({ "largest_growth_rate_" + way, growth });
      if (is_looked_at && x.points > 1)
        append<Entry>(result, { { "unstable_" + way + "_from", unstable.empty() ? std::nan("") : unstable.front().from },
                                { "unstable_" + way + "_to", unstable.empty() ? std::nan("") : unstable.back().to } });
      if (!unstable.empty() && x.points > 1)
        result.push_back({ "unstable_" + way, to_text(unstable) });
    }
    return result;
  }

  std::vector<Entry> slide_entries(const SlideStability &found, const bool is_decided)
  {
    std::vector<Entry> result = { { "verdict", is_decided ? kind_name(found.kind) : "undecided" } };
    if (const auto &slide = found.slide)
      append<Entry>(result, { { "growth_rate", found.growth_rate() },
                              { "frequency", found.frequency() },
                              { "x", slide->drive.x },
                              { "speed", slide->speed },
                              { "mu", slide->mu },
                              { "P", slide->forces.P },
                              { "Q", slide->forces.Q },
                              { "indentation", slide->indentation },
                              { "margin", slide->margin },
                              { "uniqueness", slide->uniqueness },
                              { "looked_up_to", found.highest_frequency() } });
    if (found.slide && is_pair(found.modes))
      result.push_back({ "motion", found.motion() });
    return result;
  }

  std::vector<Entry> role_entries(const std::vector<Role> &roles)
  {
    std::vector<Entry> result;
    for (const auto &role : roles)
    {
      const auto slide          = role.found.value_or(SlideStability());
      const std::string verdict = !role.found ? "not found" : slide.is_decided() ? kind_name(slide.kind) : "undecided";
      append<Entry>(result, { { role.name + "_verdict", verdict, "", role.meaning },
                              { role.name + "_growth_rate", slide.growth_rate() },
                              { role.name + "_frequency", slide.frequency() } });
      if (const auto motion = slide.motion(); !motion.empty())
        result.push_back({ role.name + "_motion", motion });
    }
    return result;
  }

  std::vector<Group> critical_groups(const std::vector<CriticalSearch> &searches)
  {
    std::vector<Group> result;
    for (const auto &search : searches)
    {
      const auto &name  = search.range.name;
      const auto unit   = parameter_unit(name);
      const auto number = [&](const ColumnInfo &info, double PlaceGrowth::*member)
      { return make_dataset(search.places, info, [member](const auto &place) { return place.*member; }); };
      result.push_back(
          { "critical_" + to_identifier(name),
            { make_dataset(search.growth, { "value", unit, name + " as tried" }, [](const auto &tried) { return tried.first; }),
              make_dataset(search.growth, { "growth_rate", "1/s", "largest of the slides there" },
                           [](const auto &tried) { return tried.second; }),
              number({ "place_value", unit, name + " at a place" }, &PlaceGrowth::value),
              number({ "place_x", "mm", "position of the slides" }, &PlaceGrowth::x),
              number({ "place_direction", "1", "1 forward, -1 backward" }, &PlaceGrowth::direction),
              number({ "place_growth_rate", "1/s", "largest of the slides there; NaN where one jams" },
                     &PlaceGrowth::growth_rate) } });
    }
    return result;
  }

  std::vector<Entry> critical_entries(const Scene &scene, const std::vector<CriticalSearch> &searches)
  {
    std::vector<Entry> result;
    for (const auto &search : searches)
    {
      const std::string name = "critical_" + to_identifier(search.range.name);
      const auto unit        = parameter_unit(search.range.name);
      for (std::size_t i = 0; i < search.changes.size(); ++i)
      {
        const auto &critical = search.changes[i];
        result.push_back({ name + "_" + std::to_string(i + 1), critical.value, unit,
                           search.range.name + ": from " + kind_name(critical.below) + " to " + kind_name(critical.above) +
                               (critical.worse.motion.empty() ? "" : ", the levers " + critical.worse.motion) });
        if (!std::isnan(critical.error))
          result.push_back({ name + "_" + std::to_string(i + 1) + "_error", critical.error, unit,
                             "by which the error of the growth rate moves it" });
        if (std::isnan(critical.own))
          continue;
        result.push_back({ name + "_" + std::to_string(i + 1) + "_own", critical.own, unit, "with the scene's own constants" });
        if (!std::isnan(critical.likely))
          result.push_back({ name + "_" + std::to_string(i + 1) + "_likely", critical.likely, unit,
                             "with 95 % of the constants in the ranges" });
      }
      append<Entry>(result, { { name + "_verdicts", verdicts_text(search, looks_over_stroke(scene)) },
                              { name + "_spacing", search.spacing, unit },
                              { name + "_values", static_cast<double>(search.range.points + search.more_values) } });
    }
    return result;
  }
} // namespace sprag
