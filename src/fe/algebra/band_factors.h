// SPDX-License-Identifier: GPL-3.0-only
#pragma once

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

    /// Makes room for the entries (i, j) with i <= j <= i + `width`.
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
} // namespace sprag
