// SPDX-License-Identifier: GPL-3.0-only
#include "model/interface/interface_compliance.h"

#include "base/ranges.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>

namespace sprag
{
  using dealii::FullMatrix;

  unsigned int find_index(const unsigned int dof, const DofSelection &dofs)
  {
    return static_cast<unsigned int>(std::lower_bound(dofs.begin(), dofs.end(), dof) - dofs.begin());
  }

  DofSelection find_indices(const DofSelection &some, const DofSelection &dofs)
  {
    return mapped(some, [&](const unsigned int dof) { return find_index(dof, dofs); });
  }

  FullMatrix<double> inverse(const FullMatrix<double> &matrix, const bool is_symmetric)
  {
    dealii::LAPACKFullMatrix<double> lapack(static_cast<unsigned int>(matrix.m()));
    lapack = matrix;
    if (is_symmetric)
      lapack.set_property(dealii::LAPACKSupport::symmetric);
    lapack.invert();
    FullMatrix<double> result(matrix.m(), matrix.n());
    result = lapack;
    return result;
  }

  double InterfaceCompliance::operator()(const unsigned int row_dof, const unsigned int column_dof) const
  {
    const auto block =
        std::find_if(diagonal.begin(), diagonal.end(), [&](const auto &candidate) { return row_dof < candidate.end(); });
    if (column_dof < block->begin || column_dof >= block->end())
      return 0.;
    return (*block->matrix)(row_dof - block->begin, column_dof - block->begin);
  }
} // namespace sprag
