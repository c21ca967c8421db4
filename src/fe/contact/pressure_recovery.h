// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <vector>

namespace sprag
{
  /// Pressures of the points of a friction face, along it.
  struct PressureSamples
  {
    std::vector<double> xi;         ///< deformed, increasing [mm]
    std::vector<double> weight;     ///< area that a point represents, > 0 [mm^2]
    std::vector<double> pressure;   ///< [MPa], >= 0
    std::vector<double> trial;      ///< the same, below zero where there is a gap: its zeros are the edges of the contact [MPa]
    std::vector<unsigned int> cell; ///< of the face, in order
    double begin = 0.;              ///< of the face [mm]
    double end   = 0.;
  };

  /// The pressure on a contact at the points of a solution.
  struct RecoveredPressure
  {
    std::vector<double> pressure; ///< of the samples [MPa], >= 0
    double width   = 0.;          ///< of the contact [mm]
    double largest = 0.;          ///< [MPa]
    double place   = 0.;          ///< of the largest [mm]
    bool is_fitted = false;       ///< whether the pressure below is its own fit; else that of the samples
  };

  /// Smooths a pressure that finite elements leave with dents. These are largest in the cells that hold an edge of the contact
  /// and die out within two cells, so that samples there count a hundredth and a tenth. Over one contact [a, b] between smooth
  /// bodies p = (1 + s)^m (1 - s)^n q(s), s from -1 at a to 1 at b, with a polynomial q of degree half the number of cells in
  /// contact, two at least: it has no more waves than the solution, and approaches any pressure as cells become finer. The
  /// exponents that fit best: 1/2 and 1/2 of a smooth contact of elastic bodies; 0.4 and 0.6 or reversed, which friction makes
  /// of them (the layer slides, Comninou 1976); 3/4 or 1, of a thin layer or a soft penalty, where they fit much better. q is
  /// that of least squares whose resultant and moment are those of the samples to round-off; a, b are those of least squares,
  /// held near the zeros of the trial pressure. A degree that leaves a second peak or suction is lowered.
  /// Where this is not what touches (two contacts, a contact that reaches the face's end, fewer than ten samples, a misfit of
  /// more than a quarter) the samples themselves count.
  RecoveredPressure recover(const PressureSamples &samples);

  /// Returns the length under pressure: that of the fit, or else between the places where the trial pressure, linear between the
  /// samples, changes sign [mm].
  double contact_width(const PressureSamples &samples, const RecoveredPressure &recovered);
} // namespace sprag
