// SPDX-License-Identifier: GPL-3.0-only
#include "scene/lever_shape.h"

#include "base/text.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/device.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sprag
{
  std::array<double, 2> swept_contact(const Device &device)
  {
    return { { kinematics(device.geometry, device.drive.maximum()).s, kinematics(device.geometry, device.drive.minimum()).s } };
  }

  double least_length(const Device &device)
  {
    return kinematics(device.geometry, device.drive.minimum()).s + std::min(2., device.geometry.cylinder_radius / 28.);
  }

  std::array<double, 2> contact_surroundings(const Device &device)
  {
    const double margin      = 0.1 * device.geometry.cylinder_radius;
    const auto [first, last] = swept_contact(device);
    return { { first - margin, last + margin } };
  }

  std::array<double, 2> friction_face(const Device &device)
  {
    if (device.plate.type == PlateType::on_sensors)
      return { { device.plate.begin, device.plate.end } };
    const double begin = device.lever.outline == LeverOutline::frame ? device.frame.root + device.frame.rib : 0.;
    return { { begin, device.lever.length } };
  }

  double sensors_across(const Device &device)
  {
    return device.plate.sensors_across.value_or(0.5 * (device.lever.width - device.plate.sensor_width));
  }

  bool is_symmetric_across(const Device &device)
  {
    return !holds_slide(device.analysis.type) && device.cylinder.tilt == 0. && device.cylinder.skew == 0. &&
           device.cylinder.position == 0.;
  }

  std::vector<double> planes_across(const Device &device)
  {
    const unsigned int n = device.mesh.elements_across;
    const double width   = device.lever.width;
    std::vector<double> sizes(n);
    double sum = 0.;
    for (unsigned int i = 0; i < n; ++i)
      sum += sizes[i] = std::pow(device.mesh.growth_across, std::min(i, n - 1 - i));
    std::vector<double> result{ -0.5 * width };
    for (const double size : sizes)
      result.push_back(result.back() + size / sum * width);
    result.back() = 0.5 * width;
    if (!is_symmetric_across(device))
      return result;
    const double round_off = 1e-9 * width;
    std::vector<double> half{ 0. };
    std::copy_if(result.begin(), result.end(), std::back_inserter(half), [&](const double zeta) { return zeta > round_off; });
    return half;
  }

  std::string cylinder_too_short(const Device &device, const std::vector<double> &planes)
  {
    constexpr double least_elements = 2.; // with one a single line of nodes may carry all, whatever the length
    const auto &cylinder            = device.cylinder;
    const double half               = 0.5 * device.lever.width;
    const double begin              = std::max(-half, cylinder.position - 0.5 * cylinder.length);
    const double end                = std::min(half, cylinder.position + 0.5 * cylinder.length);
    if (cylinder.length == 0. || (begin == -half && end == half) || begin >= end) // the last is reported as a wrong position
      return {};
    double widest = 0.;
    for (std::size_t i = 1; i < planes.size(); ++i)
      if (planes[i] > begin && planes[i - 1] < end)
        widest = std::max(widest, planes[i] - planes[i - 1]);
    if (end - begin >= least_elements * widest * (1. - 1e-9))
      return {};
    return "must cover at least " + mm(least_elements * widest) + " of the lever's width, two elements across, which are " +
           mm(widest) + " wide under it: raise Mesh/Elements across, or lower Growth across";
  }

  std::vector<double> with_web_sides(const double web, std::vector<double> planes)
  {
    const double side = 0.5 * web, edge = planes.back();
    const double round_off = 1e-9 * edge;
    if (side > edge - round_off)
      return planes;
    double nearest = 0.; // plane between middle and edge
    for (const double zeta : planes)
      if (zeta > round_off && zeta < edge - round_off && (nearest == 0. || std::abs(zeta - side) < std::abs(nearest - side)))
        nearest = zeta;
    if (nearest == 0.)
    {
      if (planes.front() < 0.)
        planes.push_back(-side);
      planes.push_back(side);
      std::sort(planes.begin(), planes.end());
      return planes;
    }
    for (double &zeta : planes)
    {
      const double distance = std::abs(zeta);
      const double moved =
          distance <= nearest ? distance * side / nearest : side + (distance - nearest) * (edge - side) / (edge - nearest);
      zeta = std::copysign(distance < edge ? moved : edge, zeta);
    }
    return planes;
  }
} // namespace sprag
