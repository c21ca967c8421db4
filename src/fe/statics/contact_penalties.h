// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact_point.h"
#include "fe/statics/lever_properties.h"
#include "fe/statics/solid_body.h"

#include <optional>

namespace sprag
{
  struct Device;

  /// Normal penalty of hard contact over E/depth of the friction layer or, without one, of the first cells. Contact laws of the
  /// reduced models are fitted to it.
  constexpr double indentation_penalty = 1200.;

  /// Returns the penalties of the settings. An automatic normal one is `over_layer` E/depth where contact is enforced by penalty;
  /// without `over_layer`, or by the augmented Lagrangian, it follows from layer and mesh. `longest` is the length of the longest
  /// cells where the contact passes, of a graded mesh [mm]; 0: they are as long as the shortest. With an elastic cylinder the
  /// softer of both faces counts.
  template <int dim>
  ContactPenalties contact_penalties(const ElasticBody<dim> &body, const ContactSettings &settings, double layer_thickness,
                                     const std::optional<double> &over_layer, double longest = 0.);

  /// The same in time.
  template <int dim>
  ContactPenalties penalties_in_time(const Device &device, const ElasticBody<dim> &body);

  // Properties of the contact of a lever.
  FaceProperties face_properties(const ElasticBody<2> &body, const LeverProperties &lever, const InterfaceLayout &layout,
                                 const ContactPenalties &penalties);
  FaceProperties face_properties(const SolidBody &body, const LeverProperties &lever, const InterfaceLayout &layout,
                                 const ContactPenalties &penalties);

  // Number of slopes that the axis of the cylinder may change before a body.
  inline unsigned int count_slopes(const ElasticBody<2> &, const Cylinder &)
  {
    return 0;
  }
  inline unsigned int count_slopes(const SolidBody &body, const Cylinder &cylinder)
  {
    return body.is_half() || !cylinder.has_free_axis() ? 0 : 2;
  }
} // namespace sprag
