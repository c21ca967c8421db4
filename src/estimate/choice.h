// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/scene.h"

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  struct SlideStability;

  /// A parameter that was left open, the value chosen for it and why, a sentence.
  struct ChosenSetting
  {
    std::string parameter; ///< "Mesh/Face size"
    std::string value;
    std::string reason;
  };

  /// Settings that meet a scene's Accuracy.
  struct Choice
  {
    std::vector<ChosenSetting> settings;
    double error = 0.; ///< that is expected of the worst quantity, relative
    std::string limit; ///< why the target is not met, a sentence; empty where it is
  };

  /// Returns the scene with these settings.
  Scene with_settings(const Scene &scene, const std::vector<ChosenSetting> &settings);

  /// Returns the scene with the part of Accuracy/Budget that is left of it since the process had used so much CPU time [s].
  Scene with_budget_left(Scene scene, double since);

  /// Returns whether Accuracy/Budget pays what a run with these settings is expected to cost.
  bool is_paid(const Scene &scene, const Choice &choice);

  /// Returns whether a quantity is among Accuracy/Quantity.
  bool is_requested(const Scene &scene, const std::string &quantity);

  /// Returns the frequency of a slide by which settings are chosen [Hz]: that of the largest growth rate, or in time, where P
  /// rings, the one nearest to a rigid lever's on its contact.
  double ringing_frequency(const Scene &scene, const SlideStability &slide);

  /// Returns the scene in the plane, its cylinder true.
  Scene to_plane(Scene scene);

  /// Called with a sentence about a dear trial run and the CPU time that it is expected to take [s]; returns whether to solve it.
  using Announce = std::function<bool(const std::string &, double)>;

  /// Goes on without a word.
  inline bool solve_silently(const std::string &, double)
  {
    return true;
  }

  /// Chooses what the file leaves open so that Accuracy/Target is met, or of what Accuracy/Budget pays the most accurate. Makes
  /// trial runs: models of the scene on coarser meshes, in three dimensions too those of the plane; of the elements across these
  /// do not tell. Throws AnalysisError where trial runs have no equilibrium.
  Choice choose_settings(const Scene &scene, const Announce &announce = solve_silently);

  /// A scene that can be run, and what was chosen on the way.
  struct Resolved
  {
    Scene scene;
    std::optional<Choice> choice; ///< none where the scene leaves nothing open
  };

  /// Computes what a scene as it was read needs for a run: its leaf spring, and what it leaves open. The runs of a study are
  /// resolved one by one. Throws InputError where a scene is refused, AnalysisError as choose_settings() does.
  Resolved resolved(const Scene &original, const Announce &announce = solve_silently);

  /// Chooses to meet a relative error > 0.
  using ChooseToMeet = std::function<Choice(double target)>;

  /// Solves the trial runs of a run without inertia, and returns what chooses for it. Throws InputError where memory does not
  /// suffice.
  ChooseToMeet choose_without_inertia(const Scene &scene, const Announce &announce = solve_silently);

  /// Checks a slide, or that of a run in time, by trial runs, and returns what chooses for it.
  ChooseToMeet choose_for_vibration(const Scene &scene);

  /// Returns "Mesh/Face size = 0.6; Analysis/Step = 2".
  std::string to_text(const std::vector<ChosenSetting> &settings);

  /// Prints what was chosen and why.
  void print_choice(std::ostream &stream, const Scene &scene, const Choice &choice);
} // namespace sprag
