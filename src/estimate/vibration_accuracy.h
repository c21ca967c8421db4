// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "analytic/error_estimate.h"
#include "fe/contact/face_contact_point.h"

#include <functional>
#include <optional>

namespace sprag
{
  struct Scene;

  /// The slide of a scene by models that are less accurate, each in one respect, and at other places between the nodes.
  struct SlideTrials
  {
    SlideStability soft;                       ///< with a third of the penalty
    std::optional<SlideStability> other_modes; ///< of a condensed lever with several, half of them
    std::vector<SlideStability> elsewhere;     ///< a quarter, half and three quarters of a face from its place, same mesh
    SlideStability other_mesh;                 ///< on the mesh of with_compared_mesh(), with as many modes as `other_modes`
  };

  /// Checks the slide of a meshed scene, see held_scene(), by these models. The run's own mesh stays in the maker.
  SlideTrials run_slide_trials(const Scene &scene, const ContactPenalties &penalties, DynamicsMaker &maker);

  /// Returns the parts of the error of a value of the slide, relative to it, from what the trial runs change by Richardson; what
  /// another number of modes changes counts whole. That of the mesh is at least the range of values at places between two nodes:
  /// where few faces are in contact, two meshes may agree by chance.
  std::vector<ErrorPart> slide_error_parts(const Scene &scene, const SlideStability &found, const SlideTrials &trial_runs,
                                           const std::function<double(const SlideStability &)> &value);

  /// Estimates the errors of growth_rate and frequency of a meshed lever's held slide: the same slide is checked with a third of
  /// the penalty and on a mesh of twice the Mesh/Face size, and the change tells the error by Richardson as it does in
  /// quasi_static_accuracy(); a condensed lever is checked there with half its modes too, and what they change counts whole.
  /// Empty for levers without a mesh.
  ///
  /// `scene` is that of the slide, see held_scene(); `maker` made its model, whose facts are `dynamics`.
  std::vector<ErrorEstimate> vibration_accuracy(const Scene &scene, const SlideStability &found, const MeshedDynamics &dynamics,
                                                DynamicsMaker &maker);
} // namespace sprag
