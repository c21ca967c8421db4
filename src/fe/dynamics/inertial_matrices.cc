// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/inertial_matrices.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/body/cell_elasticity.h"
#include "fe/body/end_face.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using PETScMatrix = PETScWrappers::SparseMatrix;

    /// Adds matrices of cells and faces, given for degrees of freedom of the body, in total coordinates.
    class Scatter
    {
    public:
      Scatter(const TotalCoordinates &coordinates_, const unsigned int n)
          : coordinates(coordinates_)
          , dofs(n)
          , indices(n)
          , shares(n)
          , scaled(n, n)
      {
      }

      template <class Cell>
      void reinit(const Cell &cell)
      {
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto &mover = coordinates.mover(static_cast<unsigned int>(dofs[i]));
          indices[i]        = mover.coordinate;
          shares[i]         = mover.share;
        }
      }

      void add(const FullMatrix<double> &local, PETScMatrix &matrix)
      {
        for (unsigned int i = 0; i < dofs.size(); ++i)
          for (unsigned int j = 0; j < dofs.size(); ++j)
            scaled(i, j) = shares[i] * shares[j] * local(i, j);
        matrix.add(indices, indices, scaled, false);
      }

      /// Adds the rows whose products with the coordinates are the mass times the displacement along each axis. Returns the mass.
      double add_momentum(const FullMatrix<double> &local, const FiniteElement<2> &fe,
                          std::array<Vector<double>, 2> &momentum) const
      {
        double along_first = 0.;
        for (unsigned int i = 0; i < dofs.size(); ++i)
          for (unsigned int j = 0; j < dofs.size(); ++j)
          {
            const unsigned int component = fe.system_to_component_index(j).first;
            momentum[component][indices[i]] += shares[i] * local(i, j);
            along_first += component == 0 ? local(i, j) : 0.;
          }
        return along_first;
      }

    private:
      const TotalCoordinates &coordinates;
      std::vector<types::global_dof_index> dofs;
      std::vector<types::global_dof_index> indices;
      std::vector<double> shares;
      FullMatrix<double> scaled;
    };

    /// Mass matrix of a cell or, with a mass per area, of a face.
    FullMatrix<double> local_mass(const FEValuesBase<2> &values, const double density)
    {
      const auto &fe       = values.get_fe();
      const unsigned int n = fe.n_dofs_per_cell();
      FullMatrix<double> result(n, n);
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            if (fe.system_to_component_index(i).first == fe.system_to_component_index(j).first)
              result(i, j) += density * values.JxW(q) * values.shape_value(i, q) * values.shape_value(j, q);
      return result;
    }
    double inertia_of_cells(const ElasticBody<2> &body, const std::map<types::material_id, double> &densities)
    {
      const auto &properties = body.body_properties();
      FEValues<2> values(body.dofs().get_fe(), QGauss<2>(properties.degree + 1), update_quadrature_points | update_JxW_values);
      double sum = 0.;
      for (const auto &cell : body.dofs().active_cell_iterators())
        if (cell->material_id() != material_id::hub && material_id::turns(cell->material_id()))
        {
          values.reinit(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            sum += densities.at(cell->material_id()) * properties.width_of(cell->material_id()) * values.JxW(q) *
                   values.quadrature_point(q).square();
        }
      return sum;
    }
    double inertia_of_tip(const ElasticBody<2> &body, const double tip_mass)
    {
      const auto faces    = faces_of_tip(body.dofs());
      const double length = total_measure<2>(faces);
      FEFaceValues<2> values(body.dofs().get_fe(), QGauss<1>(2), update_quadrature_points | update_JxW_values);
      double sum = 0.;
      for (const auto &[cell, f] : faces)
      {
        values.reinit(cell, f);
        for (const unsigned int q : values.quadrature_point_indices())
          sum += tip_mass / length * values.JxW(q) * values.quadrature_point(q).square();
      }
      return sum;
    }
  } // namespace
  TotalCoordinates::TotalCoordinates(const ElasticBody<2> &body, const unsigned int attached_coordinates)
      : movers(body.n_dofs())
      , arms(body.n_dofs())
      , n_attached(attached_coordinates)
  {
    std::vector<Point<2>> positions(body.n_dofs());
    DoFTools::map_dofs_to_support_points(MappingQ1<2>(), body.dofs(), positions);
    const auto &fe = body.dofs().get_fe();
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      if (!material_id::turns(cell->material_id()))
        continue;
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        const unsigned int component = fe.system_to_component_index(i).first;
        arms[dofs[i]]                = component == 0 ? -positions[dofs[i]][1] : component == 1 ? positions[dofs[i]][0] : 0.;
      }
    }
    for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
      if (!body.is_held(dof))
        movers[dof] = { n_free++, 1. };
    for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
      if (body.is_held(dof))
        movers[dof] = { rotation(), arms[dof] };
  }
  unsigned int TotalCoordinates::size() const
  {
    return n_free + n_attached + 1;
  }
  unsigned int TotalCoordinates::rotation() const
  {
    return n_free + n_attached;
  }
  unsigned int TotalCoordinates::attached(const unsigned int i) const
  {
    return n_free + i;
  }
  const TotalCoordinates::Mover &TotalCoordinates::mover(const unsigned int dof) const
  {
    return movers[dof];
  }
  double TotalCoordinates::arm(const unsigned int dof) const
  {
    return arms[dof];
  }
  std::vector<std::pair<unsigned int, double>> TotalCoordinates::row(const Connector &connector) const
  {
    std::vector<std::pair<unsigned int, double>> result;
    double of_rotation = 0.;
    for (const auto &[dof, weight] : connector.row)
    {
      result.emplace_back(movers[dof].coordinate, weight);
      of_rotation -= weight * arms[dof];
    }
    result.emplace_back(rotation(), of_rotation);
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
  Vector<double> TotalCoordinates::elastic_displacement(const Vector<double> &total) const
  {
    Vector<double> result(static_cast<unsigned int>(movers.size()));
    for (unsigned int dof = 0; dof < movers.size(); ++dof)
      if (movers[dof].coordinate != rotation())
        result[dof] = total[movers[dof].coordinate] - arms[dof] * total[rotation()];
    return result;
  }

  double scaling_of_densities(const LeverInertia &inertia, const double of_cells, const double added)
  {
    if (inertia.source != InertiaSource::scaled)
      return 1.;
    if (inertia.moment_of_inertia <= added)
      throw InputError("tip mass, hub and leaf spring alone have a moment of inertia of " + rounded_text(added) +
                       " t mm^2 about the pivot: Lever/Moment of inertia = " + rounded_text(inertia.moment_of_inertia) +
                       " must be larger");
    return (inertia.moment_of_inertia - added) / of_cells;
  }
  InertialMatrices::InertialMatrices(const ElasticBody<2> &body, const LeverInertia &inertia)
      : coordinates(body, static_cast<unsigned int>(inertia.leaf.modes.size()))
  {
    const double of_cells = inertia_of_cells(body, inertia.densities);
    const double of_tip   = inertia.tip_mass > 0. ? inertia_of_tip(body, inertia.tip_mass) : 0.;
    const double added    = of_tip + inertia.hub + inertia.leaf.inertia;
    density_factor        = scaling_of_densities(inertia, of_cells, added);
    moment_of_inertia     = density_factor * of_cells + added;

    auto densities = inertia.densities;
    for (auto &[material, density] : densities)
      density *= material_id::turns(material) ? density_factor : 1.;
    find_pattern(body);
    for (auto *const matrix : { &mass, &stiffness, &layer_stiffness })
      matrix->reinit(pattern);
    for (auto &row : momentum)
      row.reinit(coordinates.size());
    assemble_cells(body, densities);
    assemble_connectors(body);
    if (inertia.tip_mass > 0.)
      assemble_tip(body, inertia.tip_mass);
    attach_hub(inertia.hub, inertia.leaf);
    for (auto *const matrix : { &mass, &stiffness, &layer_stiffness })
      matrix->compress(VectorOperation::add);
  }
  void InertialMatrices::find_pattern(const ElasticBody<2> &body)
  {
    pattern.reinit(coordinates.size(), coordinates.size());
    std::vector<types::global_dof_index> dofs(body.dofs().get_fe().n_dofs_per_cell());
    for (const auto &cell : body.dofs().active_cell_iterators())
      if (cell->material_id() != material_id::hub)
      {
        cell->get_dof_indices(dofs);
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
  void InertialMatrices::assemble_cells(const ElasticBody<2> &body, const std::map<types::material_id, double> &densities)
  {
    const auto &properties = body.body_properties();
    const auto &fe         = body.dofs().get_fe();
    FEValues<2> values(body.cell_mapping(), fe, QGauss<2>(properties.degree + 1), update_values | update_JxW_values);
    CellElasticity<2> elasticity(body.cell_mapping(), fe, properties);
    const unsigned int n = fe.n_dofs_per_cell();
    const Vector<double> at_rest(n);
    FullMatrix<double> of_cell(n, n);
    Vector<double> forces(n);
    Scatter scatter(coordinates, n);
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      const auto material = cell->material_id();
      if (material == material_id::hub)
        continue;
      values.reinit(cell);
      elasticity.reinit(cell, at_rest);
      elasticity.assemble(of_cell, forces);
      scatter.reinit(cell);
      const auto cell_mass = local_mass(values, densities.at(material) * properties.width_of(material));
      scatter.add(of_cell, stiffness);
      scatter.add(cell_mass, mass);
      if (material == material_id::layer)
        scatter.add(of_cell, layer_stiffness);
      if (material_id::turns(material))
        total_mass += scatter.add_momentum(cell_mass, fe, momentum);
    }
  }
  void InertialMatrices::assemble_connectors(const ElasticBody<2> &body)
  {
    for (const auto &connector : body.connectors())
    {
      const auto row = coordinates.row(connector);
      for (const auto &[i, weight_i] : row)
        for (const auto &[j, weight_j] : row)
          stiffness.add(i, j, connector.stiffness * weight_i * weight_j);
    }
  }
  void InertialMatrices::assemble_tip(const ElasticBody<2> &body, const double tip_mass)
  {
    const auto &fe      = body.dofs().get_fe();
    const auto faces    = faces_of_tip(body.dofs());
    const double length = total_measure<2>(faces);
    FEFaceValues<2> values(fe, QGauss<1>(body.body_properties().degree + 1), update_values | update_JxW_values);
    Scatter scatter(coordinates, fe.n_dofs_per_cell());
    for (const auto &[cell, f] : faces)
    {
      values.reinit(cell, f);
      scatter.reinit(cell);
      const auto face_mass = local_mass(values, tip_mass / length);
      scatter.add(face_mass, mass);
      total_mass += scatter.add_momentum(face_mass, fe, momentum);
    }
  }
  void InertialMatrices::attach_hub(const double of_hub, const LeafBehaviour &leaf)
  {
    const unsigned int hub  = coordinates.rotation();
    const auto add_momentum = [&](const unsigned int coordinate, const std::array<double, 2> &of_unit_rate)
    {
      for (unsigned int axis = 0; axis < 2; ++axis)
        momentum[axis][coordinate] += of_unit_rate[axis];
    };
    mass.add(hub, hub, of_hub + leaf.inertia);
    add_momentum(hub, leaf.momentum);
    total_mass += leaf.mass;
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
