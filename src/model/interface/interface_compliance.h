// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <memory>
#include <utility>
#include <vector>

namespace sprag
{
  /// Dofs in increasing order. Computations restricted to a selection leave the other entries of full vectors undefined.
  using DofSelection = std::vector<unsigned int>;

  /// Returns the index of a dof among increasing ones, or that at which it would be inserted.
  unsigned int find_index(unsigned int dof, const DofSelection &dofs);

  /// Returns the indices of some dofs among increasing ones, which hold them.
  DofSelection find_indices(const DofSelection &some, const DofSelection &dofs);

  /// Returns the inverse of a matrix by LAPACK; a symmetric one must be positive definite.
  dealii::FullMatrix<double> inverse(const dealii::FullMatrix<double> &matrix, bool is_symmetric = false);

  /// Compliance G of the interface of a linear structure: displacements of the dofs by unit forces on them, symmetric. G is block
  /// diagonal in consecutive dofs: the two levers of a pair and the support are uncoupled, for example.
  class InterfaceCompliance
  {
  public:
    /// A block on the diagonal of G, for consecutive dofs.
    struct Block
    {
      unsigned int begin; ///< its first dof
      std::shared_ptr<const dealii::FullMatrix<double>> matrix;

      unsigned int end() const
      {
        return begin + static_cast<unsigned int>(matrix->m());
      }

      /// Returns the range of its dofs among increasing ones: index of the first and one past the last.
      std::pair<unsigned int, unsigned int> places_among(const DofSelection &dofs) const
      {
        return { find_index(begin, dofs), find_index(end(), dofs) };
      }
    };

    /// Appends a block for the next dofs. Blocks may share a matrix.
    void append(std::shared_ptr<const dealii::FullMatrix<double>> matrix)
    {
      diagonal.push_back({ size(), std::move(matrix) });
    }

    void append(dealii::FullMatrix<double> matrix)
    {
      append(std::make_shared<const dealii::FullMatrix<double>>(std::move(matrix)));
    }

    /// Adds a block of one dof.
    void append(const double compliance)
    {
      append(dealii::FullMatrix<double>(1, 1, &compliance));
    }

    const std::vector<Block> &blocks() const
    {
      return diagonal;
    }

    /// Returns the number of dofs.
    unsigned int size() const
    {
      return diagonal.empty() ? 0 : diagonal.back().end();
    }

    double operator()(unsigned int row_dof, unsigned int column_dof) const;

  private:
    std::vector<Block> diagonal;
  };
} // namespace sprag
