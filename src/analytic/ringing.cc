// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/ringing.h"

#include "base/least_squares.h"
#include "base/ranges.h"
#include "base/unknown.h"

#include <boost/numeric/ublas/lu.hpp>
#include <gsl/gsl_fft_real.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numeric>
#include <optional>

namespace sprag
{
  namespace
  {
    using Complex = std::complex<double>;

    constexpr double fewest_periods  = 2.;  ///< of a signal that has a frequency
    constexpr std::size_t padding    = 4;   ///< points of the spectrum per sample, at least
    constexpr double weakest_peak    = 0.1; ///< of a sinusoid, relative to the whole spectrum; side lobes stay below 0.03
    constexpr unsigned int unknowns  = 6;   ///< of the fit
    constexpr unsigned int max_steps = 50;  ///< of the fit

    Signal without_trend(Signal signal)
    {
      std::vector<double> index(signal.values.size());
      std::iota(index.begin(), index.end(), 0.);
      const Line trend = fitted_line(index, signal.values);
      for (std::size_t i = 0; i < index.size(); ++i)
        signal.values[i] -= trend.at(index[i]);
      return signal;
    }

    /// Part of the signal between its first and its last value beyond the noise.
    Signal loud_part(const Signal &signal, const double noise)
    {
      const Signal level = without_trend(signal);
      const auto is_loud = [noise](const double value) { return std::abs(value) > noise; };
      const auto first   = std::find_if(level.values.begin(), level.values.end(), is_loud);
      const auto last    = std::find_if(level.values.rbegin(), level.values.rend(), is_loud).base();
      if (first >= last)
        return { signal.step, {} };
      const auto begin = signal.values.begin();
      return { signal.step, { begin + (first - level.values.begin()), begin + (last - level.values.begin()) } };
    }

    /// Magnitudes at multiples of 1 / (2 (size - 1) step), after a Hann window.
    std::vector<double> spectrum(const Signal &signal)
    {
      const std::size_t n = signal.values.size();
      std::size_t padded  = 1;
      while (padded < padding * n)
        padded *= 2;
      std::vector<double> values(padded); // real parts from the front, imaginary ones from the back after the transform
      for (std::size_t i = 0; i < n; ++i)
        values[i] = signal.values[i] * std::pow(std::sin(M_PI * (static_cast<double>(i) + 0.5) / static_cast<double>(n)), 2);
      gsl_fft_real_radix2_transform(values.data(), 1, padded);
      std::vector<double> magnitudes{ std::abs(values[0]) };
      for (std::size_t i = 1; 2 * i < padded; ++i)
        magnitudes.push_back(std::sqrt(values[i] * values[i] + values[padded - i] * values[padded - i]));
      magnitudes.push_back(std::abs(values[padded / 2]));
      return magnitudes;
    }

    /// Position of the maximum of the parabola through the logarithms of a peak and its neighbours.
    double interpolated_peak(const std::vector<double> &magnitudes, const std::size_t peak)
    {
      const double before = std::log(magnitudes[peak - 1]);
      const double at     = std::log(magnitudes[peak]);
      const double after  = std::log(magnitudes[peak + 1]);
      const double offset = 0.5 * (before - after) / (before - 2. * at + after);
      return static_cast<double>(peak) + (std::isfinite(offset) ? offset : 0.);
    }

    std::optional<double> spectral_peak(const Signal &signal)
    {
      const auto magnitudes   = spectrum(without_trend(signal));
      const double resolution = 0.5 / (static_cast<double>(magnitudes.size() - 1) * signal.step);
      const double lowest     = fewest_periods / (static_cast<double>(signal.values.size()) * signal.step);
      std::size_t peak        = 0;
      for (auto i = static_cast<std::size_t>(std::ceil(lowest / resolution)); i + 1 < magnitudes.size(); ++i)
        if (magnitudes[i] >= magnitudes[i - 1] && magnitudes[i] > magnitudes[i + 1])
          if (peak == 0 || magnitudes[i] > magnitudes[peak])
            peak = i;
      if (peak == 0 || magnitudes[peak] < weakest_peak * *std::max_element(magnitudes.begin(), magnitudes.end()))
        return std::nullopt;
      return interpolated_peak(magnitudes, peak) * resolution;
    }

    double envelope_growth(const Signal &signal, const double frequency, const double noise)
    {
      const double samples = 1. / (frequency * signal.step);
      const auto n_periods = static_cast<std::size_t>(static_cast<double>(signal.values.size()) / samples);
      std::vector<double> times, logarithms;
      for (std::size_t i = 0; i < n_periods; ++i)
      {
        const auto begin         = signal.values.begin() + std::lround(static_cast<double>(i) * samples);
        const auto end           = signal.values.begin() + std::lround(static_cast<double>(i + 1) * samples);
        const auto [least, most] = std::minmax_element(begin, end);
        if (const double half_range = (*most - *least) / 2.; half_range > noise)
        {
          times.push_back(static_cast<double>(i) / frequency);
          logarithms.push_back(std::log(half_range));
        }
      }
      return times.size() < 2 ? unknown : fitted_line(times, logarithms).slope;
    }

    using Vector = std::array<double, unknowns>;

    /// exp(growth t) (a cos(omega t) + b sin(omega t)) + c + d t, t from 0 to 1 over the signal. The unknowns are a, b, c, d,
    /// omega and growth in this order.
    struct Fit
    {
      const Signal &signal;
      Vector parameters;

