// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/result_file.h"

#include <vector>

namespace sprag
{
  struct Scene;

  /// An indentation without friction: what the reduced models have to lump into their contact.
  struct Indentation
  {
    double P;           ///< [N]
    double approach;    ///< approach of the cylinder to the undeformed lever [mm]
    double bending;     ///< deflection of the Euler-Bernoulli lever under P at the contact [mm]
    double penetration; ///< numerical, largest; what hard contact would not have [mm]

    double local() const
    {
      return approach - bending;
    }
  };

  /// P = stiffness delta^exponent, fitted to indentations.
  struct ContactLawFit
  {
    double stiffness;     ///< [N/mm^n]
    double exponent;      ///< n, 1 ... 3 as scenes take it; elements wider than the contact tend to less than 1
    double largest_error; ///< of P, relative
    double rms_error;
  };

  struct FittedContact
  {
    std::vector<Indentation> points;
    ContactLawFit fit;

    /// Returns the largest relative error of P that the penalty leaves: the exponent times the penetration over the local
    /// indentation.
    double penalty_error() const;
  };

  /// Indents the scene's meshed lever by a cylinder moved along the drive without friction, the rotational spring scaled so that
  /// P grows to 1.2 times the largest of the run. Points from 5 % of that on. The face is half as
  /// coarse as the scene's and an automatic penalty as stiff as hard contact.
  FittedContact indent(const Scene &scene);

  /// Indents a lever that bends as a beam of that EI [N mm^2] does, instead of the scene's bar.
  FittedContact indent(const Scene &scene, double bending_stiffness);
} // namespace sprag
