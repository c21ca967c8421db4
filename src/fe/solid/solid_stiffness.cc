#include "fe/solid/solid_stiffness.h"

#include "fe/body/cell_elasticity.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using Cell = DoFHandler<3>::active_cell_iterator;

    /// Material and shape of a cell up to a shift, in steps of a nanometre: cells that are alike share a stiffness.
    std::vector<long> likeness(const Cell &cell)
    {
      std::vector<long> result{ static_cast<long>(cell->material_id()) };
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int d = 0; d < 3; ++d)
          result.push_back(std::lround(1e6 * (cell->vertex(v)[d] - cell->vertex(0)[d])));
      return result;
    }

    void reinit(const StiffnessSource &source, PETScWrappers::MPI::SparseMatrix &matrix)
    {
      const IndexSet &owned = source.dof_handler.locally_owned_dofs();
      const MPI_Comm ranks  = source.dof_handler.get_communicator();
      DynamicSparsityPattern pattern(source.dof_handler.n_dofs(), source.dof_handler.n_dofs());
      std::vector<types::global_dof_index> indices(source.dof_handler.get_fe().n_dofs_per_cell());
      for (const auto &cell : source.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          cell->get_dof_indices(indices);
          source.constraints.add_entries_local_to_global(indices, pattern, true);
        }
      SparsityTools::distribute_sparsity_pattern(pattern, owned, ranks,
                                                 DoFTools::extract_locally_relevant_dofs(source.dof_handler));
      matrix.reinit(owned, owned, pattern, ranks);
    }

    void assemble(const StiffnessSource &source, PETScWrappers::MPI::SparseMatrix &matrix)
    {
      const auto &fe       = source.dof_handler.get_fe();
      const unsigned int n = fe.n_dofs_per_cell();
      CellElasticity<3> elasticity(source.mapping, fe, source.properties);
      const Vector<double> at_rest(n);
      Vector<double> no_forces(n);
      std::map<std::vector<long>, FullMatrix<double>> known;
      std::vector<types::global_dof_index> indices(n);
      for (const auto &cell : source.dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned() || cell->material_id() == material_id::hub)
          continue;
        const auto [found, is_new] = known.try_emplace(likeness(cell), n, n);
        if (is_new)
        {
          elasticity.reinit(cell, at_rest);
          elasticity.assemble(found->second, no_forces);
        }
        cell->get_dof_indices(indices);
        source.constraints.distribute_local_to_global(found->second, indices, matrix);
      }
      const IndexSet &owned = source.dof_handler.locally_owned_dofs();
      for (const auto &line : source.constraints.get_lines())
        if (owned.is_element(line.index))
          matrix.add(line.index, line.index, 1.);
      matrix.compress(VectorOperation::add);
    }

    /// Calls of_entry(row, column, value) for this rank's part of the upper triangle.
    template <class OfEntry>
    void visit_upper_triangle(const Mat matrix, const OfEntry &of_entry)
    {
      PetscInt begin = 0, end = 0;
      MatGetOwnershipRange(matrix, &begin, &end);
      for (PetscInt row = begin; row < end; ++row)
      {
        PetscInt entries          = 0;
        const PetscInt *columns   = nullptr;
        const PetscScalar *values = nullptr;
        MatGetRow(matrix, row, &entries, &columns, &values);
        for (PetscInt k = 0; k < entries; ++k)
          if (columns[k] >= row && (values[k] != 0. || columns[k] == row))
            of_entry(row, columns[k], values[k]);
        MatRestoreRow(matrix, row, &entries, &columns, &values);
      }
    }

    void add(const int row, const int column, const double value, SymmetricEntries &entries)
    {
      entries.row.push_back(row + 1);
      entries.column.push_back(column + 1);
      entries.value.push_back(value);
    }
  } // namespace

  SymmetricEntries assemble_stiffness(const StiffnessSource &source, const std::vector<int> &number_in_part,
                                      SymmetricEntries &of_part)
  {
    PETScWrappers::MPI::SparseMatrix matrix;
    reinit(source, matrix);
    assemble(source, matrix);

    SymmetricEntries result;
    result.size  = source.dof_handler.n_dofs();
    of_part.size = number_in_part.empty() ? 0 : 1 + *std::max_element(number_in_part.begin(), number_in_part.end());
    visit_upper_triangle(matrix,
                         [&](const PetscInt row, const PetscInt column, const double value)
                         {
                           add(row, column, value, result);
                           if (of_part.size > 0 && number_in_part[row] >= 0 && number_in_part[column] >= 0)
                             add(number_in_part[row], number_in_part[column], value, of_part);
                         });
    return result;
  }
} // namespace sprag
