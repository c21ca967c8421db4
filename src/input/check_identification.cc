// SPDX-License-Identifier: GPL-3.0-only
#include "base/text.h"
#include "input/check_parts.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/scene.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
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

    void way(const Scene &scene, Rules &rules)
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
      const double room = 0.01 * (scene.drive.maximum() - scene.drive.minimum());
      rules.need(!identifies_by_model(scene) || most <= scene.drive.maximum() + room, "Drive/Stroke",
                 { "Analysis/Type", "Analysis/Model", "Drive/Profile" },
                 "must reach the largest x measured, " + mm(most) + ", where a model corrects the closed form");
      if (has_x)
        return;
      rules.need(measured.time.back() <= 1.001 * scene.drive.duration(), "Identification/Table",
                 { "Analysis/Type", "Drive/Profile", "Drive/Start", "Drive/Stroke", "Drive/Speed", "Drive/Cycles" },
                 "goes on to " + rounded_text(measured.time.back()) + " s, the drive ends at " +
                     rounded_text(scene.drive.duration()) + " s: give a column x or the drive");
    }
  } // namespace

  void check_identification(const Scene &scene, Rules &rules)
  {
    apparatus(scene, rules);
    if (rules.broken.empty())
      way(scene, rules);
  }
} // namespace sprag
