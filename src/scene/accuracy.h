// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/analysis_settings.h"

#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  // The quantities whose errors are told in /accuracy and may be asked for in Accuracy/Quantity, by their names.

  /// Returns those that an analysis tells; none where it tells none.
  std::vector<std::string> accuracy_quantities(AnalysisType type);

  /// Returns those that a text of Accuracy/Quantity means: those that it names, or with auto those that an analysis is mostly
  /// asked for.
  std::vector<std::string> quantities_meant(const std::string &text, AnalysisType type);

  /// Returns whether a parameter, "Mesh/Face size", was left open: not given, or as auto.
  bool is_open(const Scene &scene, const std::string &parameter);
} // namespace sprag
