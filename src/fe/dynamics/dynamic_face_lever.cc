// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/dynamic_face_lever.h"

#include "fe/statics/contact_penalties.h"
#include "model/lever/assemble_lever.h"
#include "model/structure/lever_frame.h"
#include "scene/device.h"
#include "scene/mirrored_pair.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    MeshedDynamics facts(const Device &device, const ElasticBody<2> &body, const std::vector<double> &omega_squared,
                         const MassSums &mass)
    {
      MeshedDynamics result;
      static_cast<MassSums &>(result) = mass;
      result.penalties                = penalties_in_time(device, body);
      for (const double stiffness : omega_squared)
        result.frequencies.push_back(0.5 * std::sqrt(stiffness) / M_PI);
      return result;
    }

    template <class Structure>
    std::unique_ptr<DynamicModel> assemble(const Device &device, const ElasticBody<2> &body, std::unique_ptr<Structure> structure,
                                           const MeshedDynamics &facts)
    {
      const InterfaceLayout layout = structure->layout();
      const auto levers            = all_lever_properties(device);
      const auto contact           = [&](const unsigned int lever)
      {
        return std::make_unique<FaceContact<2>>(body.friction_face(),
                                                face_properties(body, levers[lever], layout.single_lever(), facts.penalties),
                                                body.cylinder_face());
      };
      return assemble_lever(std::move(structure), lever_frame(device, layout, facts.total_mass), contact,
                            static_cast<unsigned int>(body.friction_face().points.size()));
    }
  } // namespace

  LeverInertia lever_inertia(const Device &device)
  {
    const Lever &lever                                     = device.lever;
    std::map<dealii::types::material_id, double> densities = { { material_id::lever, lever.density },
                                                               { material_id::web, lever.density },
                                                               { material_id::plate, device.plate.density },
                                                               { material_id::layer, device.layer.density } };
    if (device.cylinder.type != CylinderType::rigid)
      densities[material_id::cylinder] = device.cylinder.density;
    return { densities, lever.tip_mass, lever.moment_of_inertia, lever.inertia, lever.hub_inertia, device.spring.behaviour };
  }

  double mesh_inertia(const Device &device, const ElasticBody<2> &body)
  {
    return BodyMass<2>(body, lever_inertia(device)).moment_of_inertia;
  }

  FiniteElementBasis make_finite_element_basis(const Device &device, const ElasticBody<2> &body)
  {
    const auto inertia = lever_inertia(device);
    FiniteElementBasis basis{ std::make_shared<InertialMatrices>(body, inertia),
                              lever_modes(body, make_response(body), inertia, device.spring.stiffness, device.condensed.modes),
                              {} };
    if (swings_otherwise(device))
      basis.swinging = std::make_shared<const FiniteElementBasis>(make_finite_element_basis(swinging_device(device), body));
    return basis;
  }

  CondensedBases make_condensed_basis(const Device &device, const std::string &key, const ElasticBody<2> &body, const bool store)
  {
    const auto make = [&](const Device &own)
    {
      const BasisSettings settings{ own.condensed.modes, own.spring.stiffness, lever_inertia(own), own.condensed.cache, key };
      return std::make_shared<const CondensedBasis>(store ? condensed_basis(body, settings) : make_basis(body, settings));
    };
    CondensedBases bases{ make(device), {} };
    if (swings_otherwise(device))
      bases.swinging = make(swinging_device(device));
    return bases;
  }

  MeshedDynamics make_finite_element_dynamics(const Device &device, const ElasticBody<2> &body, const FiniteElementBasis &basis,
                                              const double relaxation)
  {
    const auto &matrices = *basis.matrices;
    const auto constants = make_lever_dynamics(device, relaxation, matrices.total_mass);
    const auto structure = [&](const FiniteElementBasis &element_basis)
    { return std::make_unique<SparseStructure>(body, element_basis.matrices, element_basis.modes, constants); };

    MeshedDynamics result = facts(device, body, basis.modes.stiffness, matrices);
    result.n_coordinates  = count_levers(device) * matrices.coordinates.size();
    const auto complete   = [&](auto lever)
    {
      result.elastic_displacement = [lever_structure = lever.get()](const Motion &motion, const unsigned int index)
      { return lever_structure->elastic_displacement(motion, index); };
      result.model = assemble(device, body, std::move(lever), result);
    };
    if (count_levers(device) == 1)
      complete(structure(basis));
    else
      complete(std::make_unique<MirroredStructure<SparseStructure>>(
          structure(basis), structure(basis.swinging ? *basis.swinging : basis), basis.swinging == nullptr));
    return result;
  }

  MeshedDynamics make_condensed_dynamics(const Device &device, const ElasticBody<2> &body, const CondensedBases &bases,
                                         const double relaxation)
  {
    const auto &basis = bases.lever;
    const std::array<std::shared_ptr<const CondensedBasis>, 2> parts{ { basis, bases.swinging ? bases.swinging : basis } };
    const auto constants = make_lever_dynamics(device, relaxation, basis->total_mass);

    MeshedDynamics result    = facts(device, body, basis->stiffness, *basis);
    result.n_coordinates     = count_levers(device) * static_cast<unsigned int>(basis->stiffness.size()) + constants.sprung;
    result.basis_from_cache  = basis->from_cache && parts[1]->from_cache;
    result.basis_cpu_seconds = basis->cpu_seconds + (bases.swinging ? bases.swinging->cpu_seconds : 0.);
    result.message           = basis->message;
    const auto structure     = [&](const unsigned int part)
    { return std::make_unique<ModalStructure>(modal_data(*parts[part], constants)); };
    const auto displacement =
        [&body, parts, response = std::make_shared<Response>()](const unsigned int part, const Motion &motion)
    {
      if (!*response) // the first field
        *response = make_response(body);
      return condensed_displacement(body.held(), *parts[part], surface_dofs(body), *response, motion);
    };
    complete_condensed(
        count_levers(device), !bases.swinging, structure, displacement,
        [&](auto lever) { return assemble(device, body, std::move(lever), result); }, result);
    return result;
  }
} // namespace sprag
