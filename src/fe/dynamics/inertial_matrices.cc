// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/inertial_matrices.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "fe/body/cell_stiffness.h"
#include "fe/body/end_face.h"

namespace sprag
{
  using namespace dealii;

  using PETScMatrix = PETScWrappers::SparseMatrix;

  TotalCoordinates::TotalCoordinates(const ElasticBody<2> &body, const unsigned int attached_coordinates)
      : movers(body.n_dofs())
      , arms(rotation_arms(body))
      , n_attached(attached_coordinates)
  {
    for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
      if (!body.is_held(dof))
        movers[dof] = { n_free++, 1. };
    for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
      if (body.is_held(dof))
        movers[dof] = { rotation(), arms[dof] };
  }

  std::vector<std::pair<unsigned int, double>> TotalCoordinates::row(const Connector &connector) const
  {
    std::vector<std::pair<unsigned int, double>> result;
    double rotation_weight = 0.;
    for (const auto &[dof, weight] : connector.row)
    {
      result.emplace_back(movers[dof].coordinate, weight);
      rotation_weight -= weight * arms[dof];
    }
    result.emplace_back(rotation(), rotation_weight);
    return result;
  }

  Vector<double> TotalCoordinates::rigid_rotation() const
  {
    Vector<double> result(size());
    for (unsigned int dof = 0; dof < movers.size(); ++dof)
      result[movers[dof].coordinate] = arms[dof];
    result[rotation()] = 1.;
    return result;
  }

  Vector<double> TotalCoordinates::collect(const Vector<double> &dof_values) const
  {
    Vector<double> result(size());
    for (unsigned int dof = 0; dof < movers.size(); ++dof)
      result[movers[dof].coordinate] += movers[dof].share * dof_values[dof];
    return result;
  }

  void TotalCoordinates::scatter(const std::vector<types::global_dof_index> &dofs, const FullMatrix<double> &local,
                                 PETScMatrix &matrix) const
  {
    const auto indices        = mapped(dofs, [&](const auto dof) -> types::global_dof_index { return movers[dof].coordinate; });
    FullMatrix<double> scaled = local;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      for (unsigned int j = 0; j < dofs.size(); ++j)
        scaled(i, j) *= movers[dofs[i]].share * movers[dofs[j]].share;
    matrix.add(indices, scaled, false);
  }

  Vector<double> TotalCoordinates::total(const Vector<double> &elastic, const std::vector<double> &attached_values,
                                         const double rotation_value) const
  {
    Vector<double> result(size());
    for (unsigned int dof = 0; dof < movers.size(); ++dof)
      if (movers[dof].coordinate != rotation())
        result[movers[dof].coordinate] = elastic[dof] + arms[dof] * rotation_value;
    std::copy(attached_values.begin(), attached_values.end(), result.begin() + n_free);
    result[rotation()] = rotation_value;
    return result;
  }

  Vector<double> TotalCoordinates::elastic_displacement(const Vector<double> &total) const
  {
    Vector<double> result(static_cast<unsigned int>(movers.size()));
    for (unsigned int dof = 0; dof < movers.size(); ++dof)
      if (movers[dof].coordinate != rotation())
        result[dof] = total[movers[dof].coordinate] - arms[dof] * total[rotation()];
    return result;
  }

  InertialMatrices::InertialMatrices(const ElasticBody<2> &body, const LeverInertia &inertia)
      : InertialMatrices(body, BodyMass<2>(body, inertia), inertia.leaf)
  {
  }

  InertialMatrices::InertialMatrices(const ElasticBody<2> &body, const BodyMass<2> &body_mass, const LeafBehaviour &leaf)
      : MassSums(body_mass)
      , coordinates(body, static_cast<unsigned int>(leaf.modes.size()))
  {
    find_pattern(body);
    for (auto *const matrix : { &mass, &stiffness, &layer_stiffness })
      matrix->reinit(pattern);
    for (unsigned int axis = 0; axis < 2; ++axis)
      momentum[axis] = coordinates.collect(body_mass(body_mass.translation(axis)));
    for (const auto &[unit, density, dofs] : body_mass.cells())
    {
      FullMatrix<double> local = *unit;
      local *= density;
      for (unsigned int axis = 0; axis < 2; ++axis)
        coordinates.scatter(mapped(dofs, [axis](const auto &node_dofs) { return node_dofs[axis]; }), local, mass);
    }
    assemble_stiffness(body);
    attach(body_mass.hub, leaf);
    for (auto *const matrix : { &mass, &stiffness, &layer_stiffness })
      matrix->compress(VectorOperation::add);
  }

