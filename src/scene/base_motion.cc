// SPDX-License-Identifier: GPL-3.0-only
#include "scene/base_motion.h"

#include "base/ranges.h"

#include <gsl/gsl_fft_complex.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <random>

namespace sprag
{
  namespace
  {
    constexpr double full_turn          = 2. * M_PI;
    constexpr double samples_per_period = 24.;

    BaseMotion at_rest()
    {
      BaseMotion motion;
      motion.at  = [](double, std::size_t) { return BasePoint{ 0., 0., 0., 0. }; };
      motion.end = 0.;
      return motion;
    }

    BaseMotion harmonic(const IsolationSettings &settings)
    {
      const double X = settings.base_amplitude, w = full_turn * settings.base_frequency;
      BaseMotion motion;
      motion.at = [=](const double t, std::size_t)
      {
        const double sine = std::sin(w * t), cosine = std::cos(w * t);
        return BasePoint{ X * sine, X * w * cosine, -X * w * w * sine, -X * w * w * w * cosine };
      };
      motion.shortest_period = 1. / settings.base_frequency;
      motion.frequency       = settings.base_frequency;
      return motion;
    }

    /// X sin(phi), phi' = w0 + r t or w0 e^(r t).
    BaseMotion sweep(const IsolationSettings &settings)
    {
      const double X = settings.base_amplitude, T = settings.duration;
      const double w0 = full_turn * settings.base_frequency, w1 = full_turn * settings.final_frequency;
      const bool linear = settings.sweep == SweepForm::linear || w0 == w1;
      const double rate = linear ? (w1 - w0) / T : std::log(w1 / w0) / T;
      BaseMotion motion;
      motion.at = [=](const double t, std::size_t)
      {
        const double w     = linear ? w0 + rate * t : w0 * std::exp(rate * t);
        const double phase = linear ? (w0 + 0.5 * rate * t) * t : (w - w0) / rate;
        const double dw = linear ? rate : rate * w, ddw = linear ? 0. : rate * rate * w;
        const double sine = std::sin(phase), cosine = std::cos(phase);
        return BasePoint{ X * sine, X * w * cosine, X * (dw * cosine - w * w * sine),
                          X * (ddw * cosine - 3. * w * dw * sine - w * w * w * cosine) };
      };
      motion.shortest_period = 1. / std::max(settings.base_frequency, settings.final_frequency);
      return motion;
    }

    BaseMotion shock(const IsolationSettings &settings)
    {
      const double X = settings.base_amplitude, w = full_turn * settings.base_frequency, end = 0.5 / settings.base_frequency;
      const bool is_step = settings.shock == ShockForm::step;
      BaseMotion motion;
      motion.at = [=](const double t, const std::size_t piece)
      {
        if (piece > 0)
          return is_step ? BasePoint{ X, 0., 0., 0. } : BasePoint{ X * w * (2. * t - end), 2. * X * w, 0., 0. };
        const double sine = std::sin(w * t), cosine = std::cos(w * t);
        if (is_step)
          return BasePoint{ 0.5 * X * (1. - cosine), 0.5 * X * w * sine, 0.5 * X * w * w * cosine, -0.5 * X * w * w * w * sine };
        return BasePoint{ X * (w * t - sine), X * w * (1. - cosine), X * w * w * sine, X * w * w * w * cosine };
      };
      motion.kinks = { end };
      if (is_step)
        motion.jumps = motion.kinks;
      motion.shortest_period = 1. / settings.base_frequency;
      motion.end             = end;
      return motion;
    }

