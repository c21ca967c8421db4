// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <optional>

namespace sprag
{
  struct Device;

  /// Estimates how wide the contact is under a force P >= 0 [N] between the scene's layer, or the bare lever, and a rigid
  /// cylinder [mm]: the smaller of Hertz's width on a body of the layer's material, which holds while the contact is narrower
  /// than the layer is thick, and that on a thin bonded layer, 2 (3 P R h (1 - nu^2)/(2 b E))^(1/3).
  double estimated_contact_width(const Device &device, double P);

  /// Faces that become shorter towards where the contact is narrow, in lever axes.
  struct FaceGrading
  {
    double begin    = 0.; ///< xi up to which they are the longest; from there their length falls linearly [mm]
    double end      = 0.; ///< xi of the shortest, just beyond the contact there; further on they grow again [mm]
    double longest  = 0.; ///< <= Mesh/Face size [mm]
    double shortest = 0.; ///< >= Mesh/Face size/4 [mm]
  };

  /// Returns how the faces of a built-in bar are graded so that Mesh/Faces in contact lie across the contact, if that
  /// takes no faces below a quarter of Mesh/Face size, by estimated_contact_width() and P of the closed form. None where faces of
  /// Mesh/Face size are short enough everywhere, and where they are twice too long even for the widest contact: of such a mesh
  /// forces are wanted alone.
  std::optional<FaceGrading> face_grading(const Device &device);

  /// Returns whether a contact that is `width` wide [mm] spreads over so few faces of a built-in bar, less than one of degree 2
  /// or two of degree 1, that its stiffness follows no power of their size. Faces that are graded are short enough.
  bool is_narrower_than_faces(const Device &device, double width);

  /// Returns the height of the cylinder's arc over Hertz's contact width [mm] as far as lever and cylinder yield under P [N],
  /// 2 P/(pi w) (1 - nu^2)/E of each: of a lever without a layer and of an elastic cylinder.
  double hertz_height(const Device &device, double P);

  /// Returns the largest pressure p [MPa] under P [N] between cylinder and rigid lever, 0 without a layer. Over the half width a
  /// the layer is an elastic foundation of the compliance c(a) that it has for cosines of the wave length pi a:
  ///   p = a^2/(2 R c),   P = w p integral of (1 - x^2/a^2)^m dx,   m = 1 - (a/c dc/da)/2,
  /// which is exact for a thin compressible layer (m = 1) and for a half-plane (m = 1/2, Hertz). Within 7 % of exact solutions of
  /// layers up to nu = 0.45, within 11 % up to 0.4995.
  double layer_pressure(const Device &device, double P);

  /// State to which the contact's damping and stiffness in stick refer: the largest P of the closed form over the drive.
  struct ContactReference
  {
    double P;          ///< [N]
    double smallest_P; ///< of the closed form over the drive [N]
    double s;          ///< pivot to contact there [mm]
    double stiffness;  ///< dP/d(delta) at that P, of the contact law or, of a meshed lever, of its face [N/mm]
    double omega;      ///< of a rigid lever on the contact, s sqrt(stiffness / J) [1/s]
    double relaxation; ///< damping over stiffness: 2 zeta / omega, zeta = Contact/Damping [s]
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
} // namespace sprag
