// SPDX-License-Identifier: GPL-3.0-only
#include "scene/contact_width.h"

#include "scene/closed_form.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    // Shares of Mesh/Face size: of the shortest faces, as the width of a contact begins at none, and of the longest.
    constexpr double shortest_share = 0.25;
    constexpr double least_longest  = 0.5;

    constexpr double room_behind  = 4.;  ///< shortest faces beyond the last place of the contact's centre
    constexpr unsigned int places = 256; ///< of the drive that are looked at

    double needed_length(const Scene &scene, const double x)
    {
      const double v = scene.drive.peak_speed();
      const double P = std::min(closed_form(scene, x, v).P, closed_form(scene, x, -v).P);
      return estimated_contact_width(scene, std::max(0., P)) / scene.mesh.faces_in_contact;
    }
  } // namespace

  double estimated_contact_width(const Scene &scene, const double P)
  {
    const auto &layer    = scene.layer;
    const bool has_layer = layer.thickness > 0.;
    const double E       = has_layer ? layer.young_modulus : scene.lever.young_modulus;
    const double nu      = has_layer ? layer.poisson_ratio : scene.lever.poisson_ratio;
    const double load    = P * scene.geometry.cylinder_radius * (1. - nu * nu) / (scene.lever.width * E);
    const double hertz   = 4. * std::sqrt(load / M_PI);
    return has_layer ? std::min(hertz, 2. * std::cbrt(1.5 * load * layer.thickness)) : hertz;
  }

  std::optional<FaceGrading> face_grading(const Scene &scene)
  {
    const double size = scene.mesh.face_size;
    const double from = scene.drive.minimum();
    const double way  = scene.drive.maximum() - from;
    if (!(scene.mesh.faces_in_contact > 0.) || !scene.mesh.file.empty() || scene.lever.outline != LeverOutline::bar)
      return {};
    const double longest  = std::min(size, needed_length(scene, scene.drive.maximum()));
    const double shortest = std::max(shortest_share * size, needed_length(scene, from));
    if (longest < least_longest * size || shortest >= longest)
      return {};
    double x = from;
    for (unsigned int i = 1; i <= places && needed_length(scene, x) < longest; ++i)
      x = from + way * i / places;
    const double end = kinematics(scene.geometry, from).s + room_behind * shortest;
    return FaceGrading{ kinematics(scene.geometry, x).s, end, longest, shortest };
  }

  double layer_pressure(const Scene &scene, const double P)
  {
    const double t       = scene.layer.thickness;
    const double nu      = scene.layer.poisson_ratio;
    const double modulus = scene.layer.plane == PlaneState::stress
                               ? scene.layer.young_modulus / (1. - nu * nu)
                               : scene.layer.young_modulus * (1. - nu) / ((1. + nu) * (1. - 2. * nu));
    if (t == 0.)
      return 0.;
    const double half_width_at_unit_pressure = std::sqrt(2. * scene.geometry.cylinder_radius * t / modulus);
    return std::pow(0.75 * P / (scene.lever.width * half_width_at_unit_pressure), 2. / 3.);
  }
} // namespace sprag
