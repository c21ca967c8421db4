#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace sprag
{
  // The quantities whose errors are told in /accuracy and may be asked for in Accuracy/Quantity, by their names.

  /// Returns those that an analysis tells; none where it tells none.
  std::vector<std::string> quantities_of(AnalysisType type);

  /// Returns those that Accuracy/Quantity = auto stands for.
  std::vector<std::string> usual_quantities_of(AnalysisType type);

  /// Returns whether a parameter, "Mesh/Face size", was left open: not given, or as auto.
  bool is_open(const Scene &scene, const std::string &parameter);
} // namespace sprag
