// SPDX-License-Identifier: GPL-3.0-only
#include "scene/motion.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// Strokes of equal duration, given by x and its derivatives over the fraction of a stroke's duration.
    class EqualStrokes : public DriveMotion
    {
    public:
      /// Share of the way gone at a fraction of the time, and its derivatives.
      struct Shares
      {
        double x;
        double v;
        double a;
      };
      using Shape = Shares (*)(double);

      EqualStrokes(const DriveProfile kind, const std::vector<Stroke> &strokes, const double stroke_duration,
                   const Shape shape_over_time)
          : DriveMotion(kind)
          , row(strokes)
          , duration(stroke_duration)
          , shape(shape_over_time)
      {
        for (std::size_t i = 0; i < row.size(); ++i)
        {
          times.push_back(static_cast<double>(i) * duration);
          positions.push_back(row[i].from);
        }
        const Stroke &last = row.back();
        times.push_back((static_cast<double>(row.size() - 1) + last.part) * duration);
        positions.push_back(last.part == 1. ? last.to : last.from + (last.to - last.from) * shape(last.part).x);
        find_reversals();
        kinks = reversals;
      }

    protected:
      DrivePoint point(const std::size_t piece, const double time, Drive::Side) const override
      {
        const double way  = row[piece].to - row[piece].from;
        const bool ends   = time == times[piece + 1] && row[piece].part == 1.;
        const auto shares = shape(ends ? 1. : (time - times[piece]) / duration);
        return { time, row[piece].from + way * shares.x, way / duration * shares.v, way / duration / duration * shares.a };
      }

    private:
      const std::vector<Stroke> row;
      const double duration;
      const Shape shape;
    };

    class Triangle : public EqualStrokes
    {
    public:
      Triangle(const std::vector<Stroke> &strokes, const double speed)
          : EqualStrokes(DriveProfile::triangle, strokes, std::abs(strokes[0].to - strokes[0].from) / speed,
                         [](const double fraction) {
                           return Shares{ fraction, 1., 0. };
                         })
      {
        peak_speed = speed;
      }

      double moved_by(std::size_t, const double time, const double dx) const override
      {
        return time + dx / peak_speed;
      }

    protected:
      DrivePoint point(const std::size_t piece, const double time, const Drive::Side side) const override
      {
        DrivePoint point = EqualStrokes::point(piece, time, side);
        point.v          = std::copysign(peak_speed, point.v);
        return point;
      }
    };

  } // namespace

  std::size_t interval_at(const std::vector<double> &bounds, const double time, const Drive::Side side)
  {
    const auto after = side == Drive::Side::before ? std::lower_bound(bounds.begin(), bounds.end(), time)
                                                   : std::upper_bound(bounds.begin(), bounds.end(), time);
    return std::clamp<std::ptrdiff_t>(after - bounds.begin(), 1, static_cast<std::ptrdiff_t>(bounds.size()) - 1) - 1;
  }

  DrivePoint DriveMotion::at(const std::size_t piece, const double time, const Drive::Side side) const
  {
    DrivePoint result = point(piece, time, side);
    if (time == times[piece])
      result.x = positions[piece];
    else if (time == times[piece + 1])
      result.x = positions[piece + 1];
    if (result.v * directions[piece] <= 0.)
      result.v = std::copysign(0., directions[piece]);
    return result;
  }

  double DriveMotion::moved_by(const std::size_t piece, const double time, const double dx) const
  {
    const double from = at(piece, time, Drive::Side::after).x;
    double early      = time;
    double late       = times[piece + 1];
    for (double middle = (early + late) / 2.; early < middle && middle < late; middle = (early + late) / 2.)
      (std::abs(at(piece, middle, Drive::Side::before).x - from) < dx ? early : late) = middle;
    return late;
  }

  /// After a rest the direction changes when the motion sets in again.
  void DriveMotion::find_reversals()
  {
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
    {
      const int before = i == 0 ? 1 : directions.back();
      const int moves  = signum(positions[i + 1] - positions[i]);
      directions.push_back(moves != 0 ? moves : before);
      if (i > 0 && directions.back() != before)
        reversals.push_back(times[i]);
    }
  }

  std::shared_ptr<const DriveMotion> triangle_motion(const double start, const double stroke, const double speed,
                                                     const double cycles)
  {
    return std::make_shared<const Triangle>(strokes(start, stroke, cycles), speed);
  }

  std::shared_ptr<const DriveMotion> harmonic_motion(const double start, const double stroke, const double speed,
                                                     const double cycles)
  {
    const auto shape = [](const double fraction)
    {
      const double sine = std::sin(M_PI / 2. * fraction);
      const double rate = fraction < 1. ? M_PI / 2. * std::sin(M_PI * fraction) : 0.;
      return EqualStrokes::Shares{ sine * sine, rate, M_PI * M_PI / 2. * std::cos(M_PI * fraction) };
    };
    const double duration = M_PI / 2. * std::abs(stroke - start) / speed;
    const auto motion = std::make_shared<EqualStrokes>(DriveProfile::harmonic, strokes(start, stroke, cycles), duration, shape);
    // It is fastest a quarter of a cycle after its start.
    motion->peak_speed = cycles < 0.25 ? speed * std::sin(2. * M_PI * cycles) : speed;
    return motion;
  }
} // namespace sprag
