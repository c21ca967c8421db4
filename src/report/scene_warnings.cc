// SPDX-License-Identifier: GPL-3.0-only
#include "report/warnings.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"
#include "base/units.h"
#include "input/sections.h"
#include "laws/friction_law.h"
#include "report/peak_report.h"
#include "results/columns.h"
#include "scene/base_motion.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <variant>

namespace sprag
{
  namespace
  {
    // An error of 1 % in mu, which no measurement of it undercuts, is one of 10 % in P.
    constexpr double largest_amplification = 10.;

    // A device that differs from model A in one quantity may be a variation of it; from two on it is taken for another.
    constexpr unsigned int other_device_differences = 2;

    // Poisson's ratio from which a wide layer between bonded faces is twice as stiff in plane strain, (1-nu)/((1+nu)(1-2nu)) E,
    // as in plane stress, E/(1-nu^2): nu^2 + 2 nu - 1 = 0.
    const double largest_plane_stress_ratio = std::sqrt(2.) - 1.;

    // Hardened spring steels have a proof stress of 1000 to 1600 MPa, less what many cycles cost: 0.4 % strain is 824 MPa.
    constexpr double largest_leaf_strain = 4e-3;

    // With that many times the cylinder's sagitta between two points of the face P is 1 % off, with a tenth of that 10 %.
    constexpr double least_opening  = 20.;
    constexpr double element_points = 10.;

    // Changes of speed, over the largest speed and over the range of x, and how many must turn, in number and of all such
    // changes. White noise turns 73 % of them, steps of a resolution half or more, ten rows a period of a real vibration a fifth.
    constexpr double least_shaking      = 0.005;
    constexpr double range_limit        = 0.05;
    constexpr unsigned int fewest_turns = 20;
    constexpr double least_turn_share   = 0.3;
    constexpr unsigned int n_looks      = 2000;

    // A base that starts at once and keeps its speed has 6.5.
    constexpr double largest_drift_ratio = 10.;

    bool follows_drive(const Scene &scene)
    {
      return scene.analysis.type == AnalysisType::quasi_static || scene.analysis.type == AnalysisType::transient;
    }

    bool has_mesh(const Scene &scene)
    {
      return is_meshed(scene.analysis.model) || scene.analysis.type == AnalysisType::contact_law ||
             scene.analysis.type == AnalysisType::calibration;
    }

    /// P over P at small mu' changes by this times the relative change of mu: mu e / (s - mu e), greatest moving back where s is
    /// least.
    struct Amplification
    {
      double x, s, mu, value;
    };

    Amplification drive_amplification(const Scene &scene)
    {
      constexpr unsigned int samples = 64;
      const double from = scene.drive.minimum(), to = scene.drive.maximum();
      Amplification largest{};
      for (unsigned int i = 0; i <= samples; ++i)
      {
        const double x    = from + (to - from) * i / samples;
        const auto state  = closed_form(scene, x, -scene.drive.peak_speed());
        const double s    = state.contact.s;
        const double mu_e = state.mu * scene.geometry.interface_offset;
        if (s > mu_e && mu_e / (s - mu_e) > largest.value)
          largest = { x, s, state.mu, mu_e / (s - mu_e) };
      }
      return largest;
    }

    void add_sensitivity(const Scene &scene, Warnings &warnings)
    {
      if (!follows_drive(scene))
        return;
      const auto found = drive_amplification(scene);
      if (found.value <= largest_amplification)
        return;
      warnings.push_back(make_warning(
          "near_locking", { mm(found.x), rounded_text(found.mu), rounded_text(found.s / scene.geometry.interface_offset),
                            rounded_text(found.value), rounded_text(largest_amplification), rounded_text(found.value) }));
    }

    /// Returns the strain at the surface in the clamp of a beam: M = a EI/L (1 + b c/L) turn with the clamp c behind the pivot.
    double leaf_strain(const LeafSpring &leaf, const double turn)
    {
      const double ratio  = leaf.clamp_distance / leaf.length;
      const double moment = leaf.end == LeafEnd::clamped ? 4. + 6. * ratio : leaf.end == LeafEnd::pinned ? 3. + 3. * ratio : 1.;
      return 0.5 * leaf.thickness / leaf.length * moment * turn;
    }

