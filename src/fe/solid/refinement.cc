// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/refinement.h"

#include "base/errors.h"

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sprag
{
  namespace
  {
    constexpr double tolerance        = 5e-8; ///< of displacements, over the largest, as estimated; a tenth of it is left
    constexpr double least_left       = 1e-3; ///< by a step, of the error before it: later steps gain less than the first
    constexpr unsigned int most_steps = 20;
    constexpr unsigned int few_steps  = 4;
    constexpr int rows_of_piece       = 4096;
    constexpr double dependent        = 1e-8; ///< energy of a motion over what it was before others were taken out of it

    /// C = factor A B + kept C, A or its transpose, of matrices that lie column by column.
    void multiply(const bool transposed, const int rows, const int columns, const int inner, const double factor,
                  const double *const a, const int stride_a, const double *const b, const int stride_b, const double kept,
                  double *const c, const int stride_c)
    {
      dealii::gemm(transposed ? "T" : "N", "N", &rows, &columns, &inner, &factor, a, &stride_a, b, &stride_b, &kept, c,
                   &stride_c);
    }

    template <class Number>
    double largest(const Number *const begin, const std::size_t n)
    {
      return std::accumulate(begin, begin + n, 0.,
                             [](const double most, const Number value)
                             { return std::max(most, static_cast<double>(std::abs(value))); });
    }

    bool are_numbers(const std::vector<float> &values)
    {
      return std::isfinite(std::accumulate(values.begin(), values.end(), 0.));
    }

    template <class Number>
    double product(const double *const a, const Number *const b, const std::size_t n)
    {
      return std::inner_product(a, a + n, b, 0.);
    }
  } // namespace

  Refinement::Refinement(const StiffnessSource &source, const std::vector<int> &number_in_part,
                         const std::vector<Connector> &connectors, RoughSolve solve_)
      : n(size_of_part(source, number_in_part))
      , stiffness(source, number_in_part, connectors)
      , solve(std::move(solve_))
  {
  }

  bool Refinement::find_soft_motions(const std::vector<double> &loads)
  {
    auto left  = loads;
    auto step  = solve(loads);
    auto first = step;
    for (unsigned int round = 0; round < 2; ++round) // of which the second finds what is less soft
    {
      if (round > 0)
        take_soft_part(left, step);
      stiffness.subtract(step, left);
      step = solve(left);
      for (std::size_t begin = 0; begin < step.size(); begin += n)
        add_soft_motion(&step[begin]);
    }
    find_missed();
    left = loads;
    std::vector<double> result(loads.size(), 0.);
    return improve(std::move(first), left, result) <= few_steps;
  }

  /// Adds what of a motion the others have not.
  void Refinement::add_soft_motion(const float *const step)
  {
    std::vector<double> motion(step, step + n);
    const auto forces_of = [&]
    {
      std::vector<double> result(n, 0.);
      stiffness.subtract(motion, result);
      for (double &force : result)
        force = -force;
      return result;
    };
    const double before = product(motion.data(), forces_of().data(), n);
    for (unsigned int pass = 0; pass < 2; ++pass) // the second for round-off
      for (std::size_t other = 0; other < soft.size(); other += n)
      {
        const double amount = product(&forces_of_soft[other], motion.data(), n);
        for (std::size_t i = 0; i < n; ++i)
          motion[i] -= amount * soft[other + i];
      }
    const auto forces   = forces_of();
    const double energy = product(motion.data(), forces.data(), n);
    if (!(energy > dependent * before))
      return;
    const double factor = 1. / std::sqrt(energy);
    for (std::size_t i = 0; i < n; ++i)
    {
      soft.push_back(factor * motion[i]);
      forces_of_soft.push_back(factor * forces[i]);
    }
  }

  std::vector<double> Refinement::refined(std::vector<double> loads, std::vector<float> step) const
  {
    std::vector<double> result(loads.size(), 0.);
    if (improve(std::move(step), loads, result) > most_steps)
      throw AnalysisError("factors of single precision did not find displacements of the lever in three dimensions");
    return result;
  }

  void Refinement::find_missed()
  {
    missed           = soft;
    const auto found = solve(forces_of_soft);
    for (std::size_t i = 0; i < missed.size(); ++i)
      missed[i] -= found[i];
  }

  /// Makes of a first step one that begins with the loads' projection on the soft motions.
  void Refinement::begin_softly(const std::vector<double> &loads, std::vector<float> &step) const
  {
    const int rows = static_cast<int>(n), columns = static_cast<int>(loads.size() / n),
              motions = static_cast<int>(soft.size() / n);
    if (motions == 0)
      return;
    std::vector<double> amounts(static_cast<std::size_t>(motions) * columns);
    multiply(true, motions, columns, rows, 1., soft.data(), rows, loads.data(), rows, 0., amounts.data(), motions);
    add_motions(missed, amounts, step);
  }

  /// Adds to each step what makes the forces that it leaves on the soft motions vanish.
  void Refinement::take_soft_part(const std::vector<double> &left, std::vector<float> &step) const
  {
    const int rows = static_cast<int>(n), columns = static_cast<int>(left.size() / n),
              motions = static_cast<int>(soft.size() / n);
    if (motions == 0)
      return;
    std::vector<double> amounts(static_cast<std::size_t>(motions) * columns);
    multiply(true, motions, columns, rows, 1., soft.data(), rows, left.data(), rows, 0., amounts.data(), motions);
    std::vector<double> piece(static_cast<std::size_t>(rows_of_piece) * columns);
    for (int begin = 0; begin < rows; begin += rows_of_piece)
    {
      const int length = std::min(rows_of_piece, rows - begin);
      for (int j = 0; j < columns; ++j)
        std::copy_n(&step[static_cast<std::size_t>(j) * n + begin], length, &piece[static_cast<std::size_t>(j) * length]);
      multiply(true, motions, columns, length, -1., &forces_of_soft[begin], rows, piece.data(), length, 1., amounts.data(),
               motions);
    }
    add_motions(soft, amounts, step);
  }

  /// Adds amounts of some motions to each step.
  void Refinement::add_motions(const std::vector<double> &motions, const std::vector<double> &amounts,
                               std::vector<float> &step) const
  {
    const int rows = static_cast<int>(n), columns = static_cast<int>(step.size() / n),
              inner = static_cast<int>(motions.size() / n);
    std::vector<double> piece(static_cast<std::size_t>(rows_of_piece) * columns);
    for (int begin = 0; begin < rows; begin += rows_of_piece)
    {
      const int length = std::min(rows_of_piece, rows - begin);
      multiply(false, length, columns, inner, 1., &motions[begin], rows, amounts.data(), inner, 0., piece.data(), length);
      for (int j = 0; j < columns; ++j)
        for (int i = 0; i < length; ++i)
        {
          auto &value = step[static_cast<std::size_t>(j) * n + begin + i];
          value       = static_cast<float>(value + piece[static_cast<std::size_t>(j) * length + i]);
        }
    }
  }

  /// Adds steps, the first one given, to the result until what is still missing is small, as far as the last two steps tell.
  /// `left` is what is unbalanced before. Returns the number of steps, more than `most_steps` where that did not suffice.
  unsigned int Refinement::improve(std::vector<float> step, std::vector<double> &left, std::vector<double> &result) const
  {
    std::vector<double> last(left.size() / n, 1.);
    for (unsigned int number = 1; number <= most_steps && are_numbers(step); ++number)
    {
      if (number == 1)
        begin_softly(left, step);
      take_soft_part(left, step);
      double error = 0.;
      for (std::size_t j = 0; j < last.size(); ++j)
      {
        for (std::size_t i = j * n; i < (j + 1) * n; ++i)
          result[i] += step[i];
        const double size   = largest(&result[j * n], n);
        const double change = size > 0. ? largest(&step[j * n], n) / size : 0.;
        error               = std::max(error, number == 1 ? 1. : change * std::clamp(change / last[j], least_left, 1.));
        last[j]             = change;
      }
      if (error < tolerance)
        return number;
      stiffness.subtract(step, left);
      step = solve(left);
    }
    return most_steps + 1;
  }
} // namespace sprag
