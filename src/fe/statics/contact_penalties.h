// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"
#include "fe/contact/face_contact_point.h"
#include "scene/discretisation_settings.h"

#include <optional>

namespace sprag
{
  struct Device;

  /// Automatic normal penalty over E/depth of the friction layer or, without one, of the first cells, of hard contact, to which
  /// laws of the reduced models are fitted.
  constexpr double indentation_penalty = 1200.;

  /// The settings' penalties, or `over_layer` E/depth, or without it what suits mesh and layer of a run without inertia or of the
  /// augmented Lagrangian. `longest` is the length of the longest cells where the contact passes, of a graded mesh [mm]; 0: they
  /// are as long as the shortest.
  template <int dim>
  ContactPenalties contact_penalties(const FrictionFace<dim> &face, const ContactSettings &settings, double layer_thickness,
                                     const std::optional<double> &over_layer, double longest = 0.);

  /// The same of a body; with an elastic cylinder the softer of both faces counts.
  ContactPenalties contact_penalties(const ElasticBody<2> &body, const ContactSettings &settings, double layer_thickness,
                                     const std::optional<double> &over_layer, double longest = 0.);

  /// The same in time, of a face in space or a body in a plane.
  template <class Source>
  ContactPenalties penalties_in_time(const Device &device, const Source &source);

  /// Returns the properties of the contact of a lever (0, of a pair also 1) in time.
  ContactProperties contact_in_time(const Device &device, const InterfaceLayout &layout, const ContactPenalties &penalties,
                                    unsigned int lever);
} // namespace sprag
