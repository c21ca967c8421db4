// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/full_stiffness.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "fe/algebra/matrix_rows.h"
#include "model/step/state_archive.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <cmath>

namespace sprag
{
  using namespace dealii;

  FullStiffness::FullStiffness(const ElasticBody<2> &body_, const InterfaceLayout &layout_, const JointSprings &springs_)
      : body(body_)
      , layout(layout_)
      , springs(springs_)
      , surface(surface_dofs(body))
  {
    body.reinit(body_stiffness);
    pattern.reinit(n_coordinates(), n_coordinates());
    const MatrixRows rows(body_stiffness);
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
      for (PetscInt i = 0; i < rows.n; ++i)
        for (PetscInt k = rows.begin[i]; k < rows.begin[i + 1]; ++k)
          pattern.add(first_coordinate(lever) + static_cast<unsigned int>(i),
                      first_coordinate(lever) + static_cast<unsigned int>(rows.column[k]));

    // Hubs and support are coupled with everything that the contact touches, and an elastic cylinder's face with all of both
    // faces: the material of the lever slides along it.
    const auto couple = [&](const unsigned int dof, const unsigned int other)
    {
      pattern.add(coordinate(dof), coordinate(other));
      pattern.add(coordinate(other), coordinate(dof));
    };
    const auto n_friction = 2 * static_cast<unsigned int>(body.friction_face().nodes.size());
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
    {
      for (unsigned int i = 0; i < layout.dofs_per_lever(); ++i)
      {
        couple(layout.first(lever) + i, layout.rotation(lever));
        if (layout.sprung)
          couple(layout.first(lever) + i, layout.support());
        for (unsigned int j = n_friction; j < layout.surface; ++j)
          couple(layout.first(lever) + i, layout.first(lever) + j);
      }
      couple(layout.rotation(lever), layout.rotation(0));
    }
    if (layout.sprung)
      couple(layout.support(), layout.support());
  }

  unsigned int FullStiffness::coordinate(const unsigned int dof) const
  {
    if (dof == layout.support())
      return first_coordinate(layout.levers);
    const unsigned int lever = layout.lever_index(dof);
    return first_coordinate(lever) + (layout.is_surface(dof) ? surface[dof - layout.first(lever)] : body.n_dofs());
  }

  Vector<double> FullStiffness::interface_displacements(const Vector<double> &coordinates) const
  {
    Vector<double> result(layout.size());
    for (unsigned int dof = 0; dof < result.size(); ++dof)
      result[dof] = coordinates[coordinate(dof)];
    return result;
  }

  /// A matrix that no residual holds, all 0.
  std::shared_ptr<PETScWrappers::SparseMatrix> FullStiffness::free_matrix()
  {
    for (const auto &matrix : matrices)
      if (matrix.use_count() == 1)
      {
        *matrix = 0.;
        return matrix;
      }
    matrices.push_back(std::make_shared<PETScWrappers::SparseMatrix>());
    matrices.back()->reinit(pattern);
    return matrices.back();
  }

  Residual FullStiffness::residual(const Vector<double> &coordinates, const InterfaceForces &forces, const DofSelection &)
  {
    if (!is_ordered)
    {
      first_coordinates = coordinates;
      first_forces      = forces;
    }
    const auto tangent = free_matrix();
    auto &matrix       = *tangent;
    Vector<double> left(n_coordinates());
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
      add_body(lever, coordinates, matrix, left);
    const auto add_spring = [&](const unsigned int dof, const double stiffness)
    {
      const unsigned int i = coordinate(dof);
      matrix.add(i, i, stiffness);
      left[i] -= stiffness * coordinates[i];
    };
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
      add_spring(layout.rotation(lever), springs.rotation);
    if (layout.sprung)
      add_spring(layout.support(), layout.levers * springs.support);
    for (unsigned int i = 0; i < forces.dofs.size(); ++i)
    {
      left[coordinate(forces.dofs[i])] += forces.values[i];
      for (unsigned int j = 0; j < forces.dofs.size(); ++j)
        if (forces.tangent(i, j) != 0.)
          matrix.add(coordinate(forces.dofs[i]), coordinate(forces.dofs[j]), -forces.tangent(i, j));
    }
    matrix.compress(VectorOperation::add);

    double squares = left.norm_sqr();
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
    {
      const double moment = left[coordinate(layout.rotation(lever))];
      squares += (1. / (springs.arm * springs.arm) - 1.) * moment * moment;
    }
    return { std::move(left), std::sqrt(squares), tangent };
  }

  void FullStiffness::add_body(const unsigned int lever, const Vector<double> &coordinates, PETScWrappers::SparseMatrix &matrix,
                               Vector<double> &forces)
  {
    const unsigned int first = first_coordinate(lever);
    Vector<double> internal(body.n_dofs());
    body_stiffness = 0.;
    body.assemble(body_displacement(lever, coordinates), body_stiffness, internal);
    for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
      forces[first + dof] -= internal[dof];

    const MatrixRows from(body_stiffness), to(matrix);
    for (PetscInt i = 0; i < from.n; ++i)
    {
      PetscInt place = to.begin[first + i];
      for (PetscInt k = from.begin[i]; k < from.begin[i + 1]; ++k)
      {
        while (to.column[place] < static_cast<PetscInt>(first) + from.column[k])
          ++place;
        to[static_cast<std::size_t>(place)] += from[static_cast<std::size_t>(k)];
      }
    }
  }

  void FullStiffness::serialise_history(Archive &archive)
  {
    bool known       = is_ordered;
    auto coordinates = first_coordinates;
    auto forces      = first_forces;
    archive(known, coordinates, forces);
    if (!archive.reads() || !known)
      return;
    try
    {
      correction(residual(coordinates, forces), forces);
    }
    catch (const AnalysisError &)
    {
      // So it was, and the ordering was kept.
    }
  }

  Vector<double> FullStiffness::correction(const Residual &residual, const InterfaceForces &, const DofSelection &)
  {
    is_ordered = true;
    factors.factorise(*residual.tangent);
    Vector<double> result;
    factors.solve(residual.values, result);
    return result;
  }

  Vector<double> FullStiffness::body_displacement(const unsigned int lever, const Vector<double> &coordinates) const
  {
    const auto begin = coordinates.begin() + first_coordinate(lever);
    return Vector<double>(begin, begin + body.n_dofs());
  }

  std::vector<BodyDisplacements> FullStiffness::body_displacements(const std::vector<StaticState> &states) const
  {
    return find_displacements(states, layout.levers,
                              [&](const unsigned int lever, const Vector<double> &at) { return body_displacement(lever, at); });
  }

  std::vector<double> FullStiffness::sensor_forces(const unsigned int lever, const Vector<double> &coordinates,
                                                   const DofLoads &) const
  {
    return body.sensor_forces(body_displacement(lever, coordinates));
  }
} // namespace sprag
