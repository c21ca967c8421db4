// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/solid_dynamics.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"
#include "fe/body/friction_face.h"
#include "fe/dynamics/complete_dynamics.h"
#include "fe/dynamics/condensed_basis.h"
#include "scene/device.h"
#include "scene/lever_shape.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sprag
{
  using namespace dealii;
  using dealii::Vector;

  namespace
  {
    /// Returns a displacement of one lever, see MirroredStructure.
    double lever_displacement(const std::vector<const LeverModes *> &structures, const Vector<double> &coordinates,
                              const unsigned int index, const unsigned int dof)
    {
      const auto n  = static_cast<unsigned int>(coordinates.size() / structures.size());
      double result = 0.;
      for (unsigned int part = 0; part < structures.size(); ++part)
      {
        const auto &displacements = structures[part]->displacements;
        const double sign         = part == 1 && index == 1 ? -1. : 1.;
        for (unsigned int j = 0; j < std::min<std::size_t>(n, displacements.size()); ++j)
          result += sign * coordinates[part * n + j] * displacements[j][dof];
      }
      return structures.size() == 2 ? MirroredInterface::share() * result : result;
    }

    /// Sets the shape along an edge of the whole face, by the modes of the free lever. What these leave out is the dent of the
    /// layer under the cylinder.
    void follow_edge(const FrictionFace<3> &face, const std::vector<const LeverModes *> &structures, const Eigenmode &mode,
                     ModeShape &shape)
    {
      const auto nodes = lines_along(face).back();
      shape.xi         = mapped(nodes, [&](const unsigned int node) { return face.nodes[node].position[0]; });
      for (unsigned int index = 0; index < structures.size(); ++index)
        for (unsigned int i = 0; i < 2; ++i)
        {
          const auto moved = [&](const unsigned int d)
          {
            const auto displacement = [&](const unsigned int node)
            { return lever_displacement(structures, mode.mode.coordinates[i], index, face.nodes[node].dofs[d]); };
            return mapped(nodes, displacement);
          };
          auto &lever       = shape.levers.at(index);
          lever.along[i]    = moved(0);
          lever.across[i]   = moved(1);
          lever.sideways[i] = moved(2);
        }
    }

    /// A part of a friction face in three dimensions as a face of its own.
    struct FacePart
    {
      FrictionFace<3> face;
      unsigned int first_node; ///< number of its first node in the whole face; the others follow
    };

    /// Returns the part whose elements reach into `begin` ... `end` along xi [mm]. Nodes increase along xi. Throws
    /// AnalysisError where there is no such element.
    FacePart cut_face(const FrictionFace<3> &face, const double begin, const double end)
    {
      std::vector<std::size_t> chosen;
      auto first = static_cast<unsigned int>(face.nodes.size()), last = 0u;
      for (std::size_t i = 0; i < face.edges.size(); ++i)
        if (const auto &nodes = face.edges[i].nodes; nodes.back().position[0] > begin && nodes.front().position[0] < end)
        {
          chosen.push_back(i);
          for (const auto &node : nodes)
            if (node.index != FaceEdge<3>::held)
            {
              first = std::min(first, node.index);
              last  = std::max(last, node.index + 1);
            }
        }
      if (first >= last)
        throw AnalysisError("the friction face ends before the contact at xi = " + mm(0.5 * (begin + end)));

      FacePart result{ {}, first };
      auto &part         = result.face;
      part.young_modulus = face.young_modulus;
      part.depth         = face.depth;
      part.nodes.assign(face.nodes.begin() + first, face.nodes.begin() + last);
      for (const std::size_t i : chosen)
      {
        const auto &element = face.elements[i];
        const auto from     = static_cast<unsigned int>(part.points.size());
        part.points.insert(part.points.end(), face.points.begin() + element.begin, face.points.begin() + element.end);
        auto &added = part.elements.emplace_back(element);
        added.begin = from;
        added.end   = static_cast<unsigned int>(part.points.size());
        for (unsigned int a = 0; a < added.n_nodes; ++a)
          added.nodes[a] -= first;
        auto &edge = part.edges.emplace_back(face.edges[i]);
        for (auto &node : edge.nodes)
          if (node.index != FaceEdge<3>::held)
            node.index -= first;
      }
      return result;
    }

    DofSelection part_dofs(const FacePart &face_part)
    {
      DofSelection result(3 * face_part.face.nodes.size());
      std::iota(result.begin(), result.end(), 3 * face_part.first_node);
      return result;
    }

    /// Returns the layout of the part of the face, the sensors, the cylinder's axis, the hub and its momentum.
    InterfaceLayout make_layout(const FacePart &face_part, const SolidInTime &lever, const Device &device)
    {
      InterfaceLayout result{ static_cast<unsigned int>(3 * face_part.face.nodes.size()), true, lever.sensors->number() };
      result.slopes = count_slopes(*lever.body, device.cylinder);
      return result;
    }

  } // namespace

  std::vector<const LeverModes *> structure_modes(const SolidInTime &lever, const unsigned int levers)
  {
    if (levers == 1)
      return { &lever.modes };
    return { &lever.modes, lever.swinging ? &*lever.swinging : &lever.modes };
  }

  SolidInTime make_solid_in_time(const Device &device, const Mesh &plane)
  {
    SolidInTime result;
    result.body                         = std::make_unique<const SolidBody>(device, plane);
    constexpr double spacing_over_depth = 0.5; // ringing adds up what the compliance leaves out
    const auto [first, last]            = contact_surroundings(device);
    result.compliance                   = std::make_unique<LayeredCompliance>(*result.body, first, last, spacing_over_depth);
    result.sensors                      = std::make_unique<const SensorForces>(*result.body, make_response(*result.body));
    const auto modes                    = [&](const Device &single)
    {
      return lever_modes(*result.body, make_response(*result.body), lever_inertia(single), single.spring.stiffness,
                         single.condensed.modes);
    };
    result.modes = modes(device);
    if (swings_otherwise(device))
      result.swinging = modes(swinging_device(device));
    return result;
  }

  MeshedDynamics make_solid_dynamics(const Device &device, const SolidInTime &lever, const std::array<double, 2> &contact_range,
                                     const double relaxation, const unsigned int n_modes)
  {
    const auto face_part =
        std::make_shared<const FacePart>(cut_face(lever.body->friction_face(), contact_range[0], contact_range[1]));
    const auto &face      = face_part->face;
    const auto levers     = count_levers(device);
    const auto structures = structure_modes(lever, levers);
    const auto structure  = [&](const unsigned int part)
    {
      const auto basis = basis_on(make_layout(*face_part, lever, device), *structures[part], face_dofs(face),
                                  lever.compliance->among(part_dofs(*face_part)), *lever.sensors, 3 * face_part->first_node,
                                  device.cylinder.slope_compliances(), device.spring.stiffness);
      return std::make_unique<ModalStructure>(
          modal_data(truncated(basis, n_modes), make_lever_dynamics(device, relaxation, basis.total_mass)));
    };
    const auto displacement = [&lever, structures, dofs = face_dofs(face)](const unsigned int part, const Motion &motion)
    { return condensed_displacement(lever.body->held(), *structures[part], dofs, make_response(*lever.body), motion); };
    MeshedDynamics result;
    static_cast<MassSums &>(result) = lever.modes;
    result.n_coordinates            = levers * n_modes + (device.support.type == SupportType::sprung ? 1 : 0);
    result.penalties                = penalties_in_time(device, *lever.body);
    result.face                     = std::shared_ptr<const FrictionFace<3>>(face_part, &face);
    result.follow_edge              = [&lever, structures](const Eigenmode &mode, ModeShape &shape)
    { follow_edge(lever.body->friction_face(), structures, mode, shape); };
    complete_dynamics(device, *lever.body, face, !lever.swinging, structure, displacement, result);
    return result;
  }

  FrictionFace<3> candidate_face(const std::array<double, 2> &contact_range, const SolidBody &body)
  {
    return cut_face(body.friction_face(), contact_range[0], contact_range[1]).face;
  }
} // namespace sprag
