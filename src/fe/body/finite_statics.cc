// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/finite_statics.h"

#include "base/errors.h"
#include "fe/algebra/matrix_rows.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  using namespace dealii;
  using Matrix = PETScWrappers::SparseMatrix;

  namespace
  {
    /// Residual over all forces at which iterations end. A body that bends by hundreds of times its thickness leaves more, by
    /// round-off.
    constexpr double tolerance = 1e-9;

    constexpr unsigned int most_iterations = 20;

    /// Calls act(entry, mover of its row, mover of its column).
    template <typename Movers, typename Act>
    void for_all_couplings(const MatrixRows &rows, const Movers &movers, const Act &act)
    {
      for (PetscInt row = 0; row < rows.n; ++row)
        for (PetscInt a = rows.begin[row]; a < rows.begin[row + 1]; ++a)
          for (const auto &row_mover : movers[row])
            for (const auto &column_mover : movers[rows.column[a]])
              act(static_cast<std::size_t>(a), row_mover, column_mover);
    }
  } // namespace

  FiniteStatics::FiniteStatics(const ElasticBody<2> &body_, const AffineConstraints<double> &held)
      : body(body_)
      , internal(body.n_dofs())
  {
    body.reinit(tangent);
    number_coordinates(held);
    arrange_band();
  }

  void FiniteStatics::number_coordinates(const AffineConstraints<double> &held)
  {
    const unsigned int n_dofs = body.n_dofs();
    std::vector<unsigned int> number(n_dofs);
    for (unsigned int dof = 0; dof < n_dofs; ++dof)
      if (!held.is_constrained(dof))
        number[dof] = n++;
    movers.resize(n_dofs);
    for (unsigned int dof = 0; dof < n_dofs; ++dof)
      if (!held.is_constrained(dof))
        movers[dof] = { { number[dof], 1. } };
      else
        for (const auto &[leader, share] : *held.get_constraint_entries(dof))
          movers[dof].push_back({ number[leader], share });

    DynamicSparsityPattern pattern(n, n);
    for_all_couplings(MatrixRows(tangent), movers,
                      [&](std::size_t, const auto &row, const auto &column) { pattern.add(row.coordinate, column.coordinate); });
    std::vector<DynamicSparsityPattern::size_type> places(n);
    SparsityTools::reorder_Cuthill_McKee(pattern, places);
    for (auto &dof_movers : movers)
      for (auto &mover : dof_movers)
        mover.coordinate = static_cast<unsigned int>(places[mover.coordinate]);
  }

  void FiniteStatics::arrange_band()
  {
    const MatrixRows rows(tangent);
    unsigned int width = 0;
    for_all_couplings(rows, movers,
                      [&](std::size_t, const Mover &row, const Mover &column)
                      { width = std::max(width, std::max(row.coordinate, column.coordinate) - row.coordinate); });
    band = BandFactors(n, width);
    for_all_couplings(
        rows, movers,
        [&](const std::size_t a, const Mover &row, const Mover &column)
        {
          if (row.coordinate <= column.coordinate)
            contributions.push_back({ a, band.position(row.coordinate, column.coordinate), row.share * column.share });
        });
  }

  Vector<double> FiniteStatics::collect(const Vector<double> &forces_on_dofs) const
  {
    Vector<double> result(n);
    for (unsigned int dof = 0; dof < movers.size(); ++dof)
      for (const auto &mover : movers[dof])
        result[mover.coordinate] += mover.share * forces_on_dofs[dof];
    return result;
  }

  /// Returns the displacement of all degrees of freedom, 0 where held, that belongs to the coordinates.
  Vector<double> FiniteStatics::expand(const Vector<double> &coordinates) const
  {
    Vector<double> result(body.n_dofs());
    for (unsigned int dof = 0; dof < movers.size(); ++dof)
      for (const auto &mover : movers[dof])
        result[dof] += mover.share * coordinates[mover.coordinate];
    return result;
  }

  void FiniteStatics::linearise(const Vector<double> &displacement)
  {
    tangent  = 0.;
    internal = 0.;
    body.assemble(displacement, tangent, internal);
    auto &entries = band.entries();
    std::fill(entries.begin(), entries.end(), 0.);
    const MatrixRows values(tangent);
    for (const auto &[from, to, factor] : contributions)
      entries[to] += factor * values[from];
    negative_pivots = band.factorise();
  }

  void FiniteStatics::balance(Vector<double> &displacement, const Vector<double> &loads)
  {
    for (unsigned int i = 0; i < most_iterations; ++i)
    {
      linearise(displacement);
      Vector<double> full_residual = loads;
      full_residual -= internal;
      auto residual     = collect(full_residual);
      const double size = internal.l2_norm() + loads.l2_norm();
      if (!std::isfinite(size))
        break;
      if (residual.l2_norm() <= std::max(tolerance * size, round_off(displacement)))
        return;
      band.solve(residual);
      displacement += expand(residual);
    }
    throw AnalysisError("Newton's method found no equilibrium of a body at finite strain in " + std::to_string(most_iterations) +
                        " iterations");
  }

  double FiniteStatics::round_off(const Vector<double> &displacement) const
  {
    const MatrixRows rows(tangent);
    double sum = 0.;
    for (PetscInt a = 0; a < rows.begin[rows.n]; ++a)
    {
      const double force = rows[a] * displacement[rows.column[a]];
      sum += force * force;
    }
    return std::numeric_limits<double>::epsilon() * std::sqrt(sum);
  }

  Vector<double> FiniteStatics::stiffness_product(const Vector<double> &displacement) const
  {
    const MatrixRows rows(tangent);
    Vector<double> result(body.n_dofs());
    for (PetscInt row = 0; row < rows.n; ++row)
      for (PetscInt a = rows.begin[row]; a < rows.begin[row + 1]; ++a)
        result[row] += rows[a] * displacement[rows.column[a]];
    return result;
  }

  Vector<double> FiniteStatics::response(const Vector<double> &prescribed, const Vector<double> &applied) const
  {
    Vector<double> result(body.n_dofs());
    for (unsigned int dof = 0; dof < movers.size(); ++dof)
      if (movers[dof].empty())
        result[dof] = prescribed[dof];
    Vector<double> loads = applied;
    loads -= stiffness_product(result);
    auto coordinates = collect(loads);
    band.solve(coordinates);
    result += expand(coordinates);
    return result;
  }

  unsigned int BandFactors::factorise()
  {
    unsigned int negative = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      double *const row        = &rows[position(i, i)];
      const unsigned int width = std::min(bandwidth, n - 1 - i);
      const double pivot       = row[0];
      if (!std::isfinite(pivot) || pivot == 0.)
        throw AnalysisError("a stiffness is singular");
      negative += pivot < 0. ? 1 : 0;
      for (unsigned int r = 1; r <= width; ++r)
      {
        const double factor = row[r] / pivot;
        double *const below = &rows[position(i + r, i + r)];
        if (factor != 0.)
          for (unsigned int c = r; c <= width; ++c)
            below[c - r] -= factor * row[c];
      }
      for (unsigned int r = 1; r <= width; ++r)
        row[r] /= pivot;
    }
    return negative;
  }

  void BandFactors::solve(dealii::Vector<double> &x) const
  {
    for (unsigned int i = 0; i < n; ++i)
    {
      const double *const row = &rows[position(i, i)];
      for (unsigned int r = 1; r <= std::min(bandwidth, n - 1 - i); ++r)
        x[i + r] -= row[r] * x[i];
    }
    for (unsigned int i = n; i-- > 0;)
    {
      const double *const row = &rows[position(i, i)];
      double sum              = x[i] / row[0];
      for (unsigned int r = 1; r <= std::min(bandwidth, n - 1 - i); ++r)
        sum -= row[r] * x[i + r];
      x[i] = sum;
    }
  }
} // namespace sprag
