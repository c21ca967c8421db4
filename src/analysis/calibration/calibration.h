// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/statics/contact_law.h"
#include "levers/meshed_constants.h"
#include "model/step/dynamic_model.h"
#include "scene/scene.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// Parts that have the target k and J.
  struct CalibratedParts
  {
    std::optional<double> thickness;    ///< of the leaf spring [mm]
    std::optional<double> added;        ///< Lever/Hub inertia [t mm^2] or Lever/Tip mass [t]
    std::vector<std::string> overrides; ///< "Section/Name=value"
    Scene scene;                        ///< with them, prepared()
  };

  /// Finds the thickness of the leaf spring and the added mass by finite elements, from Calibration/Stiffness and Moment of
  /// inertia, where they are given. Throws InputError where a target cannot be reached.
  CalibratedParts calibrate_parts(const Scene &scene);

  /// Constants of the rigid and beam models for a meshed lever.
  struct ReducedConstants
  {
    double stiffness         = 0.; ///< k [N mm/rad]
    double moment_of_inertia = 0.; ///< J [t mm^2]
    EffectiveBending bending{};
    FittedContact contact;
    std::vector<std::string> overrides; ///< that make the scene a beam's
  };

  /// Finds the constants by the mesh of a prepared scene.
  ReducedConstants reduced_constants(const Scene &scene);

  /// Steady sliding at one x, by finite elements (0) and by the calibrated beam (1).
  struct SlidingComparison
  {
    double x;
    double direction; ///< 1 or -1
    std::array<SlidingForces, 2> forces;
  };

  /// Results of the finite elements beside those of the calibrated beam.
  struct Disagreement
  {
    std::vector<SlidingComparison> sliding;
    std::array<std::vector<double>, 2> free_frequencies;    ///< the two lowest, out of contact [Hz]
    std::array<std::vector<double>, 2> contact_frequencies; ///< the two lowest, in contact at Stability/Position [Hz]

    /// Returns the largest difference of the forces over the largest value: of P (which = 0) or Q (1).
    double force_deviation(unsigned int which) const;
  };

  /// Compares both scenes. `meshed` is condensed, which is exact in statics and to its modes in vibration.
  Disagreement compare(const Scene &meshed, const Scene &beam);
} // namespace sprag