    void add_leaf(const Scene &scene, Warnings &warnings)
    {
      const auto type = scene.analysis.type;
      if (scene.spring.type != SpringType::leaf || type == AnalysisType::slope || type == AnalysisType::calibration)
        return;
      const double x   = scene.drive.maximum();
      const auto &leaf = scene.spring.leaf;
      const double turn =
          std::abs(kinematics(scene.geometry, x).theta - kinematics(scene.geometry, 0.).theta - scene.spring.rest_angle);
      const double strain = leaf_strain(leaf, turn);
      if (strain <= largest_leaf_strain)
        return;
      warnings.push_back(make_warning(
          "leaf_beyond_yield", { rounded_text(turn), mm(x), mm(leaf.thickness), mm(leaf.length), rounded_text(100. * strain),
                                 rounded_text(strain * leaf.young_modulus), rounded_text(100. * largest_leaf_strain) }));
    }

    void add_plane_stress(const Scene &scene, Warnings &warnings)
    {
      const auto &layer = scene.layer;
      const double nu   = layer.poisson_ratio;
      if (!has_mesh(scene) || layer.thickness == 0. || layer.plane != PlaneState::stress || scene.analysis.dimension == 3 ||
          nu <= largest_plane_stress_ratio)
        return;
      const double ratio = (1. - nu) * (1. - nu) / (1. - 2. * nu);
      warnings.push_back(
          make_warning("plane_stress_of_layer", { rounded_text(nu), rounded_text(largest_plane_stress_ratio), mm(layer.thickness),
                                                  mm(scene.lever.width), rounded_text(ratio) }));
    }

    /// Points that lie beside the cylinder do not feel it.
    void add_opening(const Scene &scene, Warnings &warnings)
    {
      if (!follows_drive(scene) || !is_meshed(scene.analysis.model) || scene.pair.cylinder_offset != 0.)
        return;
      const double x       = scene.drive.maximum();
      const auto contact   = kinematics(scene.geometry, x);
      const double opening = contact.s * std::abs(contact.theta - kinematics(scene.geometry, 0.).theta);
      const double spacing = scene.mesh.face_size / element_points;
      const double sagitta = spacing * spacing / (8. * scene.geometry.cylinder_radius);
      if (opening >= least_opening * sagitta)
        return;
      warnings.push_back(
          make_warning("contact_between_points", { mm(opening), mm(x), mm(spacing), mm(sagitta), rounded_text(least_opening) }));
    }

    bool is_static(const Scene &scene)
    {
      return scene.analysis.type == AnalysisType::quasi_static || scene.analysis.type == AnalysisType::slope;
    }

    /// Returns whether the contact has the stiffness of a law in place of that of layer and mesh.
    bool has_contact_law(const Scene &scene)
    {
      return !is_static(scene) && is_reduced(scene.analysis.model) && scene.contact.type == ContactType::compliant &&
             !has_mesh(scene);
    }

    bool is_varied(const Scene &scene, const std::string &parameter)
    {
      return scene.analysis.type == AnalysisType::map &&
             (scene.map.first.name == parameter || scene.map.second.name == parameter);
    }

    /// Returns whether the contact stiffness was given for this layer: as late as the layer's constants, or beside model A's.
    bool has_own_contact_law(const Scene &scene)
    {
      const FrictionLayer a;
      const auto &own     = scene.layer;
      const auto is_later = [&](const std::string &name) { return scene.by_option.count("Friction layer/" + name) > 0; };
      const bool is_changed =
          is_later("Made of") || is_later("Young's modulus") || is_later("Poisson's ratio") || is_later("Thickness");
      const auto &source = is_changed ? scene.by_option : scene.specified;
      return source.count("Contact/Stiffness") > 0 || is_varied(scene, "Contact/Stiffness") ||
             (own.young_modulus == a.young_modulus && own.poisson_ratio == a.poisson_ratio && own.thickness == a.thickness);
    }