    /// Joins the rows by lines straight in logarithms, as those of vibration specifications, where both have them.
    double interpolated(const Samples &samples, const double at)
    {
      const auto next = std::upper_bound(samples.at.begin(), samples.at.end(), at);
      if (next == samples.at.begin() || (next == samples.at.end() && at > samples.at.back()))
        return 0.;
      const auto i         = std::min<std::size_t>(static_cast<std::size_t>(next - samples.at.begin()), samples.at.size() - 1);
      const auto &[f, S]   = samples;
      const bool has_logs  = f[i - 1] > 0. && S[i - 1] > 0. && S[i] > 0.;
      const auto scaled    = [has_logs](const double value) { return has_logs ? std::log(value) : value; };
      const double share   = (scaled(at) - scaled(f[i - 1])) / (scaled(f[i]) - scaled(f[i - 1]));
      const double between = scaled(S[i - 1]) + share * (scaled(S[i]) - scaled(S[i - 1]));
      return has_logs ? std::exp(between) : between;
    }

    struct Line
    {
      double amplitude, w, phase; ///< [mm/s^2, 1/s, 1]
    };

    /// Uniform in [0, 1), the same with every library.
    double uniform(std::mt19937_64 &random)
    {
      return static_cast<double>(random() >> 11) * 0x1p-53;
    }

    /// Distance of the lines in frequency, that of the first one from 0 [Hz], and their number.
    struct Grid
    {
      double width, first;
      std::size_t lines;
      std::size_t period; ///< samples after which lines at multiples of the width repeat; 0: each is anywhere in its band
    };

    /// Without a number the lines are so dense that the motion repeats at the earliest after twice the run, and at least 200: an
    /// oscillator of light damping answers few lines, and another seed would give it others.
    Grid make_grid(const IsolationSettings &settings, const double step)
    {
      constexpr double least = 200.;
      const double first = settings.lowest_frequency, band = settings.highest_frequency - first;
      if (const auto number = settings.spectrum_lines)
        return { band / *number, first, static_cast<std::size_t>(*number), 0 };
      std::size_t period = 1;
      while (static_cast<double>(period) * step < std::max(2. * settings.duration, (least + 1.) / band))
        period *= 2;
      const double width = 1. / (static_cast<double>(period) * step), before = std::ceil(first / width);
      return { width, before * width, static_cast<std::size_t>(settings.highest_frequency / width - before) + 1, period };
    }

    std::vector<Line> random_lines(const IsolationSettings &settings, const Grid &grid)
    {
      std::mt19937_64 random(settings.seed);
      std::vector<Line> lines;
      double sum = 0.;
      for (std::size_t i = 0; i < grid.lines; ++i)
      {
        const double place   = static_cast<double>(i) + (grid.period > 0 ? 0. : uniform(random));
        const double f       = grid.first + place * grid.width;
        const double density = settings.spectrum == BaseSpectrum::table
                                   ? interpolated(settings.base_table, f)
                                   : kanai_tajimi(f, settings.ground_frequency, settings.ground_damping);
        lines.push_back({ std::sqrt(2. * density * grid.width), full_turn * f, full_turn * uniform(random) });
        sum += density * grid.width;
      }
      if (settings.spectrum == BaseSpectrum::kanai_tajimi)
        for (auto &line : lines)
          line.amplitude *= settings.rms_acceleration / std::sqrt(sum);
      return lines;
    }

    /// The sum of all lines with its derivatives at an instant.
    struct Shaking
    {
      double a, jerk, snap;
    };

    std::vector<Shaking> sampled(const std::vector<Line> &lines, const double step, const std::size_t samples)
    {
      std::vector<Shaking> result(samples, Shaking{ 0., 0., 0. });
      for (const auto &[amplitude, w, phase] : lines)
      {
        constexpr std::size_t afresh    = 256; // so that round-off does not grow
        const std::complex<double> turn = std::polar(1., w * step);
        std::complex<double> value;
        for (std::size_t i = 0; i < samples; ++i)
        {
          value = i % afresh == 0 ? std::polar(amplitude, w * step * static_cast<double>(i) + phase) : value * turn;
          result[i].a += value.real();
          result[i].jerk -= w * value.imag();
          result[i].snap -= w * w * value.real();
        }
      }
      return result;
    }

