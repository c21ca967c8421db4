// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/lever_modes.h"
#include "fe/dynamics/sparse_structure.h"
#include "fe/statics/sensor_forces.h"
#include "model/structure/modal_structure.h"

#include <string>

namespace sprag
{
  /// The lowest vibration modes phi_i (mass 1) of the free lever on its spring, and the residual compliance of all others,
  ///   G - sum phi_i phi_i^T / omega_i^2   (MacNeal 1971, Rubin 1975),
  /// with the static compliance G: static deflections are those of the finite elements.
  struct CondensedBasis : ModeShapes, MassSums
  {
    dealii::FullMatrix<double> shapes;          ///< a row a dof, momentum included and support not; a column a mode
    dealii::FullMatrix<double> layer_stiffness; ///< of the friction layer, in the modes
    dealii::FullMatrix<double> face_compliance; ///< residual, of face, sensors, slopes and rotation [mm/N]
    InterfaceLayout layout;                     ///< of these, without the support
    double cpu_seconds = 0.;                    ///< that it took to make
    bool from_cache    = false;
    std::string message; ///< why it was not stored, empty if it was
  };

  /// Returns the basis of modes on the dofs of a layout, without displacements. `surface`: the body's degrees of freedom of the
  /// layout's surface, which begin at `surface_begin` of all on the surface. `face_matrix`: their static compliance with the hub
  /// held [mm/N].
  CondensedBasis basis_on(const InterfaceLayout &layout, const LeverModes &modes, const std::vector<unsigned int> &surface,
                          const dealii::FullMatrix<double> &face_matrix, const SensorForces &sensors, unsigned int surface_begin,
                          const std::array<double, 2> &slope_compliances, double spring_stiffness);

  /// Number of modes, masses and cache of a condensed basis.
  struct BasisSettings
  {
    unsigned int modes      = 1;
    double spring_stiffness = 0.; ///< [N mm/rad], > 0
    LeverInertia inertia;
    std::string cache;  ///< folder; empty: the user's
    std::string origin; ///< what the basis is made for, see body_key(): part of its name in the cache
  };

  /// Looks for the basis in the cache, else makes and stores it.
  CondensedBasis condensed_basis(const ElasticBody<2> &body, const BasisSettings &settings);

  /// Makes the basis without a cache.
  CondensedBasis make_basis(const ElasticBody<2> &body, const BasisSettings &settings);

  /// Returns the basis with the lowest `modes` >= 1 modes; the static compliance of the others joins the residual compliance.
  CondensedBasis truncated(CondensedBasis basis, unsigned int modes);

  /// The basis as the modes of a structure, with damping and support.
  ModalData modal_data(const CondensedBasis &basis, const LeverDynamics &constants);

  /// Returns the elastic displacement of all degrees of freedom of a body in a motion of a condensed lever, by its modes and the
  /// answer to forces on its surface, whose degrees of freedom are `surface` [mm]. `held`: those of the body.
  dealii::Vector<double> condensed_displacement(const dealii::AffineConstraints<double> &held, const ModeShapes &modes,
                                                const std::vector<unsigned int> &surface, const Response &response,
                                                const Motion &motion);

  /// Returns the answer of a body in a plane by its factors.
  Response make_response(const ElasticBody<2> &body);
} // namespace sprag
