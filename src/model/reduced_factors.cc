// SPDX-License-Identifier: GPL-3.0-only
#include "model/reduced_factors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Sets an entry of the result for each of some rows: its product with a vector.
    SPRAG_FOR_ANY_PROCESSOR void multiply(const RowsOfSixteen &matrix, const std::vector<unsigned int> &rows,
                                          const RowsOfSixteen &vector, float *const result)
    {
      constexpr unsigned int together = 4; // whose sums stay in registers
      const auto n                    = static_cast<unsigned int>(rows.size());
      for (unsigned int i = 0; i < n; i += together)
      {
        const Sixteen *of[together];
        for (unsigned int t = 0; t < together; ++t)
          of[t] = matrix[rows[std::min(i + t, n - 1)]];
        Sixteen sums[together];
        for (std::size_t g = 0; g < matrix.groups(); ++g)
          for (unsigned int t = 0; t < together; ++t)
            sums[t].values += of[t][g].values * vector[0][g].values;
        for (unsigned int t = 0; t < std::min(together, n - i); ++t)
          result[i + t] = sum(sums[t]);
      }
    }

    SPRAG_FOR_ANY_PROCESSOR void add(const float factor, const Sixteen *const some, const std::size_t n_groups,
                                     Sixteen *const result)
    {
      for (std::size_t g = 0; g < n_groups; ++g)
        result[g].values += factor * some[g].values;
    }

    SPRAG_FOR_ANY_PROCESSOR void scale(const float factor, const Sixteen *const factors, const std::size_t n_groups,
                                       Sixteen *const result)
    {
      for (std::size_t g = 0; g < n_groups; ++g)
        result[g].values *= factor * factors[g].values;
    }

    void add(const float factor, const RowsOfSixteen &some, RowsOfSixteen &result)
    {
      add(factor, some[0], some.groups(), result[0]);
    }

    SPRAG_FOR_ANY_PROCESSOR float dot(const RowsOfSixteen &a, const RowsOfSixteen &b)
    {
      Sixteen result;
      for (std::size_t g = 0; g < a.groups(); ++g)
        result.values += a[0][g].values * b[0][g].values;
      return sum(result);
    }

    constexpr unsigned int n_alike = 3; // rows

    /// Adds the sizes of some numbers, times a factor, to sums.
    SPRAG_FOR_ANY_PROCESSOR void add_sizes(const double *const numbers, const double factor, const unsigned int n,
                                           double *const sums)
    {
      unsigned int i = 0;
      for (; i + n_lanes <= n; i += n_lanes)
      {
        Lanes some, sum;
        std::memcpy(&some, numbers + i, sizeof(some));
        std::memcpy(&sum, sums + i, sizeof(sum));
        sum += factor * absolute(some);
        std::memcpy(sums + i, &sum, sizeof(sum));
      }
      for (; i < n; ++i)
        sums[i] += factor * std::abs(numbers[i]);
    }

    /// Adds the products of three rows at once with a vector to `result`, which has room for three more.
    template <class Number, class Entries, class Values>
    SPRAG_PART void add_products(const Entries &entries, const Values &values, const Number *const vector, Number *const result)
    {
      for (std::size_t g = 0; g + 1 < entries.begin.size(); ++g)
      {
        typename Values::value_type sums[2]{};
        std::size_t k         = entries.begin[g];
        const std::size_t end = entries.begin[g + 1];
        for (; k + 1 < end; k += 2)
          for (unsigned int s = 0; s < 2; ++s)
            sums[s].values += values[k + s].values * vector[entries.column[k + s]];
        if (k < end)
          sums[0].values += values[k].values * vector[entries.column[k]];
        for (unsigned int a = 0; a < n_alike; ++a)
          result[n_alike * g + a] += sums[0].values[a] + sums[1].values[a];
      }
    }
  } // namespace

  ReducedFactors::ReducedFactors(const PortCompliance &of_ports, const std::vector<unsigned int> &ports,
                                 const FullMatrix<double> &tangent)
      : n(static_cast<unsigned int>(ports.size()))
      , units(n, 1.)
      , compliance(rows_among(ports, of_ports))
  {
    RowsOfSixteen inverse(1, n);
    for (unsigned int i = 0; i < n; ++i)
    {
      if (const double own = of_ports(ports[i], ports[i]); own > 0.)
        units[i] = std::sqrt(own);
      inverse(0, i) = static_cast<float>(1. / units[i]);
    }
    for (unsigned int i = 0; i < n; ++i)
      scale(inverse(0, i), inverse[0], inverse.groups(), compliance[i]);
    sort_columns(tangent);
    fill(tangent);
    if (!heavy.empty())
      reduce();
  }

  void ReducedFactors::Entries::resize(const std::size_t number)
  {
    column.resize(number);
    value.resize(number);
    rounded.resize(number);
  }

  /// Heavy are those where a displacement, by the forces that follow it, displaces the ports many times as much.
  void ReducedFactors::sort_columns(const FullMatrix<double> &tangent)
  {
    constexpr double many = 10.;
    std::vector<double> weights(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
      add_sizes(&tangent(i, 0), units[i], n, weights.data());
    for (unsigned int j = 0; j < n; ++j)
      weights[j] *= units[j];
    const auto n_heavy = std::count_if(weights.begin(), weights.end(), [](const double weight) { return weight > many; });
    for (unsigned int j = 0; j < n; ++j)
      (2 * n_heavy > n || weights[j] > many ? heavy : light).push_back(j);
  }

  /// Sets the entries of heavy and light columns.
  SPRAG_FOR_ANY_PROCESSOR void ReducedFactors::fill(const FullMatrix<double> &tangent)
  {
    std::vector<unsigned int> is_heavy(n, 0), columns(n);
    for (const unsigned int j : heavy)
      is_heavy[j] = 1;
    for (unsigned int i = 0; i < n; i += n_alike)
    {
      const double *rows[n_alike];
      Entries::Four<double> of_rows{};
      for (unsigned int a = 0; a < n_alike; ++a)
      {
        rows[a] = &tangent(std::min(i + a, n - 1), 0);
        if (i + a < n)
          of_rows.values[a] = units[i + a];
      }
      unsigned int filled = 0;
      for (unsigned int j = 0; j < n; ++j)
      {
        columns[filled] = j;
        filled += static_cast<unsigned int>((rows[0][j] != 0.) | (rows[1][j] != 0.) | (rows[2][j] != 0.));
      }
      Entries *const of[]  = { &of_light, &of_heavy };
      std::size_t places[] = { of_light.column.size(), of_heavy.column.size() };
      for (auto *entries : of)
        entries->resize(entries->column.size() + filled);
      for (unsigned int k = 0; k < filled; ++k)
      {
        const unsigned int j    = columns[k];
        auto &entries           = *of[is_heavy[j]];
        const std::size_t place = places[is_heavy[j]]++;
        Entries::Four<double> value{ { rows[0][j], rows[1][j], rows[2][j], 0. } };
        value.values *= units[j] * of_rows.values;
        entries.column[place]         = j;
        entries.value[place]          = value;
        entries.rounded[place].values = __builtin_convertvector(value.values, decltype(entries.rounded[place].values));
      }
      for (unsigned int some : { 0, 1 })
      {
        of[some]->resize(places[some]);
        of[some]->begin.push_back(places[some]);
      }
    }
  }

  /// Makes the factors of S.
  SPRAG_FOR_ANY_PROCESSOR void ReducedFactors::reduce()
  {
    const auto n_heavy = static_cast<unsigned int>(heavy.size());
    std::vector<unsigned int> place(n);
    for (unsigned int j = 0; j < n_heavy; ++j)
      place[heavy[j]] = j;
    RowsOfSixteen columns(n_heavy, n_heavy), of_ports(n_alike, n_heavy);
    for (std::size_t g = 0; g + 1 < of_heavy.begin.size(); ++g)
    {
      for (unsigned int a = 0; a < n_alike; ++a)
      {
        const float *const row = &compliance(std::min<std::size_t>(n_alike * g + a, n - 1), 0);
        for (unsigned int j = 0; j < n_heavy; ++j)
          of_ports(a, j) = row[heavy[j]];
      }
      for (std::size_t k = of_heavy.begin[g]; k < of_heavy.begin[g + 1]; ++k)
      {
        const auto &value  = of_heavy.rounded[k].values;
        Sixteen *const sum = columns[place[of_heavy.column[k]]];
        for (std::size_t i = 0; i < columns.groups(); ++i)
          sum[i].values -= value[0] * of_ports[0][i].values + value[1] * of_ports[1][i].values + value[2] * of_ports[2][i].values;
      }
    }
    reduced.reinit(n_heavy);
    for (unsigned int j = 0; j < n_heavy; ++j)
    {
      std::copy_n(&columns(j, 0), n_heavy, &reduced(0, j));
      reduced(j, j) += 1.f;
    }
    reduced.compute_lu_factorization();
  }

  void ReducedFactors::add_solution(const Vector<double> &r, const double left, Vector<double> &forces) const
  {
    constexpr unsigned int most_repetitions = 10;
    RowsOfSixteen rest(1, n), found(1, n);
    for (unsigned int i = 0; i < n; ++i)
      rest(0, i) = static_cast<float>(units[i] * r[i]);
    const float enough = static_cast<float>(left * left) * dot(rest, rest);
    struct Change
    {
      RowsOfSixteen forces;
      RowsOfSixteen image; ///< (1 - A G) of these, orthogonal to those before
      float size;          ///< squared, of the image
    };
    std::vector<Change> changes;
    while (dot(rest, rest) > enough && changes.size() < most_repetitions)
    {
      Change change{ rest, rest, 0.f };
      auto followed = displacements_at(heavy, rest);
      if (!heavy.empty())
        reduced.solve(followed);
      add_forces(1.f, heavy, of_heavy, followed, change.forces);
      add_forces(-1.f, light, of_light, displacements_at(light, change.forces), change.image);
      for (const auto &before : changes)
      {
        const float share = dot(change.image, before.image) / before.size;
        add(-share, before.image, change.image);
        add(-share, before.forces, change.forces);
      }
      change.size       = dot(change.image, change.image);
      const float share = dot(rest, change.image) / change.size;
      add(share, change.forces, found);
      add(-share, change.image, rest);
      changes.push_back(std::move(change));
    }
    for (unsigned int i = 0; i < n; ++i)
      forces[i] += found(0, i) / units[i];
  }

  SPRAG_FOR_ANY_PROCESSOR void ReducedFactors::add_forces(const Vector<double> &displacements, Vector<double> &forces) const
  {
    std::vector<double> in_units(n), result(n + n_alike);
    for (unsigned int i = 0; i < n; ++i)
      in_units[i] = displacements[i] / units[i];
    for (const auto *entries : { &of_heavy, &of_light })
      add_products(*entries, entries->value, in_units.data(), result.data());
    for (unsigned int i = 0; i < n; ++i)
      forces[i] += result[i] / units[i];
  }

  double ReducedFactors::size(const Vector<double> &forces) const
  {
    double result = 0.;
    for (unsigned int i = 0; i < n; ++i)
      result += std::pow(units[i] * forces[i], 2);
    return std::sqrt(result);
  }

  double ReducedFactors::movement(const Vector<double> &displacements) const
  {
    double result = 0.;
    for (unsigned int i = 0; i < n; ++i)
      result += std::pow(displacements[i] / units[i], 2);
    return std::sqrt(result);
  }

  double ReducedFactors::movement_by(const Vector<double> &forces) const
  {
    RowsOfSixteen of_ports(1, n);
    for (unsigned int i = 0; i < n; ++i)
      of_ports(0, i) = static_cast<float>(units[i] * forces[i]);
    const auto size_at = [&](const Places &places)
    { return places.empty() ? 0.f : displacements_at(places, of_ports).l2_norm(); };
    return std::hypot(size_at(heavy), size_at(light));
  }

  Vector<float> ReducedFactors::displacements_at(const Places &places, const RowsOfSixteen &forces) const
  {
    Vector<float> result(static_cast<unsigned int>(places.size()));
    multiply(compliance, places, forces, result.begin());
    return result;
  }

  /// Adds those that follow displacements at some places, by the entries of their columns.
  SPRAG_FOR_ANY_PROCESSOR void ReducedFactors::add_forces(const float factor, const Places &places, const Entries &entries,
                                                          const Vector<float> &displacements, RowsOfSixteen &forces) const
  {
    std::vector<float> of_ports(n), result(n + n_alike);
    for (unsigned int i = 0; i < places.size(); ++i)
      of_ports[places[i]] = factor * displacements[i];
    add_products(entries, entries.rounded, of_ports.data(), result.data());
    for (unsigned int i = 0; i < n; ++i)
      forces(0, i) += result[i];
  }
} // namespace sprag
