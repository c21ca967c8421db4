// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "bar.h"
#include "fe/contact/face_contact.h"
#include "fe/dynamics/lever_interface.h"

#include <cmath>

namespace sprag
{
  // A bar of 20 mm whose lower side, turned by 0.05, lies on the cylinder some 12 mm from the pivot.

  inline constexpr double rest_inclination = 0.05;

  inline Bar bar_on_cylinder()
  {
    Bar bar;
    bar.n = 40;
    return bar;
  }

  inline Geometry cylinder_below_bar()
  {
    const double R = 6.;
    // Touching at x = 0: l sin theta + h cos theta = R - e.
    return { R, 3., 12., (R - 3. - 12. * std::sin(rest_inclination)) / std::cos(rest_inclination) };
  }

  inline FaceProperties<2> make_properties(const ElasticBody<2> &body, const bool sprung, const double regularisation_speed)
  {
    FaceProperties<2> result;
    const auto geometry     = cylinder_below_bar();
    result.counterface      = cylinder(geometry);
    result.centre           = cylinder_centre(geometry);
    result.radius           = geometry.cylinder_radius;
    result.layout           = { static_cast<unsigned int>(surface_dofs(body).size()), sprung };
    result.rest_inclination = rest_inclination;
    result.penalties        = { 240., 120. };
    result.friction         = { CorkOnAluminium{}, FrictionSpeed::sliding, regularisation_speed };
    result.layer_thickness  = 0.5;
    return result;
  }
} // namespace sprag
