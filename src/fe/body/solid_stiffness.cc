// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/solid_stiffness.h"

#include "fe/body/cell_stiffness.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Adds a cell's part of the upper triangle on those of its displacements that have numbers.
    void add(const FullMatrix<double> &cell_matrix, const std::vector<int> &numbers, MatrixEntries &entries)
    {
      for (unsigned int i = 0; i < numbers.size(); ++i)
        for (unsigned int j = 0; j <= i && numbers[i] >= 0; ++j)
          if (numbers[j] >= 0 && cell_matrix(i, j) != 0.)
            entries.add(std::min(numbers[i], numbers[j]), std::max(numbers[i], numbers[j]), cell_matrix(i, j));
    }

    /// Returns the numbers of a cell's displacements, -1 also where they are held.
    std::vector<int> cell_numbers(const DoFHandler<3>::active_cell_iterator &cell, const ElasticBody<3> &body,
                                  const std::vector<int> &number_in_part)
    {
      std::vector<types::global_dof_index> indices(cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(indices);
      std::vector<int> result(indices.size(), -1);
      for (unsigned int i = 0; i < indices.size(); ++i)
        if (!body.is_held(static_cast<unsigned int>(indices[i])))
          result[i] = number_in_part.empty() ? static_cast<int>(indices[i]) : number_in_part[indices[i]];
      return result;
    }
  } // namespace

  MatrixEntries assemble_stiffness(const ElasticBody<3> &body, const std::vector<int> &number_in_part)
  {
    std::vector<std::pair<DoFHandler<3>::active_cell_iterator, std::vector<int>>> cells;
    for (const auto &cell : body.dofs().active_cell_iterators())
      if (cell->is_locally_owned() && cell->material_id() != material_id::hub)
      {
        auto numbers = cell_numbers(cell, body, number_in_part);
        if (std::any_of(numbers.begin(), numbers.end(), [](const int number) { return number >= 0; }))
          cells.emplace_back(cell, std::move(numbers));
      }

    MatrixEntries result;
    result.size = number_in_part.empty() ? body.n_dofs() : 1 + *std::max_element(number_in_part.begin(), number_in_part.end());
    const std::size_t n = body.dofs().get_fe().n_dofs_per_cell();
    // Growing vectors would take twice the memory, which is what limits a run.
    result.reserve(cells.size() * n * (n + 1) / 2 + body.held().n_constraints());
    CellStiffness<3> stiffness(body);
    for (const auto &[cell, numbers] : cells)
      add(stiffness(cell), numbers, result);
    for (const auto index : body.dofs().locally_owned_dofs())
      if (const int number = number_in_part.empty() ? static_cast<int>(index) : number_in_part[index];
          number >= 0 && body.held().is_constrained(index))
        result.add(number, number, 1.);
    return result;
  }
} // namespace sprag
