#include "fe/dynamic_face_lever.h"

#include "fe/lever_model.h"
#include "model/dynamic_lever.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    LeverInertia inertia_of(const Scene &scene)
    {
      const Lever &lever                                     = scene.lever;
      std::map<dealii::types::material_id, double> densities = { { material_id::lever, lever.density },
                                                                 { material_id::web, lever.density },
                                                                 { material_id::plate, scene.plate.density },
                                                                 { material_id::layer, scene.layer.density } };
      if (scene.cylinder.type != CylinderType::rigid)
        densities[material_id::cylinder] = scene.cylinder.density;
      return { densities, lever.tip_mass, lever.moment_of_inertia, lever.inertia, lever.hub_inertia, scene.spring.behaviour };
    }

    BasisSettings basis_settings(const Scene &scene)
    {
      return { scene.condensed.modes, scene.spring.stiffness, inertia_of(scene), scene.condensed.cache };
    }

    LeverDynamics constants_of(const Scene &scene, const double relaxation, const double lever_mass)
    {
      LeverDynamics result;
      result.spring_stiffness  = scene.spring.stiffness;
      result.mass_damping      = scene.lever.mass_damping;
      result.stiffness_damping = scene.lever.stiffness_damping;
      result.relaxation        = relaxation;
      result.modal_damping     = scene.lever.modal_damping;
      result.sprung            = scene.support.type == SupportType::sprung;
      result.support_mass      = scene.support.mass + lever_mass;
      result.support_stiffness = scene.support.stiffness;
      result.support_damping   = support_damping(scene.support, lever_mass);
      return result;
    }

    FaceStepProperties contact_of(const Scene &scene, const PortLayout &ports, const ContactPenalties &penalties)
    {
      return { scene.geometry, ports, kinematics(scene.geometry, 0.).theta, penalties, scene.friction, scene.layer.thickness };
    }

    MeshedDynamics facts(const Scene &scene, const ElasticBody<2> &body, const std::vector<double> &omega_squared)
    {
      MeshedDynamics result;
      result.penalties = contact_penalties(body, scene.contact, scene.layer.thickness);
      for (const double stiffness : omega_squared)
        result.frequencies.push_back(0.5 * std::sqrt(stiffness) / M_PI);
      return result;
    }

    template <class Contact, class Structure>
    std::unique_ptr<DynamicModel> assemble_with(const Scene &scene, const ElasticBody<2> &body,
                                                std::unique_ptr<Structure> structure, const MeshedDynamics &facts)
    {
      const PortLayout ports = structure->ports();
      return std::make_unique<DynamicLever<Structure, Contact>>(
          std::move(structure), std::make_unique<Contact>(body, contact_of(scene, ports, facts.penalties)),
          lever_frame(scene, ports, facts.lever_mass));
    }

    template <class Structure>
    std::unique_ptr<DynamicModel> assemble(const Scene &scene, const ElasticBody<2> &body, std::unique_ptr<Structure> structure,
                                           const MeshedDynamics &facts)
    {
      const bool rigid = body.cylinder_face().patches.empty();
      return rigid ? assemble_with<FaceStepContact>(scene, body, std::move(structure), facts)
                   : assemble_with<PairStepContact>(scene, body, std::move(structure), facts);
    }
  } // namespace

  double mesh_inertia(const Scene &scene, const ElasticBody<2> &body)
  {
    return InertialMatrices<2>(body, inertia_of(scene)).moment_of_inertia;
  }

  FiniteElementBasis make_finite_element_basis(const Scene &scene, const ElasticBody<2> &body)
  {
    const auto matrices = std::make_shared<InertialMatrices<2>>(body, inertia_of(scene));
    dealii::PETScWrappers::SparseMatrix stiffness;
    matrices->sum({ 0., 1., 0., scene.spring.stiffness }, stiffness);
    return { matrices, free_modes(stiffness, matrices->mass, scene.condensed.modes) };
  }

  std::shared_ptr<const CondensedBasis> make_condensed_basis(const Scene &scene, const ElasticBody<2> &body, const bool store)
  {
    const auto settings = basis_settings(scene);
    return std::make_shared<const CondensedBasis>(store ? condensed_basis(body, settings) : make_basis(body, settings));
  }

  MeshedDynamics make_finite_element_dynamics(const Scene &scene, const ElasticBody<2> &body, const FiniteElementBasis &basis,
                                              const double relaxation)
  {
    const auto &matrices = *basis.matrices;
    const auto constants = constants_of(scene, relaxation, matrices.total_mass);
    auto structure       = std::make_unique<SparseStructure>(body, basis.matrices, basis.modes, constants);

    MeshedDynamics result       = facts(scene, body, basis.modes.stiffness);
    result.n_coordinates        = matrices.coordinates.size();
    result.density_factor       = matrices.density_factor;
    result.lever_mass           = matrices.total_mass;
    result.moment_of_inertia    = matrices.moment_of_inertia;
    result.elastic_displacement = [lever = structure.get()](const Motion &motion) { return lever->elastic_displacement(motion); };
    result.model                = assemble(scene, body, std::move(structure), result);
    return result;
  }

  MeshedDynamics make_condensed_dynamics(const Scene &scene, const ElasticBody<2> &body,
                                         const std::shared_ptr<const CondensedBasis> &basis, const double relaxation)
  {
    auto structure = std::make_unique<ModalStructure>(modal_data(*basis, constants_of(scene, relaxation, basis->lever_mass)));

    MeshedDynamics result    = facts(scene, body, basis->stiffness);
    result.n_coordinates     = structure->n_modes();
    result.density_factor    = basis->density_factor;
    result.lever_mass        = basis->lever_mass;
    result.moment_of_inertia = basis->moment_of_inertia;
    result.basis_from_cache  = basis->from_cache;
    result.basis_cpu_seconds = basis->cpu_seconds;
    result.message           = basis->message;
    // Made when the first field is wanted.
    result.elastic_displacement = [&body, settings = basis_settings(scene), basis,
                                   made = std::shared_ptr<CondensedDisplacement>()](const Motion &motion) mutable
    {
      if (!made)
        made = std::make_shared<CondensedDisplacement>(body, settings, *basis);
      return (*made)(motion);
    };
    result.model = assemble(scene, body, std::move(structure), result);
    return result;
  }
} // namespace sprag
