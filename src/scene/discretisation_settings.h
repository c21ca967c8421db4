// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

#include <optional>
#include <string>

namespace sprag
{
  /// Selects the contact of a rigid lever. With ideal contact it always touches, and theta follows from the drive.
  SPRAG_ENUMERATION(ContactType, compliant, ideal)

  /// Says whether the contact's damping is a dashpot, or its loss factor is the same at each vibration's own frequency.
  SPRAG_ENUMERATION(DampingLaw, dashpot, loss_factor)

  /// Selects how the contact of meshed levers is enforced.
  SPRAG_ENUMERATION(Enforcement, penalty, augmented_lagrangian)

  /// Holds the section Contact: enforcement for meshed levers, contact law for reduced ones.
  struct ContactSettings
  {
    Enforcement enforcement = Enforcement::penalty;
    std::optional<double> penalty;             ///< [N/mm^3], > 0; none: chosen from mesh and layer
    std::optional<double> tangential_penalty;  ///< [N/mm^3], > 0; none: equal to the normal one
    double penetration_tolerance       = 1e-6; ///< augmented Lagrangian: largest penetration left [mm], > 0
    unsigned int maximum_augmentations = 20;

    // Contact of the reduced models (rigid, beam): P = k delta^n + c delta'.
    ContactType type       = ContactType::compliant;
    double stiffness       = 2000.; ///< k [N/mm^n], > 0
    double exponent        = 1.;    ///< n, >= 1
    double damping         = 0.02;  ///< ratio to critical damping of the lever on the contact stiffness, or half the loss factor
    DampingLaw damping_law = DampingLaw::dashpot;
    std::optional<double> tangential_stiffness; ///< in stick [N/mm]; none: from the layer's shear
  };

  /// Time integration by the generalised-alpha method.
  struct TimeSettings
  {
    double step            = 5e-5; ///< first step, or every step [s], > 0
    double tolerance       = 5e-3; ///< of the adaptive step: error of P over its largest quasi-static value; 0: fixed step
    double spectral_radius = 0.8;  ///< at infinite frequency, 0 ... 1
  };

  /// Basis of the condensed model.
  struct CondensedSettings
  {
    unsigned int modes = 20; ///< vibration modes of the free lever, > 0
    std::string cache;       ///< folder of stored bases; empty: the user's cache folder
  };

  /// Holds the section Mesh: element sizes and degree of the lever.
  struct MeshSettings
  {
    double face_size        = 0.5; ///< element length along the friction face [mm], > 0
    double faces_in_contact = 0.;  ///< least number of faces across the contact, see face_grading(), >= 0
    unsigned int degree     = 2;   ///< 1 or 2
    std::string file;              ///< user's .geo or .msh; empty: the built-in lever
    unsigned int halvings = 0;     ///< of the sides of the file's elements; set by the program for comparisons

    // In three dimensions.
    unsigned int elements_across = 10;  ///< over the width, > 0
    double growth_across         = 1.2; ///< of an element over the one beside it, from the edges to the middle, >= 1
  };

  /// Selects when fields are written: never, at reversals and at the end, or also in between.
  SPRAG_ENUMERATION(FieldOutput, none, turning_points, interval)

  /// Says at which instants fields are written for ParaView, and whether errors are estimated.
  struct OutputSettings
  {
    FieldOutput fields = FieldOutput::interval;
    std::optional<double> field_interval; ///< travel between two [mm], > 0; none: a twentieth of all travel
    bool errors = true;                   ///< of runs along a drive and of limit cycles; those of a verdict belong to it
  };
} // namespace sprag
