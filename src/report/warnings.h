// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"
#include "results/warning.h"
#include "scene/lever.h"

#include <optional>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Returns the warnings that follow from the scene alone, before anything is computed. The scene is a prepared() one.
  Warnings scene_warnings(const Scene &scene);

  /// Returns the warnings that follow from the rows of a run, completed by add_closed_form(). Where a model has no friction face,
  /// layer_pressure() of the largest P stands for the largest pressure. Each lever of a pair is checked.
  Warnings row_warnings(const Scene &scene, const std::vector<Row> &rows);

  /// Throws AnalysisError where there are warnings and Analysis/Warnings = error; the message quotes the first of them.
  void check_warnings(const Scene &scene, const Warnings &warnings);

  /// Returns the warnings for a steady slide, by its row of x, v, v_rel, theta, P and indentation. `own_speed_share`: see
  /// HeldSlide.
  Warnings slide_warnings(const Scene &scene, const Row &slide, double own_speed_share);

  /// Warns of a growing vibration of a beam whose waves are too short for it, see highest_beam_frequency().
  /// `frequency` and `growth_rate` are its own [Hz, 1/s].
  Warnings beam_warnings(const Scene &scene, double frequency, double growth_rate);

  /// Warns of parameters that a verdict varies, and which do not change it; returns nothing where there are none.
  Warnings without_effect(const std::vector<std::string> &parameters);

  /// Returns Friction layer/Strength, or where it is auto and nu <= 0.2 the share 0.04 of Young's modulus at which the cells of
  /// cork buckle: 0.8 MPa of 20 MPa across the rings (Gibson, Easterling and Ashby, Proc. R. Soc. A 377 (1981) 99; Gibson and
  /// Ashby, Cellular Solids, table of cork). There is none without a layer and for other layers.
  std::optional<double> layer_strength(const FrictionLayer &layer);
} // namespace sprag