    void add_foreign_contact_law(const Scene &scene, Warnings &warnings)
    {
      constexpr double largest_ratio = 0.4; // of Poisson, up to which the formula serves
      if (!has_contact_law(scene) || has_own_contact_law(scene))
        return;
      const auto &layer     = scene.layer;
      Device meshed         = scene;
      meshed.analysis.model = ModelType::condensed;
      const auto estimate   = face_law(meshed);
      const auto text       = [](const double stiffness, const double exponent)
      { return rounded_text(stiffness) + " N/mm^n with n = " + rounded_text(exponent); };
      const bool is_estimated = layer.poisson_ratio <= largest_ratio && estimate.stiffness > 0.;
      warnings.push_back(make_warning(
          "foreign_contact_law",
          { rounded_text(layer.young_modulus), rounded_text(layer.poisson_ratio), mm(layer.thickness),
            text(scene.contact.stiffness, scene.contact.exponent),
            is_estimated ? ": such a layer has about " + text(estimate.stiffness, estimate.exponent) : std::string() }));
    }

    /// Parameters by their full names, and whether the scene uses each.
    std::vector<std::pair<std::string, bool>> dependents(const Scene &scene)
    {
      const auto &analysis   = scene.analysis;
      const bool deformable  = analysis.type != AnalysisType::slope && (has_mesh(scene) || analysis.model == ModelType::beam);
      const bool has_inertia = !is_static(scene) && analysis.type != AnalysisType::contact_law &&
                               analysis.type != AnalysisType::calibration && analysis.model != ModelType::closed_form &&
                               scene.lever.inertia == InertiaSource::scaled;
      return { { "Geometry/Cylinder radius", true },
               { "Geometry/Interface offset", true },
               { "Geometry/Pivot distance", true },
               { "Rotational spring/Stiffness", scene.spring.type == SpringType::torsional },
               { "Lever/Length", deformable },
               { "Lever/Depth", deformable },
               { "Lever/Width", deformable },
               { "Lever/Moment of inertia", has_inertia },
               { "Contact/Stiffness", has_contact_law(scene) } };
    }

    /// Returns true if the body whose mass follows from densities is not model A's.
    bool has_other_lever(const Scene &scene)
    {
      const Lever a;
      const auto &own = scene.lever;
      return !scene.mesh.file.empty() || own.outline != a.outline || own.length != a.length || own.depth != a.depth ||
             own.width != a.width || own.density != a.density;
    }

    void add_defaults(const Scene &scene, Warnings &warnings)
    {
      const Geometry a;
      const auto &own = scene.geometry;
      const bool own_spring =
          scene.spring.type == SpringType::torsional && scene.spring.stiffness != RotationalSpring().stiffness;
      const unsigned int differs = (own.cylinder_radius != a.cylinder_radius) + (own.interface_offset != a.interface_offset) +
                                   (own.pivot_distance != a.pivot_distance) + own_spring;
      const bool is_other_device = differs >= other_device_differences;
      const auto is_doubtful     = [&](const std::string &name)
      { return is_other_device || (name == "Lever/Moment of inertia" && has_other_lever(scene)); };
      SceneSettings defaults;
      const auto parameters = scene_parameters(defaults);
      std::string list;
      for (const auto &[name, counts] : dependents(scene))
        if (counts && is_doubtful(name) && scene.specified.count(name) == 0 && !is_varied(scene, name))
          list += (list.empty() ? "" : ", ") + name + " = " + find_parameter(parameters, name)->default_value;
      if (list.empty())
        return;
      warnings.push_back(make_warning("defaults_of_model_a", { is_other_device ? "The geometry or spring" : "The lever", list }));
    }

    /// A slide is held at its largest x, where s is least.
    std::optional<Locking> held_locking(const Scene &scene, const Device &device)
    {
      DrivePoint held  = held_drive(scene);
      held.v           = -std::abs(held.v);
      const auto state = closed_form(device, held.x, held.v);
      const bool locks = state.contact.s <= state.mu * device.geometry.interface_offset;
      return locks && contains(held_directions(scene), Direction::backward)
                 ? std::make_optional(Locking{ held.x, state.contact.s, state.mu })
                 : std::nullopt;
    }

    void add_locking(const Scene &scene, Warnings &warnings)
    {
      const auto type    = scene.analysis.type;
      const bool holds   = type == AnalysisType::stability || type == AnalysisType::sprag_slip;
      const bool follows = follows_drive(scene) && scene.analysis.model != ModelType::closed_form;
      std::optional<Locking> found;
      for (unsigned int lever = 0; lever < count_levers(scene) && !found; ++lever)
      {
        const auto device = lever_device(scene, lever);
        found             = holds ? held_locking(scene, device) : follows ? locking(device) : std::nullopt;
      }
      if (found)
        warnings.push_back(make_warning(
            "locks", { mm(found->x), mm(found->s), mm(found->mu * scene.geometry.interface_offset), rounded_text(found->mu) }));
    }

