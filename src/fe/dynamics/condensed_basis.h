// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/algebra/free_modes.h"
#include "fe/dynamics/lever_ports.h"
#include "fe/dynamics/sparse_structure.h"
#include "model/modal_structure.h"

#include <string>

namespace sprag
{
  /// Vibration modes of the free lever on its spring, and static shapes for what the modes left out answer to forces on the face:
  /// a residual compliance (MacNeal 1971, Rubin 1975), so that static deflections are those of the finite elements.
  struct CondensedBasis
  {
    std::vector<double> stiffness;              ///< omega^2 of the modes [1/s^2]
    dealii::FullMatrix<double> shapes;          ///< a row a port, momentum included and support not; a column a mode
    dealii::FullMatrix<double> layer_stiffness; ///< of the friction layer, in the modes
    dealii::FullMatrix<double> face_compliance; ///< residual, of face, sensors, slopes and rotation [mm/N]
    unsigned int sensors = 0;
    unsigned int slopes  = 0;                     ///< of the cylinder's axis, which no mode moves
    dealii::FullMatrix<double> coordinate_shapes; ///< a row a mode, a column a total coordinate
    double density_factor    = 1.;
    double lever_mass        = 0.; ///< [t]
    double moment_of_inertia = 0.; ///< about the pivot [t mm^2]
    double cpu_seconds       = 0.; ///< that it took to make
    bool from_cache          = false;
    std::string message; ///< why it was not stored, empty if it was
  };

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

  /// Returns the basis that has only the lowest so many modes, at least one; what the others answer statically goes to the
  /// residual compliance, as if it had been made so.
  CondensedBasis truncated(CondensedBasis basis, unsigned int modes);

  /// The basis as the modes of a structure, with damping and support.
  ModalData modal_data(const CondensedBasis &basis, const LeverDynamics &constants);

  /// Elastic displacement of all degrees of freedom of a motion in a condensed basis.
  class CondensedDisplacement
  {
  public:
    /// All arguments must outlive it. Factorises the lever's stiffness.
    CondensedDisplacement(const ElasticBody<2> &body, const BasisSettings &settings, const CondensedBasis &basis);

    dealii::Vector<double> operator()(const Motion &motion) const;

  private:
    const CondensedBasis &basis;
    const InertialMatrices matrices;
    const LeverPorts ports;
    Mumps factors;
  };
} // namespace sprag
