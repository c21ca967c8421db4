// SPDX-License-Identifier: GPL-3.0-only
#include "input/scene_key.h"

#include "base/fingerprint.h"
#include "base/ranges.h"
#include "base/text.h"
#include "input/sections.h"
#include "scene/contact_estimates.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"

namespace sprag
{
  namespace
  {
    /// Value as read and as it is now: the declared default of a parameter bound to the scene is its value in the scene.
    std::string setting_value(const Parameter &parameter, const Scene &scene)
    {
      const auto as_read = scene.parameters ? scene.parameters->at(full_name(parameter)) : "";
      const auto &as_is  = parameter.default_value;
      if (parameter.rule.kind != Rule::Kind::file)
        return as_read + " | " + as_is;
      const auto &file = as_is.empty() ? as_read : as_is;
      return file.empty() ? file : content_fingerprint(file);
    }

    /// All parameters but those that `is_spared` says.
    template <class Spared>
    std::string key_without(const Scene &scene, const Spared &is_spared)
    {
      SceneSettings settings;
      settings.scene            = scene;
      settings.face_size        = scene.mesh.face_size;
      settings.faces_in_contact = scene.mesh.faces_in_contact;
      settings.model            = scene.analysis.model;
      settings.enforcement      = scene.contact.enforcement;
      settings.dimension        = scene.analysis.dimension;
      std::string key;
      for (const auto &parameter : scene_parameters(settings))
        if (!is_spared(parameter))
          key += full_name(parameter) + " = " + setting_value(parameter, scene) + '\n';
      return key;
    }

    /// Lists the files among the values of a study.
    std::vector<std::string> study_files(const StudySettings &study)
    {
      SceneSettings settings;
      const auto parameters = scene_parameters(settings);
      std::vector<std::string> files;
      for (const auto &[name, values] : joined(study.varied, study.reference_values))
        if (find_parameter(parameters, name)->rule.kind == Rule::Kind::file)
          append(files, values);
      return files;
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
    std::string key = key_without(scene, [](const Parameter &) { return false; });
    for (const auto &file : study_files(scene.study))
      key += content_fingerprint(file) + '\n';
    return key;
  }

  std::string body_key(const Scene &scene)
  {
    const auto is_spared = [](const Parameter &parameter)
    { return spared_sections().count(parameter.section) > 0 || spared_parameters().count(full_name(parameter)) > 0; };
    std::string key = key_without(scene, is_spared);
    key += "drive";
    add_number(scene.drive.minimum(), key);
    add_number(scene.drive.maximum(), key);
    key += "\nhalvings";
    add_number(scene.mesh.halvings, key);
    key += "\nfaces";
    if (const auto grading = face_grading(scene))
      for (const double number : { grading->begin, grading->end, grading->longest, grading->shortest })
        add_number(number, key);
    key += '\n';
    if (scene.analysis.dimension == 3)
      key += is_symmetric_across(scene) ? "half\n" : "whole\n";
    add_leaf(scene.spring.behaviour, key);
    if (scene.spring.swing)
      add_leaf(*scene.spring.swing, key);
    return key;
  }

  const std::set<std::string> &spared_sections()
  {
    // Friction acts on the face, and the others say which slide is checked and what else is tried.
    static const std::set<std::string> all = { "Friction",  "Stability",      "Map",    "Sprag slip", "Study",
                                               "Isolation", "Identification", "Design", "Accuracy" };
    return all;
  }

  const std::set<std::string> &spared_parameters()
  {
    static const std::set<std::string> all = {
      // The use of a lever does not change the lever.
      "Analysis/Type", "Analysis/Solution", "Analysis/Step", "Analysis/Minimum step", "Analysis/Maximum deviation",
      "Analysis/Maximum energy residual",
      // The drive counts by its ends, which belong to the key.
      "Drive/Speed", "Drive/Cycles", "Drive/Reversal duration",
      // Rigid levers and beams alone have these.
      "Lever/Neutral axis offset", "Contact/Type", "Contact/Stiffness", "Contact/Exponent",
      // Damping is added to mass and stiffness.
      "Lever/Modal damping", "Lever/Mass damping", "Lever/Stiffness damping", "Contact/Damping", "Contact/Damping law",
      // The contact's springs join the lever later.
      "Contact/Enforcement", "Contact/Penalty", "Contact/Tangential penalty", "Contact/Penetration tolerance",
      "Contact/Maximum augmentations", "Contact/Tangential stiffness",
      // So do the support, the cylinder's path, friction and spring of a second lever.
      "Support/Type", "Support/Mass", "Support/Stiffness", "Support/Damping", "Mirrored pair/Cylinder offset",
      "Mirrored pair/Friction ratio", "Mirrored pair/Spring ratio", "Mirrored pair/Contact ratio",
      // Steps in time, where bases are kept, what is written.
      "Time/Step", "Time/Tolerance", "Time/Spectral radius", "Condensed/Cache", "Output/Fields", "Output/Field interval",
      "Output/Errors"
    };
    return all;
  }
} // namespace sprag
