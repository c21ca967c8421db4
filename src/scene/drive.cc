// SPDX-License-Identifier: GPL-3.0-only
#include "scene/drive.h"

#include "base/errors.h"
#include "base/monotone_cubic.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <deal.II/base/exceptions.h>
#include <iterator>
#include <limits>

namespace sprag
{
  namespace
  {
    /// One way of the cylinder; the last one may be cut short.
    struct Stroke
    {
      double from;
      double to;
      double part; ///< of the way that is gone, 0 < part <= 1
    };

    /// Returns the strokes there and back, `cycles` > 0 times.
    std::vector<Stroke> strokes(const double start, const double stroke, const double cycles)
    {
      const double n_half_cycles = 2. * cycles;
      std::vector<Stroke> result;
      for (unsigned int i = 0; i < n_half_cycles; ++i)
        result.push_back({ i % 2 == 0 ? start : stroke, i % 2 == 0 ? stroke : start, std::min(1., n_half_cycles - i) });
      return result;
    }

    /// Returns -1, 0 or 1.
    int signum(const double value)
    {
      return (value > 0.) - (value < 0.);
    }

    /// Returns the number of the interval between `bounds`, of which there are at least two, that a time lies in; at a bound it
    /// is the interval on the side asked for. Times beyond the ends belong to the first or last.
    std::size_t interval_at(const std::vector<double> &bounds, const double time, const Drive::Side side)
    {
      const auto after = side == Drive::Side::before ? std::lower_bound(bounds.begin(), bounds.end(), time)
                                                     : std::upper_bound(bounds.begin(), bounds.end(), time);
      return std::clamp<std::ptrdiff_t>(after - bounds.begin(), 1, static_cast<std::ptrdiff_t>(bounds.size()) - 1) - 1;
    }
  } // namespace

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
    DrivePoint at(const std::size_t piece, const double time, const Drive::Side side) const
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

    /// Returns the time within a moving piece, after `time`, at which x has moved by dx; the piece moves farther than that.
    virtual double moved_by(const std::size_t piece, const double time, const double dx) const
    {
      const double from = at(piece, time, Drive::Side::after).x;
      double early      = time;
      double late       = times[piece + 1];
      for (double middle = (early + late) / 2.; early < middle && middle < late; middle = (early + late) / 2.)
        (std::abs(at(piece, middle, Drive::Side::before).x - from) < dx ? early : late) = middle;
      return late;
    }

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