    struct Shaking
    {
      unsigned int turns = 0;  ///< of the speed's change from one interval to the next
      double share       = 0.; ///< of these among all such changes
      double largest     = 0.; ///< change of speed [mm/s]

      bool is_known() const
      {
        return turns >= fewest_turns && share >= least_turn_share;
      }
    };

    /// Looks at mean speeds between the given times.
    Shaking shaking_between(const std::vector<double> &times, const Drive &drive)
    {
      const double range = drive.maximum() - drive.minimum();
      Shaking found;
      unsigned int changes = 0;
      double speed = 0., before = 0.;
      for (std::size_t i = 1; i < times.size(); ++i)
      {
        const double time   = times[i] - times[i - 1];
        const double next   = (drive.at(times[i]).x - drive.at(times[i - 1]).x) / time;
        const double change = i > 1 ? next - speed : 0.;
        speed               = next;
        // A drive that turns goes far in between, unlike one that trembles.
        const bool counts =
            std::abs(change) > least_shaking * drive.peak_speed() && std::abs(change) * time < range_limit * range;
        changes += counts;
        if (counts && change * before < 0.)
        {
          ++found.turns;
          found.largest = std::max(found.largest, std::abs(change));
        }
        before = counts ? change : 0.;
      }
      found.share = changes > 0 ? static_cast<double>(found.turns) / changes : 0.;
      return found;
    }

    /// A table of up to 2000 rows has all of them as kinks, a longer one is looked at as often.
    Shaking find_shaking(const Drive &drive)
    {
      std::vector<double> rows = drive.kinks(), even;
      rows.insert(rows.begin(), 0.);
      rows.push_back(drive.duration());
      for (unsigned int i = 0; i <= n_looks; ++i)
        even.push_back(drive.duration() * i / n_looks);
      const auto row_shaking = shaking_between(rows, drive);
      return row_shaking.is_known() ? row_shaking : shaking_between(even, drive);
    }

    /// Without inertia speeds count by the friction coefficient alone.
    void add_shaking(const Scene &scene, Warnings &warnings)
    {
      const bool by_speed =
          scene.analysis.type == AnalysisType::transient || !std::holds_alternative<CoulombFriction>(scene.friction.law);
      if (!follows_drive(scene) || scene.drive.profile() != DriveProfile::table || !by_speed)
        return;
      const auto found = find_shaking(scene.drive);
      if (!found.is_known())
        return;
      warnings.push_back(make_warning(
          "shaking_drive", { std::to_string(found.turns), rounded_text(found.largest), rounded_text(scene.drive.peak_speed()) }));
    }

    void add_drift(const Scene &scene, Warnings &warnings)
    {
      const auto &isolation = scene.isolation;
      if (scene.analysis.type != AnalysisType::isolation || isolation.base != BaseMotionType::record || isolation.corrects_drift)
        return;
      const auto [raw, corrected] = recorded_travel(isolation.base_table);
      if (raw > largest_drift_ratio * corrected)
        warnings.push_back(make_warning("drifting_record", { mm(raw), mm(corrected) }));
    }

    /// A slide is held at the largest speed. Near its ends such a drive is slower, where a mu that depends on speed is another.
    void add_largest_speed(const Scene &scene, Warnings &warnings)
    {
      const auto profile   = scene.drive.profile();
      const bool is_varied = profile == DriveProfile::harmonic || profile == DriveProfile::table;
      if (!is_varied || !looks_over_stroke(scene) || std::holds_alternative<CoulombFriction>(scene.friction.law))
        return;
      warnings.push_back(make_warning("largest_speed_alone", { rounded_text(scene.drive.peak_speed()) }));
    }

    /// Holds a value, its plausible range with a margin, and units that are often used by mistake.
    struct CheckedValue
    {
      std::string parameter;
      double value;
      double low;
      double high;
      std::string unit;
      std::string known; ///< of extremes that there are
      std::vector<std::string> mistaken;

      bool is_plausible(const double candidate) const
      {
        return candidate >= low && candidate <= high;
      }
    };