    /// The same by Fourier's fast transform of lines at multiples of the grid's width.
    std::vector<Shaking> sampled(const std::vector<Line> &lines, const Grid &grid, const std::size_t samples)
    {
      std::vector<Shaking> result(samples, Shaking{ 0., 0., 0. });
      std::vector<std::complex<double>> values(grid.period);
      for (const auto &[derivative, member] :
           { std::make_pair(0, &Shaking::a), std::make_pair(1, &Shaking::jerk), std::make_pair(2, &Shaking::snap) })
      {
        std::fill(values.begin(), values.end(), 0.);
        for (const auto &[amplitude, w, phase] : lines)
          values[static_cast<std::size_t>(std::lround(w / full_turn / grid.width))] =
              std::polar(amplitude * std::pow(w, derivative), phase + 0.5 * M_PI * derivative);
        gsl_fft_complex_radix2_backward(reinterpret_cast<double *>(values.data()), 1, grid.period);
        for (std::size_t i = 0; i < samples; ++i)
          result[i].*member = values[i].real();
      }
      return result;
    }

    /// A quintic of the acceleration over the share of a step, integrated from x and v at its beginning.
    struct ShakingPiece
    {
      double x, v;
      std::array<double, 6> c;

      BasePoint at(const double share, const double h) const
      {
        BasePoint point{ 0., 0., 0., 0. };
        for (std::size_t k = c.size(); k-- > 0;)
        {
          const double n = static_cast<double>(k);
          point.a        = point.a * share + c[k];
          point.v        = point.v * share + c[k] / (n + 1.);
          point.x        = point.x * share + c[k] / ((n + 1.) * (n + 2.));
          if (k > 0)
            point.jerk = point.jerk * share + n * c[k];
        }
        return { x + h * share * (v + h * share * point.x), v + h * share * point.v, point.a, point.jerk / h };
      }
    };

    std::array<double, 6> quintic(const Shaking &begin, const Shaking &end, const double h)
    {
      const double first = begin.jerk * h, half = 0.5 * begin.snap * h * h;
      const double d0 = end.a - begin.a - first - half, d1 = (end.jerk - begin.jerk - begin.snap * h) * h;
      const double d2 = (end.snap - begin.snap) * h * h;
      return { { begin.a, first, half, 10. * d0 - 4. * d1 + 0.5 * d2, -15. * d0 + 7. * d1 - d2, 6. * d0 - 3. * d1 + 0.5 * d2 } };
    }

    /// x and v of the lines at t = 0, from where the pieces are integrated.
    BasePoint beginning(const std::vector<Line> &lines)
    {
      BasePoint point{ 0., 0., 0., 0. };
      for (const auto &[amplitude, w, phase] : lines)
      {
        point.v += amplitude * std::sin(phase) / w;
        point.x -= amplitude * std::cos(phase) / (w * w);
      }
      return point;
    }

    /// Sampled so densely that quintics between the samples miss 1e-8 of the fastest line.
    BaseMotion random(const IsolationSettings &settings)
    {
      const double h     = 1. / (samples_per_period * settings.highest_frequency);
      const auto pieces  = static_cast<std::size_t>(settings.duration / h) + 1;
      const auto grid    = make_grid(settings, h);
      const auto lines   = random_lines(settings, grid);
      const auto samples = grid.period > 0 ? sampled(lines, grid, pieces + 1) : sampled(lines, h, pieces + 1);
      const auto shaking = std::make_shared<std::vector<ShakingPiece>>();
      BasePoint now      = beginning(lines);
      BaseMotion motion;
      for (std::size_t i = 0; i < pieces; ++i)
      {
        shaking->push_back({ now.x, now.v, quintic(samples[i], samples[i + 1], h) });
        now = shaking->back().at(1., h);
        motion.kinks.push_back(static_cast<double>(i + 1) * h);
      }
      motion.at = [shaking, h](const double t, const std::size_t piece)
      {
        const std::size_t i = std::min(piece, shaking->size() - 1);
        return (*shaking)[i].at(t / h - static_cast<double>(i), h);
      };
      motion.shortest_period = 1. / settings.highest_frequency;
      return motion;
    }

