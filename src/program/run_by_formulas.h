// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "program/run_options.h"
#include "results/warning.h"

#include <functional>

namespace sprag
{
  struct Scene;

  /// A function that carries out an analysis.
  using Run = std::function<void(const Scene &, const RunOptions &, Warnings &)>;

  /// Carries out an analysis and prints its warnings at the end. Analyses that move along the drive or hold a slide first print
  /// the margin of a rigid lever to jamming.
  void run_from_margin_to_warnings(const Scene &scene, const RunOptions &options, const Run &analysis);

  /// Carries out the analysis of a scene that follows_formulas() and has no leaf spring. It throws what run() throws.
  void run_formulas(const Scene &scene, const RunOptions &options, Warnings &warnings);
} // namespace sprag
