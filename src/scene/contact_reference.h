// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  struct Device;

  /// State to which the contact's damping and stiffness in stick refer: the largest P of the closed form over the drive.
  struct ContactReference
  {
    double P;          ///< [N]
    double smallest_P; ///< of the closed form over the drive [N]
    double s;          ///< pivot to contact there [mm]
    double stiffness;  ///< dP/d(delta) at that P, of the contact law or, of a meshed lever, of its face [N/mm]
    double relaxation; ///< damping over stiffness: 2 zeta / omega, omega = s sqrt(stiffness / J), zeta = Contact/Damping [s]
    double tangential; ///< in stick: Contact/Tangential stiffness, or the layer's shear beside its compression [N/mm]
  };

  ContactReference contact_reference(const Device &device);

  /// P = stiffness delta^exponent.
  struct ContactLaw
  {
    double stiffness, exponent;
  };

  /// Returns the law by which a reduced lever stands for a meshed one: that of a cylinder on a thin layer, delta^1.5, with the
  /// stiffness of the meshed lever's face at the largest P. A reduced lever keeps its own.
  ContactLaw face_law(const Device &device);

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
