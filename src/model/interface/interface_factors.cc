// SPDX-License-Identifier: GPL-3.0-only
#include "model/interface/interface_factors.h"

#include "model/interface/block_product.h"

namespace sprag
{
  using namespace dealii;

  /// A tangent has few entries in a row, so that its product with G is summed over these alone.
  InterfaceFactors::InterfaceFactors(const InterfaceCompliance &compliance, const DofSelection &dofs,
                                     const FullMatrix<double> &tangent)
      : matrix(static_cast<unsigned int>(dofs.size()))
  {
    const auto n = static_cast<unsigned int>(dofs.size());
    if (n == 0)
      return;
    FullMatrix<double> row(1, n); // of G, which is symmetric
    for (const auto &block : compliance.blocks())
    {
      const auto [first, last] = block.places_among(dofs);
      for (unsigned int k = first; k < last; ++k)
      {
        for (unsigned int i = first; i < last; ++i)
          row(0, i) = (*block.matrix)(dofs[k] - block.begin, dofs[i] - block.begin);
        for (unsigned int j = 0; j < n; ++j)
          if (const double value = -tangent(k, j); value != 0.)
            add_block_product(row, { first, last }, { 0, 1 }, &value, &matrix(first, j));
      }
    }
    for (unsigned int i = 0; i < n; ++i)
      matrix(i, i) += 1.;
    matrix.compute_lu_factorization();
  }

  Vector<double> InterfaceFactors::reaction(const FullMatrix<double> &tangent, const Vector<double> &displacements) const
  {
    Vector<double> moved = displacements, forces(displacements.size());
    if (forces.size() == 0)
      return forces;
    matrix.solve(moved);
    tangent.vmult(forces, moved);
    return forces;
  }

  double InterfaceFactors::determinant() const
  {
    return matrix.m() > 0 ? matrix.determinant() : 1.;
  }
} // namespace sprag