    /// Levers are made a thousand times stiffer than metal on purpose, so that they do not bend.
    CheckedValue young_modulus(const std::string &section, const double value, const double low, const double high,
                               const std::string &softest)
    {
      return {
        section + "/Young's modulus", value, low, high, "MPa", "diamond has 1.2e6 MPa, " + softest, { "Pa", "kPa", "GPa" }
      };
    }

    CheckedValue metal(const std::string &section, const double value)
    {
      return young_modulus(section, value, 300., 1e9, "PTFE 500");
    }

    CheckedValue density(const std::string &section, const double value)
    {
      return { section + "/Density",          value, 1e-11, 3e-8, "t/mm3", "osmium has 2.3e-8 t/mm3, foams 2e-11",
               { "kg/m3", "g/cm3", "kg/mm3" } };
    }

    CheckedValue length(const std::string &parameter, const double value)
    {
      return { parameter, value, 0.5, 1e5, "mm", "parts of such devices measure a millimetre to some metres", { "m", "inch" } };
    }

    /// Its lever of the dimensions given would be lighter than balsa or, with as much again in a hub, ten times as heavy as
    /// osmium.
    CheckedValue inertia(const Lever &lever)
    {
      const double volume_moment = lever.depth * lever.width * std::pow(lever.length, 3) / 3.;
      return { "Lever/Moment of inertia",
               lever.moment_of_inertia,
               5e-11 * volume_moment,
               3e-7 * volume_moment,
               "t mm2",
               "the lever of this length, depth and width has " + rounded_text(2.7e-9 * volume_moment) + " t mm2 of aluminium",
               { "kg m2", "kg mm2", "g mm2" } };
    }

    /// Turned by a radian, of which levers turn a tenth, it would press with less than 10 N at the pivot's distance. That of a
    /// lever below 100 mm is smaller as its areas are.
    CheckedValue spring(const Scene &scene)
    {
      const double distance = scene.geometry.pivot_distance;
      const double least    = 10. * std::min(1., std::pow(distance / 100., 2));
      return { "Rotational spring/Stiffness",
               scene.spring.stiffness,
               least * distance,
               1e7 * distance,
               "N mm/rad",
               "model A has 7.4e4 N mm/rad, 400 N/rad at the pivot's distance",
               { "N m/rad", "N mm/deg", "N m/deg" } };
    }

    std::vector<CheckedValue> checked_values(const Scene &scene)
    {
      return { metal("Lever", scene.lever.young_modulus),
               metal("Friction plate", scene.plate.young_modulus),
               metal("Leaf spring", scene.spring.leaf.young_modulus),
               young_modulus("Friction layer", scene.layer.young_modulus, 1e-3, 5e6, "gels 0.01"),
               young_modulus("Cylinder", scene.cylinder.young_modulus, 1e-3, 5e6, "gels 0.01"),
               density("Lever", scene.lever.density),
               density("Friction plate", scene.plate.density),
               density("Leaf spring", scene.spring.leaf.density),
               density("Friction layer", scene.layer.density),
               density("Cylinder", scene.cylinder.density),
               length("Geometry/Cylinder radius", scene.geometry.cylinder_radius),
               length("Geometry/Pivot distance", scene.geometry.pivot_distance),
               length("Leaf spring/Length", scene.spring.leaf.length),
               length("Lever/Length", scene.lever.length),
               length("Lever/Depth", scene.lever.depth),
               length("Lever/Width", scene.lever.width),
               inertia(scene.lever),
               spring(scene) };
    }

    /// "2700 kg/m3, which is 2.7e-09 t/mm3", of the first unit in which the value is plausible; empty where it is in none.
    std::string likely_reading(const CheckedValue &checked)
    {
      try
      {
        for (const auto &unit : checked.mistaken)
          if (const double value = checked.value * unit_factor(unit, checked.unit); checked.is_plausible(value))
            return rounded_text(checked.value) + ' ' + unit + ", which is " + rounded_text(value) + ' ' + checked.unit;
      }
      catch (const InputError &)
      {
        // Without the data base of units there is nothing to propose.
      }
      return {};
    }

