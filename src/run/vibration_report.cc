// SPDX-License-Identifier: GPL-3.0-only
#include "run/vibration_report.h"

#include "base/append.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <map>
#include <sstream>

namespace sprag
{
  namespace
  {
    using ValueOfMode = std::function<double(const Eigenmode &)>;

    void append_numbers(const std::vector<Eigenmode> &modes, Group &group)
    {
      const auto add = [&](const ColumnInfo &info, const ValueOfMode &value)
      { group.datasets.push_back(dataset_of(modes, info, value)); };
      add({ "frequency", "Hz", "Im lambda / 2 pi" }, frequency_of);
      add({ "growth_rate", "1/s", "Re lambda" }, [](const auto &mode) { return mode.mode.eigenvalue.real(); });
      add({ "damping_ratio", "1", "-Re lambda / |lambda|" },
          [](const auto &mode) { return -mode.mode.eigenvalue.real() / std::abs(mode.mode.eigenvalue); });
      add({ "kind", "1", "0 stable, 1 flutter, 2 divergence" },
          [](const auto &mode) { return static_cast<double>(kind_of(mode)); });
      add({ "residual", "1", "backward error of the eigenpair" }, [](const auto &mode) { return mode.mode.residual; });

      if (is_pair(modes))
        add({ "mirroring", "1", "1 where the levers of a pair mirror each other, -1 where both swing the same way" },
            [](const auto &mode) { return mode.mirroring; });

      const auto across = [&](const std::string &name, double Eigenmode::AcrossShares::*share, const std::string &what)
      {
        if (is_solid(modes))
          add({ name, "1", "share of the kinetic energy in " + what }, [share](const auto &mode) { return mode.across.*share; });
      };
      across("plane", &Eigenmode::AcrossShares::plane, "motion as in a plane");
      across("twisting", &Eigenmode::AcrossShares::twisting, "twisting");
      across("sideways", &Eigenmode::AcrossShares::sideways, "motion along the cylinder's axis");

      const auto energy = [&](const std::string &name, double EnergyShares::*share, const std::string &where)
      {
        add({ "energy_" + name, "1", "share of the potential energy " + where },
            [share](const auto &mode) { return mode.energy.*share; });
      };
      energy("rotation", &EnergyShares::rotation, "in the rotational spring");
      energy("bending", &EnergyShares::bending, "in lever and layer");
      energy("support", &EnergyShares::support, "in the support");
      energy("contact", &EnergyShares::contact, "in the contact");

      const auto growth = [&](const std::string &name, double GrowthShares::*share, const std::string &what)
      {
        add({ "growth_by_" + name, "1/s", "part of the growth rate: " + what },
            [share](const auto &mode) { return mode.growth.*share; });
      };
      growth("friction_rotation", &GrowthShares::friction_rotation, "friction that follows displacements, on the hub's rotation");
      growth("friction_bending", &GrowthShares::friction_bending,
             "friction that follows displacements, on the deflection of the lever");
      growth("friction_support", &GrowthShares::friction_support,
             "friction that follows displacements, on the displacement of the support");
      growth("friction_speed", &GrowthShares::friction_speed,
             "friction that follows velocities: mu'(v), and mu times the contact damping's pressure");
      growth("contact_damping", &GrowthShares::contact_damping, "contact damping");
      growth("structure_damping", &GrowthShares::structure_damping, "damping of lever, layer and support");
    }

