// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/identification/measured_motion.h"
#include "laws/friction_law.h"
#include "scene/identification.h"
#include "scene/lever.h"

#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  struct UnknownNumber
  {
    std::string name; ///< "mu", "k", "offset_P"
    std::string unit;
    std::string meaning;
    double start;
    double scale; ///< a change that is large, > 0
  };

  /// A lever as far as a stroke tells of it.
  struct IdentifiedLever
  {
    Geometry geometry;
    FrictionLaw friction;
    double stiffness;            ///< k [N mm/rad]
    std::vector<double> offsets; ///< of the channels [N]
    double lag = 0.;             ///< [s]
  };

  /// The unknowns of a scene as numbers, of which a law of friction may have several.
  class LeverUnknowns
  {
  public:
    LeverUnknowns(const Scene &scene, const MeasuredMotion &motion);

    const std::vector<UnknownNumber> &numbers() const
    {
      return all;
    }

    /// Returns the lever with these values; throws InputError where they make no lever.
    IdentifiedLever lever(const std::vector<double> &values) const;

    /// Returns the scene with the lever, changed in memory.
    Scene scene_with(const IdentifiedLever &lever) const;

    /// Returns "Section/Name=value" for what a scene has of the lever. `friction_table` is the file that a polynomial or table of
    /// mu is in.
    std::vector<std::string> overrides(const IdentifiedLever &lever, const std::string &friction_table) const;

    /// Returns the rows, speed [mm/s] and mu, of a polynomial or table of mu; empty for another law.
    std::vector<std::pair<double, double>> friction_rows(const std::vector<double> &values) const;

  private:
    const Scene &scene;
    const double peak_speed;
    std::vector<UnknownNumber> all;

    void add_friction(Unknown unknown, const MeasuredMotion &motion);
    void add_offsets();
  };
} // namespace sprag
