// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/roles.h"

#include "base/errors.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

namespace sprag
{
  namespace
  {
    /// Factor on the lever's Young's modulus that makes its flexure negligible.
    constexpr double rigid_factor = 1e4;

    Role checked(const std::string &name, const std::string &meaning, const Scene &scene, DynamicsMaker &maker)
    {
      try
      {
        const auto found = check_slide(scene, maker);
        return { name, meaning, found.kind, found.growth_rate(), found.frequency(), found.motion() };
      }
      catch (const AnalysisError &error)
      {
        return { name, meaning + "; " + error.what() };
      }
    }

    /// Without mass nothing vibrates: what is left is whether the equilibrium is unique.
    Role without_inertia(const SlideStability &present)
    {
      const bool unique = present.slide && present.uniqueness() > 0.;
      return { "without_inertia", "massless: stable where the equilibrium is unique",
               unique ? SlideKind::stable : SlideKind::jammed };
    }
  } // namespace

  std::vector<Role> roles(const Scene &scene, const SlideStability &present, DynamicsMaker &maker)
  {
    std::vector<Role> result    = { without_inertia(present) };
    const bool depends_on_speed = !std::holds_alternative<CoulombFriction>(held_scene(scene).friction.law);
    if (present.slide && depends_on_speed)
    {
      Scene constant           = held_scene(scene);
      constant.friction.law    = CoulombFriction{ present.slide->mu };
      constant.friction.factor = 1.;
      result.push_back(checked("without_friction_derivative", "mu constant, as it is at this speed", constant, maker));
    }
    Scene undamped             = scene;
    undamped.stability.damping = false;
    result.push_back(checked("without_damping", "no damping of lever, contact and support", undamped, maker));
    if (scene.support.type == SupportType::sprung)
    {
      Scene fixed        = scene;
      fixed.support.type = SupportType::rigid;
      result.push_back(checked("without_support", "pivot at rest", fixed, maker));
    }
    if (scene.analysis.model != ModelType::rigid)
    {
      Scene stiff = scene;
      stiff.lever.young_modulus *= rigid_factor;
      result.push_back(checked("without_flexure", "Young's modulus of the lever times 1e4", stiff, maker));
    }
    return result;
  }
} // namespace sprag
