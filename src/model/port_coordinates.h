// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/port_forces.h"
#include "model/port_layout.h"

namespace sprag
{
  /// A generalised coordinate of a contact that is a port.
  struct PortCoordinate
  {
    unsigned int index; ///< among the coordinates
    unsigned int port;
    double sign; ///< of the coordinate along the port
  };

  using PortCoordinates = std::vector<PortCoordinate>;

  /// Adds the coordinates of the pivot frame: the hub's rotation and, where the support is sprung, its displacement, which moves
  /// the obstacle's position x back.
  inline void add_frame(const PortLayout &ports, const unsigned int theta_index, const unsigned int x_index,
                        PortCoordinates &result)
  {
    result.push_back({ theta_index, ports.rotation(), 1. });
    if (ports.sprung)
      result.push_back({ x_index, ports.support(), -1. });
  }

  /// Returns the ports of the coordinates, in their order.
  inline std::vector<unsigned int> collect_ports(const PortCoordinates &coordinates)
  {
    std::vector<unsigned int> result;
    for (const auto &coordinate : coordinates)
      result.push_back(coordinate.port);
    return result;
  }

  /// Returns a row over the coordinates as one over their ports.
  template <class Row>
  dealii::Vector<double> row_on_ports(const PortCoordinates &coordinates, const Row &row)
  {
    dealii::Vector<double> result(static_cast<unsigned int>(coordinates.size()));
    for (unsigned int i = 0; i < coordinates.size(); ++i)
      result[i] = coordinates[i].sign * row[coordinates[i].index];
    return result;
  }

  /// Returns a matrix over the coordinates as one over their ports.
  template <class Matrix>
  dealii::FullMatrix<double> matrix_on_ports(const PortCoordinates &coordinates, const Matrix &matrix)
  {
    const auto n = static_cast<unsigned int>(coordinates.size());
    dealii::FullMatrix<double> result(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        result(i, j) = coordinates[i].sign * coordinates[j].sign * matrix[coordinates[i].index][coordinates[j].index];
    return result;
  }
} // namespace sprag
