// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"

#include <deal.II/lac/vector.h>

#include <vector>

namespace sprag
{
  /// Symmetric matrix of small bandwidth and its factors L D L^T without pivoting, in place: for slender meshes that are
  /// factorised very often.
  class BandFactors
  {
  public:
    BandFactors() = default;

    /// Allocates the entries (i, j) with i <= j <= i + `width`.
    BandFactors(const unsigned int size, const unsigned int width)
        : n(size)
        , bandwidth(width)
        , rows(static_cast<std::size_t>(size) * (width + 1))
    {
    }

    /// Returns where in entries() the entry (i, j) is.
    std::size_t position(const unsigned int i, const unsigned int j) const
    {
      return static_cast<std::size_t>(i) * (bandwidth + 1) + (j - i);
    }

    std::vector<double> &entries()
    {
      return rows;
    }

    /// Replaces the entries. Returns how many pivots are negative: 0 if and only if the matrix is positive definite. Throws
    /// AnalysisError if one is 0 or no number.
    unsigned int factorise();

    /// Solves with the factors that factorise() has left.
    void solve(dealii::Vector<double> &right_hand_side_and_solution) const;

  private:
    unsigned int n         = 0;
    unsigned int bandwidth = 0;
    std::vector<double> rows; ///< upper ones, diagonal first
  };

  /// Statics of a slender body at finite strain by Newton's method; the tangent is factorised as a band.
  class FiniteStatics
  {
  public:
    /// The body itself must hold nothing and outlive this. What it is held by is closed and without inhomogeneities: a degree of
    /// freedom whose line is empty is held at a given displacement, one with entries follows others, the rest are the
    /// coordinates.
    FiniteStatics(const ElasticBody<2> &body, const dealii::AffineConstraints<double> &held);

    /// Brings `displacement` of all degrees of freedom into equilibrium with dead `loads` [N] on them, the held ones as they are
    /// given. Those that follow others must begin so. Throws AnalysisError where the iteration finds none.
    void balance(dealii::Vector<double> &displacement, const dealii::Vector<double> &loads);

    // The following are of all degrees of freedom at the displacement last balanced.

    /// Returns the internal forces [N]; those of held degrees of freedom are what holds them.
    const dealii::Vector<double> &forces() const
    {
      return internal;
    }

    /// Returns how far the internal forces are uncertain because displacements are rounded [N]: the norm over all degrees of
    /// freedom, about twice what Newton's method leaves unbalanced at its best.
    double round_off(const dealii::Vector<double> &displacement) const;

    /// Returns how displacements change with those of held degrees of freedom (others in `prescribed` count for nothing) and with
    /// the loads.
    dealii::Vector<double> response(const dealii::Vector<double> &prescribed, const dealii::Vector<double> &applied) const;

    /// Multiplies a displacement by the tangent stiffness.
    dealii::Vector<double> stiffness_product(const dealii::Vector<double> &displacement) const;

    /// Returns whether the equilibrium is stable.
    bool is_stable() const
    {
      return negative_pivots == 0;
    }

  private:
    /// A coordinate that moves a degree of freedom, and by how much a unit of it does.
    struct Mover
    {
      unsigned int coordinate;
      double share;
    };

    /// An entry of the tangent, the entry of the band it is added to, and the factor.
    struct Contribution
    {
      std::size_t from;
      std::size_t to;
      double factor;
    };

    void number_coordinates(const dealii::AffineConstraints<double> &held);
    void arrange_band();
    dealii::Vector<double> collect(const dealii::Vector<double> &forces) const;
    dealii::Vector<double> expand(const dealii::Vector<double> &coordinates) const;
    void linearise(const dealii::Vector<double> &displacement);

    const ElasticBody<2> &body;
    unsigned int n = 0;
    dealii::PETScWrappers::SparseMatrix tangent;
    std::vector<std::vector<Mover>> movers; ///< of each degree of freedom, none where held
    std::vector<Contribution> contributions;
    dealii::Vector<double> internal;
    BandFactors band;
    unsigned int negative_pivots = 0;
  };
} // namespace sprag
