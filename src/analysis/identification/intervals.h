// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/identification/lever_unknowns.h"
#include "analysis/identification/stroke_fit.h"

#include <string>
#include <vector>

namespace sprag
{
  /// What the residuals of a channel say about its noise.
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
  std::vector<ChannelNoise> noise_of(const std::vector<UsedValue> &values, const std::vector<double> &residuals,
                                     const std::vector<double> &deviations, IdentificationLoss loss, std::size_t unknowns);

  /// How well the unknowns are known. Everything about scaled ones.
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
