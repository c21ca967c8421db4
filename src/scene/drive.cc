// SPDX-License-Identifier: GPL-3.0-only
#include "scene/drive.h"

#include "scene/motion.h"

#include <algorithm>
#include <cmath>
#include <deal.II/base/exceptions.h>

namespace sprag
{
  namespace
  {
    std::shared_ptr<const DriveMotion> periodic_motion(const DriveProfile profile, const double start, const double stroke,
                                                       const double speed, const double cycles, const double reversal_duration)
    {
      Assert(profile != DriveProfile::table, dealii::ExcMessage("A table needs its samples."));
      Assert(start != stroke && speed > 0. && cycles > 0., dealii::ExcMessage("This drive does not move."));
      if (profile == DriveProfile::harmonic)
        return harmonic_motion(start, stroke, speed, cycles);
      if (reversal_duration == 0.)
        return triangle_motion(start, stroke, speed, cycles);
      Assert(reversal_duration > 0. && reversal_duration <= Drive::largest_reversal_duration(start, stroke, speed, cycles),
             dealii::ExcMessage("The strokes have no room for these reversals."));
      return smooth_triangle_motion(start, stroke, speed, cycles, reversal_duration);
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
      : motion(table_motion(times, positions))
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
} // namespace sprag
