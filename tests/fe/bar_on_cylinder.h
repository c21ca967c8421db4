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

  inline FaceProperties make_properties(const ElasticBody<2> &body, const bool sprung, const double regularisation_speed)
  {
    const auto geometry = cylinder_below_bar();
    return { cylinder_centre(geometry),
             geometry.cylinder_radius,
             { static_cast<unsigned int>(surface_dofs(body).size()), sprung },
             rest_inclination,
             { 240., 120. },
             { CorkOnAluminium{}, FrictionSpeed::sliding, regularisation_speed },
             0.5,
             RigidCylinder(geometry, {}) };
  }
} // namespace sprag