  void InertialMatrices::find_pattern(const ElasticBody<2> &body)
  {
    pattern.reinit(coordinates.size(), coordinates.size());
    for (const auto &cell : body.dofs().active_cell_iterators())
      if (cell->material_id() != material_id::hub)
      {
        const auto dofs = cell_dofs(cell);
        for (const auto i : dofs)
          for (const auto j : dofs)
            pattern.add(coordinates.mover(static_cast<unsigned int>(i)).coordinate,
                        coordinates.mover(static_cast<unsigned int>(j)).coordinate);
      }
    for (const auto &connector : body.connectors())
    {
      const auto row = coordinates.row(connector);
      for (const auto &i : row)
        for (const auto &j : row)
          pattern.add(i.first, j.first);
    }
    const unsigned int hub = coordinates.rotation();
    pattern.add(hub, hub);
    for (unsigned int attached = coordinates.attached(0); attached < hub; ++attached)
    {
      pattern.add(attached, attached);
      pattern.add(attached, hub);
      pattern.add(hub, attached);
    }
  }

  void InertialMatrices::sum(const Weights &weights, PETScMatrix &result) const
  {
    const std::pair<const PETScMatrix &, double> parts[] = { { mass, weights.mass },
                                                             { stiffness, weights.stiffness },
                                                             { layer_stiffness, weights.layer } };
    result.reinit(pattern);
    result.compress(VectorOperation::add);
    for (const auto &[part, weight] : parts)
      if (weight != 0. && MatAXPY(result, weight, part, SAME_NONZERO_PATTERN) != 0)
        throw AnalysisError("the matrices of the lever cannot be added");
    result.add(coordinates.rotation(), coordinates.rotation(), weights.rotation);
    result.compress(VectorOperation::add);
  }

  void InertialMatrices::assemble_stiffness(const ElasticBody<2> &body)
  {
    CellStiffness<2> cell_stiffness(body);
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      if (cell->material_id() == material_id::hub)
        continue;
      const auto &cell_matrix = cell_stiffness(cell);
      const auto dofs         = cell_dofs(cell);
      coordinates.scatter(dofs, cell_matrix, stiffness);
      if (cell->material_id() == material_id::layer)
        coordinates.scatter(dofs, cell_matrix, layer_stiffness);
    }
    for (const auto &connector : body.connectors())
    {
      const auto row = coordinates.row(connector);
      for (const auto &[i, weight_i] : row)
        for (const auto &[j, weight_j] : row)
          stiffness.add(i, j, connector.stiffness * weight_i * weight_j);
    }
  }

  void InertialMatrices::attach(const double hub_inertia, const LeafBehaviour &leaf)
  {
    const unsigned int hub  = coordinates.rotation();
    const auto add_momentum = [&](const unsigned int coordinate, const std::array<double, 2> &unit_rates)
    {
      for (unsigned int axis = 0; axis < 2; ++axis)
        momentum[axis][coordinate] += unit_rates[axis];
    };
    mass.add(hub, hub, hub_inertia);
    add_momentum(hub, leaf.momentum);
    for (unsigned int i = 0; i < leaf.modes.size(); ++i)
    {
      const auto &mode              = leaf.modes[i];
      const unsigned int coordinate = coordinates.attached(i);
      mass.add(coordinate, coordinate, 1.);
      mass.add(coordinate, hub, mode.participation);
      mass.add(hub, coordinate, mode.participation);
      stiffness.add(coordinate, coordinate, mode.stiffness);
      add_momentum(coordinate, mode.momentum);
    }
  }
} // namespace sprag
