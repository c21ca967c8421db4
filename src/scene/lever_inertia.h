// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  struct Device;

  /// Returns the density per length of a beam [t/mm]: with the scene's moment of inertia, rho A = (J - J_0) / (L^3/3 + L e_a^2),
  /// J_0 that of tip mass, hub and leaf spring; or that of bar and layer as built.
  double mass_per_length(const Device &device);

  /// Returns the frequency up to which bending waves of the lever are longer than six of its depths, as a beam needs [Hz]:
  ///   k^2 sqrt(E I / m) / (2 pi),   k = 2 pi / (6 depth).
  double highest_beam_frequency(const Device &device);

  /// Returns J about the pivot of all that turns with the hub [t mm^2]: the scene's, or as built.
  double moment_of_inertia(const Device &device);

  /// Returns the part of J that tip mass, hub and leaf spring have alone [t mm^2].
  double added_inertia(const Device &device);

  /// Returns e_a [mm]: the given one, or that of the meshed bar.
  double neutral_axis_offset(const Device &device);
} // namespace sprag
