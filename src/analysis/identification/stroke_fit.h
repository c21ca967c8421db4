// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/identification/lever_unknowns.h"
#include "base/nonlinear_least_squares.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Forces of a model's steady slide less those of the closed form, P and Q [N].
  struct ForceDifference
  {
    double P = 0.;
    double Q = 0.;
  };

  /// Takes x [mm] and the direction, 1 or -1.
  using ModelCorrection = std::function<ForceDifference(double x, int direction)>;

  /// Returns the differences of the scene's model from the closed form of the same lever, at the drive's peak speed and at places
  /// over the drive between which they are interpolated; nothing for Analysis/Model = closed form. Throws AnalysisError where the
  /// model has no steady slide.
  ModelCorrection model_correction(const Scene &scene, double peak_speed);

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

  /// Noise of a channel, estimated from its residuals.
  struct ChannelNoise
  {
    double deviation   = 0.; ///< standard deviation [N]
    double rows        = 0.; ///< that count
    double correlation = 1.; ///< rows for one independent one: 1 + 2 (sum of the autocorrelation), >= 1
    double spread      = 1.; ///< of the estimate, over that of least squares of normal noise

    double effective_rows() const
    {
      return rows / correlation;
    }
  };

  /// Influence of a residual of so many standard deviations on the fit: itself, or at most Huber's 1.345 either way.
  double influence(IdentificationLoss loss, double residual);

  /// Returns the noise of each channel. `residuals` are over `deviations`. The autocorrelation is summed within strokes up to the
  /// first that is less than 2/sqrt(rows); the mean is not taken off, so that what the lever cannot follow counts as correlated.
  std::vector<ChannelNoise> estimate_noise(const std::vector<UsedValue> &values, const std::vector<double> &residuals,
                                           const std::vector<double> &deviations, IdentificationLoss loss, std::size_t unknowns);

  /// Uncertainty of the unknowns. All entries refer to scaled unknowns.
  struct Knowledge
  {
    std::vector<double> deviations;      ///< standard deviations
    std::vector<double> correlation;     ///< of i and j at i * unknowns + j
    SingularValues singular;             ///< of the Jacobian over the noise; `left` empty
    double quantile = 0.;                ///< of Student's t for the confidence asked for, two-sided
    double freedom  = 0.;                ///< degrees of freedom: effective rows less unknowns, at least 1
    std::vector<std::string> indistinct; ///< sentences: what the data cannot find or tell apart
    std::vector<std::string> weak;       ///< sentences: what they tell apart badly, where they tell all
  };

  /// `jacobian` is that of residuals over the deviations of `noise`, without weights.
  Knowledge knowledge(const std::vector<double> &jacobian, const std::vector<UsedValue> &values,
                      const std::vector<ChannelNoise> &noise, const std::vector<UnknownNumber> &unknowns, double confidence);
} // namespace sprag
