// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <memory>
#include <vector>

namespace sprag
{
  /// Some dofs, increasing. A contact that reaches few of many looks at those alone; entries of others in vectors of all dofs
  /// mean nothing then.
  using DofSelection = std::vector<unsigned int>;

  /// Returns the place where a dof stands, or would stand, among increasing ones.
  unsigned int find_index(unsigned int dof, const DofSelection &dofs);

  /// Compliance G of the interface of a linear structure: the displacement of each dof by a unit force on each, symmetric. Dofs
  /// that follow each other make up blocks, and those of different blocks feel nothing of each other: the levers of a pair, say,
  /// and the support.
  class InterfaceCompliance
  {
  public:
    struct Block
    {
      unsigned int begin; ///< its first dof
      std::shared_ptr<const dealii::FullMatrix<double>> matrix;

      unsigned int end() const
      {
        return begin + static_cast<unsigned int>(matrix->m());
      }

      /// Returns the place of its first dof among increasing ones, and that beyond the last.
      std::pair<unsigned int, unsigned int> places_among(const DofSelection &dofs) const
      {
        return { find_index(begin, dofs), find_index(end(), dofs) };
      }
    };

    /// Adds a block of the dofs that follow those there are. Blocks may share a matrix.
    void append(std::shared_ptr<const dealii::FullMatrix<double>> matrix);
    void append(dealii::FullMatrix<double> matrix);

    /// Adds a block of one dof.
    void append(double compliance);

    const std::vector<Block> &blocks() const;

    /// Returns the number of dofs.
    unsigned int size() const;

    double operator()(unsigned int row_dof, unsigned int column_dof) const;

  private:
    std::vector<Block> diagonal;
  };
} // namespace sprag
