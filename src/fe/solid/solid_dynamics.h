#pragma once

#include "fe/contact/face_contact_point.h"
#include "fe/solid/layered_compliance.h"
#include "fe/solid/sensor_forces.h"
#include "fe/solid/solid_modes.h"
#include "model/dynamic_model.h"

#include <functional>
#include <memory>

namespace sprag
{
  /// A lever in three dimensions at rest, to be shared by models that differ in friction, damping, drive and contact.
  struct SolidInTime
  {
    std::unique_ptr<const SolidBody> body;
    std::unique_ptr<LayeredCompliance> compliance; ///< remembers what it found
    std::unique_ptr<const SensorForces> sensors;
    SolidModes modes;
  };

  /// Makes body, compliance and the scene's number of modes from the plane mesh. Throws AnalysisError if a factorisation fails.
  SolidInTime make_solid_in_time(const Scene &scene, const Mesh &plane);

  /// The condensed model of a scene: the lowest `n_modes` of the lever's modes, and the static answer of the part of the face
  /// that the contact can reach. `relaxation`: damping over stiffness of the friction layer [s]. The lever must outlive it.
  std::unique_ptr<DynamicModel> make_solid_dynamics(const Scene &scene, const SolidInTime &lever, double relaxation,
                                                    unsigned int n_modes);

  /// Returns the penalties that this model has.
  ContactPenalties penalties_in_time(const Scene &scene, const FrictionFace<3> &face);

  /// Returns the part of the face that this model looks at: where the contact may come.
  FrictionFace<3> reached_face(const Scene &scene, const SolidBody &body);

  /// Returns what finds the elastic displacement of all degrees of freedom of the body in a motion of that model: modes, and the
  /// static answer of the face by a back-substitution with the whole body [mm]. The lever must outlive it.
  std::function<dealii::Vector<double>(const Motion &, unsigned int)> solid_displacement(const Scene &scene,
                                                                                         const SolidInTime &lever);
} // namespace sprag