      /// Does one step of Gauss-Newton. Returns its change of omega, none if the matrix is singular.
      std::optional<double> improve()
      {
        namespace dense = boost::numeric::ublas;
        std::array<Vector, unknowns> sums{}; // below the diagonal
        dense::vector<double> change = dense::zero_vector<double>(unknowns);
        dense::permutation_matrix<std::size_t> order(unknowns);
        Complex wave       = 1.;
        const Complex turn = std::exp(Complex(parameters[5], parameters[4]) * time(1));
        for (std::size_t i = 0; i < signal.values.size(); ++i, wave *= turn)
        {
          const double t        = time(i);
          const Vector gradient = gradient_at(t, wave);
          const double rest     = signal.values[i] - value_at(gradient, t);
          for (unsigned int row = 0; row < unknowns; ++row)
          {
            change[row] += gradient[row] * rest;
            for (unsigned int column = 0; column <= row; ++column)
              sums[row][column] += gradient[row] * gradient[column];
          }
        }
        dense::matrix<double> matrix(unknowns, unknowns);
        for (unsigned int row = 0; row < unknowns; ++row)
          for (unsigned int column = 0; column <= row; ++column)
            matrix(row, column) = matrix(column, row) = sums[row][column];
        // At zero amplitude omega and growth have no gradient: the first step solves for the linear unknowns alone.
        if (parameters[0] == 0. && parameters[1] == 0.)
          matrix(4, 4) = matrix(5, 5) = 1.;
        if (dense::lu_factorize(matrix, order) != 0)
          return std::nullopt;
        dense::lu_substitute(matrix, order, change);
        for (unsigned int i = 0; i < unknowns; ++i)
          parameters[i] += change[i];
        return change[4];
      }

      Signal without_drift() const
      {
        Signal result = signal;
        for (std::size_t i = 0; i < result.values.size(); ++i)
          result.values[i] -= parameters[2] + parameters[3] * time(i);
        return result;
      }

      double time(const std::size_t i) const
      {
        return static_cast<double>(i) / static_cast<double>(signal.values.size());
      }

      /// `wave`: exp((growth + i omega) t).
      Vector gradient_at(const double t, const Complex &wave) const
      {
        const double cosine = wave.real(), sine = wave.imag();
        const double value = parameters[0] * cosine + parameters[1] * sine;
        return { { cosine, sine, 1., t, t * (parameters[1] * cosine - parameters[0] * sine), t * value } };
      }

      double value_at(const Vector &gradient, const double t) const
      {
        return parameters[0] * gradient[0] + parameters[1] * gradient[1] + parameters[2] + parameters[3] * t;
      }
    };

    /// Frequency by the fit, or the spectrum's if the fit leaves it by more than the spectrum's resolution, and the signal
    /// without its drift.
    std::pair<double, Signal> refined(const Signal &signal, const double frequency, const double growth)
    {
      const double length = static_cast<double>(signal.values.size()) * signal.step;
      const double start  = 2. * M_PI * frequency * length;
      Fit fit{ signal, { { 0., 0., 0., 0., start, growth * length } } };
      for (unsigned int i = 0; i < max_steps; ++i)
      {
        const auto change = fit.improve();
        if (!change || !(std::abs(fit.parameters[4] - start) < 2. * M_PI))
          return { frequency, without_trend(signal) };
        if (i > 0 && std::abs(*change) < 1e-9 * start)
          break;
      }
      return { fit.parameters[4] / (2. * M_PI * length), fit.without_drift() };
    }
  } // namespace

  Recurrence find_recurrence(const Signal &signal)
  {
    constexpr double same  = 4e-4; ///< mean square of the change, over that of the signal
    constexpr double other = 0.5;  ///< the same of a signal that has left its beginning
    const auto &values     = signal.values;
    const std::size_t n    = values.size();
    const double mean      = std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(n);
    const double square    = sum_over(values, [=](const double v) { return (v - mean) * (v - mean) / static_cast<double>(n); });

    struct Shifted
    {
      double share;  ///< of a step beyond the lag that makes the change least
      double change; ///< mean square
    };
    const auto shifted = [&](const std::size_t lag)
    {
      double by_step = 0., step_square = 0., lag_square = 0.;
      for (std::size_t i = lag + 1; i < n; ++i)
      {
        const double change = values[i] - values[i - lag], step = values[i - lag - 1] - values[i - lag];
        by_step += change * step;
        step_square += step * step;
        lag_square += change * change;
      }
      const double share = std::clamp(by_step / step_square, 0., 1.);
      return Shifted{ share, (lag_square - share * (2. * by_step - share * step_square)) / static_cast<double>(n - lag - 1) };
    };

    bool has_left = false;
    for (std::size_t lag = 1; 2 * lag < n; ++lag)
    {
      auto found = shifted(lag);
      has_left   = has_left || found.change > other * square;
      if (!has_left || !(found.change < same * square))
        continue;
      for (auto next = shifted(lag + 1); next.change < found.change; next = shifted(lag + 1))
      {
        found = next;
        ++lag;
      }
      return { (static_cast<double>(lag) + found.share) * signal.step, std::sqrt(found.change / square) };
    }
    return {};
  }

  Ringing ringing(const Signal &signal, const double noise)
  {
    if (signal.values.size() < 2)
      return {};
    const Signal part = loud_part(signal, noise);
    if (part.values.size() < 8)
      return {};
    const auto coarse = spectral_peak(part);
    if (!coarse)
      return {};
    const double growth          = envelope_growth(without_trend(part), *coarse, noise);
    const auto [frequency, wave] = refined(part, *coarse, std::isfinite(growth) ? growth : 0.);
    return { frequency, envelope_growth(wave, frequency, noise) };
  }
} // namespace sprag