    void append_shapes(const std::vector<Eigenmode> &modes, const DynamicModel &model, Group &group)
    {
      std::vector<double> xi;
      std::map<std::string, std::vector<double>> values;
      const std::array<std::string, 2> part = { { "real", "imaginary" } };
      for (const auto &mode : modes)
      {
        const auto shape = model.mode_shape(mode);
        xi               = shape.xi;
        for (unsigned int i = 0; i < 2; ++i)
        {
          const auto add = [&](const std::string &name, const std::vector<double> &more)
          { append(values[name + part[i]], more); };
          const auto part_of = [i](const std::complex<double> &value) { return i == 0 ? value.real() : value.imag(); };
          for (std::size_t lever = 0; lever < shape.levers.size(); ++lever)
          {
            const std::string of_lever = lever == 0 ? "_" : "_2_";
            add("along" + of_lever, shape.levers[lever].along[i]);
            add("across" + of_lever, shape.levers[lever].across[i]);
            if (!shape.levers[lever].sideways[i].empty())
              add("sideways" + of_lever, shape.levers[lever].sideways[i]);
            add("rotation" + of_lever, { part_of(shape.levers[lever].rotation) });
          }
          add("support_", { part_of(shape.support) });
        }
      }
      group.datasets.push_back({ { "xi", "mm", "lever coordinate of the shapes' points, from the pivot" }, xi, {} });
      for (const auto &[name, numbers] : values)
      {
        const bool of_points   = name.front() == 'a' || name.rfind("sideways", 0) == 0;
        const std::string unit = name[0] == 'r' ? "rad" : "mm";
        group.datasets.push_back(
            { { name, unit, of_points ? "displacement of the points in lever axes, modes x points" : "in the modes" },
              numbers,
              of_points ? std::vector<std::size_t>{ modes.size(), xi.size() } : std::vector<std::size_t>{} });
      }
    }

    const std::string motions = "mirroring, swinging, either where both tie, mixed where the levers differ";

    /// Which motion of a pair's levers is unstable on one side.
    std::string of_motion(const CriticalValue &critical)
    {
      return critical.worse.motion.empty() ? "" : ", the levers " + critical.worse.motion;
    }

  } // namespace

  double frequency_of(const Eigenmode &mode)
  {
    return mode.mode.eigenvalue.imag() / (2. * M_PI);
  }

  bool grows(const Eigenmode &mode)
  {
    return mode.mode.eigenvalue.real() > smallest_growth * std::abs(mode.mode.eigenvalue);
  }

  SlideKind kind_of(const Eigenmode &mode)
  {
    if (!grows(mode))
      return SlideKind::stable;
    return mode.mode.eigenvalue.imag() > 0. ? SlideKind::flutter : SlideKind::divergence;
  }

  bool is_pair(const std::vector<Eigenmode> &modes)
  {
    return !modes.empty() && !std::isnan(modes.front().mirroring);
  }

