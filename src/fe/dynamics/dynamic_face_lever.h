// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact.h"
#include "fe/dynamics/condensed_basis.h"
#include "fe/dynamics/sparse_structure.h"
#include "model/step/dynamic_model.h"

#include <functional>
#include <memory>

namespace sprag
{
  struct Device;

  /// The masses of a scene's meshed lever.
  LeverInertia lever_inertia(const Device &device);

  /// A meshed lever in time, and its numbers for /meta.
  struct MeshedDynamics : MassSums
  {
    std::shared_ptr<const FrictionFace<3>> face; ///< in space, of the contact
    std::unique_ptr<DynamicModel> model;

    /// In space, turns the shape of a mode at the interface into that along an edge of the whole face.
    std::function<void(const Eigenmode &, ModeShape &)> follow_edge;

    /// Elastic displacement of all degrees of freedom of the body in the axes of a lever, 0 or of a pair 1 [mm]; the model must
    /// live.
    std::function<dealii::Vector<double>(const Motion &, unsigned int lever)> elastic_displacement;

    unsigned int n_coordinates = 0;
    std::vector<double> frequencies; ///< of the lever on its spring out of contact [Hz]
    ContactPenalties penalties{};

    // Condensed only.
    bool basis_from_cache    = false;
    double basis_cpu_seconds = 0.; ///< that the basis took, or saved if it comes from the cache
    std::string message;           ///< why the basis was not stored; empty if it was
  };

  /// The part of a meshed lever with all degrees of freedom that friction, damping and drive leave as it is: models of one body
  /// share it.
  struct FiniteElementBasis
  {
    std::shared_ptr<const InertialMatrices> matrices;
    LeverModes modes;
    std::shared_ptr<const FiniteElementBasis> swinging; ///< of a pair's levers that swing together, where it is another
  };

  /// The part of a condensed lever that models of one body share.
  struct CondensedBases
  {
    std::shared_ptr<const CondensedBasis> lever;
    std::shared_ptr<const CondensedBasis> swinging;
  };

  /// J about the pivot of all that turns with the hub, by the mesh [t mm^2].
  double mesh_inertia(const Device &device, const ElasticBody<2> &body);

  FiniteElementBasis make_finite_element_basis(const Device &device, const ElasticBody<2> &body);

  /// Takes the bases from the device's cache if they are there. If not, makes them and, if `store`, stores them there. `key`: see
  /// body_key().
  CondensedBases make_condensed_basis(const Device &device, const std::string &key, const ElasticBody<2> &body, bool store);

  /// All degrees of freedom. `relaxation`: damping over stiffness of the friction layer [s]. The body must outlive the model.
  MeshedDynamics make_finite_element_dynamics(const Device &device, const ElasticBody<2> &body, const FiniteElementBasis &basis,
                                              double relaxation);

  /// Modes and static face shapes, see CondensedBasis.
  MeshedDynamics make_condensed_dynamics(const Device &device, const ElasticBody<2> &body, const CondensedBases &bases,
                                         double relaxation);
} // namespace sprag
