// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/vibration_accuracy.h"

#include "estimate/coarser_scene.h"
#include "estimate/vibration_accuracy.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sprag
{
  namespace
  {
    /// Shifts of the slide over the length of a face element, to see how far its place between the nodes matters.
    constexpr double face_shares[] = { 0.25, 0.5, 0.75 };

    /// Modes that a lever with one alone is compared with.
    constexpr unsigned int several_modes = 4;
  } // namespace

  SlideTrials run_slide_trials(const Scene &scene, const ContactPenalties &penalties, DynamicsMaker &maker)
  {
    SlideTrials result;
    result.soft = check_slide(with_penalties(scene, penalties, 1. / softer), maker);
    {
      const Scene held    = held_scene(scene);
      const auto dynamics = maker.make(held);
      for (const double share : face_shares)
      {
        DrivePoint drive  = held_drive(scene);
        const double away = share * scene.mesh.face_size;
        drive.x += drive.x - away > scene.drive.minimum() ? -away : away;
        if (auto slide = check_slide(dynamics.model(), drive, checked_modes(held)); slide.slide)
          result.elsewhere.push_back(std::move(slide));
      }
    }
    Scene other = with_compared_mesh(with_penalties(scene, penalties, 1.));
    if (scene.analysis.model == ModelType::condensed && scene.condensed.modes > 1)
    {
      other.condensed.modes = scene.condensed.modes / 2;
      const auto dynamics   = maker.make(scene, other.condensed.modes);
      result.other_modes    = check_slide(dynamics.model(), held_drive(scene), checked_modes(scene));
    }
    else if (scene.analysis.model == ModelType::condensed)
    {
      other.condensed.modes = several_modes;
      Scene more            = scene;
      more.condensed.modes  = several_modes;
      DynamicsMaker finer_maker;
      result.other_modes = check_slide(more, finer_maker);
    }
    DynamicsMaker other_maker;
    result.other_mesh = check_slide(other, other_maker);
    return result;
  }

  std::vector<ErrorPart> slide_error_parts(const Scene &scene, const SlideStability &found, const SlideTrials &trial_runs,
                                           const std::function<double(const SlideStability &)> &value)
  {
    const auto difference = [&](const SlideStability &a, const SlideStability &b)
    { return std::abs((value(a) - value(b)) / value(found)); };
    const auto &on_mesh = trial_runs.other_modes ? *trial_runs.other_modes : found;
    ErrorPart mesh      = mesh_part(scene, difference(trial_runs.other_mesh, on_mesh), force_order(scene));
    double least = value(found), most = value(found);
    for (const auto &slide : trial_runs.elsewhere)
    {
      least = std::fmin(least, value(slide)); // passes over places without a slide
      most  = std::fmax(most, value(slide));
    }
    mesh.value                   = std::max(mesh.value, (most - least) / std::abs(value(found)));
    std::vector<ErrorPart> parts = { mesh, penalty_part(scene, difference(trial_runs.soft, found)) };
    if (trial_runs.other_modes)
      parts.push_back({ "modes", difference(*trial_runs.other_modes, found), "Try twice the Condensed/Modes." });
    return parts;
  }

  std::vector<ErrorEstimate> vibration_accuracy(const Scene &scene, const SlideStability &found, const MeshedDynamics &dynamics,
                                                DynamicsMaker &maker)
  {
    if (!is_meshed(scene.analysis.model))
      return {};
    const auto estimate = [&]
    {
      if (!(found.frequency() > 0.))
        throw NoEstimate{ "the mode that grows most does not oscillate." };
      const auto trial_runs = run_slide_trials(scene, dynamics.penalties, maker);
      if (!(trial_runs.other_mesh.frequency() > 0.) || !(trial_runs.soft.frequency() > 0.))
        throw NoEstimate{ "on another mesh or with a softer penalty the mode that grows most does not oscillate." };
      const auto parts = [&](const auto &value) { return slide_error_parts(scene, found, trial_runs, value); };
      return std::vector<ErrorEstimate>{
        { "growth_rate",
          "it, and beyond 100 % the verdict may flip",
          parts([](const SlideStability &slide) { return slide.growth_rate(); }),
          {} },
        { "frequency", "it", parts([](const SlideStability &slide) { return slide.frequency(); }), {} }
      };
    };
    return estimates_or_reason(scene, { "growth_rate", "frequency" }, estimate);
  }
} // namespace sprag
