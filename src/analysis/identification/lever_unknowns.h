// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/friction_law.h"
#include "scene/identification.h"
#include "scene/lever.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Motion of the cylinder at the rows of a measurement: strokes one way, between turns of at least 2 % of the whole range.
  class MeasuredMotion
  {
  public:
    struct Stroke
    {
      std::size_t first; ///< row of the turn that begins it
      std::size_t last;  ///< row of the turn that ends it, which begins the next one
      int direction;     ///< +1 forward, -1 back
    };

    struct Place
    {
      double x; ///< [mm]
      double v; ///< [mm/s], with the sign of the stroke's direction
    };

    /// Takes x of the measurement, or else of the drive at its times; v from a line through x over up to a fortieth of the
    /// stroke, or of the drive, at its peak speed where no times are known.
    explicit MeasuredMotion(const Scene &scene);

    const std::vector<Stroke> &strokes() const
    {
      return all;
    }

    /// Returns the stroke of what is measured in a row that comes a lag behind x [s].
    std::size_t stroke_at(std::size_t row, double lag) const;

    /// Returns whether the cylinder was in the stroke a lag before the row, behind its first row and before its last:
    /// which way it moves there nobody knows.
    bool covers(std::size_t row, double lag, std::size_t stroke) const;

    /// Returns where the cylinder was a lag before the row. Beyond the stroke's ends it goes on at their speed, so that a place
    /// changes smoothly with the lag.
    Place at(std::size_t row, double lag, std::size_t stroke) const;

    /// Returns how far the cylinder has gone in the stroke a lag before the row [mm].
    double travel(std::size_t row, double lag, std::size_t stroke) const;

    /// Returns the distance between the ends of a stroke [mm].
    double length(std::size_t stroke) const;

    double peak_speed() const
    {
      return fastest;
    }

    /// Returns the mean time between rows, 0 where no times are known [s].
    double spacing() const;

  private:
    std::vector<double> time, x;
    std::vector<Stroke> all;
    std::vector<std::vector<double>> speeds; ///< of each stroke at its rows, signed
    double fastest = 0.;

    void find_strokes();
    std::vector<double> measured_speeds(const Stroke &stroke) const;
  };

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
    double rest_angle;           ///< of the rotational spring [rad]
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
    std::vector<std::string> overrides(IdentifiedLever lever, const std::string &friction_table) const;

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
