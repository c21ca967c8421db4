// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstddef>
#include <vector>

namespace sprag
{
  struct Scene;

  /// How the cylinder moved at the rows of a measurement: strokes one way, between turns of at least 2 % of the whole range.
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
} // namespace sprag
