// SPDX-License-Identifier: GPL-3.0-only
#include "scene/contact_width.h"

#include "scene/closed_form.h"
#include "scene/device.h"

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

    double needed_length(const Device &device, const double x)
    {
      const double v = device.drive.peak_speed();
      const double P = std::min(closed_form(device, x, v).P, closed_form(device, x, -v).P);
      return estimated_contact_width(device, std::max(0., P)) / device.mesh.faces_in_contact;
    }
  } // namespace

  double estimated_contact_width(const Device &device, const double P)
  {
    const auto &layer    = device.layer;
    const bool has_layer = layer.thickness > 0.;
    const double E       = has_layer ? layer.young_modulus : device.lever.young_modulus;
    const double nu      = has_layer ? layer.poisson_ratio : device.lever.poisson_ratio;
    const double load    = P * device.geometry.cylinder_radius * (1. - nu * nu) / (device.lever.width * E);
    const double hertz   = 4. * std::sqrt(load / M_PI);
    return has_layer ? std::min(hertz, 2. * std::cbrt(1.5 * load * layer.thickness)) : hertz;
  }

  std::optional<FaceGrading> face_grading(const Device &device)
  {
    const double size = device.mesh.face_size;
    const double from = device.drive.minimum();
    const double way  = device.drive.maximum() - from;
    if (!(device.mesh.faces_in_contact > 0.) || !device.mesh.file.empty() || device.lever.outline != LeverOutline::bar)
      return {};
    const double longest  = std::min(size, needed_length(device, device.drive.maximum()));
    const double shortest = std::max(shortest_share * size, needed_length(device, from));
    if (longest < least_longest * size || shortest >= longest)
      return {};
    double x = from;
    for (unsigned int i = 1; i <= places && needed_length(device, x) < longest; ++i)
      x = from + way * i / places;
    const double end = kinematics(device.geometry, from).s + room_behind * shortest;
    return FaceGrading{ kinematics(device.geometry, x).s, end, longest, shortest };
  }

  double layer_pressure(const Device &device, const double P)
  {
    const double t       = device.layer.thickness;
    const double nu      = device.layer.poisson_ratio;
    const double modulus = device.layer.plane == PlaneState::stress
                               ? device.layer.young_modulus / (1. - nu * nu)
                               : device.layer.young_modulus * (1. - nu) / ((1. + nu) * (1. - 2. * nu));
    if (t == 0.)
      return 0.;
    const double half_width_at_unit_pressure = std::sqrt(2. * device.geometry.cylinder_radius * t / modulus);
    return std::pow(0.75 * P / (device.lever.width * half_width_at_unit_pressure), 2. / 3.);
  }
} // namespace sprag
