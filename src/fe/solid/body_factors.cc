// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/body_factors.h"

#include "fe/solid/solid_connectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    constexpr int together = 64; ///< columns that are refined together, which bounds the memory that they take

    std::vector<double> dense(const SparseColumns &columns, const unsigned int n)
    {
      std::vector<double> result(static_cast<std::size_t>(n) * columns.size(), 0.);
      for (int j = 0; j < columns.size(); ++j)
        for (int k = columns.begin[j]; k < columns.begin[j + 1]; ++k)
          result[static_cast<std::size_t>(j) * n + columns.row[k - 1] - 1] += columns.value[k - 1];
      return result;
    }

    SparseColumns some_of(const SparseColumns &columns, const int first, const int last)
    {
      SparseColumns result;
      for (int j = first; j < last; ++j)
      {
        for (int k = columns.begin[j]; k < columns.begin[j + 1]; ++k)
          result.add(columns.row[k - 1] - 1, columns.value[k - 1]);
        result.end_column();
      }
      return result;
    }

    /// Solves with columns scaled to a size of 1: what is left of loads may be too small for single precision.
    std::vector<float> solve_scaled(const SharedFactors<float> &factors, const std::vector<double> &columns)
    {
      const std::size_t n = factors.size();
      std::vector<float> result(columns.size());
      std::vector<double> sizes;
      for (std::size_t begin = 0; begin < columns.size(); begin += n)
      {
        double size = std::numeric_limits<double>::min();
        for (std::size_t i = begin; i < begin + n; ++i)
          size = std::max(size, std::abs(columns[i]));
        for (std::size_t i = begin; i < begin + n; ++i)
          result[i] = static_cast<float>(columns[i] / size);
        sizes.push_back(size);
      }
      factors.solve(result);
      for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = static_cast<float>(sizes[i / n] * result[i]);
      return result;
    }
  } // namespace

  BodyFactors::BodyFactors(const StiffnessSource &of_body, const std::vector<int> &numbers, const SharedTask solve,
                           const BodyCalls &calls)
      : source(of_body)
      , number_in_part(numbers)
      , task(solve)
      , call_others(calls)
  {
  }

  void BodyFactors::factorise(const std::vector<Connector> &connectors, const FactorStorage &storage)
  {
    release();
    n            = size_of_part(source, number_in_part);
    auto entries = assemble_stiffness(source, number_in_part);
    for (const auto &connector : connectors)
      add(connector, entries);
    if (!storage.single)
    {
      precise = std::make_unique<SharedFactors<double>>(call_others.ranks, storage.folder);
      return precise->factorise(std::move(entries));
    }
    rough = std::make_unique<SharedFactors<float>>(call_others.ranks, storage.folder);
    rough->factorise(std::move(entries));
    const auto solve_roughly = [this](const std::vector<double> &columns)
    {
      call_others(task);
      return solve_scaled(*rough, columns);
    };
    if (call_others.is_first())
      refinement = std::make_unique<Refinement>(source, number_in_part, connectors, solve_roughly);
  }

  bool BodyFactors::prepare(const SparseColumns &loads)
  {
    return precise || refinement->find_soft_motions(dense(loads, n));
  }

  void BodyFactors::solve(std::vector<double> &columns) const
  {
    call_others(task);
    if (precise)
      return precise->solve(columns);
    auto step = solve_scaled(*rough, columns);
    columns   = refinement->refined(std::move(columns), std::move(step));
  }

  std::vector<double> BodyFactors::solve(const SparseColumns &columns) const
  {
    if (precise || columns.size() <= together)
      return solve_some(columns);
    std::vector<double> result;
    result.reserve(static_cast<std::size_t>(n) * columns.size());
    for (int first = 0; first < columns.size(); first += together)
    {
      const auto some = solve_some(some_of(columns, first, std::min(first + together, columns.size())));
      result.insert(result.end(), some.begin(), some.end());
    }
    return result;
  }

  std::vector<double> BodyFactors::solve_some(const SparseColumns &columns) const
  {
    call_others(task);
    if (precise)
      return precise->solve(columns);
    auto step = rough->solve(columns);
    return refinement->refined(dense(columns, n), std::move(step));
  }

  void BodyFactors::take_part() const
  {
    if (precise)
      precise->take_part();
    else
      rough->take_part();
  }

  void BodyFactors::release()
  {
    precise.reset();
    rough.reset();
    refinement.reset();
  }
} // namespace sprag
