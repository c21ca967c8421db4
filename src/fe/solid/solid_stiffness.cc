#include "fe/solid/solid_stiffness.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  std::vector<long> likeness(const DoFHandler<3>::active_cell_iterator &cell)
  {
    std::vector<long> result{ static_cast<long>(cell->material_id()) };
    for (const unsigned int v : cell->vertex_indices())
      for (unsigned int d = 0; d < 3; ++d)
        result.push_back(std::lround(1e6 * (cell->vertex(v)[d] - cell->vertex(0)[d])));
    return result;
  }

  namespace
  {
    void add(const int row, const int column, const double value, SymmetricEntries &entries)
    {
      entries.row.push_back(row + 1);
      entries.column.push_back(column + 1);
      entries.value.push_back(value);
    }

    /// Adds a cell's part of the upper triangle on those of its displacements that have numbers.
    void add(const FullMatrix<double> &of_cell, const std::vector<int> &numbers, SymmetricEntries &entries)
    {
      for (unsigned int i = 0; i < numbers.size(); ++i)
        for (unsigned int j = 0; j <= i && numbers[i] >= 0; ++j)
          if (numbers[j] >= 0 && of_cell(i, j) != 0.)
            add(std::min(numbers[i], numbers[j]), std::max(numbers[i], numbers[j]), of_cell(i, j), entries);
    }
  } // namespace

  CellStiffness::CellStiffness(const Mapping<3> &mapping, const FiniteElement<3> &fe, const BodyProperties &properties)
      : elasticity(mapping, fe, properties)
      , at_rest(fe.n_dofs_per_cell())
      , no_forces(fe.n_dofs_per_cell())
  {
  }

  const FullMatrix<double> &CellStiffness::operator()(const DoFHandler<3>::active_cell_iterator &cell)
  {
    const unsigned int n       = at_rest.size();
    const auto [found, is_new] = known.try_emplace(likeness(cell), n, n);
    if (is_new)
    {
      elasticity.reinit(cell, at_rest);
      elasticity.assemble(found->second, no_forces);
    }
    return found->second;
  }

  SolidStiffness assemble_stiffness(const StiffnessSource &source, const std::vector<int> &number_in_part)
  {
    const auto &fe       = source.dof_handler.get_fe();
    const unsigned int n = fe.n_dofs_per_cell();
    CellStiffness stiffness(source.mapping, fe, source.properties);
    std::vector<types::global_dof_index> indices(n);
    std::vector<int> in_whole(n), in_part(n, -1);

    SolidStiffness result;
    result.whole.size = source.dof_handler.n_dofs();
    result.part.size  = number_in_part.empty() ? 0 : 1 + *std::max_element(number_in_part.begin(), number_in_part.end());
    for (const auto &cell : source.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned() || cell->material_id() == material_id::hub)
        continue;
      const auto &of_cell = stiffness(cell);
      cell->get_dof_indices(indices);
      for (unsigned int i = 0; i < n; ++i)
      {
        const bool is_free = !source.constraints.is_constrained(indices[i]);
        in_whole[i]        = is_free ? static_cast<int>(indices[i]) : -1;
        if (result.part.size > 0)
          in_part[i] = is_free ? number_in_part[indices[i]] : -1;
      }
      add(of_cell, in_whole, result.whole);
      if (result.part.size > 0)
        add(of_cell, in_part, result.part);
    }
    for (const auto index : source.dof_handler.locally_owned_dofs())
      if (source.constraints.is_constrained(index))
      {
        add(static_cast<int>(index), static_cast<int>(index), 1., result.whole);
        if (result.part.size > 0 && number_in_part[index] >= 0)
          add(number_in_part[index], number_in_part[index], 1., result.part);
      }
    return result;
  }
} // namespace sprag
