// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace sprag
{
  /// The drive has constant speed, with reversals instantaneous or of a given duration (triangle), is x = start + (stroke -
  /// start)/2 (1 - cos(omega t)) with a given peak speed (harmonic), or x over t from a file, monotone cubic (table, PCHIP).
  SPRAG_ENUMERATION(DriveProfile, triangle, harmonic, table)

  /// Motion of the drive at an instant. The sign of v, that of a zero included, is the direction of motion: at a turning point
  /// of the stroke that ends or begins there, in a rest of the motion that led to it, in a rest at the beginning forward, see
  /// drive_direction().
  struct DrivePoint
  {
    double time = 0.; ///< [s]
    double x    = 0.; ///< [mm]
    double v    = 0.; ///< [mm/s]
    double a    = 0.; ///< [mm/s^2]; an instantaneous reversal has none on either side

    /// Path of the cylinder's surface by turning, counted as slip along the lever [mm]; a drive never turns it.
    double surface = 0.;
  };

  /// Returns +1 for forward, -1 for back.
  inline int drive_direction(const double v)
  {
    return std::signbit(v) ? -1 : 1;
  }

  class DriveMotion;

  /// Prescribed motion x(t) of the cylinder's centre, t from 0 to `duration()`. A value type.
  class Drive
  {
  public:
    /// Makes the drive of model A: 0 .. 65 .. 0 mm at 112 mm/s.
    Drive();

    /// Makes a triangle or a harmonic motion between start and stroke [mm], which differ, at the speed V > 0 [mm/s], cycles > 0
    /// times (0.5 is a half cycle).
    ///
    /// Reversals of a duration T [s] concern the triangle only: 0 <= T <= largest_reversal_duration(). With
    /// S(tau) = 10 tau^3 - 15 tau^4 + 6 tau^5 the velocity is V (1 - 2 S(t/T)) in a reversal, which turns at T/2, 0.34375 V T
    /// behind where it began. A drive that starts at x = 0 does so from rest with V S(t/T), any other at V. It ends at V.
    Drive(DriveProfile profile, double start, double stroke, double speed, double cycles, double reversal_duration = 0.);

    /// Makes a motion from a table of strictly increasing times from 0, at least 4 rows. Throws InputError otherwise.
    Drive(std::vector<double> times, std::vector<double> positions);

    /// Returns the longest reversals that leave room in every stroke for the ramps before and behind it [s]; infinite without
    /// ramps.
    static double largest_reversal_duration(double start, double stroke, double speed, double cycles);

    DriveProfile profile() const;

    double duration() const;

    double minimum() const;

    double maximum() const;

    /// Returns the largest |v| [mm/s].
    double peak_speed() const;

    /// Returns how long a reversal takes [s]; 0 where reversals are instantaneous, and for harmonic motion and tables, which turn
    /// in their own way.
    double reversal_duration() const;

    /// Returns the times strictly between 0 and duration() where the direction of motion changes, increasing. A motion back that
    /// sets in after a rest at the beginning is one of them.
    const std::vector<double> &reversals() const;

    /// Returns whether a time is one of the reversals().
    bool turns_at(double time) const;

    /// Returns the times strictly between 0 and duration() at which a time integration must begin a new step, increasing: the
    /// reversals, the beginning and end of those that take time, the end of the start ramp, beginnings and ends of rests, and the
    /// samples of a table if there are at most 2000.
    const std::vector<double> &kinks() const;

    /// Selects the limit from before or from after an instant.
    enum class Side
    {
      before,
      after
    };

    /// Returns position, velocity and acceleration; where v or a jump, those just before or just after.
    DrivePoint at(double time, Side side = Side::before) const;

    /// Returns the end of a step from `time` that moves x by at most `dx` > 0 [mm]: the first later time at which |x - x(time)| =
    /// dx, the next reversal, the beginning or end of a rest, or the end of the drive, whichever comes first. A remainder of less
    /// than 1e-3 dx before a reversal or the end is taken along, so that those are hit exactly and never by a sliver of a step.
    DrivePoint step(double time, double dx) const;

    /// Returns the end of the longest such step, dx halved as often as needed, that changes v by at most this share of the peak
    /// speed.
    DrivePoint step(double time, double dx, double speed_change) const;

  private:
    std::shared_ptr<const DriveMotion> motion;
  };
} // namespace sprag
