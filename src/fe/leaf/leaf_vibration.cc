// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/compressed_rows.h"
#include "fe/algebra/free_modes.h"
#include "fe/leaf/leaf_body.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <numeric>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_modes = 8;

    /// A mass per area of the cells or length of the faces that `values` visits, once for every call of `add`.
    struct MassOf
    {
      const FEValuesBase<2> &values;
      PETScWrappers::SparseMatrix &mass;
      FullMatrix<double> local                     = FullMatrix<double>(values.get_fe().n_dofs_per_cell());
      std::vector<types::global_dof_index> indices = std::vector<types::global_dof_index>(local.m());

      template <class Cell>
      void add(const Cell &cell, const double density)
      {
        const auto &fe = values.get_fe();
        local          = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          for (unsigned int i = 0; i < local.m(); ++i)
            for (unsigned int j = 0; j < local.n(); ++j)
              if (fe.system_to_component_index(i).first == fe.system_to_component_index(j).first)
                local(i, j) += density * values.JxW(q) * values.shape_value(i, q) * values.shape_value(j, q);
        cell->get_dof_indices(indices);
        mass.add(indices, local);
      }
    };

    void assemble_mass(const ElasticBody<2> &body, const double density, PETScWrappers::SparseMatrix &mass)
    {
      const auto &fe = body.dofs().get_fe();
      FEValues<2> values(body.cell_mapping(), fe, QGauss<2>(fe.degree + 1), update_values | update_JxW_values);
      body.reinit(mass);
      MassOf of_cells{ values, mass };
      for (const auto &cell : body.dofs().active_cell_iterators())
      {
        values.reinit(cell);
        of_cells.add(cell, density * body.body_properties().width_of(cell->material_id()));
      }
      mass.compress(VectorOperation::add);
    }

    /// A mass on the section at the joint, evenly over it.
    void assemble_joint(const ElasticBody<2> &body, const double joint_mass, PETScWrappers::SparseMatrix &mass)
    {
      const auto &fe = body.dofs().get_fe();
      FEFaceValues<2> values(body.cell_mapping(), fe, QGauss<1>(fe.degree + 1), update_values | update_JxW_values);
      const auto on_joint = [&](const auto &visit)
      {
        for (const auto &cell : body.dofs().active_cell_iterators())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == boundary_id::joint)
            {
              values.reinit(cell, f);
              visit(cell);
            }
      };
      double length = 0.;
      on_joint([&](const auto &)
               { length = std::accumulate(values.get_JxW_values().begin(), values.get_JxW_values().end(), length); });
      MassOf of_section{ values, mass };
      on_joint([&](const auto &cell) { of_section.add(cell, joint_mass / length); });
      mass.compress(VectorOperation::add);
    }

    /// Unit displacements of all along xi and along eta.
    std::array<Vector<double>, 2> translations(const ElasticBody<2> &body)
    {
      std::array<Vector<double>, 2> result{ { Vector<double>(body.n_dofs()), Vector<double>(body.n_dofs()) } };
      const auto &fe = body.dofs().get_fe();
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      for (const auto &cell : body.dofs().active_cell_iterators())
      {
        cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < indices.size(); ++i)
          result[fe.system_to_component_index(i).first][indices[i]] = 1.;
      }
      return result;
    }

    Vector<double> product(const PETScWrappers::SparseMatrix &matrix, const Vector<double> &vector)
    {
      const CompressedRows rows(matrix);
      Vector<double> result(vector.size());
      rows.multiply<1>({ { &vector } }, { { &result } });
      return result;
    }
  } // namespace

  void add_inertia(LeafBody &leaf, const double density, const double joint_mass, LeafBehaviour &behaviour)
  {
    const auto &body    = leaf.body();
    const auto &statics = leaf.statics();
    const auto shape    = leaf.rest().rate;
    const auto axes     = translations(body);
    PETScWrappers::SparseMatrix mass, reduced_mass, reduced_stiffness;
    assemble_mass(body, density, mass);
    if (joint_mass > 0.)
      assemble_joint(body, joint_mass, mass);
    statics.reduce(mass, reduced_mass);
    statics.reduce(statics.stiffness(), reduced_stiffness);

    const auto weighed = product(mass, shape);
    behaviour.mass     = body.mass_and_inertia(density)[0] + joint_mass;
    behaviour.inertia  = weighed * shape;
    behaviour.momentum = { { weighed * axes[0], weighed * axes[1] } };

    const auto modes = free_modes(reduced_stiffness, reduced_mass, n_modes);
    for (unsigned int i = 0; i < modes.shapes.size(); ++i)
    {
      const auto of_mode = product(mass, statics.expand(modes.shapes[i]));
      behaviour.modes.push_back({ modes.stiffness[i], of_mode * shape, { { of_mode * axes[0], of_mode * axes[1] } } });
    }
  }
} // namespace sprag
