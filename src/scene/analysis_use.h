// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/analysis_settings.h"

#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Returns whether an analysis examines steady sliding frozen at one x.
  bool holds_slide(AnalysisType type);

  /// Returns whether an analysis takes a model of Analysis/Model, of one lever or a pair, along the drive or held at one x of it.
  bool runs_model(AnalysisType type);

  /// Returns whether an analysis distributes its parts over several processes.
  bool works_in_parallel(AnalysisType type);

  /// Returns whether several processes share one body: in three dimensions, or where the program chooses the dimension.
  bool shares_body(const Scene &scene);

  /// Returns whether the table of an isolation system works against levers of a model in time.
  bool isolates_by_model(const Scene &scene);

  /// Returns whether levers that a design proposes are meshed for a check model.
  bool is_checked_by_mesh(const Scene &scene);

  /// Returns whether a model corrects the closed form by which a measured stroke is identified.
  bool identifies_by_model(const Scene &scene);

  /// Returns whether anything of the scene is meshed, apart from a leaf spring and the levers of a design.
  bool needs_mesh(const Scene &scene);

  /// Returns whether formulas give the results without a model: for slope curves, the closed form, isolation systems without
  /// levers of a model, and a rigid lever in ideal contact in time.
  bool follows_formulas(const Scene &scene);

  /// Returns whether levers are linear and without inertia, so that they share their factors.
  bool is_factorised_once(const Scene &scene);

  /// Returns the scene with the condensed lever of its mesh in place of finite elements: a slide's growth is that of
  /// stability-a within 5e-5 and takes a hundredth of the time.
  Scene with_condensed_lever(Scene scene);

  // Names of the quantities in /accuracy, with estimated errors, that Accuracy/Quantity can refer to.

  /// Returns those of an analysis; empty if it estimates no errors.
  std::vector<std::string> accuracy_quantities(AnalysisType type);

  /// Returns those that a text of Accuracy/Quantity names, or with auto the main ones of an analysis.
  std::vector<std::string> quantities_meant(const std::string &text, AnalysisType type);

  /// Returns whether a parameter such as "Mesh/Face size" is not given, or given as auto.
  bool is_open(const Scene &scene, const std::string &parameter);

  /// Returns whether the program has chosen a parameter so that an accuracy is met.
  bool is_chosen(const Scene &scene, const std::string &parameter);
} // namespace sprag