    /// Warns of all values given that are beyond what materials and such devices have, with the unit in which each would be
    /// plausible.
    void add_implausible_values(const Scene &scene, Warnings &warnings)
    {
      std::string found, remedy;
      for (const auto &checked : checked_values(scene))
      {
        if (scene.specified.count(checked.parameter) == 0 || checked.is_plausible(checked.value))
          continue;
        const bool is_small = checked.value < checked.low;
        found += (found.empty() ? "" : " ") + checked.parameter + " = " + rounded_text(checked.value) + ' ' + checked.unit +
                 " is " + (is_small ? "less" : "more") + " than " + rounded_text(is_small ? checked.low : checked.high) + ' ' +
                 checked.unit + ": " + checked.known + '.';
        if (const auto likely = likely_reading(checked); !likely.empty())
          remedy += checked.parameter + " may be meant as " + likely + ". ";
      }
      if (found.empty())
        return;
      warnings.push_back(make_warning("implausible_values", { found }));
      warnings.back().remedy.insert(0, remedy);
    }

    /// Warns of parameters of parts that nothing says to be there, by the beginnings of their names, the choice and its word.
    /// They are admitted where the file gives the choice itself, be it another: it may serve several runs.
    void add_absent_parts(const Scene &scene, Warnings &warnings)
    {
      static const std::vector<std::array<std::string, 3>> parts = {
        { "Leaf spring/", "Rotational spring/Type", "leaf" }, { "Friction plate/", "Friction plate/Type", "on sensors" },
        { "Lever frame/", "Lever/Outline", "frame" },         { "Support/", "Support/Type", "sprung" },
        { "Cylinder/Made of", "Cylinder/Type", "solid" },     { "Cylinder/Young's modulus", "Cylinder/Type", "solid" }
      };
      std::string found;
      for (const auto &[parameters, choice, word] : parts)
        for (const auto &name : scene.specified)
          if (name.rfind(parameters, 0) == 0 && scene.specified.count(choice) == 0)
            found += (found.empty() ? "" : " ") + name + " counts only with " + choice + " = " + word + '.';
      if (!found.empty())
        warnings.push_back(make_warning("absent_part", { found }));
    }

    /// Columns that a run writes, be it of a pair or in three dimensions, cannot be misspelt.
    bool is_written_by_sprag(const std::string &column)
    {
      MirroredPair pair;
      pair.type      = PairType::full;
      const auto all = table_columns({}, pair, 3);
      return column.rfind("sensor_", 0) == 0 ||
             std::any_of(all.begin(), all.end(), [&](const ColumnInfo &info) { return info.name == column; });
    }

    void add_unused_columns(const Scene &scene, Warnings &warnings)
    {
      std::string found;
      for (const auto &[parameter, columns] : scene.unused_columns)
      {
        std::string names;
        for (const auto &name : columns)
          if (!name.empty() && !is_written_by_sprag(name))
            names += (names.empty() ? "" : ", ") + name;
        if (!names.empty())
          found += (found.empty() ? "" : " ") + std::string("Of ") + parameter + " these columns are not used: " + names + '.';
      }
      if (!found.empty())
        warnings.push_back(make_warning("unused_columns", { found }));
    }
  } // namespace

  Warnings without_effect(const std::vector<std::string> &parameters)
  {
    if (parameters.empty())
      return {};
    return { make_warning("without_effect", { boost::algorithm::join(parameters, ", ") }) };
  }

  Warnings scene_warnings(const Scene &scene)
  {
    Warnings warnings;
    // Each run of a study has its own, and a lever that is to be found has none yet.
    if (scene.analysis.type == AnalysisType::study || scene.analysis.type == AnalysisType::design)
      return warnings;
    for (const auto add :
         { add_defaults, add_foreign_contact_law, add_sensitivity, add_leaf, add_plane_stress, add_opening, add_locking,
           add_shaking, add_drift, add_largest_speed, add_implausible_values, add_absent_parts, add_unused_columns })
      add(scene, warnings);
    append(warnings, narrow_contact_warnings(scene));
    return warnings;
  }

  void check_warnings(const Scene &scene, const Warnings &warnings)
  {
    if (scene.analysis.warnings == WarningTreatment::error && !warnings.empty())
      throw AnalysisError("Analysis/Warnings = error: " + count_text(warnings) + ". The first says: " + warnings.front().found +
                          ' ' + warnings.front().remedy);
  }
} // namespace sprag
