#include "model/reduced_lever.h"

#include "model/dynamic_lever.h"
#include "model/mirrored_contact.h"
#include "model/mirrored_modes.h"
#include "model/point_contact.h"
#include "scene/contact_reference.h"
#include "scene/mirrored_pair.h"

namespace sprag
{
  namespace
  {
    ModalData modes_of(const Scene &scene, const BeamMesh &mesh)
    {
      const auto lever = beam_modes(scene, mesh);
      return number_of_levers(scene) == 1 ? lever : mirrored_modes(lever, beam_modes(swinging_scene(scene), mesh));
    }

    std::unique_ptr<PointContact> contact_of(const Scene &scene, const BeamMesh &mesh, PortLayout ports, const unsigned int lever)
    {
      const auto reference = contact_reference(scene);
      const Scene own      = scene_of_lever(scene, lever);
      ports.levers         = 1;
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
    const BeamMesh mesh    = { scene.analysis.model == ModelType::beam ? elements : 0, scene.lever.length };
    auto structure         = std::make_unique<ModalStructure>(modes_of(scene, mesh));
    const PortLayout ports = structure->ports();

    LeverFrame frame = lever_frame(scene, ports, carried_mass(scene));
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
      for (unsigned int slope = 1; slope < mesh.ports(); slope += 2)
        frame.lengths[ports.first(lever) + slope] = mesh.element_length();
    auto contact = contact_of(scene, mesh, ports, 0);
    if (ports.levers == 1)
      return std::make_unique<DynamicLever<ModalStructure, PointContact>>(std::move(structure), std::move(contact),
                                                                          std::move(frame));
    using Pair = MirroredContact<PointContact>;
    std::array<std::unique_ptr<PointContact>, 2> contacts{ { std::move(contact), contact_of(scene, mesh, ports, 1) } };
    return std::make_unique<DynamicLever<ModalStructure, Pair>>(
        std::move(structure), std::make_unique<Pair>(std::move(contacts), ports, 1), std::move(frame));
  }
} // namespace sprag
