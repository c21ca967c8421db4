// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/dynamic_face_lever.h"
#include "fe/statics/contact_penalties.h"
#include "model/lever/assemble_lever.h"
#include "model/structure/lever_frame.h"
#include "model/structure/mirrored_structure.h"
#include "scene/mirrored_pair.h"

#include <memory>
#include <utility>
#include <vector>

namespace sprag
{
  /// Completes the model of a lever or a pair. `structure(part)` and `displacement(part, motion)`: structure and elastic
  /// displacement of the lever, or of the symmetric (0) and the antisymmetric (1) motions of a pair, whose structures may be
  /// `identical`. The contact is along a `face` of the body; both must outlive the model. `result` has its masses and penalties.
  template <int dim, class Body, class Structure, class Displacement>
  void complete_dynamics(const Device &device, const Body &body, const FrictionFace<dim> &face, const bool identical,
                         const Structure &structure, const Displacement &displacement, MeshedDynamics &result)
  {
    const auto assemble = [&](auto levers)
    {
      const InterfaceLayout layout = levers->layout();
      const auto properties        = all_lever_properties(device);
      const auto contact           = [&](const unsigned int lever)
      {
        return std::make_unique<FaceContact<dim>>(
            face, face_properties(body, properties[lever], layout.single_lever(), result.penalties), body.cylinder_face());
      };
      LeverFrame frame = lever_frame(device, layout, result.total_mass);
      if constexpr (dim == 3)
      {
        const auto sensors     = body.sensors();
        frame.sensor_stiffness = sensors.empty() ? 0. : sensors.front().stiffness;
        frame.observe_sensors  = [is_half = body.is_half()](const std::vector<double> &forces, Row &row)
        { observe_sensors(forces, is_half, row); };
      }
      result.model = assemble_lever(std::move(levers), std::move(frame), contact, static_cast<unsigned int>(face.points.size()));
    };
    if (count_levers(device) == 1)
    {
      result.elastic_displacement = [displacement](const Motion &motion, unsigned int) { return displacement(0, motion); };
      return assemble(structure(0));
    }
    using Lever                 = typename decltype(structure(0))::element_type;
    auto pair                   = std::make_unique<MirroredStructure<Lever>>(structure(0), structure(1), identical);
    result.elastic_displacement = [lever_structure = pair.get(), displacement](const Motion &motion, const unsigned int lever)
    {
      return lever_structure->lever_vector(
          motion, lever, [&](const unsigned int part, const Motion &part_motion) { return displacement(part, part_motion); });
    };
    assemble(std::move(pair));
  }
} // namespace sprag
