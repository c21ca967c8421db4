#include "scene/drive.h"

#include "base/errors.h"
#include "base/monotone_cubic.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <deal.II/base/exceptions.h>
#include <optional>

namespace sprag
{
  namespace
  {
    const double pi = std::acos(-1.);

    int sign(const double value)
    {
      return (value > 0.) - (value < 0.);
    }
  } // namespace

  /// The motion as a row of pieces, each going one way or at rest throughout. Piece i lasts from times[i] to times[i+1].
  class Drive::Motion
  {
  public:
    Motion(DriveProfile kind, double start, double stroke, double speed, double cycles);
    Motion(const std::vector<double> &sample_times, const std::vector<double> &sample_positions);

    std::size_t piece(double time, Side side) const;
    double position(std::size_t piece, double time) const;
    double velocity(std::size_t piece, double time) const;
    double moved_by(std::size_t piece, double time, double dx) const;

    DriveProfile profile;
    std::vector<double> times;
    std::vector<double> positions;
    std::vector<double> reversals;
    double peak_speed;

  private:
    double half_cycle = 0.; ///< triangle and harmonic: time from turning point to turning point
    double ends[2]    = { 0., 0. };
    std::optional<MonotoneCubic> samples;

    void find_reversals();
  };

  Drive::Motion::Motion(const DriveProfile kind, const double start, const double stroke, const double speed, const double cycles)
      : profile(kind)
      , half_cycle((kind == DriveProfile::harmonic ? pi / 2. : 1.) * std::abs(stroke - start) / speed)
      , ends{ start, stroke }
  {
    const double n_half_cycles = 2. * cycles;
    for (unsigned int i = 0; i < n_half_cycles; ++i)
    {
      times.push_back(i * half_cycle);
      positions.push_back(ends[i % 2]);
    }
    const auto last          = times.size() - 1;
    const double part        = n_half_cycles - static_cast<double>(last);
    const double end_of_last = part == 1. ? ends[(last + 1) % 2] : position(last, times[last] + part * half_cycle);
    times.push_back(n_half_cycles * half_cycle);
    positions.push_back(end_of_last);
    // A harmonic drive is fastest a quarter of a cycle after its start.
    peak_speed = kind == DriveProfile::harmonic && n_half_cycles < 0.5 ? speed * std::sin(pi * n_half_cycles) : speed;
    find_reversals();
  }

  Drive::Motion::Motion(const std::vector<double> &sample_times, const std::vector<double> &sample_positions)
      : profile(DriveProfile::table)
      , peak_speed(0.)
      , samples(std::in_place, sample_times, sample_positions)
  {
    if (sample_times.front() != 0.)
      throw InputError("row 1: time " + number_text(sample_times.front()) + " s: must be 0");
    // The cubic is monotone between samples, so that it turns or comes to rest only where they do.
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

      // v is a parabola between samples: its extreme follows from three values.
      const double length = sample_times[i + 1] - sample_times[i];
      const double v0     = samples->derivative(sample_times[i]);
      const double v1     = samples->derivative(sample_times[i] + length / 2.);
      const double v2     = samples->derivative(sample_times[i + 1]);
      const double curve  = v0 - 2. * v1 + v2;
      const double vertex = curve == 0. ? 0. : std::clamp((3. * v0 - 4. * v1 + v2) / (4. * curve), 0., 1.);
      const double inside = samples->derivative(sample_times[i] + vertex * length);
      peak_speed          = std::max({ peak_speed, std::abs(v0), std::abs(v2), std::abs(inside) });
    }
    times.push_back(sample_times.back());
    positions.push_back(sample_positions.back());
    if (peak_speed == 0.)
      throw InputError("the position must change");
    find_reversals();
  }

  /// After a rest the direction changes when the motion sets in again.
  void Drive::Motion::find_reversals()
  {
    int before = 0;
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
      if (const int direction = sign(positions[i + 1] - positions[i]); direction != 0)
      {
        if (direction == -before)
          reversals.push_back(times[i]);
        before = direction;
      }
  }

  std::size_t Drive::Motion::piece(const double time, const Side side) const
  {
    const auto after = side == Side::before ? std::lower_bound(times.begin(), times.end(), time)
                                            : std::upper_bound(times.begin(), times.end(), time);
    return std::clamp<std::ptrdiff_t>(after - times.begin(), 1, static_cast<std::ptrdiff_t>(times.size()) - 1) - 1;
  }

  double Drive::Motion::position(const std::size_t piece, const double time) const
  {
    // Turning points and ends are met bit for bit.
    if (time == times[piece])
      return positions[piece];
    if (piece + 1 < positions.size() && time == times[piece + 1])
      return positions[piece + 1];
    if (profile == DriveProfile::table)
      return samples->value(time);
    const double from     = ends[piece % 2];
    const double to       = ends[(piece + 1) % 2];
    const double fraction = (time - times[piece]) / half_cycle;
    if (profile == DriveProfile::triangle)
      return from + (to - from) * fraction;
    const double half_angle_sine = std::sin(pi / 2. * fraction);
    return from + (to - from) * half_angle_sine * half_angle_sine;
  }

  double Drive::Motion::velocity(const std::size_t piece, const double time) const
  {
    if (profile == DriveProfile::table)
      return samples->derivative(time);
    const double mean = (ends[(piece + 1) % 2] - ends[piece % 2]) / half_cycle;
    if (profile == DriveProfile::triangle)
      return std::copysign(peak_speed, mean);
    return pi / 2. * mean * std::sin(pi * (time - times[piece]) / half_cycle);
  }

  /// The time within a moving piece, after `time`, at which x has moved by dx; the piece moves farther than that.
  double Drive::Motion::moved_by(const std::size_t piece, const double time, const double dx) const
  {
    if (profile == DriveProfile::triangle)
      return time + dx / peak_speed;
    const double from = position(piece, time);
    double early      = time;
    double late       = times[piece + 1];
    for (double middle = (early + late) / 2.; early < middle && middle < late; middle = (early + late) / 2.)
      (std::abs(position(piece, middle) - from) < dx ? early : late) = middle;
    return late;
  }

  Drive::Drive()
      : Drive(DriveProfile::triangle, 0., 65., 112., 1.)
  {
  }

  Drive::Drive(const DriveProfile profile, const double start, const double stroke, const double speed, const double cycles)
  {
    Assert(profile != DriveProfile::table, dealii::ExcMessage("A table needs its samples."));
    Assert(start != stroke && speed > 0. && cycles > 0., dealii::ExcMessage("This drive does not move."));
    motion = std::make_shared<const Motion>(profile, start, stroke, speed, cycles);
  }

  Drive::Drive(std::vector<double> times, std::vector<double> positions)
      : motion(std::make_shared<const Motion>(times, positions))
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

  const std::vector<double> &Drive::reversals() const
  {
    return motion->reversals;
  }

  DrivePoint Drive::at(const double time, const Side side) const
  {
    const double inside = std::clamp(time, 0., duration());
    const auto piece    = motion->piece(inside, side);
    return { inside, motion->position(piece, inside), motion->velocity(piece, inside) };
  }

  DrivePoint Drive::step(const double time, const double dx) const
  {
    Assert(dx > 0., dealii::ExcMessage("A step must move."));
    const auto piece      = motion->piece(time, Side::after);
    const double end      = motion->times[piece + 1];
    const double distance = std::abs(motion->positions[piece + 1] - motion->position(piece, time));
    return at(distance < 1.001 * dx ? end : motion->moved_by(piece, time, dx));
  }
} // namespace sprag