    /// A record with its first and second integral at the samples.
    struct Integrated
    {
      Samples a;
      std::vector<double> v, x;
    };

    Integrated integrated(const Samples &record)
    {
      Integrated result{ record, { 0. }, { 0. } };
      const auto &[times, a] = record;
      for (std::size_t i = 1; i < times.size(); ++i)
      {
        const double dt = times[i] - times[i - 1];
        result.x.push_back(result.x.back() + dt * (result.v.back() + dt * (2. * a[i - 1] + a[i]) / 6.));
        result.v.push_back(result.v.back() + 0.5 * dt * (a[i - 1] + a[i]));
      }
      return result;
    }

    BaseMotion record(const IsolationSettings &settings)
    {
      const auto data = std::make_shared<const Integrated>(
          integrated(settings.corrects_drift ? without_drift(settings.base_table) : settings.base_table));
      BaseMotion motion;
      motion.at = [data](const double t, const std::size_t piece)
      {
        const auto &times   = data->a.at;
        const std::size_t i = std::min(piece, times.size() - 1);
        const double dt     = t - times[i];
        if (i + 1 == times.size())
          return BasePoint{ data->x[i] + dt * data->v[i], data->v[i], 0., 0. };
        const double a     = data->a.values[i];
        const double slope = (data->a.values[i + 1] - a) / (times[i + 1] - times[i]);
        return BasePoint{ data->x[i] + dt * (data->v[i] + dt * (a / 2. + dt * slope / 6.)),
                          data->v[i] + dt * (a + dt * slope / 2.), a + dt * slope, slope };
      };
      motion.kinks.assign(data->a.at.begin() + 1, data->a.at.end());
      motion.end = motion.kinks.back();
      if (data->a.values.back() != 0.)
        motion.jumps = { motion.end };
      return motion;
    }
  } // namespace

  Samples without_drift(const Samples &record)
  {
    // Normal equations of c t + d t^2 for the velocity, by the trapezoidal rule over time.
    const auto all = integrated(record);
    std::array<double, 3> moments{};
    std::array<double, 2> right{};
    const auto &times = record.at;
    for (std::size_t i = 0; i < times.size(); ++i)
    {
      const double weight = 0.5 * (times[std::min(i + 1, times.size() - 1)] - times[i == 0 ? 0 : i - 1]), t = times[i];
      for (unsigned int k = 0; k < 3; ++k)
        moments[k] += weight * std::pow(t, k + 2);
      right[0] += weight * t * all.v[i];
      right[1] += weight * t * t * all.v[i];
    }
    const double determinant = moments[0] * moments[2] - moments[1] * moments[1];
    const double c           = (right[0] * moments[2] - right[1] * moments[1]) / determinant;
    const double d           = (right[1] * moments[0] - right[0] * moments[1]) / determinant;
    Samples result           = record;
    for (std::size_t i = 0; i < times.size(); ++i)
      result.values[i] -= c + 2. * d * times[i];
    return result;
  }

  RecordedTravel recorded_travel(const Samples &record)
  {
    const auto travel = [](const Samples &samples) { return largest(integrated(samples).x, [](const double x) { return x; }); };
    return { travel(record), travel(without_drift(record)) };
  }

  double kanai_tajimi(const double frequency, const double ground_frequency, const double ground_damping)
  {
    const double r = frequency / ground_frequency, square = std::pow(2. * ground_damping * r, 2);
    return (1. + square) / (std::pow(1. - r * r, 2) + square);
  }

  BaseMotion base_motion(const IsolationSettings &settings)
  {
    switch (settings.base)
    {
    case BaseMotionType::harmonic:
      return harmonic(settings);
    case BaseMotionType::sweep:
      return sweep(settings);
    case BaseMotionType::shock:
      return shock(settings);
    case BaseMotionType::random:
      return random(settings);
    case BaseMotionType::record:
      return record(settings);
    case BaseMotionType::none:
      break;
    }
    return at_rest();
  }
} // namespace sprag
