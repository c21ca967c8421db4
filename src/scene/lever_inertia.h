// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  struct Device;

  /// Returns the density per length of a beam [t/mm]: with the scene's moment of inertia, rho A = (J - J_0) / (L^3/3 + L e_a^2),
  /// J_0 that of tip mass, hub and leaf spring; or that of bar and layer as built.
  double mass_per_length(const Device &device);

  /// Elements of a beam, equally long: 8 give frequencies in contact to 5e-4 and growth rates to 0.7 %.
  inline constexpr unsigned int beam_elements = 8;

  /// Returns the frequency of bending waves of this length [mm] along the lever as a beam [Hz]:
  ///   k^2 sqrt(E I / m) / (2 pi),   k = 2 pi / length.
  double bending_frequency(const Device &device, double length);

  /// Returns the frequency up to which bending waves are longer than six depths of the lever, as a beam needs, and than two and a
  /// half of its elements [Hz]. Growth of modes with shorter waves has the wrong sign in one of eight; of longer ones in none.
  double highest_beam_frequency(const Device &device);

  /// Returns J about the pivot of all that turns with the hub [t mm^2]: the scene's, or as built.
  double moment_of_inertia(const Device &device);

  /// Returns the part of J that tip mass, hub and leaf spring have alone [t mm^2].
  double added_inertia(const Device &device);

  /// Returns e_a [mm]: the given one, or that of the meshed bar.
  double neutral_axis_offset(const Device &device);
} // namespace sprag
