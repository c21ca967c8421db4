#include "scene/motion.h"

#include "base/errors.h"
#include "base/monotone_cubic.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    const double pi = std::acos(-1.);

    int sign(const double value)
    {
      return (value > 0.) - (value < 0.);
    }

    /// One way of the cylinder, the last one possibly cut short.
    struct Stroke
    {
      double from;
      double to;
      double part; ///< of the way that is gone, 0 < part <= 1
    };

    std::vector<Stroke> strokes(const double start, const double stroke, const double cycles)
    {
      const double n_half_cycles = 2. * cycles;
      std::vector<Stroke> result;
      for (unsigned int i = 0; i < n_half_cycles; ++i)
        result.push_back({ i % 2 == 0 ? start : stroke, i % 2 == 0 ? stroke : start, std::min(1., n_half_cycles - i) });
      return result;
    }

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

    // Ramps of speed by the quintic S(tau) = 10 tau^3 - 15 tau^4 + 6 tau^5: v and a are continuous.

    constexpr double start_distance    = 0.5;     ///< over V T, from rest to V in T
    constexpr double reversal_distance = 0.34375; ///< over V T, from V to the turning point in T/2

    /// Distance over V T that a stroke needs for its ramps.
    double ramp_distance(const bool from_rest, const bool first, const bool last)
    {
      const double before = first ? (from_rest ? start_distance : 0.) : reversal_distance;
      return before + (last ? 0. : reversal_distance);
    }

    bool begins_at_rest(const double start)
    {
      return start == 0.;
    }

    class SmoothTriangle : public DriveMotion
    {
    public:
      SmoothTriangle(const std::vector<Stroke> &strokes, double speed, double duration);

    protected:
      DrivePoint point(std::size_t piece, double time, Drive::Side side) const override;

    private:
      enum class Kind
      {
        start,
        steady,
        reversal
      };

      struct Phase
      {
        Kind kind;
        double begin;
        double time; ///< a reversal's turning point, else the beginning
        double x;    ///< then
        double v;    ///< steady speed, of a reversal that before it
      };

      std::vector<Phase> phases;

      void add(const Phase &phase);
      void add_stroke(const Stroke &stroke, bool first, bool last);
      DrivePoint start(const Phase &phase, double time) const;
      DrivePoint reversal(const Phase &phase, double time) const;
    };

    SmoothTriangle::SmoothTriangle(const std::vector<Stroke> &strokes, const double speed, const double duration)
        : DriveMotion(DriveProfile::triangle)
    {
      peak_speed        = speed;
      reversal_duration = duration;
      times.push_back(0.);
      positions.push_back(strokes.front().from);
      for (std::size_t i = 0; i < strokes.size(); ++i)
        add_stroke(strokes[i], i == 0, i + 1 == strokes.size());
      find_reversals();
    }

    void SmoothTriangle::add(const Phase &phase)
    {
      if (phase.begin > 0.)
        kinks.push_back(phase.begin);
      phases.push_back(phase);
    }

    void SmoothTriangle::add_stroke(const Stroke &stroke, const bool first, const bool last)
    {
      const bool from_rest      = first && begins_at_rest(stroke.from);
      const double distance     = peak_speed * reversal_duration;
      const double way          = (stroke.to - stroke.from) * stroke.part;
      const double v            = std::copysign(peak_speed, way);
      const double steady       = (std::abs(way) - ramp_distance(from_rest, first, last) * distance) / peak_speed;
      const double ramp_before  = first ? (from_rest ? reversal_duration : 0.) : reversal_duration / 2.;
      const double steady_begin = times.back() + ramp_before;
      const double end          = steady_begin + std::max(0., steady) + (last ? 0. : reversal_duration / 2.);

      if (from_rest)
        add({ Kind::start, 0., 0., stroke.from, v });
      // A sliver would be a step of its own.
      if (steady > 1e-9 * reversal_duration)
        add({ Kind::steady, steady_begin, steady_begin,
              stroke.from + std::copysign(ramp_distance(from_rest, first, true) * distance, v), v });
      if (!last)
      {
        add({ Kind::reversal, end - reversal_duration / 2., end, stroke.to, v });
        kinks.push_back(end);
      }
      times.push_back(end);
      positions.push_back(stroke.part == 1. ? stroke.to : stroke.from + way);
    }

    DrivePoint SmoothTriangle::point(std::size_t, const double time, Drive::Side) const
    {
      const auto later   = std::upper_bound(phases.begin(), phases.end(), time,
                                            [](const double value, const Phase &phase) { return value < phase.begin; });
      const Phase &phase = later == phases.begin() ? *later : *(later - 1);
      switch (phase.kind)
      {
      case Kind::start:
        return start(phase, time);
      case Kind::reversal:
        return reversal(phase, time);
      case Kind::steady:
        break;
      }
      return { time, phase.x + phase.v * (time - phase.time), phase.v, 0. };
    }

    /// v = V S(tau).
    DrivePoint SmoothTriangle::start(const Phase &phase, const double time) const
    {
      const double duration = reversal_duration;
      const double tau      = (time - phase.time) / duration;
      const double cube     = tau * tau * tau;
      return { time, phase.x + phase.v * duration * cube * tau * (2.5 - 3. * tau + tau * tau),
               phase.v * cube * (10. - 15. * tau + 6. * tau * tau),
               phase.v / duration * 30. * tau * tau * (1. - tau) * (1. - tau) };
    }

    /// v = V (1 - 2 S(tau)) written over u = tau - 1/2, in which it is odd: the turning point is exact and never passed.
    DrivePoint SmoothTriangle::reversal(const Phase &phase, const double time) const
    {
      const double duration = reversal_duration;
      const double u        = (time - phase.time) / duration;
      const double square   = u * u;
      return { time, phase.x - phase.v * duration * square * (1.875 - 2.5 * square + 2. * square * square),
               -phase.v * u * (3.75 - 10. * square + 12. * square * square),
               -phase.v / duration * (3.75 - 30. * square + 60. * square * square) };
    }

    class Table : public DriveMotion
    {
    public:
      Table(const std::vector<double> &times, const std::vector<double> &positions);

    protected:
      DrivePoint point(std::size_t piece, double time, Drive::Side side) const override;

    private:
      const std::vector<double> sample_times;
      const std::vector<double> sample_positions;
      const MonotoneCubic samples;

      double length(std::size_t i) const;
      double acceleration(std::size_t i, double time) const;
      double fastest(std::size_t i) const;
      void find_pieces();
    };

    /// Up to so many samples, each is a kink.
    constexpr std::size_t most_samples_met = 2000;

    Table::Table(const std::vector<double> &given_times, const std::vector<double> &given_positions)
        : DriveMotion(DriveProfile::table)
        , sample_times(given_times)
        , sample_positions(given_positions)
        , samples(sample_times, sample_positions)
    {
      if (sample_times.front() != 0.)
        throw InputError("row 1: time " + number_text(sample_times.front()) + " s: must be 0");
      find_pieces();
      for (std::size_t i = 0; i + 1 < sample_times.size(); ++i)
        peak_speed = std::max(peak_speed, fastest(i));
      if (peak_speed == 0.)
        throw InputError("the position must change");
      find_reversals();
      const auto &met = sample_times.size() <= most_samples_met ? sample_times : times;
      kinks.assign(met.begin() + 1, met.end() - 1);
    }

    /// The cubic is monotone between samples, so that it turns or comes to rest only where they do.
    void Table::find_pieces()
    {
      int before = 2;
      for (std::size_t i = 0; i + 1 < sample_times.size(); ++i)
      {
        const int direction = sign(sample_positions[i + 1] - sample_positions[i]);
        if (direction != before)
        {
          times.push_back(sample_times[i]);
          positions.push_back(sample_positions[i]);
        }
        before = direction;
      }
      times.push_back(sample_times.back());
      positions.push_back(sample_positions.back());
    }

    double Table::length(const std::size_t i) const
    {
      return sample_times[i + 1] - sample_times[i];
    }

    /// v is a parabola between samples: its extreme follows from three values.
    double Table::fastest(const std::size_t i) const
    {
      const double v0     = samples.derivative(sample_times[i]);
      const double v1     = samples.derivative(sample_times[i] + length(i) / 2.);
      const double v2     = samples.derivative(sample_times[i + 1]);
      const double curve  = v0 - 2. * v1 + v2;
      const double vertex = curve == 0. ? 0. : std::clamp((3. * v0 - 4. * v1 + v2) / (4. * curve), 0., 1.);
      const double inside = samples.derivative(sample_times[i] + vertex * length(i));
      return std::max({ std::abs(v0), std::abs(v2), std::abs(inside) });
    }

    /// Linear between samples.
    double Table::acceleration(const std::size_t i, const double time) const
    {
      const double mean     = (sample_positions[i + 1] - sample_positions[i]) / length(i);
      const double v0       = samples.derivative(sample_times[i]);
      const double v1       = samples.derivative(sample_times[i + 1]);
      const double begin    = (6. * mean - 4. * v0 - 2. * v1) / length(i);
      const double end      = (-6. * mean + 2. * v0 + 4. * v1) / length(i);
      const double fraction = (time - sample_times[i]) / length(i);
      return begin + (end - begin) * fraction;
    }

    std::size_t interval(const std::vector<double> &bounds, const double time, const Drive::Side side)
    {
      const auto after = side == Drive::Side::before ? std::lower_bound(bounds.begin(), bounds.end(), time)
                                                     : std::upper_bound(bounds.begin(), bounds.end(), time);
      return std::clamp<std::ptrdiff_t>(after - bounds.begin(), 1, static_cast<std::ptrdiff_t>(bounds.size()) - 1) - 1;
    }

    DrivePoint Table::point(std::size_t, const double time, const Drive::Side side) const
    {
      return { time, samples.value(time), samples.derivative(time), acceleration(interval(sample_times, time, side), time) };
    }
  } // namespace

  DriveMotion::DriveMotion(const DriveProfile kind)
      : profile(kind)
  {
  }

  std::size_t DriveMotion::piece(const double time, const Drive::Side side) const
  {
    return interval(times, time, side);
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
      const int moves  = sign(positions[i + 1] - positions[i]);
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

  std::shared_ptr<const DriveMotion> smooth_triangle_motion(const double start, const double stroke, const double speed,
                                                            const double cycles, const double reversal_duration)
  {
    return std::make_shared<const SmoothTriangle>(strokes(start, stroke, cycles), speed, reversal_duration);
  }

  std::shared_ptr<const DriveMotion> harmonic_motion(const double start, const double stroke, const double speed,
                                                     const double cycles)
  {
    const auto shape = [](const double fraction)
    {
      const double sine = std::sin(pi / 2. * fraction);
      const double rate = fraction < 1. ? pi / 2. * std::sin(pi * fraction) : 0.;
      return EqualStrokes::Shares{ sine * sine, rate, pi * pi / 2. * std::cos(pi * fraction) };
    };
    const double duration = pi / 2. * std::abs(stroke - start) / speed;
    const auto motion = std::make_shared<EqualStrokes>(DriveProfile::harmonic, strokes(start, stroke, cycles), duration, shape);
    // It is fastest a quarter of a cycle after its start.
    motion->peak_speed = cycles < 0.25 ? speed * std::sin(2. * pi * cycles) : speed;
    return motion;
  }

  std::shared_ptr<const DriveMotion> table_motion(const std::vector<double> &times, const std::vector<double> &positions)
  {
    return std::make_shared<const Table>(times, positions);
  }

  double largest_reversal_duration(const double start, const double stroke, const double speed, const double cycles)
  {
    const auto all = strokes(start, stroke, cycles);
    double largest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const double ramps = ramp_distance(begins_at_rest(start), i == 0, i + 1 == all.size()); ramps > 0.)
        largest = std::min(largest, std::abs(all[i].to - all[i].from) * all[i].part / speed / ramps);
    return largest;
  }
} // namespace sprag
