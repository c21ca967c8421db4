// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <vector>

namespace sprag
{
  /// Moment of a rotational spring over the lever's turn from x = 0: k turn and an excess over that. A spring that is not linear
  /// has one, by cubic Hermite interpolation between samples of finite elements; beyond them by the tangent of the last one. So
  /// has a spring that is at rest at another turn.
  class MomentLaw
  {
  public:
    /// A point of the moment over the turn.
    struct Sample
    {
      double turn;      ///< from rest [rad]
      double moment;    ///< that turns it so [N mm]
      double stiffness; ///< d(moment)/d(turn) [N mm/rad]
    };

    MomentLaw() = default;

    /// k > 0 [N mm/rad]. `samples` by increasing turn, which include 0; none: linear.
    explicit MomentLaw(double stiffness, std::vector<Sample> samples = {});

    /// Returns the law of this spring at rest at a turn [rad].
    MomentLaw at_rest_at(double turn) const;

    /// Returns the law of a spring with this many times the moment; k stays, the rest is excess.
    MomentLaw times(double factor) const;

    /// Returns true if there is no excess.
    bool is_linear() const;

    double linear_stiffness() const;

    // The excess is the moment above the linear k turn.
    double excess(double turn) const;           ///< [N mm]
    double excess_stiffness(double turn) const; ///< [N mm/rad]
    double excess_energy(double turn) const;    ///< [N mm]

    // The following include the linear part.
    double moment(double turn) const;
    double stiffness(double turn) const;
    double energy(double turn) const;

    const std::vector<Sample> &samples() const;

  private:
    double k    = 0.;
    double rest = 0.;                   ///< turn [rad]
    std::vector<Sample> excess_samples; ///< moments and stiffnesses above k
    std::vector<double> energies;       ///< of the excess, at the samples
    std::vector<Sample> tabulated;
  };
} // namespace sprag
