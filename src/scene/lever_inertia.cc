// SPDX-License-Identifier: GPL-3.0-only
#include "scene/lever_inertia.h"

#include "scene/device.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  double neutral_axis_offset(const Device &device)
  {
    const double mesh = device.geometry.interface_offset + device.layer.thickness + 0.5 * device.lever.depth;
    return device.lever.neutral_axis_offset.value_or(mesh);
  }

  double added_inertia(const Device &device)
  {
    const Lever &lever = device.lever;
    const double e_a   = neutral_axis_offset(device);
    return lever.tip_mass * (lever.length * lever.length + e_a * e_a) + lever.hub_inertia + device.spring.behaviour.inertia;
  }

  double mass_per_length(const Device &device)
  {
    const Lever &lever = device.lever;
    if (lever.inertia == InertiaSource::as_built)
      return lever.width * (lever.depth * lever.density + device.layer.thickness * device.layer.density);
    const double L   = lever.length;
    const double e_a = neutral_axis_offset(device);
    return (lever.moment_of_inertia - added_inertia(device)) / (L * L * L / 3. + L * e_a * e_a);
  }

  double bending_frequency(const Device &device, const double length)
  {
    const Lever &lever      = device.lever;
    const double stiffness  = lever.young_modulus * lever.width * std::pow(lever.depth, 3) / 12.;
    const double wavenumber = 2. * M_PI / length;
    return wavenumber * wavenumber * std::sqrt(stiffness / mass_per_length(device)) / (2. * M_PI);
  }

  double highest_beam_frequency(const Device &device)
  {
    constexpr double depths = 6., elements = 2.5;
    return bending_frequency(device, std::max(depths * device.lever.depth, elements * device.lever.length / beam_elements));
  }

  double moment_of_inertia(const Device &device)
  {
    if (device.lever.inertia == InertiaSource::scaled)
      return device.lever.moment_of_inertia;
    const double L   = device.lever.length;
    const double e_a = neutral_axis_offset(device);
    return mass_per_length(device) * (L * L * L / 3. + L * e_a * e_a) + added_inertia(device);
  }
} // namespace sprag
