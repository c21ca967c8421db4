// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/stiffness_product.h"

#include "fe/solid/solid_stiffness.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr std::size_t together = 16; ///< columns: pages of more are too many for a processor to find at once
  }

  StiffnessProduct::StiffnessProduct(const ElasticBody<3> &body, const std::vector<int> &number_in_part,
                                     std::vector<Connector> connectors)
      : size(size_of_part(body, number_in_part))
      , of_cells(body)
      , springs(std::move(connectors))
  {
    for (const auto &cell : body.dofs().active_cell_iterators())
      if (cell->material_id() != material_id::hub)
      {
        auto numbers = numbers_of(cell, body, number_in_part);
        if (std::any_of(numbers.begin(), numbers.end(), [](const int number) { return number >= 0; }))
          cells.push_back({ &of_cells(cell), std::move(numbers) });
      }
  }

  void StiffnessProduct::subtract(const std::vector<double> &displacements, std::vector<double> &forces) const
  {
    if (cells.empty())
      return;
    const auto n = static_cast<unsigned int>(cells.front().numbers.size());
    for (std::size_t first = 0; first < displacements.size(); first += together * size)
    {
      const auto columns = static_cast<unsigned int>(std::min<std::size_t>(together, (displacements.size() - first) / size));
      FullMatrix<double> moved(columns, n), answer(columns, n); // a row a column, which lies in one piece
      for (const auto &[stiffness, numbers] : cells)
      {
        for (unsigned int j = 0; j < columns; ++j)
          for (unsigned int i = 0; i < n; ++i)
            moved(j, i) = numbers[i] < 0 ? 0. : displacements[first + j * static_cast<std::size_t>(size) + numbers[i]];
        moved.mmult(answer, *stiffness); // which is symmetric
        for (unsigned int j = 0; j < columns; ++j)
          for (unsigned int i = 0; i < n; ++i)
            if (numbers[i] >= 0)
              forces[first + j * static_cast<std::size_t>(size) + numbers[i]] -= answer(j, i);
      }
    }
    for (const auto &spring : springs)
      for (std::size_t begin = 0; begin < displacements.size(); begin += size)
      {
        const double force = spring.stiffness * spring.compression(&displacements[begin]);
        for (const auto &[dof, weight] : spring.row)
          forces[begin + dof] -= force * weight;
      }
  }
} // namespace sprag
