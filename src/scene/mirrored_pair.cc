#include "scene/mirrored_pair.h"

#include "base/text.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"

#include <cmath>

namespace sprag
{
  namespace
  {
    using Violations = std::vector<Violation>;

    bool are_alike(const MirroredPair &pair)
    {
      return pair.cylinder_offset == 0. && pair.friction_ratio == 1.;
    }

    void analysis(const Scene &scene, Violations &result)
    {
      const auto reject = [&](const std::string &rule) {
        result.push_back({ "Mirrored pair/Type", { "Analysis/Type", "Analysis/Model", "Contact/Type", "Support/Type" }, rule });
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
    void vibration(const Scene &scene, Violations &result)
    {
      const auto &pair = scene.pair;
      const auto type  = scene.analysis.type;
      if (scene.analysis.model == ModelType::finite_element && !are_alike(pair))
        result.push_back(
            { pair.cylinder_offset != 0. ? "Mirrored pair/Cylinder offset" : "Mirrored pair/Friction ratio",
              { "Mirrored pair/Type", "Analysis/Type", "Analysis/Model" },
              "must leave the levers alike where a slide is held with finite elements; Analysis/Model = condensed takes "
              "levers that differ" });
      if (type == AnalysisType::modal && scene.stability.contact == HeldContact::open && pair.joint == SpringJoint::free)
        result.push_back({ "Stability/Contact",
                           { "Mirrored pair/Type", "Mirrored pair/Joint", "Analysis/Type" },
                           "must not be open with Mirrored pair/Joint = free: nothing holds levers that swing together" });
    }

    void joint(const Scene &scene, Violations &result)
    {
      const auto &pair = scene.pair;
      const auto &leaf = scene.spring.leaf;
      const bool free  = pair.joint == SpringJoint::free;
      const bool leafs = scene.spring.type == SpringType::leaf;
      if (free && scene.geometry.pivot_height != 0.)
        result.push_back({ "Geometry/Pivot height",
                           { "Mirrored pair/Type", "Mirrored pair/Joint" },
                           "must be 0 mm with Mirrored pair/Joint = free: the levers swing together about one axis" });
      if (free && leafs && (leaf.axial == LeafAxial::held || leaf.end == LeafEnd::guided))
        result.push_back({ leaf.axial == LeafAxial::held ? "Leaf spring/Axial" : "Leaf spring/Joint",
                           { "Mirrored pair/Type", "Mirrored pair/Joint", "Rotational spring/Type" },
                           std::string("must be ") + (leaf.axial == LeafAxial::held ? "free" : "clamped or pinned") +
                               " with Mirrored pair/Joint = free, which nothing but the springs holds" });
      if (pair.joint_mass > 0. && !leafs)
        result.push_back({ "Mirrored pair/Joint mass",
                           { "Rotational spring/Type" },
                           "must be 0 t with a torsional spring, which has no joint" });
    }

    void offset(const Scene &scene, Violations &result)
    {
      const Geometry &g    = scene.geometry;
      const double most    = g.cylinder_radius - g.interface_offset - g.pivot_height;
      const double largest = 0.5 * most;
      if (most > 0. && std::abs(scene.pair.cylinder_offset) > largest)
        result.push_back(
            { "Mirrored pair/Cylinder offset",
              { "Mirrored pair/Type", "Geometry/Cylinder radius", "Geometry/Interface offset", "Geometry/Pivot height" },
              "must be at most (R - e - h)/2 = " + rounded_text(largest) + " mm either way" });
    }
  } // namespace

  unsigned int number_of_levers(const Scene &scene)
  {
    return scene.pair.type == PairType::full ? 2 : 1;
  }

  Scene scene_of_lever(const Scene &scene, const unsigned int lever)
  {
    Scene result    = scene;
    result.geometry = geometry_of_lever(scene, lever);
    result.friction = friction_of_lever(scene, lever);
    return result;
  }

  Geometry geometry_of_lever(const Scene &scene, const unsigned int lever)
  {
    Geometry result = scene.geometry;
    if (number_of_levers(scene) == 2)
      result.pivot_height -= (lever == 0 ? 1. : -1.) * scene.pair.cylinder_offset;
    return result;
  }

  FrictionLaw friction_of_lever(const Scene &scene, const unsigned int lever)
  {
    FrictionLaw result = scene.friction;
    if (lever == 1)
      result.factor *= scene.pair.friction_ratio;
    return result;
  }

  double rest_inclination(const Scene &scene)
  {
    return kinematics(scene.geometry, 0.).theta;
  }

  bool swings(const Scene &scene)
  {
    return scene.pair.type == PairType::full && scene.pair.joint == SpringJoint::free;
  }

  Scene swinging_scene(const Scene &scene)
  {
    Scene result = scene;
    if (!scene.spring.swing)
      return result;
    result.lever.moment_of_inertia += scene.spring.swing->inertia - scene.spring.behaviour.inertia;
    result.spring.behaviour = *scene.spring.swing;
    result.spring.swing.reset();
    return result;
  }

  std::vector<Violation> pair_violations(const Scene &scene)
  {
    if (number_of_levers(scene) == 1)
      return {};
    Violations result;
    analysis(scene, result);
    if (holds_slide(scene.analysis.type))
      vibration(scene, result);
    joint(scene, result);
    offset(scene, result);
    return result;
  }
} // namespace sprag
