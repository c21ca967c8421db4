#pragma once

#include "scene/drive.h"

#include <memory>
#include <vector>

namespace sprag
{
  /// How a drive moves: a row of pieces, each going one way or at rest throughout. Piece i lasts from times[i] to times[i+1].
  class DriveMotion
  {
  public:
    explicit DriveMotion(DriveProfile kind);
    virtual ~DriveMotion() = default;

    std::size_t piece(double time, Drive::Side side) const;

    /// The turning points and ends are met bit for bit, and v has the sign of the piece's direction, whatever round-off says.
    DrivePoint at(std::size_t piece, double time, Drive::Side side) const;

    /// The time within a moving piece, after `time`, at which x has moved by dx; the piece moves farther than that.
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
    /// Between the ends of a piece, or as near to them as rounding gets.
    virtual DrivePoint point(std::size_t piece, double time, Drive::Side side) const = 0;

    /// Sets directions and reversals by the positions.
    void find_reversals();
  };

  /// Number of the interval between `bounds`, of which there are at least two, that a time lies in; at a bound that on the side
  /// asked for. Times beyond the ends belong to the first or last.
  std::size_t interval_at(const std::vector<double> &bounds, double time, Drive::Side side);

  /// -1, 0 or 1.
  inline int sign_of(const double value)
  {
    return (value > 0.) - (value < 0.);
  }

  std::shared_ptr<const DriveMotion> triangle_motion(double start, double stroke, double speed, double cycles);

  /// `reversal_duration` > 0 and at most largest_reversal_duration().
  std::shared_ptr<const DriveMotion> smooth_triangle_motion(double start, double stroke, double speed, double cycles,
                                                            double reversal_duration);

  std::shared_ptr<const DriveMotion> harmonic_motion(double start, double stroke, double speed, double cycles);

  std::shared_ptr<const DriveMotion> table_motion(const std::vector<double> &times, const std::vector<double> &positions);

  /// The longest reversals for which every stroke has room for its ramps [s]; infinite where there are none.
  double largest_reversal_duration(double start, double stroke, double speed, double cycles);
} // namespace sprag