    /// Sets directions and reversals by the positions. After a rest the direction changes when the motion sets in again.
    void find_reversals()
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
  };

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
        const double travel = row[piece].to - row[piece].from;
        const bool ends     = time == times[piece + 1] && row[piece].part == 1.;
        const auto shares   = shape(ends ? 1. : (time - times[piece]) / duration);
        return { time, row[piece].from + travel * shares.x, travel / duration * shares.v,
                 travel / duration / duration * shares.a };
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
      SmoothTriangle(const std::vector<Stroke> &strokes, const double speed, const double duration)
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

    protected:
      DrivePoint point(std::size_t, const double time, Drive::Side) const override
      {
        const auto later   = std::upper_bound(phases.begin(), phases.end(), time,
                                              [](const double value, const Phase &phase) { return value < phase.begin; });
        const Phase &phase = later == phases.begin() ? *later : *(later - 1);
        if (phase.kind == Kind::start)
          return start(phase, time);
        if (phase.kind == Kind::reversal)
          return reversal(phase, time);
        return { time, phase.x + phase.v * (time - phase.time), phase.v, 0. };
      }

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

      void add(const Phase &phase)
      {
        if (phase.begin > 0.)
          kinks.push_back(phase.begin);
        phases.push_back(phase);
      }

      void add_stroke(const Stroke &stroke, const bool first, const bool last)
      {
        const bool from_rest      = first && begins_at_rest(stroke.from);
        const double distance     = peak_speed * reversal_duration;
        const double travel       = (stroke.to - stroke.from) * stroke.part;
        const double v            = std::copysign(peak_speed, travel);
        const double steady       = (std::abs(travel) - ramp_distance(from_rest, first, last) * distance) / peak_speed;
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
        positions.push_back(stroke.part == 1. ? stroke.to : stroke.from + travel);
      }

      /// v = V S(tau).
      DrivePoint start(const Phase &phase, const double time) const
      {
        const double duration = reversal_duration;
        const double tau      = (time - phase.time) / duration;
        const double cube     = tau * tau * tau;
        return { time, phase.x + phase.v * duration * cube * tau * (2.5 - 3. * tau + tau * tau),
                 phase.v * cube * (10. - 15. * tau + 6. * tau * tau),
                 phase.v / duration * 30. * tau * tau * (1. - tau) * (1. - tau) };
      }

      /// v = V (1 - 2 S(tau)) written over u = tau - 1/2, in which it is odd: the turning point is exact and never passed.
      DrivePoint reversal(const Phase &phase, const double time) const
      {
        const double duration = reversal_duration;
        const double u        = (time - phase.time) / duration;
        const double square   = u * u;
        return { time, phase.x - phase.v * duration * square * (1.875 - 2.5 * square + 2. * square * square),
                 -phase.v * u * (3.75 - 10. * square + 12. * square * square),
                 -phase.v / duration * (3.75 - 30. * square + 60. * square * square) };
      }
    };

    /// Up to so many samples, each is a kink.
    constexpr std::size_t most_samples_met = 2000;

    class Table : public DriveMotion
    {
    public:
      Table(const std::vector<double> &times_, const std::vector<double> &positions_)
          : DriveMotion(DriveProfile::table)
          , sample_times(times_)
          , sample_positions(positions_)
          , samples(sample_times, sample_positions, MonotoneCubic::Slopes::smooth)
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
        std::set_union(met.begin() + 1, met.end() - 1, times.begin() + 1, times.end() - 1, std::back_inserter(kinks));
      }

    protected:
      DrivePoint point(std::size_t, const double time, const Drive::Side side) const override
      {
        return { time, samples.value(time), samples.derivative(time), acceleration(interval_at(sample_times, time, side), time) };
      }

    private:
      const std::vector<double> sample_times;
      const std::vector<double> sample_positions;
      const MonotoneCubic samples;

      double length(const std::size_t i) const
      {
        return sample_times[i + 1] - sample_times[i];
      }

      /// Linear between samples.
      double acceleration(const std::size_t i, const double time) const
      {
        const double mean     = (sample_positions[i + 1] - sample_positions[i]) / length(i);
        const double v0       = samples.derivative(sample_times[i]);
        const double v1       = samples.derivative(sample_times[i + 1]);
        const double begin    = (6. * mean - 4. * v0 - 2. * v1) / length(i);
        const double end      = (-6. * mean + 2. * v0 + 4. * v1) / length(i);
        const double fraction = (time - sample_times[i]) / length(i);
        return begin + (end - begin) * fraction;
      }

      /// v is a parabola between samples: its extreme follows from three values.
      double fastest(const std::size_t i) const
      {
        const double v0     = samples.derivative(sample_times[i]);
        const double v1     = samples.derivative(sample_times[i] + length(i) / 2.);
        const double v2     = samples.derivative(sample_times[i + 1]);
        const double curve  = v0 - 2. * v1 + v2;
        const double vertex = curve == 0. ? 0. : std::clamp((3. * v0 - 4. * v1 + v2) / (4. * curve), 0., 1.);
        const double inside = samples.derivative(sample_times[i] + vertex * length(i));
        return std::max({ std::abs(v0), std::abs(v2), std::abs(inside) });
      }

      /// Returns the time at which v takes the sign of the end of an interval, in which it changes sign once. Near a row it is
      /// that of the row, as no step should be so short.
      double turn(const std::size_t i, const int end_direction) const
      {
        constexpr double sliver = 1e-3;
        double early            = 0.;
        double late             = 1.;
        for (double middle = 0.5; early < middle && middle < late; middle = (early + late) / 2.)
          (samples.derivative(sample_times[i] + middle * length(i)) * end_direction > 0. ? late : early) = middle;
        return late < sliver ? sample_times[i] : late > 1. - sliver ? sample_times[i + 1] : sample_times[i] + late * length(i);
      }

      /// Between two samples the cubic goes one way, rests or turns once.
      void find_pieces()
      {
        int before      = 2;
        const auto goes = [&](const double time, const int direction)
        {
          if (direction != before)
          {
            times.push_back(time);
            positions.push_back(samples.value(time));
          }
          before = direction;
        };
        for (std::size_t i = 0; i + 1 < sample_times.size(); ++i)
        {
          const int way       = signum(sample_positions[i + 1] - sample_positions[i]);
          const auto at       = [&](const std::size_t row) { return signum(samples.derivative(sample_times[row])); };
          const int begin     = at(i) != 0 ? at(i) : way;
          const int end       = at(i + 1) != 0 ? at(i + 1) : way;
          const double turned = begin == end ? sample_times[i + 1] : turn(i, end);
          if (turned > sample_times[i])
            goes(sample_times[i], begin);
          if (turned < sample_times[i + 1])
            goes(turned, end);
        }
        times.push_back(sample_times.back());
        positions.push_back(sample_positions.back());
      }
    };

    std::shared_ptr<const DriveMotion> periodic_motion(const DriveProfile profile, const double start, const double stroke,
                                                       const double speed, const double cycles, const double reversal_duration)
    {
      Assert(profile != DriveProfile::table, dealii::ExcMessage("A table needs its samples."));
      Assert(start != stroke && speed > 0. && cycles > 0., dealii::ExcMessage("This drive does not move."));
      if (profile == DriveProfile::harmonic)
        return harmonic_motion(start, stroke, speed, cycles);
      if (reversal_duration == 0.)
        return std::make_shared<const Triangle>(strokes(start, stroke, cycles), speed);
      Assert(reversal_duration > 0. && reversal_duration <= Drive::largest_reversal_duration(start, stroke, speed, cycles),
             dealii::ExcMessage("The strokes have no room for these reversals."));
      return std::make_shared<const SmoothTriangle>(strokes(start, stroke, cycles), speed, reversal_duration);
    }
  } // namespace

  Drive::Drive()
      : Drive(DriveProfile::triangle, 0., 65., 112., 1.)
  {
  }

  Drive::Drive(const DriveProfile profile, const double start, const double stroke, const double speed, const double cycles,
               const double reversal_duration)
      : motion(periodic_motion(profile, start, stroke, speed, cycles, reversal_duration))
  {
  }

  Drive::Drive(std::vector<double> times, std::vector<double> positions)
      : motion(std::make_shared<const Table>(times, positions))
  {
  }

  DriveProfile Drive::profile() const
  {
    return motion->profile;
  }

  double Drive::duration() const
  {
    return motion->times.back();
  }

  double Drive::minimum() const
  {
    return *std::min_element(motion->positions.begin(), motion->positions.end());
  }

  double Drive::maximum() const
  {
    return *std::max_element(motion->positions.begin(), motion->positions.end());
  }

  double Drive::peak_speed() const
  {
    return motion->peak_speed;
  }

  double Drive::reversal_duration() const
  {
    return motion->reversal_duration;
  }

  const std::vector<double> &Drive::reversals() const
  {
    return motion->reversals;
  }

  bool Drive::turns_at(const double time) const
  {
    return std::binary_search(motion->reversals.begin(), motion->reversals.end(), time);
  }

  const std::vector<double> &Drive::kinks() const
  {
    return motion->kinks;
  }

  DrivePoint Drive::at(const double time, const Side side) const
  {
    const double inside = std::clamp(time, 0., duration());
    return motion->at(interval_at(motion->times, inside, side), inside, side);
  }

  DrivePoint Drive::step(const double time, const double dx) const
  {
    Assert(dx > 0., dealii::ExcMessage("A step must move."));
    const auto piece      = interval_at(motion->times, time, Side::after);
    const double end      = motion->times[piece + 1];
    const double distance = std::abs(motion->positions[piece + 1] - motion->at(piece, time, Side::after).x);
    return at(distance < 1.001 * dx ? end : motion->moved_by(piece, time, dx));
  }

  DrivePoint Drive::step(const double time, double dx, const double speed_change) const
  {
    const double v = at(time, Side::after).v;
    auto point     = step(time, dx);
    while (std::abs(point.v - v) > speed_change * peak_speed())
      point = step(time, dx *= 0.5);
    return point;
  }

  double Drive::largest_reversal_duration(const double start, const double stroke, const double speed, const double cycles)
  {
    const auto all = strokes(start, stroke, cycles);
    double largest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const double ramps = ramp_distance(begins_at_rest(start), i == 0, i + 1 == all.size()); ramps > 0.)
        largest = std::min(largest, std::abs(all[i].to - all[i].from) * all[i].part / speed / ramps);
    return largest;
  }
} // namespace sprag
