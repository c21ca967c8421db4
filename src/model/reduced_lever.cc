#include "model/reduced_lever.h"

#include "model/dynamic_lever.h"
#include "model/point_contact.h"
#include "scene/contact_reference.h"

#include <cmath>

namespace sprag
{
  std::unique_ptr<DynamicModel> make_reduced_lever(const Scene &scene, const unsigned int elements)
  {
    const BeamMesh mesh  = { scene.analysis.model == ModelType::beam ? elements : 0, scene.lever.length };
    const auto reference = contact_reference(scene);
    auto structure       = std::make_unique<ModalStructure>(beam_modes(scene, mesh));

    PointContactProperties properties;
    properties.geometry            = scene.geometry;
    properties.mesh                = mesh;
    properties.ports               = structure->ports();
    properties.rest_inclination    = kinematics(scene.geometry, 0.).theta;
    properties.neutral_axis_offset = neutral_axis_offset(scene);
    properties.normal              = { scene.contact.stiffness, scene.contact.exponent };
    properties.damping             = reference.relaxation * reference.stiffness;
    properties.tangential          = reference.tangential;
    properties.friction            = scene.friction;

    LeverFrame frame = lever_frame(scene, structure->ports(), carried_mass(scene));
    for (unsigned int slope = 1; slope < mesh.ports(); slope += 2)
      frame.lengths[slope] = mesh.element_length();
    return std::make_unique<DynamicLever<ModalStructure, PointContact>>(
        std::move(structure), std::make_unique<PointContact>(properties), std::move(frame));
  }
} // namespace sprag
