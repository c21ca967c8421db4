// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/result_file.h"

#include <optional>
#include <vector>

namespace sprag
{
  struct Scene;

  /// A point of the force-approach curve without friction, to which the contact law of the reduced models is fitted.
  struct Indentation
  {
    double P;           ///< [N]
    double approach;    ///< approach of the cylinder to the undeformed lever [mm]
    double bending;     ///< deflection P s^3/(3 E I) of a cantilever under P at the contact [mm]
    double penetration; ///< largest numerical penetration by the penalty [mm]

    /// Returns the local indentation delta [mm].
    double local() const
    {
      return approach - bending;
    }
  };

  /// P = stiffness delta^exponent, fitted to indentations.
  struct ContactLawFit
  {
    double stiffness;     ///< [N/mm^n]
    double exponent;      ///< n, limited to 1 ... 3 as in scenes; too coarse elements tend to n < 1
    double largest_error; ///< of P, relative
    double rms_error;     ///< of P, relative
  };

  /// A contact law with the points that it is fitted to.
  struct FittedContact
  {
    std::vector<Indentation> points;
    ContactLawFit fit;

    /// Returns the largest relative error of P by the penalty, n penetration/delta.
    double penalty_error() const;
  };

  /// Indents the meshed lever by a cylinder that moves along the drive without friction. The rotational spring is scaled for a
  /// largest P of 1.2 times that of the run; points with less than 5 % of the run's P are left out. The faces are half as long
  /// as the scene's and an automatic penalty is that of hard contact. The bending stiffness E I [N mm^2] is that of the scene's
  /// bar if none is given.
  FittedContact indent(const Scene &scene, std::optional<double> bending_stiffness = {});
} // namespace sprag
