#include "scene/scene_key.h"

#include "base/fingerprint.h"
#include "base/text.h"
#include "scene/sections.h"

#include <set>

namespace sprag
{
  namespace
  {
    std::set<std::string> spared_names()
    {
      std::set<std::string> names;
      for (const auto &spared : spared_parameters())
        names.insert(spared.parameters.begin(), spared.parameters.end());
      return names;
    }

    /// All parameters of these sections, and some more.
    std::vector<std::string> all_of(const std::set<std::string> &sections, std::vector<std::string> more = {})
    {
      SceneSettings settings;
      for (const auto &parameter : scene_parameters(settings))
        if (sections.count(parameter.section) == 1)
          more.push_back(full_name(parameter));
      return more;
    }

    std::string value_as_read(const std::string &name, const Scene &scene)
    {
      if (!scene.parameters)
        return {};
      const auto found = scene.parameters->find(name);
      return found == scene.parameters->end() ? std::string() : found->second;
    }

    /// As it was read and as it is now: the declared default of one that is bound to the scene is its value in the scene.
    std::string value_of(const Parameter &parameter, const Scene &scene)
    {
      const auto as_read = value_as_read(full_name(parameter), scene);
      const auto &as_is  = parameter.default_value;
      if (parameter.rule.kind != Rule::Kind::file)
        return as_read + " | " + as_is;
      const auto &file = as_is.empty() ? as_read : as_is;
      return file.empty() ? file : content_fingerprint(file);
    }

    std::string key_without(const Scene &scene, const std::set<std::string> &spared)
    {
      SceneSettings settings;
      settings.scene     = scene;
      settings.face_size = scene.mesh.face_size;
      std::string key;
      for (const auto &parameter : scene_parameters(settings))
        if (const auto name = full_name(parameter); spared.count(name) == 0)
          key += name + " = " + value_of(parameter, scene) + '\n';
      return key;
    }

    void add_number(const double number, std::string &key)
    {
      key += ' ' + number_text(number);
    }

    void add_leaf(const LeafBehaviour &leaf, std::string &key)
    {
      key += "leaf";
      for (const double number : { leaf.mass, leaf.inertia, leaf.momentum[0], leaf.momentum[1] })
        add_number(number, key);
      for (const auto &mode : leaf.modes)
        for (const double number : { mode.stiffness, mode.participation, mode.momentum[0], mode.momentum[1] })
          add_number(number, key);
      key += '\n';
    }
  } // namespace

  std::string scene_key(const Scene &scene)
  {
    return key_without(scene, {});
  }

  std::string body_key(const Scene &scene)
  {
    static const auto spared = spared_names();
    std::string key          = key_without(scene, spared);
    key += "drive";
    add_number(scene.drive.minimum(), key);
    add_number(scene.drive.maximum(), key);
    key += '\n';
    add_leaf(scene.spring.behaviour, key);
    if (scene.spring.swing)
      add_leaf(*scene.spring.swing, key);
    return key;
  }

  const std::vector<Spared> &spared_parameters()
  {
    static const std::vector<Spared> all = {
      { "what is done with a lever, not what it is",
        { "Analysis/Type", "Analysis/Solution", "Analysis/Step", "Analysis/Minimum step", "Analysis/Maximum deviation",
          "Analysis/Maximum energy residual" } },
      { "the drive counts by its ends, which belong to the key", { "Drive/Speed", "Drive/Cycles", "Drive/Reversal duration" } },
      { "friction acts on the face", all_of({ "Friction" }, { "Mirrored pair/Friction ratio" }) },
      { "of rigid and beam alone", { "Lever/Neutral axis offset", "Contact/Type", "Contact/Stiffness", "Contact/Exponent" } },
      { "damping is added to mass and stiffness",
        { "Lever/Modal damping", "Lever/Mass damping", "Lever/Stiffness damping", "Contact/Damping" } },
      { "the contact's springs join the lever later",
        { "Contact/Enforcement", "Contact/Penalty", "Contact/Tangential penalty", "Contact/Penetration tolerance",
          "Contact/Maximum augmentations", "Contact/Tangential stiffness" } },
      { "so does the support", { "Support/Type", "Support/Mass", "Support/Stiffness", "Support/Damping" } },
      { "the cylinder's path meets the lever later", { "Mirrored pair/Cylinder offset" } },
      { "steps in time", { "Time/Step", "Time/Tolerance", "Time/Spectral radius" } },
      { "where bases are kept", { "Condensed/Cache" } },
      { "what is written", { "Output/Fields", "Output/Field interval" } },
      { "which slide is judged and what else is tried", all_of({ "Stability", "Map", "Sprag slip" }) },
    };
    return all;
  }
} // namespace sprag
