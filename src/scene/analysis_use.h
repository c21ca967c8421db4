// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/analysis_settings.h"

#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Returns whether an analysis looks at the slide held at one x.
  bool holds_slide(AnalysisType type);

  /// Returns whether an analysis takes a model of Analysis/Model, of one lever or a pair, along the drive or held at one x of it.
  bool runs_model(AnalysisType type);

  /// Returns whether an analysis has pieces that several processes share.
  bool works_in_parallel(AnalysisType type);

  /// Returns whether several processes share the body of an analysis, which is in three dimensions or may turn out to be.
  bool shares_body(const Scene &scene);

  /// Returns whether the table of an isolation system works against levers of a model in time.
  bool isolates_by_model(const Scene &scene);

  /// Returns whether levers that a design proposes are meshed for a check model.
  bool is_checked_by_mesh(const Scene &scene);

  /// Returns whether a model corrects the closed form by which a measured stroke is identified.
  bool identifies_by_model(const Scene &scene);

  /// Returns whether anything of the scene is meshed, apart from a leaf spring and the levers of a design.
  bool needs_mesh(const Scene &scene);

  /// Returns whether formulas give the results and no model is made: of the slope's sweep, an isolation system without such
  /// levers, the closed form, and in time the ideal contact of a rigid lever.
  bool follows_formulas(const Scene &scene);

  // The quantities whose errors are told in /accuracy and may be asked for in Accuracy/Quantity, by their names.

  /// Returns those that an analysis tells; none where it tells none.
  std::vector<std::string> accuracy_quantities(AnalysisType type);

  /// Returns those that a text of Accuracy/Quantity means: those that it names, or with auto those that an analysis is mostly
  /// asked for.
  std::vector<std::string> quantities_meant(const std::string &text, AnalysisType type);

  /// Returns whether a parameter, "Mesh/Face size", was left open: not given, or as auto.
  bool is_open(const Scene &scene, const std::string &parameter);
} // namespace sprag
