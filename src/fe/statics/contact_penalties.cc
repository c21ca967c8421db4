// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/contact_penalties.h"

#include "scene/device.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    /// This times E/depth of the layer is the penalty. The penetration is then a tenth of the layer's compression, which moves P
    /// by 0.03 % and the largest pressure by 3 %.
    constexpr double penalty_factor = 12.;

    /// Leaves 0.25 % of the largest pressure where the cells are as fine as that takes.
    constexpr double largest_penalty_factor = 200.;

    /// This times E/length of the cells, of degree 2, is the penalty without a layer. Much stiffer penalties make a contact
    /// narrower than the cells, which then tilts with each of them. Linear cells meet a circle with their chords, whose pressures
    /// would show.
    constexpr double penalty_over_cells = 12.5;

    /// In time the penalty lies in series with the layer and slows the ringing: by 2.4 % at 12, by 0.25 % at this one. Linear
    /// elements would ring as they pass under such a contact.
    constexpr double in_time        = 120.;
    constexpr double in_time_linear = 12.;

    template <int dim>
    double automatic_penalty(const FrictionFace<dim> &face, const Enforcement enforcement, const double layer_thickness,
                             const double longest)
    {
      constexpr unsigned int corners = dim == 2 ? 2 : 4;
      const double by_layer          = penalty_factor * face.young_modulus / std::max(face.depth, layer_thickness);
      if (face.edges.front().nodes.size() == corners)
        return by_layer;
      const auto shorter    = [](const auto &a, const auto &b) { return a.length < b.length; };
      const double shortest = std::min_element(face.elements.begin(), face.elements.end(), shorter)->length;
      const double length   = std::max(shortest, longest);
      const double by_cells = std::max(by_layer, penalty_over_cells * face.young_modulus / length);
      if (enforcement == Enforcement::augmented_lagrangian)
        return by_cells;
      return std::min(by_cells, largest_penalty_factor / penalty_factor * by_layer);
    }

    template <int dim>
    ContactPenalties face_penalties(const FrictionFace<dim> &face, const ContactSettings &settings, const double layer_thickness,
                                    const std::optional<double> &over_layer, const double longest)
    {
      const double automatic = over_layer && settings.enforcement == Enforcement::penalty
                                   ? *over_layer * face.young_modulus / std::max(face.depth, layer_thickness)
                                   : automatic_penalty(face, settings.enforcement, layer_thickness, longest);
      const double normal    = settings.penalty.value_or(automatic);
      return { normal, settings.tangential_penalty.value_or(normal) };
    }

    FaceProperties make_properties(const LeverProperties &lever, const InterfaceLayout &layout, const ContactPenalties &penalties,
                                   const Cylinder &cylinder, const bool half)
    {
      return { lever.centre,
               lever.radius,
               layout,
               lever.spring.rest,
               penalties,
               lever.friction,
               lever.layer_thickness,
               RigidCylinder(lever.geometry, cylinder),
               half };
    }
  } // namespace

  template <int dim>
  ContactPenalties contact_penalties(const ElasticBody<dim> &body, const ContactSettings &settings, const double layer_thickness,
                                     const std::optional<double> &over_layer, const double longest)
  {
    const auto lever = face_penalties(body.friction_face(), settings, layer_thickness, over_layer, longest);
    if (body.cylinder_face().elements.empty())
      return lever;
    const auto cylinder = face_penalties(body.cylinder_face(), settings, 0., over_layer, 0.);
    return { std::min(lever.normal, cylinder.normal), std::min(lever.tangential, cylinder.tangential) };
  }

  template <int dim>
  ContactPenalties penalties_in_time(const Device &device, const ElasticBody<dim> &body)
  {
    const double factor = device.mesh.degree == 1 ? in_time_linear : in_time;
    return contact_penalties(body, device.contact, device.layer.thickness, factor);
  }

  FaceProperties face_properties(const ElasticBody<2> &, const LeverProperties &lever, const InterfaceLayout &layout,
                                 const ContactPenalties &penalties)
  {
    return make_properties(lever, layout, penalties, {}, false);
  }

  FaceProperties face_properties(const SolidBody &body, const LeverProperties &lever, const InterfaceLayout &layout,
                                 const ContactPenalties &penalties)
  {
    return make_properties(lever, layout, penalties, lever.cylinder, body.is_half());
  }

  template ContactPenalties contact_penalties(const ElasticBody<2> &, const ContactSettings &, double,
                                              const std::optional<double> &, double);
  template ContactPenalties contact_penalties(const ElasticBody<3> &, const ContactSettings &, double,
                                              const std::optional<double> &, double);
  template ContactPenalties penalties_in_time(const Device &, const ElasticBody<2> &);
  template ContactPenalties penalties_in_time(const Device &, const ElasticBody<3> &);
} // namespace sprag
