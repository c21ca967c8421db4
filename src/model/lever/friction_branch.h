// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <limits>
#include <vector>

namespace sprag
{
  /// An equilibrium on the way from no friction to the scene's.
  struct BranchPoint
  {
    double share;       ///< of the friction
    double penetration; ///< [mm]
  };

  /// The share of the friction up to which such a branch was followed, and whether it jams there.
  struct BranchEnd
  {
    double share;
    bool jams;
  };

  /// Returns the share s of friction from the last of these points to a fold, at which ds/dp = 0 over the penetration p:
  ///   (ds/dp)^2 / (2 |d^2s/dp^2|)   of a parabola; infinite if ds/dp does not fall.
  /// The points used have penetrations at least a tenth apart, which averages over elements that come into contact.
  inline double distance_to_fold(const std::vector<BranchPoint> &branch)
  {
    constexpr double none = std::numeric_limits<double>::infinity(), apart = 0.9;
    std::vector<BranchPoint> p; // the last first
    for (auto point = branch.rbegin(); point != branch.rend() && p.size() < 3; ++point)
      if (p.empty() || point->penetration <= apart * p.back().penetration)
        p.push_back(*point);
    if (p.size() < 3)
      return none;
    const auto slope = [&](const unsigned int i)
    { return (p[i].share - p[i + 1].share) / (p[i].penetration - p[i + 1].penetration); };
    const double bend         = (slope(1) - slope(0)) / (0.5 * (p[0].penetration - p[2].penetration));
    const double slope_at_end = slope(0) - 0.5 * bend * (p[0].penetration - p[1].penetration);
    if (!(bend > 0.))
      return none;
    return slope_at_end > 0. ? 0.5 * slope_at_end * slope_at_end / bend : 0.;
  }
} // namespace sprag
