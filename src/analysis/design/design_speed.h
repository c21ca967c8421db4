// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Returns a design's scene whose Drive/Speed is that of the isolated table on the lever found with it, within 1 %; the scene
  /// itself where that is given, or no table or motion of it is asked for or found.
  Scene at_table_speed(const Scene &design);

  /// A demand that a lever meets at the design's speed and misses at another.
  struct MissedDemand
  {
    std::size_t demand; ///< its index
    double value;       ///< of its quantity there
    double violation;   ///< see demand_violation()
  };

  /// The speed and stroke at which a design takes its lever, those of its drive, beside the machine's own motion.
  struct DesignSpeed
  {
    double speed;     ///< of the drive [mm/s]
    double mu;        ///< at x = 0
    double other;     ///< the table's largest over the base by harmonic balance; without a table a tenth of `speed` [mm/s]
    double other_mu;  ///< at x = 0
    double amplitude; ///< of the table over the base; NaN without one [mm]
    double stroke;    ///< largest x of the drive [mm]
    std::vector<MissedDemand> missed; ///< at the other speed
    std::string broken_rule;          ///< of all levers, which this one breaks there; empty: none
  };

  /// Looks at the lever of a scene at another speed, by the closed form. `values`: what the demands' quantities are at the
  /// design's speed, which the closed form changes by its own ratio of both speeds.
  DesignSpeed design_speed(const Scene &lever, const std::vector<double> &values);
} // namespace sprag
