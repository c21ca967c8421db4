// SPDX-License-Identifier: GPL-3.0-only
#include "model/block_matrix.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    bool holds(const std::pair<unsigned int, unsigned int> &places, const unsigned int i)
    {
      return places.first <= i && i < places.second;
    }

    /// Tangent of the ports of one block.
    struct TangentOfBlock
    {
      const PartOfTangent &tangent;
      unsigned int first; ///< of the block
      unsigned int n;

      double operator()(const unsigned int i, const unsigned int j) const
      {
        return tangent(first + i, first + j);
      }
    };

    /// Compliance of the ports of one block.
    struct ComplianceOfBlock
    {
      const FullMatrix<double> &matrix;
      std::vector<unsigned int> rows; ///< of the ports

      ComplianceOfBlock(const PortCompliance::Block &block, const std::vector<unsigned int> &ports, const unsigned int first,
                        const unsigned int last)
          : matrix(*block.matrix)
      {
        for (unsigned int i = first; i < last; ++i)
          rows.push_back(ports[i] - block.begin);
      }

      double operator()(const unsigned int i, const unsigned int j) const
      {
        return matrix(rows[i], rows[j]);
      }
    };

    /// 1 - G A by its definition.
    void fill(const ComplianceOfBlock &compliance, const TangentOfBlock &tangent, LAPACKFullMatrix<double> &result)
    {
      const unsigned int n = tangent.n;
      LAPACKFullMatrix<double> loaded(n), of_block(n);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
        {
          loaded(i, j)   = -compliance(j, i); // G is symmetric
          of_block(i, j) = tangent(i, j);
        }
      loaded.mmult(result, of_block);
      for (unsigned int i = 0; i < n; ++i)
        result(i, i) += 1;
    }
  } // namespace

  BlockMatrix::BlockMatrix(const PortCompliance &compliance, const std::vector<unsigned int> &ports, const PartOfTangent &tangent)
  {
    for (const auto &block : compliance.blocks())
      if (const auto places = block.places_among(ports); places.first < places.second)
        blocks.push_back({ places, block, LAPACKFullMatrix<double>(places.second - places.first), LAPACKFullMatrix<double>() });
    find_columns(tangent);
    for (auto &block : blocks)
      factorise(ports, tangent, block);
    if (columns.empty())
      return;
    of_columns.reinit(static_cast<unsigned int>(columns.size()));
    for (unsigned int j = 0; j < columns.size(); ++j)
      for (unsigned int k = 0; k < columns.size(); ++k)
        of_columns(j, k) = (j == k ? 1. : 0.) + answer(columns[j], k);
    of_columns.compute_lu_factorization();
  }

  void BlockMatrix::solve(Vector<double> &values) const
  {
    for (const auto &[places, of_ports, matrix, answers] : blocks)
    {
      Vector<double> of_block(values.begin() + places.first, values.begin() + places.second);
      matrix.solve(of_block);
      std::copy(of_block.begin(), of_block.end(), values.begin() + places.first);
    }
    if (columns.empty())
      return;
    Vector<double> of_others(static_cast<unsigned int>(columns.size()));
    for (unsigned int k = 0; k < columns.size(); ++k)
      of_others[k] = values[columns[k]];
    of_columns.solve(of_others);
    for (const auto &[places, of_ports, matrix, answers] : blocks)
      for (unsigned int i = places.first; i < places.second; ++i)
        for (unsigned int k = 0; k < columns.size(); ++k)
          values[i] -= answers(i - places.first, k) * of_others[k];
  }

  double BlockMatrix::determinant() const
  {
    double result = columns.empty() ? 1. : of_columns.determinant();
    for (const auto &block : blocks)
      result *= block.matrix.determinant();
    return result;
  }

  void BlockMatrix::find_columns(const PartOfTangent &tangent)
  {
    const unsigned int n = tangent.n();
    std::vector<char> counts(n, 0);
    for (const auto &[places, of_ports, matrix, answers] : blocks)
      for (unsigned int i = places.first; i < places.second; ++i)
      {
        for (unsigned int column = 0; column < places.first; ++column)
          counts[column] |= tangent(i, column) != 0.;
        for (unsigned int column = places.second; column < n; ++column)
          counts[column] |= tangent(i, column) != 0.;
      }
    for (unsigned int column = 0; column < n; ++column)
      if (counts[column])
        columns.push_back(column);
  }

  void BlockMatrix::factorise(const std::vector<unsigned int> &ports, const PartOfTangent &tangent, Block &block) const
  {
    const auto [first, last] = block.places;
    const ComplianceOfBlock compliance(block.of_ports, ports, first, last);
    const TangentOfBlock of_block{ tangent, first, last - first };
    fill(compliance, of_block, block.matrix);
    block.matrix.compute_lu_factorization();
    if (columns.empty())
      return;
    block.answers.reinit(of_block.n, static_cast<unsigned int>(columns.size()));
    for (unsigned int k = 0; k < columns.size(); ++k)
      if (!holds(block.places, columns[k]))
        for (unsigned int a = 0; a < of_block.n; ++a)
          if (const double force = tangent(first + a, columns[k]); force != 0.)
            for (unsigned int i = 0; i < of_block.n; ++i)
              block.answers(i, k) -= compliance(a, i) * force; // G is symmetric
    block.matrix.solve(block.answers);
  }

  /// Of D^-1 E.
  double BlockMatrix::answer(const unsigned int row, const unsigned int k) const
  {
    const auto block =
        std::find_if(blocks.begin(), blocks.end(), [&](const auto &candidate) { return holds(candidate.places, row); });
    return block->answers(row - block->places.first, k);
  }

} // namespace sprag
