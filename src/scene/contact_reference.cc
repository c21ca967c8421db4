// SPDX-License-Identifier: GPL-3.0-only
#include "scene/contact_reference.h"

#include "scene/closed_form.h"
#include "scene/contact_width.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    /// P of the closed form over the drive, both ways at peak speed, with s at the largest. It is infinite where the lever locks.
    void set_forces(const Scene &scene, ContactReference &result)
    {
      constexpr unsigned int samples = 64;
      const double from              = scene.drive.minimum();
      const double to                = scene.drive.maximum();
      result.smallest_P              = std::numeric_limits<double>::infinity();
      for (unsigned int i = 0; i <= samples; ++i)
        for (const double direction : { 1., -1. })
        {
          const auto state = closed_form(scene, from + (to - from) * i / samples, direction * scene.drive.peak_speed());
          if (!std::isfinite(state.P) || state.P < 0.)
            continue;
          result.smallest_P = std::min(result.smallest_P, state.P);
          if (state.P <= result.P)
            continue;
          result.P = state.P;
          result.s = state.contact.s;
        }
    }

    /// Returns dP/d(delta) of a contact of width w [N/mm]: b E w/(h (1 - nu^2)) of a thin bonded layer of thickness h, and of a
    /// contact that is narrow against it pi b E/(2 (1 - nu^2) log(1 + 2.426 h/w)), which tends to Johnson, Contact Mechanics,
    /// eq. 5.57. The larger of the two is within some 5 % of indentation by finite elements where nu is small, and up to a third
    /// too small at nu = 0.4. A bare lever is its own layer, and the cylinder counts as rigid.
    double stiffness_of_face(const Scene &scene, const double P)
    {
      const bool has_layer = scene.layer.thickness > 0.;
      const double h       = has_layer ? scene.layer.thickness : scene.lever.depth;
      const double E       = has_layer ? scene.layer.young_modulus : scene.lever.young_modulus;
      const double nu      = has_layer ? scene.layer.poisson_ratio : scene.lever.poisson_ratio;
      const bool is_short  = scene.analysis.dimension == 3 && scene.cylinder.length > 0.;
      const double width   = is_short ? std::min(scene.lever.width, scene.cylinder.length) : scene.lever.width;
      const double slender = h / estimated_contact_width(scene, P);
      return width * E / (1. - nu * nu) / std::min(slender, M_2_PI * std::log1p(2.426 * slender));
    }

    /// Returns dP/d(delta) of the contact law of reduced models [N/mm].
    double stiffness_of_law(const ContactSettings &contact, const double P)
    {
      const double n = contact.exponent;
      return n * std::pow(contact.stiffness, 1. / n) * std::pow(P, 1. - 1. / n);
    }
  } // namespace

  ContactReference contact_reference(const Scene &scene)
  {
    const auto &contact = scene.contact;
    const auto &layer   = scene.layer;
    ContactReference result{};
    set_forces(scene, result);

    result.stiffness = is_meshed(scene.analysis.model) ? stiffness_of_face(scene, result.P) : stiffness_of_law(contact, result.P);
    const double omega = result.s * std::sqrt(result.stiffness / moment_of_inertia(scene));
    result.relaxation  = 2. * contact.damping / omega;
    const double nu    = layer.thickness > 0. ? layer.poisson_ratio : scene.lever.poisson_ratio;
    result.tangential  = contact.tangential_stiffness.value_or(result.stiffness / (2. * (1. + nu)));
    return result;
  }

  ContactLaw law_of_face(const Scene &scene)
  {
    if (!is_meshed(scene.analysis.model))
      return { scene.contact.stiffness, scene.contact.exponent };
    constexpr double n   = 1.5;
    const auto reference = contact_reference(scene);
    return { std::pow(reference.stiffness / n, n) / std::sqrt(reference.P), n };
  }

  double neutral_axis_offset(const Scene &scene)
  {
    const double mesh = scene.geometry.interface_offset + scene.layer.thickness + 0.5 * scene.lever.depth;
    return scene.lever.neutral_axis_offset.value_or(mesh);
  }

  double added_inertia(const Scene &scene)
  {
    const Lever &lever = scene.lever;
    const double e_a   = neutral_axis_offset(scene);
    return lever.tip_mass * (lever.length * lever.length + e_a * e_a) + lever.hub_inertia + scene.spring.behaviour.inertia;
  }

  double mass_per_length(const Scene &scene)
  {
    const Lever &lever = scene.lever;
    if (lever.inertia == InertiaSource::as_built)
      return lever.width * (lever.depth * lever.density + scene.layer.thickness * scene.layer.density);
    const double L   = lever.length;
    const double e_a = neutral_axis_offset(scene);
    return (lever.moment_of_inertia - added_inertia(scene)) / (L * L * L / 3. + L * e_a * e_a);
  }

  double moment_of_inertia(const Scene &scene)
  {
    if (scene.lever.inertia == InertiaSource::scaled)
      return scene.lever.moment_of_inertia;
    const double L   = scene.lever.length;
    const double e_a = neutral_axis_offset(scene);
    return mass_per_length(scene) * (L * L * L / 3. + L * e_a * e_a) + added_inertia(scene);
  }
} // namespace sprag
