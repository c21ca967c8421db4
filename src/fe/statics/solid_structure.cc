// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/solid_structure.h"

#include "base/ranges.h"
#include "fe/body/end_face.h"
#include "fe/contact/contact_face.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  FiniteStrain::FiniteStrain(const SolidBody &body_)
      : body(body_)
      , surface(surface_dofs(body))
      , stiffness(body)
      , elasticity(body.cell_mapping(), body.dofs().get_fe(), body.body_properties())
      , cell_displacement(body.dofs().get_fe().n_dofs_per_cell())
  {
    for (const auto &cell : body.dofs().active_cell_iterators())
      if (cell->material_id() != material_id::hub)
        cells.push_back({ cell, cell_dofs(cell), &stiffness(cell) });
  }

  void FiniteStrain::add(const DofLoads &on_face, std::vector<double> &loads) const
  {
    for (unsigned int i = 0; i < on_face.dofs.size(); ++i)
      if (const unsigned int dof = surface[on_face.dofs[i]]; !body.is_held(dof))
        loads[dof] += on_face.values[i];
  }

  Vector<double> FiniteStrain::strain_residual(const Vector<double> &displacement, const DofLoads &on_face)
  {
    std::vector<double> loads(body.n_dofs(), 0.);
    Vector<double> internal(cell_displacement.size()), stiffness_forces(cell_displacement.size());
    for (const auto &cell : cells)
    {
      for (unsigned int i = 0; i < cell.dofs.size(); ++i)
        cell_displacement[i] = displacement[cell.dofs[i]];
      elasticity.reinit(cell.cell, cell_displacement);
      elasticity.find_forces(internal);
      cell.stiffness->vmult(stiffness_forces, cell_displacement);
      internal -= stiffness_forces;
      for (unsigned int i = 0; i < cell.dofs.size(); ++i)
        if (!body.is_held(cell.dofs[i]))
          loads[cell.dofs[i]] += internal[i];
    }
    for (double &load : loads)
      load = -load;
    add(on_face, loads);
    body.respond(loads);
    Vector<double> result(loads.begin(), loads.end());
    result -= displacement;
    return result;
  }

  Vector<double> FiniteStrain::correction(const Vector<double> &strain_residual, const DofLoads &change) const
  {
    std::vector<double> loads(body.n_dofs(), 0.);
    add(change, loads);
    body.respond(loads);
    Vector<double> result(loads.begin(), loads.end());
    return result += strain_residual;
  }

  SolidStructure::SolidStructure(const SolidBody &body_, const double begin, const double end, const InterfaceLayout &layout_,
                                 const JointSprings &springs_)
      : SolidStructure(body_, std::make_shared<LayeredCompliance>(body_, begin, end), layout_, springs_)
  {
  }

  SolidStructure::SolidStructure(const SolidBody &body_, std::shared_ptr<LayeredCompliance> face, const InterfaceLayout &layout_,
                                 const JointSprings &springs_)
      : StaticInterface(layout_, springs_, { face })
      , body(body_)
      , surface(surface_dofs(body))
      , compliance(std::move(face))
      , sensors(body, make_response(body))
  {
    if (body.body_properties().material != MaterialModel::linear)
      finite.emplace(body);
  }

  Vector<double> SolidStructure::lever_displacement(const Vector<double> &coordinates, const unsigned int lever) const
  {
    const auto first = coordinates.begin() + first_body_coordinate(lever);
    return Vector<double>(first, first + body.n_dofs());
  }

  void SolidStructure::set_faces(const DofLoads &forces, const DofSelection &near, Vector<double> &coordinates)
  {
    if (!finite)
      return StaticInterface::set_faces(forces, near, coordinates);
    for (unsigned int i = 0; i < layout.levers; ++i)
      for (unsigned int dof = 0; dof < layout.surface; ++dof)
        coordinates[layout.first(i) + dof] = coordinates[first_body_coordinate(i) + surface[dof]];
  }

  Residual SolidStructure::residual(const Vector<double> &coordinates, const InterfaceForces &forces, const DofSelection &near)
  {
    if (!finite)
      return StaticInterface::residual(coordinates, forces, near);
    Vector<double> face_displacements(layout.size()), strain_parts(n_coordinates());
    for (unsigned int i = 0; i < layout.levers; ++i)
    {
      const auto displacement = lever_displacement(coordinates, i);
      const auto strain_part  = finite->strain_residual(displacement, on_surface(forces, i));
      std::copy(strain_part.begin(), strain_part.end(), strain_parts.begin() + first_body_coordinate(i));
      for (unsigned int dof = 0; dof < layout.surface; ++dof)
        face_displacements[layout.first(i) + dof] = displacement[surface[dof]] + strain_part[surface[dof]];
    }
    auto result = StaticInterface::residual(coordinates, forces, near, &face_displacements);
    result.norm = std::hypot(result.norm, strain_parts.l2_norm());
    std::copy(result.values.begin(), result.values.end(), strain_parts.begin());
    result.values = std::move(strain_parts);
    return result;
  }

  Vector<double> SolidStructure::correction(const Residual &residual, const InterfaceForces &forces, const DofSelection &near)
  {
    auto result = StaticInterface::correction(residual, forces, near);
    if (!finite)
      return result;
    DofLoads change{ forces.dofs, Vector<double>(forces.values.size()) };
    Vector<double> moved(forces.values.size());
    result.extract_subvector_to(forces.dofs.begin(), forces.dofs.end(), moved.begin());
    forces.tangent.vmult(change.values, moved);
    result.grow_or_shrink(n_coordinates());
    for (unsigned int i = 0; i < layout.levers; ++i)
    {
      const auto strain_part = finite->correction(lever_displacement(residual.values, i), on_surface(change, i));
      std::copy(strain_part.begin(), strain_part.end(), result.begin() + first_body_coordinate(i));
    }
    return result;
  }

  std::vector<double> SolidStructure::sensor_forces(const unsigned int lever, const Vector<double> &coordinates,
                                                    const DofLoads &forces) const
  {
    return finite ? body.sensor_forces(lever_displacement(coordinates, lever)) : sensors(on_surface(forces, lever));
  }

  double SolidStructure::displacement(const unsigned int lever, const DofLoads &shares, const Vector<double> &coordinates,
                                      const DofLoads &forces) const
  {
    const auto acting = on_surface(forces, lever);
    if (acting.dofs.empty() || shares.dofs.empty())
      return 0.;
    if (!finite)
      return shares.values * compliance->displacements(shares.dofs, acting);
    double sum = 0.;
    for (unsigned int i = 0; i < shares.dofs.size(); ++i)
      sum += shares.values[i] * coordinates[first_body_coordinate(lever) + surface[shares.dofs[i]]];
    return sum;
  }

  std::vector<BodyDisplacements> SolidStructure::body_displacements(const std::vector<StaticState> &states) const
  {
    if (!finite)
      return by_states(body.respond(body_loads(body, on_levers(states))), body.n_dofs());
    return find_displacements(states, layout.levers,
                              [&](const unsigned int lever, const Vector<double> &at) { return lever_displacement(at, lever); });
  }

  std::vector<FaceSample> SolidStructure::samples(const Vector<double> &coordinates, const DofLoads &forces) const
  {
    std::vector<FaceSample> result;
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
    {
      result.push_back({ on_surface(forces, lever), {} });
      auto &[acting, displacements] = result.back();
      displacements.reinit(static_cast<unsigned int>(acting.dofs.size()));
      for (unsigned int i = 0; i < displacements.size(); ++i)
        displacements[i] = coordinates[layout.first(lever) + acting.dofs[i]];
    }
    return result;
  }

  SolidStructure::Exactness SolidStructure::exactness(const std::vector<FaceSample> &samples) const
  {
    const auto whole_responses = body.respond(body_loads(body, mapped(samples, &FaceSample::first)));

    Exactness result{};
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      const auto &[acting, displacements] = samples[k];
      double difference = 0., largest = 0., missed = 0., work = 0.;
      for (unsigned int i = 0; i < acting.dofs.size(); ++i)
      {
        const double exact = whole_responses[k * body.n_dofs() + surface[acting.dofs[i]]];
        difference         = std::max(difference, std::abs(exact - displacements[i]));
        largest            = std::max(largest, std::abs(exact));
        missed += (exact - displacements[i]) * acting.values[i];
        work += exact * acting.values[i];
      }
      result.displacement = std::max(result.displacement, largest > 0. ? difference / largest : 0.);
      result.work         = std::max(result.work, work > 0. ? std::abs(missed) / work : 0.);
    }
    return result;
  }
} // namespace sprag
