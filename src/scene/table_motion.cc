// SPDX-License-Identifier: GPL-3.0-only
#include "base/errors.h"
#include "base/monotone_cubic.h"
#include "base/text.h"
#include "scene/motion.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// Up to so many samples, each is a kink.
    constexpr std::size_t most_samples_met = 2000;

    class Table : public DriveMotion
    {
    public:
      Table(const std::vector<double> &times_, const std::vector<double> &positions_)
          : DriveMotion(DriveProfile::table)
          , sample_times(times_)
          , sample_positions(positions_)
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

      /// The cubic is monotone between samples, so that it turns or comes to rest only where they do.
      void find_pieces()
      {
        int before = 2;
        for (std::size_t i = 0; i + 1 < sample_times.size(); ++i)
        {
          const int direction = signum(sample_positions[i + 1] - sample_positions[i]);
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
    };

  } // namespace

  std::shared_ptr<const DriveMotion> table_motion(const std::vector<double> &times, const std::vector<double> &positions)
  {
    return std::make_shared<const Table>(times, positions);
  }
} // namespace sprag
