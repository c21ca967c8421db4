// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <vector>

namespace sprag
{
  /// Moment of a rotational spring over its turn from rest: k turn and, of a spring that is not linear, an excess over that, by
  /// cubic Hermite interpolation between samples of finite elements. Beyond the samples the last one's tangent goes on.
  class MomentLaw
  {
  public:
    struct Sample
    {
      double turn;      ///< [rad]
      double moment;    ///< that turns it so [N mm]
      double stiffness; ///< d(moment)/d(turn) [N mm/rad]
    };

    MomentLaw() = default;

    /// k > 0 [N mm/rad]. `samples` by increasing turn, which include 0; none: linear.
    explicit MomentLaw(double stiffness, std::vector<Sample> samples = {});

    bool is_linear() const;

    double linear_stiffness() const;

    // The excess is the moment above the linear k turn.
    double excess(double turn) const;           ///< [N mm]
    double excess_stiffness(double turn) const; ///< [N mm/rad]
    double excess_energy(double turn) const;    ///< from rest [N mm]

    // The following include the linear part.
    double moment(double turn) const;
    double stiffness(double turn) const;
    double energy(double turn) const;

    const std::vector<Sample> &samples() const;

  private:
    double k = 0.;
    std::vector<Sample> excess_samples; ///< moments and stiffnesses above k
    std::vector<double> energies;       ///< of the excess, at the samples
    std::vector<Sample> given;
  };
} // namespace sprag
