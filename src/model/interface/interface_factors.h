// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_compliance.h"

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace sprag
{
  /// LU factors of the dense matrix 1 - G A on some dofs, with the compliance G and a tangent A = df/dz.
  class InterfaceFactors
  {
  public:
    /// Throws an exception of deal.II where the matrix is singular.
    InterfaceFactors(const InterfaceCompliance &compliance, const DofSelection &dofs, const dealii::FullMatrix<double> &tangent);

    /// Returns A (1 - G A)^-1 z, the forces that answer to displacements z which those forces have not changed yet.
    dealii::Vector<double> reaction(const dealii::FullMatrix<double> &tangent, const dealii::Vector<double> &displacements) const;

    /// Returns det(1 - G A).
    double determinant() const;

  private:
    dealii::LAPACKFullMatrix<double> matrix;
  };
} // namespace sprag
