// SPDX-License-Identifier: GPL-3.0-only
#include "model/port_compliance.h"

#include <algorithm>

namespace sprag
{
  using dealii::FullMatrix;

  unsigned int find_index(const unsigned int port, const std::vector<unsigned int> &ports)
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
} // namespace sprag
