// SPDX-License-Identifier: GPL-3.0-only
#include "scene/mirrored_pair.h"

#include "base/text.h"
#include "scene/analysis_use.h"
#include "scene/check_parts.h"
#include "scene/closed_form.h"
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

  unsigned int count_levers(const Device &device)
  {
    return device.pair.type == PairType::full ? 2 : 1;
  }

  Device lever_device(const Device &device, const unsigned int lever)
  {
    Device result   = device;
    result.geometry = lever_geometry(device, lever);
    result.friction = lever_friction(device, lever);
    if (lever == 1)
      result.cylinder.tilt = -result.cylinder.tilt;
    return result;
  }

  Geometry lever_geometry(const Device &device, const unsigned int lever)
  {
    Geometry result = device.geometry;
    if (count_levers(device) == 2)
      result.pivot_height -= (lever == 0 ? 1. : -1.) * device.pair.cylinder_offset;
    return result;
  }

  FrictionLaw lever_friction(const Device &device, const unsigned int lever)
  {
    FrictionLaw result = device.friction;
    if (lever == 1)
      result.factor *= device.pair.friction_ratio;
    return result;
  }

  double rest_inclination(const Device &device)
  {
    return kinematics(device.geometry, 0.).theta;
  }

  bool swings(const Device &device)
  {
    return device.pair.type == PairType::full && device.pair.joint == SpringJoint::free;
  }

  bool swings_otherwise(const Device &device)
  {
    return swings(device) && device.spring.swing;
  }

  Device swinging_device(const Device &device)
  {
    Device result = device;
    if (!device.spring.swing)
      return result;
    result.lever.moment_of_inertia += device.spring.swing->inertia - device.spring.behaviour.inertia;
    result.spring.behaviour = *device.spring.swing;
    result.spring.swing.reset();
    return result;
  }

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
