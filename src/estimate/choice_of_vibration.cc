// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/choice.h"

#include "analysis/accuracy/step_errors.h"
#include "analysis/stability/stability.h"
#include "analysis/transient/transient.h"
#include "analytic/error_estimate.h"
#include "base/errors.h"
#include "base/text.h"
#include "estimate/coarser_scene.h"
#include "estimate/dynamic_accuracy.h"
#include "input/check.h"
#include "report/summary_lines.h"
#include "results/row_statistics.h"
#include "scene/analysis_use.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    // Shares of the target that the causes of an error may use up.
    constexpr double slide_mesh_share = 0.3, slide_penalty_share = 0.2, slide_mode_share = 0.1, slide_step_share = 0.4,
                     slide_model_share = 0.8;
    constexpr double step_error        = 2.; ///< part `step` of P that a run tells, over Time/Tolerance
    // A held slide has no steps. What it scatters over a face falls by a lower power of the face size: 3.5, 1.7 and 0.64 % of the
    // growth rate of stability-a with 0.93, 0.27 and 0.12 mm.
    constexpr double held_mesh_share = 0.5, held_order = 1.;

    constexpr double stiffest          = 0.5; ///< penalty over the stiffest that a mesh takes
    constexpr double slide_trial_faces = 3.;  ///< across the contact where P is largest
    constexpr double slide_finest      = 8.;  ///< Mesh/Face size of the trial run over that of a run

    /// Returns what a slide has of Accuracy/Quantity.
    SlideValue value_for(const Scene &scene, const std::string &quantity)
    {
      return [&scene, is_growth = quantity == "growth_rate"](const SlideStability &slide)
      { return is_growth ? slide.growth_rate() : ringing_frequency(scene, slide); };
    }

    double difference(const Scene &scene, const SlideStability &found, const SlideStability &other,
                      const std::vector<std::string> &quantities)
    {
      double result = 0.;
      for (const auto &quantity : quantities)
      {
        const auto value = value_for(scene, quantity);
        result           = std::max(result, std::abs(value(other) / value(found) - 1.));
      }
      if (!std::isfinite(result))
        throw AnalysisError("Accuracy/Target: the slide at x = " + mm(found.slide ? found.slide->drive.x : 0.) +
                            " has no vibration by which settings could be chosen. Give them instead");
      return result;
    }

    std::vector<std::string> trial_quantities(const Scene &scene)
    {
      if (scene.analysis.type == AnalysisType::transient)
        return { "frequency" };
      return scene.accuracy.quantities;
    }

    /// Error of the worst quantity wanted over that of the frequency with which P rings.
    double error_over_frequency(const Scene &scene)
    {
      const double least = is_requested(scene, "overshoot") ? 2. : 1.; // it goes with the square of the frequency
      if (scene.analysis.type != AnalysisType::transient || scene.drive.reversals().empty() || !is_requested(scene, "P"))
        return least;
      const auto rows   = beam_run(scene);
      const double turn = scene.drive.reversals().front();
      return std::max(least, change_by_frequency(rows, turn, rows.back()[Column::time]) / largest(rows, Column::P));
    }

    Scene with_modes(Scene scene, const unsigned int modes)
    {
      scene.condensed.modes = modes;
      return scene;
    }

    /// Chooses for a slide or a run in time.
    class VibrationChoice
    {
    public:
      explicit VibrationChoice(const Scene &scene_)
          : scene(scene_)
      {
        if (!is_meshed(scene.analysis.model))
          return;
        const auto quantities = trial_quantities(scene);
        const double factor   = error_over_frequency(scene);
        DynamicsMaker maker(true, 2);
        Scene fine          = held_scene(scene);
        fine.analysis.model = ModelType::condensed;
        face_size           = estimated_contact_width(scene, contact_reference(scene).P) / slide_trial_faces;
        fine.mesh.face_size = face_size;
        const auto found    = check_slide(fine, maker);
        const auto change   = [&](const Scene &other)
        { return factor * difference(scene, found, check_slide(other, maker), quantities); };
        penalties     = maker.make(fine).meshed.penalties;
        penalty_error = change(with_penalties(fine, penalties, 1. / softer)) * finer_share(softer, 1.);
        // A run tells what half its modes change.
        for (unsigned int modes = 5; 2 * modes < fine.condensed.modes; modes *= 2)
          mode_errors.emplace_back(2 * modes, change(with_modes(fine, modes)));
        mesh_error = change(with_coarser_mesh(with_penalties(fine, penalties, 1.))) * finer_share(coarser, force_order(scene));
        if (scene.analysis.type == AnalysisType::stability) // of which a run tells the scatter, too
          mesh_error += largest_scatter(slides_over_face(fine, maker, &found), quantities);
        if (scene.accuracy.is_model_open)
        {
          Scene beam          = fine;
          beam.analysis.model = ModelType::beam;
          beam_error          = change(beam);
        }
      }

      Choice meeting(const double target) const
      {
        Choice choice;
        const bool beam = takes_beam(target);
        if (scene.accuracy.is_model_open)
          choice.settings.push_back(
              { "Analysis/Model", beam ? "beam" : "condensed", "the beam is " + percent(beam_error) + " off a condensed probe" });
        const bool meshed = !beam && is_meshed(scene.analysis.model);
        if (beam)
          choice.error = beam_error;
        if (!scene.accuracy.is_model_open && !is_meshed(scene.analysis.model))
          choice.limit = "What this model leaves out is not known; Analysis/Model = auto compares it with finite elements.";
        double size = scene.mesh.face_size;
        if (meshed && is_open(scene, "Mesh/Face size") && scene.mesh.file.empty())
          size = add_mesh(target, choice);
        if (meshed && is_open(scene, "Contact/Penalty") && scene.mesh.file.empty())
          add_penalty(target, size, choice);
        if (meshed && scene.analysis.model == ModelType::condensed && is_open(scene, "Condensed/Modes"))
          add_modes(target, choice);
        if (scene.analysis.type == AnalysisType::transient && is_open(scene, "Time/Tolerance") && is_open(scene, "Time/Step"))
        {
          choice.error += slide_step_share * target;
          choice.settings.push_back({ "Time/Tolerance", rounded_text(slide_step_share * target / step_error),
                                      "errors of P are about " + rounded_text(step_error) + " times as large" });
        }
        return choice;
      }

    private:
      const Scene scene;
      double face_size     = 0.;                                ///< of the finer trial run [mm]
      double mesh_error    = 0.;                                ///< of the finer trial run, of the worst quantity
      double beam_error    = 0.;                                ///< of the beam, likewise
      double penalty_error = 0.;                                ///< of the trial run's penalty, likewise
      ContactPenalties penalties{};                             ///< of the trial run
      std::vector<std::pair<unsigned int, double>> mode_errors; ///< of numbers of modes

      double largest_scatter(const std::vector<SlideStability> &places, const std::vector<std::string> &quantities) const
      {
        return largest(quantities,
                       [&](const std::string &quantity)
                       {
                         const auto value = value_for(scene, quantity);
                         return scatter(places, value) / std::abs(value(places.front()));
                       });
      }

      bool takes_beam(const double target) const
      {
        const double share = scene.analysis.type == AnalysisType::transient ? 1. - slide_step_share : slide_model_share;
        return scene.accuracy.is_model_open && beam_error <= share * target;
      }

      double add_mesh(const double target, Choice &choice) const
      {
        const bool is_held = scene.analysis.type == AnalysisType::stability;
        const double order = is_held ? held_order : force_order(scene);
        const double share = is_held ? held_mesh_share : slide_mesh_share;
        const double ideal = face_size * std::pow(share * target / std::max(mesh_error, 1e-12), 1. / order);
        const double size  = std::clamp(ideal, face_size / slide_finest, coarser * face_size);
        choice.error += mesh_error * std::pow(size / face_size, order);
        choice.settings.push_back({ "Mesh/Face size", rounded_text(size),
                                    "a probe with " + rounded_text(face_size) + " mm is " + percent(mesh_error) + " off" });
        if (ideal < size)
          choice.limit = "Faces of " + mm(size) + " are the shortest that a probe tells of.";
        return size;
      }

      void add_penalty(const double target, const double size, Choice &choice) const
      {
        Scene sized                = scene;
        sized.mesh.face_size       = size;
        const double most          = std::max(1., stiffest * largest_penalty(sized) / penalties.normal);
        const double needed_factor = std::max(1., penalty_error / (slide_penalty_share * target));
        const double factor        = std::min(needed_factor, most);
        if (factor < needed_factor)
          choice.limit = "A stiffer Contact/Penalty is too stiff for this mesh.";
        choice.error += penalty_error / factor;
        if (factor > 1.)
          choice.settings.push_back(
              { "Contact/Penalty", rounded_text(factor * penalties.normal),
                "with " + rounded_text(penalties.normal) + " N/mm3 it is " + percent(penalty_error) + " off" });
      }

      void add_modes(const double target, Choice &choice) const
      {
        for (const auto &[modes, error] : mode_errors)
          if (error <= slide_mode_share * target)
          {
            choice.error += error;
            choice.settings.push_back(
                { "Condensed/Modes", std::to_string(modes), "half of them are " + percent(error) + " off a probe with more" });
            return;
          }
      }
    };
  } // namespace

  ChooseToMeet choose_for_vibration(const Scene &scene)
  {
    return [all = VibrationChoice(scene)](const double target) { return all.meeting(target); };
  }
} // namespace sprag
