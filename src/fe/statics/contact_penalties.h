// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"
#include "fe/contact/face_contact_point.h"
#include "scene/contact_settings.h"

#include <optional>

namespace sprag
{
  /// Automatic normal penalty over E/depth of the friction layer or, without one, of the first cells, where it is not that of a
  /// run without inertia.
  namespace penalty_over_layer
  {
    /// In time the penalty lies in series with the layer and slows the ringing: by 2.4 % at 12, by 0.25 % at this one. Linear
    /// elements would ring as they pass under such a contact.
    constexpr double in_time        = 120.;
    constexpr double in_time_linear = 12.;

    /// Hard contact, to which laws of the reduced models are fitted.
    constexpr double indentation = 1200.;
  } // namespace penalty_over_layer

  /// The settings' penalties, or `over_layer` E/depth, or without it what suits mesh and layer of a run without inertia or of the
  /// augmented Lagrangian. `longest` is the length of the longest cells where the contact passes, of a graded mesh [mm]; 0: they
  /// are as long as the shortest.
  template <int dim>
  ContactPenalties contact_penalties(const FrictionFace<dim> &face, const ContactSettings &settings, double layer_thickness,
                                     const std::optional<double> &over_layer, double longest = 0.);

  /// The same of a body; with an elastic cylinder the softer of both faces counts.
  ContactPenalties contact_penalties(const ElasticBody<2> &body, const ContactSettings &settings, double layer_thickness,
                                     const std::optional<double> &over_layer, double longest = 0.);
} // namespace sprag
