#include "run/choice.h"

#include "analysis/accuracy/error_estimate.h"
#include "analysis/stability/stability.h"
#include "base/errors.h"
#include "base/text.h"
#include "run/coarser_scene.h"
#include "run/percent.h"
#include "scene/accuracy.h"
#include "scene/contact_reference.h"
#include "scene/contact_width.h"
#include "scene/held_slide.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    // Shares of the target that the causes of an error may use up.
    constexpr double share_of_mesh  = 0.4;
    constexpr double share_of_modes = 0.1;
    constexpr double share_of_steps = 0.4;
    constexpr double share_of_model = 0.8;

    constexpr double faces_of_probe = 3.; ///< across the contact where P is largest
    constexpr double finest         = 8.; ///< Mesh/Face size of the probe over that of a run

    double difference(const SlideStability &found, const SlideStability &other, const std::vector<std::string> &quantities)
    {
      double result = 0.;
      for (const auto &quantity : quantities)
      {
        const auto value = [&](const SlideStability &slide)
        { return quantity == "growth_rate" ? slide.growth_rate() : slide.frequency(); };
        result = std::max(result, std::abs(value(other) / value(found) - 1.));
      }
      if (!std::isfinite(result))
        throw AnalysisError("Accuracy/Target: the slide at x = " + mm(found.slide ? found.slide->drive.x : 0.) +
                            " has no vibration by which settings could be chosen. Give them instead");
      return result;
    }

    /// In time the contact's frequency carries over to P: it rings with it.
    std::vector<std::string> probed_quantities(const Scene &scene)
    {
      if (scene.analysis.type == AnalysisType::transient)
        return { "frequency" };
      return scene.accuracy.quantities;
    }

    Scene with_modes(Scene scene, const unsigned int modes)
    {
      scene.condensed.modes = modes;
      return scene;
    }
  } // namespace

  VibrationChoice::VibrationChoice(const Scene &given)
      : scene(given)
  {
    const auto quantities = probed_quantities(scene);
    DynamicsMaker maker(true, 2);
    Scene fine          = held_scene(scene);
    fine.analysis.model = ModelType::condensed;
    face_size           = estimated_contact_width(scene, contact_reference(scene).P) / faces_of_probe;
    fine.mesh.face_size = face_size;
    const auto found    = judge(fine, maker);
    mesh_error =
        difference(found, judge(with_coarser_mesh(fine), maker), quantities) * share_of_finer(coarser, order_of_forces(scene));
    if (scene.accuracy.is_model_open)
    {
      Scene beam          = fine;
      beam.analysis.model = ModelType::beam;
      beam_error          = difference(found, judge(beam, maker), quantities);
    }
    for (unsigned int modes = 5; modes < fine.condensed.modes; modes *= 2)
      mode_errors.emplace_back(modes, difference(found, judge(with_modes(fine, modes), maker), quantities));
  }

  Choice VibrationChoice::meeting(const double target) const
  {
    Choice choice;
    const bool beam = scene.accuracy.is_model_open && beam_error <= share_of_model * target;
    if (scene.accuracy.is_model_open)
      choice.settings.push_back(
          { "Analysis/Model", beam ? "beam" : "condensed", "the beam is " + percent(beam_error) + " off a condensed probe" });
    const bool in_time = scene.analysis.type == AnalysisType::transient;
    choice.error       = beam ? beam_error : 0.;
    if (!beam && is_open(scene, "Mesh/Face size") && scene.mesh.file.empty())
    {
      const double order = order_of_forces(scene);
      const double ideal = face_size * std::pow(share_of_mesh * target / std::max(mesh_error, 1e-12), 1. / order);
      const double size  = std::clamp(ideal, face_size / finest, coarser * face_size);
      choice.error       = mesh_error * std::pow(size / face_size, order);
      choice.settings.push_back({ "Mesh/Face size", rounded_text(size),
                                  "a probe with " + rounded_text(face_size) + " mm is " + percent(mesh_error) + " off" });
      if (ideal < size)
        choice.limit = "Faces of " + mm(size) + " are the shortest that a probe tells of.";
    }
    if (!beam && scene.analysis.model == ModelType::condensed && is_open(scene, "Condensed/Modes"))
      for (const auto &[modes, error] : mode_errors)
        if (error <= share_of_modes * target)
        {
          choice.error += error;
          choice.settings.push_back({ "Condensed/Modes", std::to_string(modes), percent(error) + " off a probe with more" });
          break;
        }
    if (in_time && is_open(scene, "Time/Tolerance") && is_open(scene, "Time/Step"))
    {
      choice.error += share_of_steps * target;
      choice.settings.push_back({ "Time/Tolerance", rounded_text(share_of_steps * target), "errors of P are about as large" });
    }
    return choice;
  }
} // namespace sprag
