// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/port_compliance.h"

#include <deal.II/lac/lapack_full_matrix.h>

namespace sprag
{
  /// Some rows and the same columns of a tangent A = df/dz, where they are.
  struct PartOfTangent
  {
    const dealii::FullMatrix<double> &whole;
    const std::vector<unsigned int> &places; ///< in the whole

    double operator()(const unsigned int i, const unsigned int j) const
    {
      return whole(places[i], places[j]);
    }

    unsigned int n() const
    {
      return static_cast<unsigned int>(places.size());
    }
  };

  /// Factors of M = 1 - G A on some of the ports, A = df/dz. Forces on a block of ports follow its own displacements and few
  /// others, say the turn of a joint. So M is factorised block by block, D, and what stands beside the blocks, in few columns C,
  /// enters by Woodbury:
  ///   M = D + E,   x = D^-1 (b - E x_C),   (1 + (D^-1 E)_C) x_C = (D^-1 b)_C.
  class BlockMatrix
  {
  public:
    /// Throws an exception of deal.II where it is singular.
    BlockMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports, const PartOfTangent &tangent);

    void solve(dealii::Vector<double> &values) const;

    double determinant() const;

  private:
    using Places = std::pair<unsigned int, unsigned int>; // the first, and beyond the last

    struct Block
    {
      Places places;
      PortCompliance::Block of_ports;
      dealii::LAPACKFullMatrix<double> matrix;
      dealii::LAPACKFullMatrix<double> answers; ///< D^-1 E, a column for each of C
    };

    std::vector<Block> blocks;
    std::vector<unsigned int> columns; ///< C
    dealii::LAPACKFullMatrix<double> of_columns;

    void find_columns(const PartOfTangent &tangent);
    void factorise(const std::vector<unsigned int> &ports, const PartOfTangent &tangent, Block &block) const;
    double answer(unsigned int row, unsigned int k) const;
  };
} // namespace sprag
