// SPDX-License-Identifier: GPL-3.0-only
#include "base/text.h"
#include "input/check_parts.h"
#include "scene/analysis_use.h"
#include "scene/damper.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    void damper(const Scene &scene, Rules &rules)
    {
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
      rules.need(scene.spring.rest_angle == 0., "Rotational spring/Rest angle", { "Analysis/Type", "Isolation/Damper" },
                 "must be 0 with Isolation/Damper = lever");
    }

    /// Once the damper can be made.
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
  } // namespace

  void check_isolation(const Scene &scene, Rules &rules)
  {
    damper(scene, rules);
    base(scene.isolation, rules);
    const bool has_damper = scene.isolation.damper != DamperType::loop || !scene.isolation.loop.out.at.empty();
    if (rules.broken.empty() && has_damper)
      beginning(scene, rules);
  }
} // namespace sprag
