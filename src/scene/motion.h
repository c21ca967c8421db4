// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/drive.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace sprag
{
  /// Motion of a drive: a row of pieces, each going one way or at rest throughout. Piece i lasts from times[i] to times[i+1].
  class DriveMotion
  {
  public:
    explicit DriveMotion(const DriveProfile kind)
        : profile(kind)
    {
    }
    virtual ~DriveMotion() = default;

    /// Returns the drive at a time on a piece. Turning points and ends are met bit for bit, and v has the sign of the piece's
    /// direction, whatever round-off says.
    DrivePoint at(std::size_t piece, double time, Drive::Side side) const;

    /// Returns the time within a moving piece, after `time`, at which x has moved by dx; the piece moves farther than that.
    virtual double moved_by(std::size_t piece, double time, double dx) const;

    const DriveProfile profile;
    std::vector<double> times;
    std::vector<double> positions;
    std::vector<int> directions; ///< of the pieces, +1 or -1; of a rest that of the motion that led to it, of the first +1
    std::vector<double> reversals;
    std::vector<double> kinks;
    double peak_speed        = 0.;
    double reversal_duration = 0.;

  protected:
    /// Returns where the drive is between the ends of a piece, or as near to them as rounding gets.
    virtual DrivePoint point(std::size_t piece, double time, Drive::Side side) const = 0;

    /// Sets directions and reversals by the positions.
    void find_reversals();
  };

  /// Returns the number of the interval between `bounds`, of which there are at least two, that a time lies in; at a bound it is
  /// the interval on the side asked for. Times beyond the ends belong to the first or last.
  std::size_t interval_at(const std::vector<double> &bounds, double time, Drive::Side side);

  /// One way of the cylinder; the last one may be cut short.
  struct Stroke
  {
    double from;
    double to;
    double part; ///< of the way that is gone, 0 < part <= 1
  };

  /// Returns the strokes there and back, `cycles` > 0 times.
  inline std::vector<Stroke> strokes(const double start, const double stroke, const double cycles)
  {
    const double n_half_cycles = 2. * cycles;
    std::vector<Stroke> result;
    for (unsigned int i = 0; i < n_half_cycles; ++i)
      result.push_back({ i % 2 == 0 ? start : stroke, i % 2 == 0 ? stroke : start, std::min(1., n_half_cycles - i) });
    return result;
  }

  /// Returns -1, 0 or 1.
  inline int signum(const double value)
  {
    return (value > 0.) - (value < 0.);
  }

  std::shared_ptr<const DriveMotion> triangle_motion(double start, double stroke, double speed, double cycles);

  /// Makes a triangle whose reversals take `reversal_duration` > 0, at most Drive::largest_reversal_duration() [s].
  std::shared_ptr<const DriveMotion> smooth_triangle_motion(double start, double stroke, double speed, double cycles,
                                                            double reversal_duration);

  std::shared_ptr<const DriveMotion> harmonic_motion(double start, double stroke, double speed, double cycles);

  std::shared_ptr<const DriveMotion> table_motion(const std::vector<double> &times, const std::vector<double> &positions);
} // namespace sprag
