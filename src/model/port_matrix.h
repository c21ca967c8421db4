// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/block_matrix.h"

#include <optional>

namespace sprag
{
  /// Factors of M = 1 - G A on some of the ports, A = df/dz. Ports that follow no others, B (a hub on its spring, a support),
  /// have forces that follow all displacements: they border the matrix of the others, I.
  ///   S = M_BB - M_BI M_II^-1 M_IB,   x_B = S^-1 (b_B - M_BI M_II^-1 b_I),   x_I = M_II^-1 b_I - M_II^-1 M_IB x_B.
  class PortMatrix
  {
  public:
    /// Throws an exception of deal.II where it is singular.
    PortMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
               const dealii::FullMatrix<double> &tangent);

    void solve(dealii::Vector<double> &values) const;

    double determinant() const;

  private:
    using Places = std::vector<unsigned int>;

    void make_border(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                     const dealii::FullMatrix<double> &tangent);

    Places inner;  ///< I
    Places border; ///< B
    std::optional<BlockMatrix> of_inner;
    dealii::FullMatrix<double> below;           ///< M_BI
    dealii::FullMatrix<double> aside;           ///< M_II^-1 M_IB
    dealii::LAPACKFullMatrix<double> of_border; ///< S
  };
} // namespace sprag
