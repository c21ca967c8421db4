// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "analytic/error_estimate.h"
#include "levers/dynamics.h"

#include <functional>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Checks the slide of a meshed scene at places over a face of its mesh, where there is one; the first may be known already.
  std::vector<SlideStability> slides_over_face(const Scene &scene, DynamicsMaker &maker, const SlideStability *known = nullptr);

  using SlideValue = std::function<double(const SlideStability &)>;

  /// Returns how far a value scatters over such places, root mean square.
  double scatter(const std::vector<SlideStability> &places, const SlideValue &value);

  /// Estimates the errors of growth_rate and frequency of a meshed lever's held slide. The same slide is checked with a third of
  /// the penalty and, over places between the nodes, on its mesh and one of twice the Mesh/Face size. The changes tell the error
  /// by Richardson as in quasi_static_accuracy(), that of the mesh by means over the places, whose scatter on its own mesh adds
  /// to it. A condensed lever is checked with half its modes too, and what they change counts whole. If another mode
  /// grows most on one of them, its distance in frequency counts whole. Empty for levers without a mesh.
  ///
  /// `scene` is that of the slide, see held_scene(); `maker` made its model, whose facts are `dynamics`.
  std::vector<ErrorEstimate> vibration_accuracy(const Scene &scene, const SlideStability &found, const MeshedDynamics &dynamics,
                                                DynamicsMaker &maker);

  /// Estimates the errors of a finished run in time, of P, overshoot, frequency and decay of the ringing behind the first
  /// reversal.
  ///
  /// The slide behind that reversal is held, and the vibration nearest to the frequency of P checked as vibration_accuracy()
  /// does: that gives the parts of mesh, penalty and modes, to the overshoot alone with the scatter over places. The part of the
  /// step is the frequency error of the generalised-alpha method, see estimate_step_errors(). A vibration that is too slow lags
  /// behind, the more the longer it rings, see change_by_frequency(), up to where its decay takes more than the lag adds. The
  /// overshoot is wrong as the stiffness is, with the square of the frequency, and a peak may lie between two rows. If P vibrates
  /// before the drive turns, as passing elements excite it or the slide grows there, the part `vibration` tells that this goes on
  /// through the ringing at any phase: to P its amplitude, to the overshoot the root mean square. The frequency is a mean of
  /// both, weighted by their integrals over the window, or where it is far from the slide's it is the other vibration's. The
  /// decay has the parts of the vibration's, for the step the algorithmic damping, and `fit`: how far the envelope's decay is
  /// from that of the slide. Reduced levers have the parts of step and vibration alone: only finite elements show what they leave
  /// out.
  ///
  /// Drives without a reversal, contacts that open and slides that grow on their own have no estimate, but the reason in words.
  std::vector<ErrorEstimate> transient_accuracy(const Scene &scene, const MeshedDynamics &dynamics, const std::vector<Row> &rows,
                                                DynamicsMaker &maker);
} // namespace sprag
