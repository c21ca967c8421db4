// SPDX-License-Identifier: GPL-3.0-only
#include "scene/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
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
  } // namespace

  std::shared_ptr<const DriveMotion> smooth_triangle_motion(const double start, const double stroke, const double speed,
                                                            const double cycles, const double reversal_duration)
  {
    return std::make_shared<const SmoothTriangle>(strokes(start, stroke, cycles), speed, reversal_duration);
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
