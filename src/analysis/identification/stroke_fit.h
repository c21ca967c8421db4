// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/identification/lever_unknowns.h"
#include "analysis/identification/model_correction.h"
#include "base/nonlinear_least_squares.h"

#include <optional>
#include <vector>

namespace sprag
{
  struct Scene;

  /// One measured force at one row.
  struct UsedValue
  {
    std::size_t row;
    std::size_t channel;
    std::size_t stroke;
    double value; ///< [N]
  };

  /// A lever against a measured stroke: which values count, and by how much the lever misses them.
  class StrokeFit
  {
  public:
    StrokeFit(const Scene &scene, const MeasuredMotion &motion, const LeverUnknowns &unknowns);

    /// Returns the values that count with this window behind each turn [mm] and lag: x > 0, a speed of more than 2 % of the
    /// peak, and not the last 2 % of a stroke, in which the drive slows down to turn.
    std::vector<UsedValue> used(double window, double lag) const;

    /// Forces of the lever, correction included [N].
    struct Slide
    {
      double P;
      double Q;
    };

    /// Returns the forces at a row; none where the lever has no slide there.
    std::optional<Slide> slide(const IdentifiedLever &lever, const ModelCorrection &correction, std::size_t row,
                               std::size_t stroke) const;

    /// Returns what a channel shows of them, offset included [N].
    double shown(const IdentifiedLever &lever, const Slide &slide, std::size_t channel) const;

    /// Returns measured less shown over the standard deviation of the channel and times the square root of the weight, where
    /// there are weights; large numbers where the lever has no slide.
    std::vector<double> residuals(const std::vector<double> &scaled, const std::vector<UsedValue> &values,
                                  const std::vector<double> &deviations, const ModelCorrection &correction,
                                  const std::vector<double> &weights = {}) const;

    /// Returns the unknowns in their units.
    std::vector<double> in_units(const std::vector<double> &scaled) const;

    const MeasuredMotion &way() const
    {
      return motion;
    }

  private:
    const Scene &scene;
    const MeasuredMotion &motion;
    const LeverUnknowns &unknowns;
    const double inertia; ///< J, which a steady speed already turns unevenly [t mm^2]; 0 for the closed form
  };
} // namespace sprag
