// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/pressure_recovery.h"

#include <deal.II/lac/exceptions.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace sprag
{
  /// The data that a pressure is fitted to: points along a face or means over some of them.
  struct PressureData
  {
    std::vector<double> xi;       ///< [mm]
    std::vector<double> weight;   ///< area [mm^2]
    std::vector<double> pressure; ///< [MPa]
    std::vector<double> trust;    ///< weight in the misfit [mm^2]
    double size = 0.;             ///< misfit of no pressure
  };

  /// p = (1 + s)^m (1 - s)^n (c_0 + c_1 T_1(s) + ...) with Chebyshev polynomials, s from -1 at a to 1 at b; none elsewhere.
  struct PressureFit
  {
    static constexpr unsigned int largest_degree = 16;
    using Coefficients                           = std::array<double, largest_degree + 1>;

    struct Exponents
    {
      double left, right;
    };

    double a = 0., b = 0.; ///< [mm]
    Exponents exponents{ 0.5, 0.5 };
    unsigned int degree = 2;
    Coefficients c{};
    double misfit = std::numeric_limits<double>::infinity(); ///< sum of its squares, weighted with trust

    double pressure(double xi) const;
  };

  namespace
  {
    /// Returns whether xi lies in the contact; if so, sets the functions that the coefficients belong to, there.
    bool set_shapes(const PressureFit &fit, const double xi, PressureFit::Coefficients &values)
    {
      const double s = (2. * xi - fit.a - fit.b) / (fit.b - fit.a);
      if (!(std::abs(s) < 1.))
        return false;
      values[0] = std::exp(fit.exponents.left * std::log(1. + s) + fit.exponents.right * std::log(1. - s));
      values[1] = s * values[0];
      for (unsigned int k = 2; k <= fit.degree; ++k)
        values[k] = 2. * s * values[k - 1] - values[k - 2];
      return true;
    }

    double dot(const PressureFit::Coefficients &x, const PressureFit::Coefficients &y, const unsigned int n)
    {
      return std::inner_product(x.begin(), x.begin() + n, y.begin(), 0.);
    }
  } // namespace

  double PressureFit::pressure(const double xi) const
  {
    Coefficients values;
    return set_shapes(*this, xi, values) ? dot(c, values, degree + 1) : 0.;
  }

  /// Sets the coefficients of least misfit among those that keep resultant and moment of the data, and the misfit; infinite if
  /// the data do not determine the coefficients.
  void set_coefficients(const PressureData &data, PressureFit &fit)
  {
    const unsigned int n = fit.degree + 1;
    const double middle  = 0.5 * (fit.a + fit.b);
    std::array<PressureFit::Coefficients, PressureFit::largest_degree + 1> squares{};
    PressureFit::Coefficients load{}, force{}, moment{}, shapes;
    double force_sum = 0., moment_sum = 0.;
    for (std::size_t i = 0; i < data.xi.size(); ++i)
    {
      const double area = data.weight[i], trust = data.trust[i], p = data.pressure[i], arm = data.xi[i] - middle;
      force_sum += area * p;
      moment_sum += area * p * arm;
      if (!set_shapes(fit, data.xi[i], shapes))
        continue;
      for (unsigned int j = 0; j < n; ++j)
      {
        load[j] += trust * p * shapes[j];
        force[j] += area * shapes[j];
        moment[j] += area * arm * shapes[j];
        for (unsigned int k = 0; k <= j; ++k)
          squares[j][k] += trust * shapes[j] * shapes[k];
      }
    }
    dealii::LAPACKFullMatrix<double> matrix(n + 2);
    dealii::Vector<double> solution(n + 2);
    for (unsigned int j = 0; j < n; ++j)
    {
      for (unsigned int k = 0; k <= j; ++k)
        matrix(j, k) = matrix(k, j) = squares[j][k];
      matrix(j, n) = matrix(n, j) = force[j];
      matrix(j, n + 1) = matrix(n + 1, j) = moment[j];
      solution[j]                         = load[j];
    }
    solution[n]     = force_sum;
    solution[n + 1] = moment_sum;
    fit.misfit      = std::numeric_limits<double>::infinity();
    try
    {
      matrix.compute_lu_factorization();
    }
    catch (const dealii::LACExceptions::ExcSingular &)
    {
      return;
    }
    matrix.solve(solution);
    for (unsigned int k = 0; k < n; ++k)
      fit.c[k] = solution[k];
    fit.misfit = data.size;
    for (unsigned int j = 0; j < n; ++j)
      fit.misfit += fit.c[j] * (squares[j][j] * fit.c[j] + 2. * (dot(squares[j], fit.c, j) - load[j]));
  }

  namespace
  {
    constexpr std::size_t fewest_samples = 10;
    constexpr double largest_misfit      = 0.25; ///< root mean square over that of the pressure
    constexpr std::size_t enough_samples = 48;
    constexpr unsigned int least_degree  = 2;
    constexpr double trust_in_cell[]     = { 0.01, 0.1, 1. }; ///< from the edge inwards
    constexpr double edge_hold           = 0.1;               ///< root of the misfit that a move by a cell costs
    constexpr double soft_gain           = 0.5;               ///< of the misfit, for exponents of a thin layer or a soft penalty

    struct Range
    {
      std::size_t begin;
      std::size_t end; ///< beyond the last
    };

    /// Samples under pressure; gaps of less than a fifth of the whole are dents.
    std::optional<Range> single_contact(const PressureSamples &samples)
    {
      const auto &p     = samples.pressure;
      std::size_t first = p.size(), last = 0, closed = 0;
      for (std::size_t i = 0; i < p.size(); ++i)
        if (p[i] > 0.)
        {
          first = std::min(first, i);
          last  = i;
          ++closed;
        }
      if (closed < fewest_samples || 5 * (last + 1 - first - closed) > last + 1 - first)
        return {};
      const double spacing = (samples.xi[last] - samples.xi[first]) / static_cast<double>(last - first);
      if (samples.xi[first] - samples.begin < 2. * spacing || samples.end - samples.xi[last] < 2. * spacing)
        return {};
      return Range{ first, last + 1 };
    }

    /// Returns the samples in and beside the contact, as means over some.
    PressureData data(const PressureSamples &samples, const Range &contact, const Range &range, const std::size_t together)
    {
      const unsigned int first = samples.cell[contact.begin], last = samples.cell[contact.end - 1];
      PressureData result;
      for (std::size_t i = range.begin; i < range.end; i += together)
      {
        double area = 0., force = 0., moment = 0., trust = 0.;
        for (std::size_t k = i; k < std::min(i + together, range.end); ++k)
        {
          const unsigned int cell   = std::clamp(samples.cell[k], first, last);
          const unsigned int inside = std::min({ cell - first, last - cell, 2u });
          area += samples.weight[k];
          force += samples.weight[k] * samples.pressure[k];
          moment += samples.weight[k] * samples.xi[k];
          trust += samples.weight[k] * trust_in_cell[inside];
        }
        result.xi.push_back(moment / area);
        result.weight.push_back(area);
        result.pressure.push_back(force / area);
        result.trust.push_back(trust);
        result.size += trust * force * force / (area * area);
      }
      return result;
    }

    /// Finds where the trial pressure, linear between a sample under pressure and the one beside it, changes sign.
    double zero(const PressureSamples &samples, const std::size_t closed, const std::size_t open)
    {
      if (open >= samples.xi.size())
        return samples.xi[closed];
      const double inside = samples.trial[closed], outside = std::min(0., samples.trial[open]);
      return samples.xi[closed] + (samples.xi[open] - samples.xi[closed]) * inside / (inside - outside);
    }

    /// Moves both edges of the contact by turns, in shares of a cell that halve.
    PressureFit with_best_edges(const PressureData &data, PressureFit best, const double cell)
    {
      const double a = best.a, b = best.b;
      const auto cost = [&](const PressureFit &fit)
      {
        const double left = (fit.a - a) / cell, right = (fit.b - b) / cell;
        return fit.misfit + edge_hold * edge_hold * data.size * (left * left + right * right);
      };
      for (const double share : { 0.2, 0.06, 0.02 })
        for (double PressureFit::*const edge : { &PressureFit::a, &PressureFit::b })
          for (const double sign : { -1., 1. })
            for (unsigned int times = 0; times < 2; ++times)
            {
              PressureFit next = best;
              next.*edge += sign * share * cell;
              set_coefficients(data, next);
              if (!(cost(next) < cost(best)))
                break;
              best = next;
            }
      return best;
    }

    PressureFit with_best_exponents(const PressureData &data, PressureFit fit)
    {
      PressureFit best                              = fit;
      constexpr PressureFit::Exponents candidates[] = { { 0.5, 0.5 }, { 0.4, 0.6 }, { 0.6, 0.4 }, { 0.75, 0.75 }, { 1., 1. } };
      for (const auto &exponents : candidates)
      {
        fit.exponents = exponents;
        set_coefficients(data, fit);
        if (fit.misfit < (exponents.left + exponents.right > 1.1 ? soft_gain : 1.) * best.misfit)
          best = fit;
      }
      return best;
    }

    /// The fitted pressure at the samples and, by a parabola through a fine grid, where it is largest; none if it is not a single
    /// rise and fall.
    std::optional<RecoveredPressure> single_hump(const PressureSamples &samples, const PressureFit &fit)
    {
      constexpr unsigned int places = 100;
      const double length           = (fit.b - fit.a) / places;
      std::array<double, places + 1> p{};
      unsigned int peak = 0;
      for (unsigned int i = 1; i < places; ++i)
      {
        p[i] = fit.pressure(fit.a + i * length);
        if (!(p[i] >= 0.) || (peak + 1 < i && p[i] > p[i - 1]))
          return {};
        if (p[i] > p[peak])
          peak = i;
      }
      if (peak == 0)
        return {};
      RecoveredPressure result;
      const double slope = 0.5 * (p[peak + 1] - p[peak - 1]), bend = p[peak + 1] - 2. * p[peak] + p[peak - 1];
      const double shift = bend < 0. ? -slope / bend : 0.;
      result.largest     = p[peak] + 0.5 * slope * shift;
      result.place       = fit.a + (peak + shift) * length;
      result.is_fitted   = true;
      result.width       = fit.b - fit.a;
      for (const double xi : samples.xi)
        result.pressure.push_back(fit.pressure(xi));
      return result;
    }

    RecoveredPressure as_sampled(const PressureSamples &samples)
    {
      RecoveredPressure result;
      result.pressure = samples.pressure;
      for (std::size_t i = 0; i < samples.xi.size(); ++i)
        if (const double p = samples.pressure[i]; p > result.largest)
        {
          result.largest = p;
          result.place   = samples.xi[i];
        }
      return result;
    }
  } // namespace

  RecoveredPressure recover(const PressureSamples &samples)
  {
    const auto contact = single_contact(samples);
    if (!contact)
      return as_sampled(samples);
    const std::size_t closed = contact->end - contact->begin;
    const std::size_t aside  = closed / 4 + 2; // edges may move outwards over samples without pressure
    const Range near{ contact->begin - std::min(aside, contact->begin), std::min(contact->end + aside, samples.xi.size()) };
    const auto all = data(samples, *contact, near, 1);
    const auto few = data(samples, *contact, near, 1 + (near.end - near.begin) / enough_samples);

    PressureFit start;
    start.a                  = zero(samples, contact->begin, contact->begin > 0 ? contact->begin - 1 : samples.xi.size());
    start.b                  = zero(samples, contact->end - 1, contact->end);
    const unsigned int cells = samples.cell[contact->end - 1] - samples.cell[contact->begin] + 1;
    const double cell        = (start.b - start.a) / cells;
    for (start.degree = std::clamp(cells / 2, least_degree, PressureFit::largest_degree); start.degree > 0; --start.degree)
    {
      auto fit = with_best_edges(few, with_best_exponents(few, start), cell);
      set_coefficients(all, fit);
      if (!(fit.misfit < largest_misfit * largest_misfit * all.size))
        continue;
      if (auto result = single_hump(samples, fit))
        return *result;
    }
    return as_sampled(samples);
  }

  double contact_width(const PressureSamples &samples, const RecoveredPressure &recovered)
  {
    if (recovered.is_fitted)
      return recovered.width;
    double width = 0.;
    for (std::size_t q = 0; q + 1 < samples.xi.size(); ++q)
    {
      const double length = samples.xi[q + 1] - samples.xi[q];
      const double left   = samples.trial[q];
      const double right  = samples.trial[q + 1];
      if (left > 0. && right > 0.)
        width += length;
      else if (left > 0. || right > 0.)
        width += length * std::max(left, right) / (std::max(left, right) - std::min(left, right));
    }
    return width;
  }
} // namespace sprag
