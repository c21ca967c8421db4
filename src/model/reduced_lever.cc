// SPDX-License-Identifier: GPL-3.0-only
#include "model/reduced_lever.h"

#include "model/assemble_lever.h"
#include "model/point_contact.h"
#include "scene/contact_reference.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

namespace sprag
{
  namespace
  {
    std::unique_ptr<PointContact> contact_of(const Scene &scene, const BeamMesh &mesh, const PortLayout &ports,
                                             const unsigned int lever)
    {
      const auto reference = contact_reference(scene);
      const Scene own      = scene_of_lever(scene, lever);
      PointContactProperties properties;
      properties.geometry            = own.geometry;
      properties.mesh                = mesh;
      properties.ports               = ports;
      properties.rest_inclination    = rest_inclination(scene);
      properties.neutral_axis_offset = neutral_axis_offset(scene);
      properties.normal              = { scene.contact.stiffness, scene.contact.exponent };
      properties.damping             = reference.relaxation * reference.stiffness;
      properties.tangential          = reference.tangential;
      properties.friction            = own.friction;
      return std::make_unique<PointContact>(properties);
    }
  } // namespace

  std::unique_ptr<DynamicModel> make_reduced_lever(const Scene &scene, const unsigned int elements)
  {
    const BeamMesh mesh  = { scene.analysis.model == ModelType::beam ? elements : 0, scene.lever.length };
    const auto assembled = [&](auto structure)
    {
      const PortLayout ports = structure->ports();
      LeverFrame frame       = lever_frame(scene, ports, carried_mass(scene));
      for (unsigned int lever = 0; lever < ports.levers; ++lever)
        for (unsigned int slope = 1; slope < mesh.ports(); slope += 2)
          frame.lengths[ports.first(lever) + slope] = mesh.element_length();
      const auto contact = [&](const unsigned int lever) { return contact_of(scene, mesh, ports.of_one_lever(), lever); };
      return assemble_lever(std::move(structure), std::move(frame), contact, 1);
    };
    const auto of_lever = [&](const Scene &of) { return std::make_unique<ModalStructure>(beam_modes(of, mesh)); };
    if (number_of_levers(scene) == 1)
      return assembled(of_lever(scene));
    return assembled(std::make_unique<MirroredStructure<ModalStructure>>(of_lever(scene), of_lever(swinging_scene(scene)),
                                                                         !swings_otherwise(scene)));
  }
} // namespace sprag
