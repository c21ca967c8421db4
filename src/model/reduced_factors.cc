#include "model/reduced_factors.h"

#include <algorithm>
#include <cmath>

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
  } // namespace

  ReducedFactors::ReducedFactors(const PortCompliance &of_ports, const std::vector<unsigned int> &ports,
                                 const FullMatrix<double> &of_contact)
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
    {
      scale(inverse(0, i), inverse[0], inverse.groups(), compliance[i]);
      tangent.begin.push_back(tangent.column.size());
      for (unsigned int j = 0; j < n; ++j)
        if (of_contact(i, j) != 0.)
        {
          tangent.column.push_back(j);
          tangent.value.push_back(units[i] * of_contact(i, j) * units[j]);
        }
    }
    tangent.begin.push_back(tangent.column.size());
    tangent.rounded.assign(tangent.value.begin(), tangent.value.end());
    sort_columns();
    if (!heavy.empty())
      reduce();
  }

  /// Heavy are those where a displacement, by the forces that follow it, displaces the ports many times as much.
  void ReducedFactors::sort_columns()
  {
    constexpr double many = 10.;
    std::vector<double> weights(n, 0.);
    for (std::size_t k = 0; k < tangent.column.size(); ++k)
      weights[tangent.column[k]] += std::abs(tangent.value[k]);
    const auto n_heavy = std::count_if(weights.begin(), weights.end(), [](const double weight) { return weight > many; });
    for (unsigned int j = 0; j < n; ++j)
      (2 * n_heavy > n || weights[j] > many ? heavy : light).push_back(j);
  }

  /// Makes the factors of S.
  void ReducedFactors::reduce()
  {
    const auto n_heavy = static_cast<unsigned int>(heavy.size());
    std::vector<unsigned int> column_of(n, n_heavy);
    for (unsigned int j = 0; j < n_heavy; ++j)
      column_of[heavy[j]] = j;
    RowsOfSixteen columns(n_heavy, n_heavy), of_port(1, n_heavy);
    for (unsigned int k = 0; k < n; ++k)
    {
      for (unsigned int i = 0; i < n_heavy; ++i)
        of_port(0, i) = compliance(k, heavy[i]);
      for (std::size_t entry = tangent.begin[k]; entry < tangent.begin[k + 1]; ++entry)
        if (const unsigned int column = column_of[tangent.column[entry]]; column < n_heavy)
          add(-tangent.rounded[entry], of_port[0], of_port.groups(), columns[column]);
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
      add_forces(1.f, heavy, followed, change.forces);
      add_forces(-1.f, light, displacements_at(light, change.forces), change.image);
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

  void ReducedFactors::add_forces(const Vector<double> &displacements, Vector<double> &forces) const
  {
    std::vector<double> in_units(n);
    for (unsigned int i = 0; i < n; ++i)
      in_units[i] = displacements[i] / units[i];
    for (unsigned int i = 0; i < n; ++i)
      forces[i] += row_product(i, tangent.value, in_units) / units[i];
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
    return std::hypot(displacements_at(heavy, of_ports).l2_norm(), displacements_at(light, of_ports).l2_norm());
  }

  Vector<float> ReducedFactors::displacements_at(const Places &places, const RowsOfSixteen &forces) const
  {
    Vector<float> result(static_cast<unsigned int>(places.size()));
    multiply(compliance, places, forces, result.begin());
    return result;
  }

  /// A row of the tangent times a vector, in some sums that do not wait for each other.
  template <class Number>
  Number ReducedFactors::row_product(const unsigned int row, const std::vector<Number> &values,
                                     const std::vector<Number> &vector) const
  {
    constexpr unsigned int together = 4;
    Number sums[together]{};
    std::size_t k = tangent.begin[row];
    for (; k + together <= tangent.begin[row + 1]; k += together)
      for (unsigned int s = 0; s < together; ++s)
        sums[s] += values[k + s] * vector[tangent.column[k + s]];
    for (; k < tangent.begin[row + 1]; ++k)
      sums[0] += values[k] * vector[tangent.column[k]];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }

  /// Adds those that follow displacements at some places.
  void ReducedFactors::add_forces(const float factor, const Places &places, const Vector<float> &displacements,
                                  RowsOfSixteen &forces) const
  {
    std::vector<float> of_ports(n);
    for (unsigned int i = 0; i < places.size(); ++i)
      of_ports[places[i]] = factor * displacements[i];
    for (unsigned int i = 0; i < n; ++i)
      forces(0, i) += row_product(i, tangent.rounded, of_ports);
  }
} // namespace sprag
