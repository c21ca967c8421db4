// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "model/interface/interface_forces.h"
#include "model/interface/interface_layout.h"

namespace sprag
{
  /// A generalised coordinate of a contact that is a dof of the interface.
  struct InterfaceCoordinate
  {
    unsigned int index; ///< among the coordinates
    unsigned int dof;
    double sign; ///< of the coordinate along the dof
  };

  using InterfaceCoordinates = std::vector<InterfaceCoordinate>;

  /// Adds the coordinates of the pivot frame: the hub's rotation and, where the support is sprung, its displacement, which moves
  /// the counterface's position x back.
  inline void add_frame(const InterfaceLayout &layout, const unsigned int theta_index, const unsigned int x_index,
                        InterfaceCoordinates &result)
  {
    result.push_back({ theta_index, layout.rotation(), 1. });
    if (layout.sprung)
      result.push_back({ x_index, layout.support(), -1. });
  }

  /// Returns the dofs of the coordinates, in their order.
  inline DofSelection collect_dofs(const InterfaceCoordinates &coordinates)
  {
    return mapped(coordinates, &InterfaceCoordinate::dof);
  }

  /// Returns a row over the coordinates as one over their dofs.
  template <class Row>
  dealii::Vector<double> row_on_dofs(const InterfaceCoordinates &coordinates, const Row &row)
  {
    dealii::Vector<double> result(static_cast<unsigned int>(coordinates.size()));
    for (unsigned int i = 0; i < coordinates.size(); ++i)
      result[i] = coordinates[i].sign * row[coordinates[i].index];
    return result;
  }

  /// Returns a matrix over the coordinates as one over their dofs.
  template <class Matrix>
  dealii::FullMatrix<double> matrix_on_dofs(const InterfaceCoordinates &coordinates, const Matrix &matrix)
  {
    const auto n = static_cast<unsigned int>(coordinates.size());
    dealii::FullMatrix<double> result(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        result(i, j) = coordinates[i].sign * coordinates[j].sign * matrix[coordinates[i].index][coordinates[j].index];
    return result;
  }
} // namespace sprag
