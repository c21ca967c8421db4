// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact_point.h"
#include "fe/dynamics/dynamic_face_lever.h"
#include "fe/statics/layered_compliance.h"
#include "fe/statics/sensor_forces.h"
#include "fe/statics/solid_body.h"

#include <memory>
#include <optional>

namespace sprag
{
  struct Device;

  /// A lever in three dimensions at rest, to be shared by models that differ in friction, damping, drive and contact. Both of a
  /// pair are alike.
  struct SolidInTime
  {
    std::unique_ptr<const SolidBody> body;
    std::unique_ptr<LayeredCompliance> compliance; ///< keeps the columns found
    std::unique_ptr<const SensorForces> sensors;
    LeverModes modes;
    std::optional<LeverModes> swinging; ///< of a pair's levers that swing together, where they are others
  };

  /// Returns the modes of each structure that such levers make: of a pair those of the symmetric motions, in which the levers
  /// mirror each other, and of the antisymmetric.
  std::vector<const LeverModes *> structure_modes(const SolidInTime &lever, unsigned int levers);

  /// Makes body, compliance and the scene's number of modes from the plane mesh. Throws AnalysisError if a factorisation fails.
  SolidInTime make_solid_in_time(const Device &device, const Mesh &plane);

  /// The condensed model of a scene, of a lever or both of its full pair: the lowest `n_modes` of a lever's modes, and the static
  /// answer of the part of the face where the contact may come, see contact_range(). Displacements are found by a
  /// back-substitution with the whole body. `relaxation`: damping over stiffness of the friction layer [s]. The lever must
  /// outlive it.
  MeshedDynamics make_solid_dynamics(const Device &device, const SolidInTime &lever, const std::array<double, 2> &contact_range,
                                     double relaxation, unsigned int n_modes);

  /// Returns the part of the face that this model looks at: where the contact may come.
  FrictionFace<3> candidate_face(const std::array<double, 2> &contact_range, const SolidBody &body);
} // namespace sprag
