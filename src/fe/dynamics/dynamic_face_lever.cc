// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/dynamic_face_lever.h"

#include "fe/dynamics/complete_dynamics.h"
#include "scene/device.h"

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
    const std::array<const FiniteElementBasis *, 2> parts{ { &basis, basis.swinging ? basis.swinging.get() : &basis } };
    const auto structure = [&](const unsigned int part)
    { return std::make_unique<SparseStructure>(body, parts[part]->matrices, parts[part]->modes, constants); };
    const auto displacement =
        [both = std::array{ parts[0]->matrices, parts[1]->matrices }](const unsigned int part, const Motion &motion)
    { return both[part]->coordinates.elastic_displacement(motion.coordinates.position); };
    MeshedDynamics result = facts(device, body, basis.modes.stiffness, matrices);
    result.n_coordinates  = count_levers(device) * matrices.coordinates.size();
    complete_dynamics(device, body, body.friction_face(), !basis.swinging, structure, displacement, result);
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
    complete_dynamics(device, body, body.friction_face(), !bases.swinging, structure, displacement, result);
    return result;
  }
} // namespace sprag
