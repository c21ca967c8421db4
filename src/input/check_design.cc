// SPDX-License-Identifier: GPL-3.0-only
#include "base/text.h"
#include "input/check_parts.h"
#include "scene/design_quantities.h"
#include "scene/scene.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    bool asks_for(const DesignSettings &design, bool (*is_meant)(DesignQuantity))
    {
      const auto is_it = [&](const auto &asked) { return is_meant(asked.term.quantity); };
      return std::any_of(design.demanded.begin(), design.demanded.end(), is_it) ||
             std::any_of(design.aims.begin(), design.aims.end(), is_it);
    }

    bool is_offset(const DesignQuantity quantity)
    {
      return quantity == DesignQuantity::residual_offset;
    }

    void table(const Scene &scene, Rules &rules)
    {
      const auto &isolation = scene.isolation;
      rules.need(isolation.damper == DamperType::lever, "Isolation/Damper", { "Analysis/Type", "Design/Demands", "Design/Aim" },
                 "must be lever where something of the table is asked for: its levers are designed");
      rules.need(!asks_for(scene.design, is_offset) || isolation.base != BaseMotionType::none ||
                     isolation.initial_displacement != 0. || isolation.initial_velocity != 0.,
                 "Isolation/Initial displacement", { "Analysis/Type", "Isolation/Base motion", "Isolation/Initial velocity" },
                 "must not be 0 mm with Base motion = none where a residual offset is asked for: nothing moves");
    }
  } // namespace

  void check_design(const Scene &scene, Rules &rules)
  {
    rules.need(scene.drive.minimum() >= 0., "Drive/Table", {},
               "x must be >= 0 mm throughout, it falls to " + rounded_text(scene.drive.minimum()));
    rules.need(scene.analysis.dimension == 2, "Analysis/Dimension", { "Analysis/Type" }, "must be 2 in a design");
    rules.need(scene.spring.type == SpringType::torsional, "Rotational spring/Type", { "Analysis/Type" },
               "must be torsional in a design, which finds k; Analysis/Type = calibration makes a leaf spring of it");
    rules.need(scene.spring.rest_angle == 0., "Rotational spring/Rest angle", { "Analysis/Type" }, "must be 0 in a design");
    rules.need(scene.pair.type == PairType::half, "Mirrored pair/Type", { "Analysis/Type" },
               "must be half in a design, whose quantities are of one lever");
    rules.need(scene.support.type == SupportType::rigid, "Support/Type", { "Analysis/Type" }, "must be rigid in a design");
    rules.need(scene.contact.type == ContactType::compliant, "Contact/Type", { "Analysis/Type" },
               "must be compliant in a design, whose judges have a contact that yields");
    if (asks_for(scene.design, is_table_quantity))
      table(scene, rules);
  }
} // namespace sprag
