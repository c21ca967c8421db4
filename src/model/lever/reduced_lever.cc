// SPDX-License-Identifier: GPL-3.0-only
#include "model/lever/reduced_lever.h"

#include "model/contact/point_contact.h"
#include "model/lever/assemble_lever.h"
#include "scene/contact_estimates.h"
#include "scene/device.h"
#include "scene/lever_inertia.h"
#include "scene/mirrored_pair.h"

namespace sprag
{
  namespace
  {
    std::unique_ptr<PointContact> make_contact(const Device &device, const BeamMesh &mesh, const InterfaceLayout &layout,
                                               const unsigned int lever)
    {
      const Device own     = lever_device(device, lever);
      Device first         = device; // to whose largest P the damping refers
      first.contact        = own.contact;
      const auto reference = contact_reference(first);
      PointContactProperties properties;
      properties.geometry            = own.geometry;
      properties.mesh                = mesh;
      properties.layout              = layout;
      properties.rest_inclination    = rest_inclination(device);
      properties.neutral_axis_offset = neutral_axis_offset(device);
      properties.normal              = { own.contact.stiffness, own.contact.exponent };
      properties.damping             = reference.relaxation * reference.stiffness;
      properties.tangential          = reference.tangential;
      properties.friction            = own.friction;
      return std::make_unique<PointContact>(properties);
    }
  } // namespace

  std::unique_ptr<DynamicModel> make_reduced_lever(const Device &device, const unsigned int elements)
  {
    const BeamMesh mesh  = { device.analysis.model == ModelType::beam ? elements : 0, device.lever.length };
    const auto assembled = [&](auto structure)
    {
      const InterfaceLayout layout = structure->layout();
      LeverFrame frame             = lever_frame(device, layout, carried_mass(device));
      for (unsigned int lever = 0; lever < layout.levers; ++lever)
        for (unsigned int slope = 1; slope < mesh.n_dofs(); slope += 2)
          frame.lengths[layout.first(lever) + slope] = mesh.element_length();
      const auto contact = [&](const unsigned int lever) { return make_contact(device, mesh, layout.single_lever(), lever); };
      return assemble_lever(std::move(structure), std::move(frame), contact, 1);
    };
    const auto make_modal = [&](const Device &single) { return std::make_unique<ModalStructure>(beam_modes(single, mesh)); };
    if (count_levers(device) == 1)
      return assembled(make_modal(device));
    return assembled(std::make_unique<MirroredStructure<ModalStructure>>(make_modal(device), make_modal(swinging_device(device)),
                                                                         !swings_otherwise(device)));
  }
} // namespace sprag
