// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/cell_stiffness.h"

namespace sprag
{
  /// The stiffness of a body or of a part of it times displacements, cell by cell: as cells that are alike share theirs, it takes
  /// hardly any memory.
  class StiffnessProduct
  {
  public:
    /// `number_in_part` as of assemble_stiffness(). The body must outlive this.
    StiffnessProduct(const ElasticBody<3> &body, const std::vector<int> &number_in_part, std::vector<Connector> connectors);

    /// Subtracts the product with some columns, one after another, from others. Held displacements must be 0.
    void subtract(const std::vector<double> &displacements, std::vector<double> &forces) const;

  private:
    struct Cell
    {
      const dealii::FullMatrix<double> *stiffness;
      std::vector<int> numbers; ///< of its displacements, -1 for none
    };

    unsigned int size;
    CellStiffness<3> of_cells;
    std::vector<Connector> springs;
    std::vector<Cell> cells;
  };
} // namespace sprag
