// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "analytic/error_estimate.h"

namespace sprag
{
  struct Scene;

  /// Estimates the errors of growth_rate and frequency of a meshed lever's held slide: the same slide is judged with a third of
  /// the penalty and on a mesh of twice the Mesh/Face size, and the change tells the error by Richardson as it does in
  /// quasi_static_accuracy(); a condensed lever is judged there with half its modes too, and what they change counts whole. Empty
  /// for levers without a mesh.
  ///
  /// `scene` is that of the slide, see held_scene(); `maker` made its model, whose facts are `dynamics`.
  std::vector<ErrorEstimate> vibration_accuracy(const Scene &scene, const SlideStability &found, const MeshedDynamics &dynamics,
                                                DynamicsMaker &maker);
} // namespace sprag
