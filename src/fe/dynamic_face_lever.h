#pragma once

#include "fe/face_step.h"
#include "model/dynamic_model.h"

#include <functional>
#include <memory>

namespace sprag
{
  /// A meshed lever in time, and what there is to tell about it.
  struct MeshedDynamics
  {
    std::unique_ptr<DynamicModel> model;

    /// Elastic displacement of all degrees of freedom of the body in lever axes [mm]; the model must live.
    std::function<dealii::Vector<double>(const Motion &)> elastic_displacement;

    unsigned int n_coordinates = 0;
    double density_factor      = 1.; ///< by which the densities were scaled to meet the moment of inertia
    double lever_mass          = 0.; ///< [t]
    std::vector<double> frequencies; ///< of the lever on its spring out of contact [Hz]
    ContactPenalties penalties{};

    // Condensed only.
    bool basis_from_cache    = false;
    double basis_cpu_seconds = 0.; ///< that the basis took, or saved if it comes from the cache
    std::string message;           ///< why the basis was not stored; empty if it was
  };

  /// All degrees of freedom. `relaxation`: damping over stiffness of the friction layer [s]. The body must outlive the model.
  MeshedDynamics make_finite_element_dynamics(const Scene &scene, const ElasticBody<2> &body, double relaxation);

  /// Modes and static face shapes, see CondensedBasis.
  MeshedDynamics make_condensed_dynamics(const Scene &scene, const ElasticBody<2> &body, double relaxation);
} // namespace sprag
