#pragma once

#include <memory>
#include <string>
#include <vector>

namespace sprag
{
  enum class DriveProfile
  {
    triangle, ///< constant speed, instantaneous reversals
    harmonic, ///< x = start + (stroke - start)/2 (1 - cos(omega t)), peak speed given
    table     ///< x over t from a file, monotone cubic (PCHIP)
  };

  /// Where the drive is at an instant. Constant-speed drives are two-valued at a reversal: see `Drive::at`.
  struct DrivePoint
  {
    double time = 0.; ///< [s]
    double x    = 0.; ///< [mm]
    double v    = 0.; ///< [mm/s]
  };

  /// Prescribed motion x(t) of the cylinder's centre, t from 0 to `duration()`. A value type.
  class Drive
  {
  public:
    /// Model A's: 0 .. 65 .. 0 mm at 112 mm/s.
    Drive();

    /// Triangle and harmonic. start, stroke [mm], speed [mm/s] > 0, cycles > 0 (a half cycle is 0.5). Unequal start and stroke.
    Drive(DriveProfile profile, double start, double stroke, double speed, double cycles);

    /// Table: strictly increasing times from 0, at least 4 rows. Throws InputError otherwise.
    Drive(std::vector<double> times, std::vector<double> positions);

    DriveProfile profile() const;

    double duration() const;

    double minimum() const;

    double maximum() const;

    /// Largest |v| [mm/s].
    double peak_speed() const;

    /// Times strictly between 0 and duration() where the direction of motion changes, increasing.
    const std::vector<double> &reversals() const;

    enum class Side
    {
      before,
      after
    };

    /// Position and velocity; at a reversal of the triangle v is that just before or just after it.
    DrivePoint at(double time, Side side = Side::before) const;

    /// The end of a step from `time` that moves x by at most `dx` > 0 [mm]: the first later time at which |x - x(time)| = dx,
    /// the next reversal, the beginning or end of a rest, or the end of the drive, whichever comes first. A remainder of less
    /// than 1e-3 dx before a reversal or the end is taken along, so that those are hit exactly and never by a sliver of a step.
    DrivePoint step(double time, double dx) const;

  private:
    class Motion;
    std::shared_ptr<const Motion> motion;
  };
} // namespace sprag
