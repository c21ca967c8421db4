// SPDX-License-Identifier: GPL-3.0-only
#include "base/text.h"
#include "input/check_parts.h"
#include "scene/analysis_use.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <cmath>

namespace sprag
{
  namespace
  {
    bool are_alike(const MirroredPair &pair)
    {
      return pair.cylinder_offset == 0. && pair.friction_ratio == 1.;
    }

    void analysis(const Scene &scene, Rules &rules)
    {
      const auto reject = [&](const std::string &rule) {
        rules.need(false, "Mirrored pair/Type", { "Analysis/Type", "Analysis/Model", "Contact/Type", "Support/Type" }, rule);
      };
      const auto type  = scene.analysis.type;
      const auto model = scene.analysis.model;
      if (!runs_model(type))
        reject("must be half but in a quasi-static, transient, modal, stability, map or sprag-slip analysis");
      else if (type == AnalysisType::transient && (model == ModelType::closed_form || scene.contact.type == ContactType::ideal))
        reject("must be half with an ideal contact in time");
      else if (type == AnalysisType::quasi_static && scene.support.type == SupportType::sprung && model == ModelType::closed_form)
        reject("must be half on a sprung support in the closed form without inertia; with finite elements and in time it may be "
               "full");
    }

    /// Rules where a slide is held.
    void vibration(const Scene &scene, Rules &rules)
    {
      const auto &pair = scene.pair;
      rules.need(scene.analysis.model != ModelType::finite_element || are_alike(pair),
                 pair.cylinder_offset != 0. ? "Mirrored pair/Cylinder offset" : "Mirrored pair/Friction ratio",
                 { "Mirrored pair/Type", "Analysis/Type", "Analysis/Model" },
                 "must leave the levers alike where a slide is held with finite elements; Analysis/Model = condensed takes "
                 "levers that differ");
      rules.need(scene.analysis.type != AnalysisType::modal || scene.stability.contact != HeldContact::open ||
                     pair.joint != SpringJoint::free,
                 "Stability/Contact", { "Mirrored pair/Type", "Mirrored pair/Joint", "Analysis/Type" },
                 "must not be open with Mirrored pair/Joint = free: nothing holds levers that swing together");
    }

    void joint(const Scene &scene, Rules &rules)
    {
      const auto &leaf = scene.spring.leaf;
      const bool free  = scene.pair.joint == SpringJoint::free;
      const bool leafs = scene.spring.type == SpringType::leaf;
      const bool held  = leaf.axial == LeafAxial::held;
      rules.need(!free || scene.geometry.pivot_height == 0., "Geometry/Pivot height",
                 { "Mirrored pair/Type", "Mirrored pair/Joint" },
                 "must be 0 mm with Mirrored pair/Joint = free: the levers swing together about one axis");
      rules.need(!free || !leafs || (!held && leaf.end != LeafEnd::guided), held ? "Leaf spring/Axial" : "Leaf spring/Joint",
                 { "Mirrored pair/Type", "Mirrored pair/Joint", "Rotational spring/Type" },
                 std::string("must be ") + (held ? "free" : "clamped or pinned") +
                     " with Mirrored pair/Joint = free, which nothing but the springs holds");
      rules.need(scene.pair.joint_mass <= 0. || leafs, "Mirrored pair/Joint mass", { "Rotational spring/Type" },
                 "must be 0 t with a torsional spring, which has no joint");
    }

    void offset(const Scene &scene, Rules &rules)
    {
      const Geometry &g    = scene.geometry;
      const double most    = g.cylinder_radius - g.interface_offset - g.pivot_height;
      const double largest = 0.5 * most;
      rules.need(most <= 0. || std::abs(scene.pair.cylinder_offset) <= largest, "Mirrored pair/Cylinder offset",
                 { "Mirrored pair/Type", "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot height" },
                 "must be at most (R - e - h)/2 = " + mm(largest) + " either way");
    }
  } // namespace

  void check_pair(const Scene &scene, Rules &rules)
  {
    if (count_levers(scene) == 1)
      return;
    analysis(scene, rules);
    if (holds_slide(scene.analysis.type))
      vibration(scene, rules);
    joint(scene, rules);
    offset(scene, rules);
  }
} // namespace sprag
