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

    /// Entries (i, j) with i <= j <= i + `bandwidth`.
    BandFactors(unsigned int n, unsigned int bandwidth);

    /// Where in entries() (i, j) is.
    std::size_t position(unsigned int i, unsigned int j) const;

    std::vector<double> &entries()
    {
      return rows;
    }

    /// Replaces the entries. Returns how many pivots are negative: 0 if and only if the matrix is positive definite. Throws
    /// AnalysisError if one is 0 or no number.
    unsigned int factorise();

    /// After factorise().
    void solve(dealii::Vector<double> &right_hand_side_and_solution) const;

  private:
    unsigned int n         = 0;
    unsigned int bandwidth = 0;
    std::vector<double> rows; ///< upper ones, diagonal first
  };
} // namespace sprag
