// SPDX-License-Identifier: GPL-3.0-only
#include "run/vibration_print.h"

#include "base/text.h"
#include "report/brief_lines.h"
#include "run/vibration_report.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace sprag
{
  namespace
  {
    std::string cell(const double value, const int width)
    {
      std::ostringstream number;
      number << std::setprecision(4) << (std::abs(value) < 1e-6 ? 0. : value);
      const std::string text = std::isnan(value) ? "-" : number.str();
      return std::string(static_cast<std::size_t>(std::max(1, width - static_cast<int>(text.size()))), ' ') + text;
    }

    struct EnergyColumn
    {
      std::string name;
      double EnergyShares::*share;
    };

    /// Those that say anything of one of the modes.
    std::vector<EnergyColumn> energy_columns(const std::vector<Eigenmode> &modes)
    {
      std::vector<EnergyColumn> columns = { { "spring", &EnergyShares::rotation },
                                            { "lever", &EnergyShares::bending },
                                            { "support", &EnergyShares::support },
                                            { "contact", &EnergyShares::contact } };
      const auto says_nothing           = [&](const EnergyColumn &column)
      {
        return std::none_of(modes.begin(), modes.end(),
                            [&](const Eigenmode &mode) { return std::abs(mode.energy.*column.share) >= 5e-4; });
      };
      columns.erase(std::remove_if(columns.begin(), columns.end(), says_nothing), columns.end());
      return columns;
    }

    struct GrowthPart
    {
      std::string name;
      double value; ///< [1/s]
    };

    std::string text_of(const GrowthPart &part)
    {
      return part.name + ' ' + four_digits(part.value);
    }

    /// What feeds a mode most and what damps it most.
    std::array<std::string, 2> extremes(const GrowthShares &growth)
    {
      const std::vector<GrowthPart> parts = {
        { "friction on rotation", growth.friction_rotation },   { "friction on bending", growth.friction_bending },
        { "friction on the support", growth.friction_support }, { "friction by velocities", growth.friction_speed },
        { "contact damping", growth.contact_damping },          { "structural damping", growth.structure_damping }
      };
      const auto [least, most] =
          std::minmax_element(parts.begin(), parts.end(), [](const auto &a, const auto &b) { return a.value < b.value; });
      return { { most->value > 0. ? text_of(*most) : "-", least->value < 0. ? text_of(*least) : "-" } };
    }

    constexpr std::size_t most_modes = 3; ///< of those that grow most

    void print_growing(std::ostream &stream, std::vector<Eigenmode> modes)
    {
      const auto more = [](const Eigenmode &a, const Eigenmode &b)
      { return a.mode.eigenvalue.real() > b.mode.eigenvalue.real(); };
      std::stable_sort(modes.begin(), modes.end(), more);
      modes.resize(std::min(modes.size(), most_modes));
      stream << "  growth [1/s]  frequency [Hz]  fed most by [1/s]               damped most by [1/s]\n";
      for (const auto &mode : modes)
      {
        const auto [fed, damped] = extremes(mode.growth);
        stream << cell(mode.mode.eigenvalue.real(), 14) << cell(frequency_of(mode), 16) << "  " << padded(fed, -32) << damped
               << '\n';
      }
    }

    std::string verdict_text(const SlideStability &found)
    {
      const auto growth = [&] { return with_unit(std::abs(found.growth_rate()), "1/s"); };
      const auto at     = [&] { return found.frequency() > 0. ? " at " + with_unit(found.frequency(), "Hz") : ""; };
      if (found.modes.empty() || found.kind == SlideKind::jammed)
        return kind_name(found.kind);
      return kind_name(found.kind) + (found.growth_rate() > 0. ? ", grows by " : ", dies out by at least ") + growth() + at() +
             (found.motion().empty() ? "" : ", the levers " + found.motion());
    }

    std::string motion_of(const Eigenmode::AcrossShares &across)
    {
      if (across.plane > 0.5)
        return "in the plane";
      return across.twisting > across.sideways ? "twisting" : "sideways";
    }
  } // namespace

  void print_modes(std::ostream &stream, const std::vector<Eigenmode> &modes)
  {
    if (modes.empty())
      return;
    const auto columns = energy_columns(modes);
    stream << "  frequency [Hz]";
    for (const auto &column : columns)
      stream << padded(column.name + " [%]", 13);
    stream << (is_pair(modes) ? "    mirroring [1]" : "") << (is_solid(modes) ? "  motion" : "") << "\n";
    for (const auto &mode : modes)
    {
      stream << cell(frequency_of(mode), 16);
      for (const auto &column : columns)
        stream << cell(std::round(1000. * mode.energy.*column.share) / 10., 13);
      stream << (is_pair(modes) ? cell(mode.mirroring, 17) : "") << (is_solid(modes) ? "  " + motion_of(mode.across) : "")
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
      const auto &g    = mode.growth;
      std::string kind = "  " + kind_name(kind_of(mode));
      kind.resize(13, ' ');
      stream << cell(frequency_of(mode), 11) << cell(mode.mode.eigenvalue.real(), 10) << kind << cell(g.friction_rotation, 10)
             << cell(g.friction_bending, 11) << cell(g.friction_support, 10) << cell(g.friction_speed, 12)
             << cell(g.contact_damping, 10) << cell(g.structure_damping, 11) << '\n';
    }
  }

  void print_slide(std::ostream &stream, const SlideStability &found, const bool is_decided)
  {
    brief_line(stream, "verdict",
               is_decided ? verdict_text(found) : "undecided, growth is less than its error: " + verdict_text(found));
    if (!found.slide)
      return;
    const auto &slide = *found.slide;
    brief_line(stream, "slide",
               "at x = " + with_unit(slide.drive.x, "mm") + ", " + with_unit(std::abs(slide.speed), "mm/s") + ' ' +
                   (slide.speed < 0. ? "backward" : "forward") + " along the lever, mu = " + four_digits(slide.mu));
    brief_line(stream, "forces",
               "P = " + with_unit(slide.forces.P, "N") + ", Q = " + with_unit(slide.forces.Q, "N") + ", indentation " +
                   with_unit(slide.indentation, "mm"));
    if (std::isfinite(slide.margin))
      brief_line(stream, "margin to jamming", four_digits(100. * slide.margin) + " % (P without friction over P)");
    print_growing(stream, found.modes);
  }

  void print_sweep(std::ostream &stream, const Scene &scene, const SweptSlides &swept)
  {
    const auto &first        = swept.ways.front().along;
    const bool over_stroke   = first.range.points > 1;
    const auto directions    = held_directions(scene);
    const std::string ways   = directions.size() > 1                      ? "both ways"
                               : directions.front() == Direction::forward ? "forward alone"
                                                                          : "backward alone";
    const std::string places = over_stroke ? "x = " + four_digits(first.range.from) + " to " + with_unit(first.range.to, "mm")
                                           : "x = " + with_unit(first.range.from, "mm") + " alone";
    brief_line(stream, "looked at",
               places + ", " + ways + (scene.stability.ranges == "none" ? "" : ", with ends of " + scene.stability.ranges) +
                   ": " + std::to_string(swept.slides()) + (swept.slides() == 1 ? " slide" : " slides"));
    if (!over_stroke)
      return;
    bool is_stable = true;
    for (const auto &way : swept.ways)
      for (const auto &stretch : unstable_stretches(way.along))
      {
        is_stable                  = false;
        const std::string constant = boost::algorithm::join(way.constants, ", ");
        brief_line(stream, kind_name(stretch.kind),
                   std::string(way.direction == Direction::forward ? "forward" : "backward") +
                       " from x = " + four_digits(stretch.from) + " to " + with_unit(stretch.to, "mm") +
                       (constant.empty() ? "" : ", " + constant));
      }
    if (is_stable)
      brief_line(stream, "stable", "everywhere that was looked at");
  }

  void print_constants(std::ostream &stream, const DampingRange &damping, const StickLimits &stick)
  {
    brief_line(stream, "verdict holds",
               "for Contact/Damping " + four_digits(damping.low) + " to " + four_digits(damping.high) + " of 0 to " +
                   four_digits(damping.looked_up_to) + "; without, growth " + with_unit(damping.growth_rate_at_none, "1/s"));
    brief_line(stream, "stiffness in stick",
               (std::isnan(stick.soft) ? "" : "a tenth of it: growth " + with_unit(stick.soft, "1/s") + ", ") + "rigid: growth " +
                   with_unit(stick.rigid, "1/s"));
  }

  void print_roles(std::ostream &stream, const SlideStability &present, const std::vector<Role> &roles)
  {
    const bool pair = is_pair(present.modes);
    stream << "                               verdict     growth [1/s]  frequency [Hz]" << (pair ? "  motion" : "") << '\n';
    const auto line = [&](std::string name, std::string kind, const double growth, const double hertz, const std::string &motion)
    {
      std::replace(name.begin(), name.end(), '_', ' ');
      name.resize(29, ' ');
      kind.resize(10, ' ');
      stream << "  " << name << kind << cell(growth, 14) << cell(hertz, 16) << (motion.empty() ? "" : "  " + motion) << '\n';
    };
    line("as it is", kind_name(present.kind), present.growth_rate(), present.frequency(), present.motion());
    for (const auto &role : roles)
      line(role.name, kind_name(role.kind), role.growth_rate, role.frequency, role.motion);
  }

  void print_critical(std::ostream &stream, const Scene &scene, const std::vector<CriticalSearch> &searches,
                      const bool with_spacing)
  {
    stream << "  Critical values of " << (looks_over_stroke(scene) ? "the worst slide" : "this slide")
           << ", all else as it is; narrow islands between the values tried may be missed:\n";
    for (const auto &[range, first, changes, worst, not_judged, reason, spacing, more_values] : searches)
    {
      const auto unit = unit_of_parameter(range.name);
      stream << "    " << range.name << " from " << four_digits(range.from) << " to " << with_unit(range.to, unit) << ": "
             << (first ? kind_name(*first) : "cannot be judged");
      for (const auto &critical : changes)
      {
        const bool of_friction = range.name == "Friction/Factor" && !std::isnan(critical.mu);
        stream << ", " << kind_name(critical.above) << " from " << with_unit(critical.value, unit)
               << (of_friction ? " (mu = " + four_digits(critical.mu) + ")" : "")
               << (critical.worse.motion.empty() ? "" : " (" + critical.worse.motion + ")");
        if (looks_over_stroke(scene) && range.name != "Stability/Position")
          stream << " (worst " << (critical.worse.drive.v < 0. ? "backward" : "forward")
                 << " at x = " << with_unit(critical.worse.drive.x, "mm") << ")";
      }
      stream << (first && changes.empty() ? " throughout" : "");
      if (first && !not_judged.empty())
      {
        const auto [least, most] = std::minmax_element(not_judged.begin(), not_judged.end());
        stream << "; cannot be judged at " << (*least < *most ? four_digits(*least) + " to " : "") << with_unit(*most, unit)
               << (*least < *most ? " (" + std::to_string(not_judged.size()) + " values)" : "");
      }
      if (with_spacing)
        stream << "; tried every " << with_unit(spacing, unit);
      if (with_spacing && more_values > 0)
        stream << " and " << more_values << " times between, where growth peaks";
      stream << '\n';
    }
  }
} // namespace sprag