  bool is_solid(const std::vector<Eigenmode> &modes)
  {
    return !modes.empty() && !std::isnan(modes.front().across.plane);
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

  Group mode_group(const std::vector<Eigenmode> &modes, const DynamicModel &model)
  {
    Group group{ "modes", {} };
    append_numbers(modes, group);
    if (!modes.empty())
      append_shapes(modes, model, group);
    return group;
  }

  std::vector<UnstableStretch> unstable_stretches(const CriticalSearch &along)
  {
    std::vector<UnstableStretch> result;
    double from      = along.range.from;
    auto kind        = along.first;
    const auto close = [&](const double to)
    {
      if (kind && *kind != SlideKind::stable)
        result.push_back({ from, to, *kind });
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

  std::vector<Entry> sweep_entries(const SweptSlides &swept)
  {
    std::vector<Entry> result = { { "slides_looked_at", static_cast<double>(swept.slides()), "1",
                                    "by the verdict, which is the worst of them; 1: at one x, one way" } };
    for (const auto &[direction, way] :
         { std::pair<Direction, std::string>{ Direction::forward, "forward" }, { Direction::backward, "backward" } })
    {
      double from = std::nan(""), to = std::nan(""), growth = std::nan("");
      bool is_looked_at = false;
      for (const auto &of : swept.ways)
      {
        if (of.direction != direction)
          continue;
        is_looked_at = true;
        growth       = std::fmax(growth, of.along.worst->growth_rate);
        for (const auto &stretch : unstable_stretches(of.along))
        {
          from = std::fmin(from, stretch.from);
          to   = std::fmax(to, stretch.to);
        }
      }
      if (!is_looked_at)
        continue;
      result.push_back({ "largest_growth_rate_" + way, growth, "1/s", "of all slides " + way + " that were looked at" });
      result.push_back(
          { "unstable_" + way + "_from", from, "mm", "least x of a slide " + way + " that is not stable; NaN: none" });
      result.push_back({ "unstable_" + way + "_to", to, "mm", "largest x of such a slide" });
    }
    return result;
  }

  std::vector<Entry> stick_entries(const StickLimits &limits)
  {
    const std::string what = "largest growth rate with the contact's stiffness in stick ";
    return { { "growth_rate_soft_stick", limits.soft, "1/s",
               what + "a tenth of what it is; NaN: the mesh has the layer's shear" },
             { "growth_rate_rigid_stick", limits.rigid, "1/s", what + "without end: friction does not lag" } };
  }

  std::vector<Entry> damping_entries(const DampingRange &range)
  {
    return { { "contact_damping_limit_low", range.low, "1",
               "least Contact/Damping for which the verdict holds; 0: it holds without" },
             { "contact_damping_limit_high", range.high, "1",
               "largest Contact/Damping for which it holds, or the largest that was looked at" },
             { "growth_rate_without_contact_damping", range.growth_rate_at_none, "1/s",
               "of the mode that grows most with Contact/Damping = 0" } };
  }

  std::vector<Entry> slide_entries(const SlideStability &found, const bool is_decided)
  {
    std::vector<Entry> result = { { "verdict", is_decided ? kind_name(found.kind) : "undecided", "",
                                    "stable, flutter (sprag-slip), divergence, jammed, or undecided: it grows by less than the "
                                    "error of that" } };
    if (!found.slide)
      return result;
    const auto &slide = *found.slide;
    append<Entry>(
        result,
        {
            { "growth_rate", found.growth_rate(), "1/s", "largest Re lambda" },
            { "frequency", found.frequency(), "Hz", "of that mode" },
            { "x", slide.drive.x, "mm", "where the slide is held" },
            { "speed", slide.speed, "mm/s", "of the cylinder's surface along the lever" },
            { "mu", slide.mu, "1", "friction coefficient" },
            { "P", slide.forces.P, "N", "normal force" },
            { "Q", slide.forces.Q, "N", "force along x" },
            { "indentation", slide.indentation, "mm", "physical compression of the friction layer, at its largest" },
            { "margin", slide.margin, "1", "to jamming: P without friction over P" },
            { "uniqueness", slide.uniqueness, "1", "determinant of the tangent over that without friction; <= 0: not unique" },
        });
    if (is_pair(found.modes))
      result.push_back({ "motion", found.motion(), "", "of the levers in that mode: " + motions });
    return result;
  }

  std::vector<Entry> role_entries(const std::vector<Role> &roles)
  {
    std::vector<Entry> result;
    for (const auto &role : roles)
    {
      result.push_back({ role.name + "_verdict", kind_name(role.kind), "", role.meaning });
      result.push_back({ role.name + "_growth_rate", role.growth_rate, "1/s", role.meaning });
      result.push_back({ role.name + "_frequency", role.frequency, "Hz", role.meaning });
      if (!role.motion.empty())
        result.push_back({ role.name + "_motion", role.motion, "", "of the levers in the most unstable mode: " + motions });
    }
    return result;
  }

  std::vector<Entry> critical_entries(const std::vector<CriticalSearch> &searches)
  {
    std::vector<Entry> result;
    for (const auto &search : searches)
    {
      const std::string name = "critical_" + identifier_of(search.range.name);
      for (std::size_t i = 0; i < search.changes.size(); ++i)
      {
        const auto &critical = search.changes[i];
        result.push_back({ name + "_" + std::to_string(i + 1), critical.value, "",
                           search.range.name + ": from " + kind_name(critical.below) + " to " + kind_name(critical.above) +
                               of_motion(critical) });
      }
      result.push_back({ name + "_spacing", search.spacing, "",
                         "of the values of " + search.range.name + " tried: narrower islands may be missed" });
      result.push_back({ name + "_values", static_cast<double>(search.range.points + search.more_values), "1",
                         "tried, those between where a growth rate peaks included" });
    }
    return result;
  }
} // namespace sprag
