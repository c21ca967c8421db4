// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <memory>
#include <vector>

namespace sprag
{
  /// The place where a port stands, or would stand, among increasing ones.
  unsigned int find_index(unsigned int port, const std::vector<unsigned int> &ports);

  /// Compliance G of the ports of a linear structure: the displacement of each by a unit force on each, symmetric. Ports that
  /// follow each other make up blocks, and those of different blocks feel nothing of each other: the levers of a pair, say, and
  /// the support.
  class PortCompliance
  {
  public:
    struct Block
    {
      unsigned int begin; ///< its first port
      std::shared_ptr<const dealii::FullMatrix<double>> matrix;

      unsigned int end() const
      {
        return begin + static_cast<unsigned int>(matrix->m());
      }

      /// The place of its first port among increasing ones, and that beyond the last.
      std::pair<unsigned int, unsigned int> places_among(const std::vector<unsigned int> &ports) const
      {
        return { find_index(begin, ports), find_index(end(), ports) };
      }
    };

    /// Adds a block of the ports that follow those there are. Blocks may share a matrix.
    void append(std::shared_ptr<const dealii::FullMatrix<double>> matrix);
    void append(dealii::FullMatrix<double> matrix);

    /// Adds a block of one port.
    void append(double compliance);

    const std::vector<Block> &blocks() const;

    /// Number of ports.
    unsigned int size() const;

    double operator()(unsigned int row_port, unsigned int column_port) const;

  private:
    std::vector<Block> diagonal;
  };
} // namespace sprag
