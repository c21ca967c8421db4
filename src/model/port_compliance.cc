// SPDX-License-Identifier: GPL-3.0-only
#include "model/port_compliance.h"

#include "model/block_product.h"

#include <algorithm>
#include <cstring>

namespace sprag
{
  using dealii::FullMatrix;

  unsigned int place_of(const unsigned int port, const std::vector<unsigned int> &ports)
  {
    return static_cast<unsigned int>(std::lower_bound(ports.begin(), ports.end(), port) - ports.begin());
  }

  void PortCompliance::append(std::shared_ptr<const FullMatrix<double>> matrix)
  {
    diagonal.push_back({ size(), std::move(matrix) });
  }

  void PortCompliance::append(FullMatrix<double> matrix)
  {
    append(std::make_shared<const FullMatrix<double>>(std::move(matrix)));
  }

  void PortCompliance::append(const double compliance)
  {
    append(FullMatrix<double>(1, 1, &compliance));
  }

  const std::vector<PortCompliance::Block> &PortCompliance::blocks() const
  {
    return diagonal;
  }

  unsigned int PortCompliance::size() const
  {
    return diagonal.empty() ? 0 : diagonal.back().end();
  }

  double PortCompliance::operator()(const unsigned int row_port, const unsigned int column_port) const
  {
    const auto block =
        std::find_if(diagonal.begin(), diagonal.end(), [&](const auto &candidate) { return row_port < candidate.end(); });
    if (column_port < block->begin || column_port >= block->end())
      return 0.;
    return (*block->matrix)(row_port - block->begin, column_port - block->begin);
  }

  namespace
  {
    using EightRounded = float __attribute__((vector_size(32)));

    /// Numbers that follow each other, eight at once.
    SPRAG_FOR_ANY_PROCESSOR void copy_rounded(const double *const from, const unsigned int n, float *const to)
    {
      unsigned int i = 0;
      for (; i + n_lanes <= n; i += n_lanes)
      {
        Lanes numbers;
        std::memcpy(&numbers, from + i, sizeof(numbers));
        const auto rounded = __builtin_convertvector(numbers, EightRounded);
        std::memcpy(to + i, &rounded, sizeof(rounded));
      }
      for (; i < n; ++i)
        to[i] = static_cast<float>(from[i]);
    }
  } // namespace

  RowsOfSixteen rows_among(const std::vector<unsigned int> &ports, const PortCompliance &compliance)
  {
    RowsOfSixteen result(ports.size(), ports.size());
    for (const auto &block : compliance.blocks())
    {
      const auto [first, last] = block.places_among(ports);
      const auto ranges        = ranges_of(ports.begin() + first, ports.begin() + last);
      for (unsigned int k = first; k < last; ++k)
      {
        float *filled = &result(k, first);
        for (const auto &range : ranges)
        {
          copy_rounded(&(*block.matrix)(ports[k] - block.begin, range.begin - block.begin), range.size(), filled);
          filled += range.size();
        }
      }
    }
    return result;
  }
} // namespace sprag
