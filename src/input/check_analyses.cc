// SPDX-License-Identifier: GPL-3.0-only
#include "input/check.h"

#include "base/text.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/damper.h"
#include "scene/design.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    void damper(const Scene &scene, Rules &rules)
    {
      const bool multiplies = scene.isolation.levers > 1 && scene.specified.count("Isolation/Levers") > 0;
      rules.need(scene.isolation.damper != DamperType::loop || !multiplies, "Isolation/Levers", { "Isolation/Damper" },
                 "must be 1 or left out with Isolation/Damper = loop, whose table has the force of all levers together");
      if (scene.isolation.damper != DamperType::lever)
        return;
      rules.need(scene.analysis.model == ModelType::closed_form || scene.contact.type == ContactType::compliant, "Contact/Type",
                 { "Analysis/Type", "Analysis/Model", "Isolation/Damper" },
                 "must be compliant with Isolation/Damper = lever and a model in time");
      rules.need(!isolates_by_model(scene) || std::abs(scene.isolation.initial_displacement) < scene.drive.maximum(),
                 "Isolation/Initial displacement", { "Analysis/Type", "Analysis/Model", "Drive/Stroke", "Drive/Profile" },
                 "must be less than Drive/Stroke = " + mm(scene.drive.maximum()) + " either way, for which the levers are made");
      rules.need(scene.support.type == SupportType::rigid, "Support/Type", { "Analysis/Type", "Isolation/Damper" },
                 "must be rigid with Isolation/Damper = lever");
      rules.need(
          !isolates_by_model(scene) || scene.spring.rest_angle == 0., "Rotational spring/Rest angle",
          { "Analysis/Type", "Analysis/Model", "Isolation/Damper" },
          "must be 0 with Isolation/Damper = lever but for Analysis/Model = closed form: a preload presses levers at x < 0, "
          "for which no lever in time is made");
    }

    /// Checks where the motion begins, of a damper that can be made.
    void beginning(const Scene &scene, Rules &rules)
    {
      const auto &settings = scene.isolation;
      const auto made      = make_damper(scene);
      const double y       = std::abs(settings.initial_displacement);
      rules.need(y < made.reach, "Isolation/Initial displacement",
                 { "Analysis/Type", "Isolation/Damper", "Isolation/Loop table", "Geometry/Cylinder radius",
                   "Geometry/Interface offset", "Geometry/Pivot distance", "Geometry/Pivot height" },
                 "must be less than " + mm(made.reach) + " either way, where " + made.end);
      if (y >= made.reach || !made.locking_margin)
        return;
      rules.need(made.locking_margin(y, 0.) > 0., "Isolation/Initial displacement",
                 { "Analysis/Type", "Isolation/Damper", "Friction/Law", "Friction/Coefficient", "Friction/Table" },
                 "must not be where the damper locks: friction holds the table there whatever pulls it back");
    }

    void base(const IsolationSettings &settings, Rules &rules)
    {
      rules.need(settings.base != BaseMotionType::none || settings.initial_displacement != 0. || settings.initial_velocity != 0.,
                 "Isolation/Initial displacement", { "Analysis/Type", "Isolation/Base motion", "Isolation/Initial velocity" },
                 "must not be 0 mm with Base motion = none and no Initial velocity: nothing moves");
      rules.need(settings.base != BaseMotionType::random || settings.highest_frequency > settings.lowest_frequency,
                 "Isolation/Highest frequency", { "Analysis/Type", "Isolation/Base motion", "Isolation/Lowest frequency" },
                 "must be more than Lowest frequency = " + rounded_text(settings.lowest_frequency) + " Hz");
      rules.need(!settings.spectrum_lines || *settings.spectrum_lines == std::floor(*settings.spectrum_lines),
                 "Isolation/Spectrum lines", {}, "must be a whole number or auto");
      constexpr double most_periods = 1e6; // of which each takes memory
      rules.need(settings.base != BaseMotionType::random || settings.duration * settings.highest_frequency <= most_periods,
                 "Isolation/Highest frequency", { "Analysis/Type", "Isolation/Base motion", "Isolation/Duration" },
                 "must be at most " + rounded_text(most_periods / settings.duration) +
                     " Hz: a random motion has at most 1e6 periods of it");
      rules.need(settings.end == IsolationEnd::duration || settings.base == BaseMotionType::harmonic, "Isolation/End",
                 { "Analysis/Type", "Isolation/Base motion" }, "must be duration but with Base motion = harmonic");
      if (settings.base != BaseMotionType::random || settings.spectrum != BaseSpectrum::table || settings.base_table.at.empty())
        return;
      rules.need(settings.base_table.at.front() < settings.highest_frequency &&
                     settings.base_table.at.back() > settings.lowest_frequency,
                 "Isolation/Base table", { "Isolation/Lowest frequency", "Isolation/Highest frequency" },
                 "must have densities between Lowest frequency and Highest frequency");
    }

    void table(const Scene &scene, Rules &rules)
    {
      const auto &isolation = scene.isolation;
      rules.need(isolation.damper == DamperType::lever, "Isolation/Damper", { "Analysis/Type", "Design/Demands", "Design/Aim" },
                 "must be lever where something of the table is asked for: its levers are designed");
      const bool asks_offset = asks_for(scene.design, DesignQuantity::residual_offset);
      rules.need(!asks_offset || isolation.base == BaseMotionType::none || isolation.base == BaseMotionType::record,
                 "Isolation/Base motion", { "Analysis/Type", "Design/Demands", "Design/Aim", "Design/Second aim" },
                 "must be none or record where a residual offset is asked for: on a base that moves until the end there is none");
      const auto &record = isolation.base_table.at;
      rules.need(!asks_offset || isolation.base != BaseMotionType::record || record.empty() || record.back() < isolation.duration,
                 "Isolation/Duration", { "Analysis/Type", "Isolation/Base motion", "Isolation/Base table" },
                 "must be more than the " + (record.empty() ? "" : rounded_text(record.back())) +
                     " s of Base table where a residual offset is asked for");
      rules.need(!asks_offset || isolation.base != BaseMotionType::none || isolation.initial_displacement != 0. ||
                     isolation.initial_velocity != 0.,
                 "Isolation/Initial displacement", { "Analysis/Type", "Isolation/Base motion", "Isolation/Initial velocity" },
                 "must not be 0 mm with Base motion = none where a residual offset is asked for: nothing moves");
    }

    void apparatus(const Scene &scene, Rules &rules)
    {
      rules.need(scene.spring.type == SpringType::torsional, "Rotational spring/Type", { "Analysis/Type" },
                 "must be torsional where k is identified");
      rules.need(scene.support.type == SupportType::rigid, "Support/Type", { "Analysis/Type" },
                 "must be rigid where a lever is identified");
      rules.need(scene.analysis.model != ModelType::finite_element, "Analysis/Model", { "Analysis/Type" },
                 "must be closed form, rigid, beam or condensed where a lever is identified");
      rules.need(!identifies_by_model(scene) || scene.contact.type == ContactType::compliant, "Contact/Type",
                 { "Analysis/Type", "Analysis/Model" }, "must be compliant where a model corrects the closed form");
    }

    void check_measured_range(const Scene &scene, Rules &rules)
    {
      const auto &measured = scene.identification.measured;
      if (measured.rows() == 0)
        return;
      const bool has_x   = !measured.x.empty();
      const double most  = has_x ? *std::max_element(measured.x.begin(), measured.x.end()) : scene.drive.maximum();
      const double least = has_x ? *std::min_element(measured.x.begin(), measured.x.end()) : scene.drive.minimum();
      const double reach = pivot_contact(scene.geometry);
      rules.need(most < reach, "Identification/Table",
                 { "Analysis/Type", "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot distance",
                   "Geometry/Pivot height" },
                 "x = " + mm(most) + " must stay below " + mm(reach) + ", where the cylinder reaches the pivot");
      rules.need(most - least > 0., "Identification/Table", {}, "x must change");
      const double tolerance = 0.01 * (scene.drive.maximum() - scene.drive.minimum());
      rules.need(!identifies_by_model(scene) || most <= scene.drive.maximum() + tolerance, "Drive/Stroke",
                 { "Analysis/Type", "Analysis/Model", "Drive/Profile" },
                 "must reach the largest x measured, " + mm(most) + ", where a model corrects the closed form");
      if (has_x)
      {
        // Rows at rest lie about 0, and of a stroke to both sides the positive half serves.
        const auto lowest   = std::min_element(measured.x.begin(), measured.x.end()) - measured.x.begin();
        const auto negative = std::count_if(measured.x.begin(), measured.x.end(), [](const double x) { return x < 0.; });
        rules.need(2 * negative <= static_cast<std::ptrdiff_t>(measured.rows()), "Identification/Table", {},
                   "x must be >= 0, it is negative in " + std::to_string(negative) + " of " + std::to_string(measured.rows()) +
                       " rows, down to " + mm(least) + " in row " + std::to_string(lowest + 1) +
                       ": give x the other sign or another origin");
        return;
      }
      rules.need(measured.time.back() <= 1.001 * scene.drive.duration(), "Identification/Table",
                 { "Analysis/Type", "Drive/Profile", "Drive/Start", "Drive/Stroke", "Drive/Speed", "Drive/Cycles" },
                 "goes on to " + rounded_text(measured.time.back()) + " s, the drive ends at " +
                     rounded_text(scene.drive.duration()) + " s: give a column x or the drive");
    }
  } // namespace

  void check_isolation(const Scene &scene, Rules &rules)
  {
    damper(scene, rules);
    base(scene.isolation, rules);
    const bool has_damper = scene.isolation.damper != DamperType::loop || !scene.isolation.loop.out.at.empty();
    if (rules.broken.empty() && has_damper)
      beginning(scene, rules);
  }

  void check_design(const Scene &scene, Rules &rules)
  {
    rules.need(scene.drive.minimum() >= 0., "Drive/Table", {},
               "x must be >= 0 mm throughout, it falls to " + rounded_text(scene.drive.minimum()));
    rules.need(scene.analysis.dimension == 2, "Analysis/Dimension", { "Analysis/Type" }, "must be 2 in a design");
    rules.need(scene.spring.type == SpringType::torsional, "Rotational spring/Type", { "Analysis/Type" },
               "must be torsional in a design, which finds k; Analysis/Type = calibration makes a leaf spring of it");
    rules.need(scene.pair.type == PairType::half, "Mirrored pair/Type", { "Analysis/Type" },
               "must be half in a design, whose quantities are of one lever");
    rules.need(scene.support.type == SupportType::rigid, "Support/Type", { "Analysis/Type" }, "must be rigid in a design");
    rules.need(scene.contact.type == ContactType::compliant, "Contact/Type", { "Analysis/Type" },
               "must be compliant in a design, whose judges have a contact that yields");
    if (asks_for(scene.design, is_table_quantity))
      table(scene, rules);
  }

  void check_identification(const Scene &scene, Rules &rules)
  {
    apparatus(scene, rules);
    if (rules.broken.empty())
      check_measured_range(scene, rules);
  }
} // namespace sprag
