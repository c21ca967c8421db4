// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/solid_dynamics.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/body/friction_face.h"
#include "fe/dynamics/condensed_basis.h"
#include "fe/dynamics/lever_constants.h"
#include "fe/solid/surface_contact.h"
#include "fe/statics/contact_penalties.h"
#include "fe/statics/lever_properties.h"
#include "model/dynamic_lever.h"
#include "model/mirrored_contact.h"
#include "model/mirrored_ports.h"
#include "model/mirrored_structure.h"
#include "scene/across.h"
#include "scene/device.h"
#include "scene/lever_shape.h"
#include "scene/mirrored_pair.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;
  using dealii::Vector;

  /// A condensed lever in three dimensions, or a pair of them, which tells shapes of modes along an edge of the whole face, by
  /// the modes of the free lever. What these leave out is the dent of the layer under the cylinder. Structure and Contact: see
  /// DynamicLever; `face` is that of the contact.
  template <class Structure, class Contact>
  class SolidDynamicLever : public DynamicLever<Structure, Contact>
  {
    using Base = DynamicLever<Structure, Contact>;

  public:
    /// `lever` must outlive this.
    SolidDynamicLever(std::unique_ptr<Structure> structure, std::unique_ptr<Contact> contact, LeverFrame frame,
                      const SolidInTime &lever_, std::shared_ptr<const FrictionFace<3>> face_)
        : Base(std::move(structure), std::move(contact), std::move(frame))
        , face(std::move(face_))
        , lever(lever_)
        , structures(modes_of_structures(lever, Structure::levers))
    {
    }

    ModeShape mode_shape(const Eigenmode &mode) const override
    {
      const auto nodes = nodes_of_edge();
      ModeShape result = Base::mode_shape(mode);
      result.xi.clear();
      for (const auto *node : nodes)
        result.xi.push_back(node->position[0]);
      for (unsigned int index = 0; index < Structure::levers; ++index)
        for (unsigned int i = 0; i < 2; ++i)
        {
          const auto moved = [&](const unsigned int d)
          {
            std::vector<double> values;
            for (const auto *node : nodes)
              values.push_back(moved_by(mode.mode.coordinates[i], index, node->dofs[d]));
            return values;
          };
          auto &shape       = result.levers.at(index);
          shape.along[i]    = moved(0);
          shape.across[i]   = moved(1);
          shape.sideways[i] = moved(2);
        }
      return result;
    }

  private:
    using Node = FaceNode<3>;

    const std::shared_ptr<const FrictionFace<3>> face;
    const SolidInTime &lever;
    const std::vector<const SolidModes *> structures;

    std::vector<const Node *> nodes_of_edge() const
    {
      const auto &nodes     = lever.body->friction_face().nodes;
      const auto is_farther = [](const Node &a, const Node &b) { return a.position[2] < b.position[2]; };
      const double edge     = std::max_element(nodes.begin(), nodes.end(), is_farther)->position[2];
      std::vector<const Node *> result;
      for (const auto &node : nodes)
        if (node.position[2] > edge - 1e-6)
          result.push_back(&node);
      return result;
    }

    /// Returns a displacement of one lever, see MirroredStructure.
    double moved_by(const dealii::Vector<double> &coordinates, const unsigned int index, const unsigned int dof) const
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
      return structures.size() == 2 ? MirroredPorts::share() * result : result;
    }
  };

  namespace
  {
    /// A part of a friction face in three dimensions as a face of its own.
    struct FaceWindow
    {
      FrictionFace<3> face;
      unsigned int first_node; ///< number of its first node in the whole face; the others follow
    };

    bool reaches_into(const FaceEdge<3> &edge, const double begin, const double end)
    {
      const auto is_before = [](const auto &a, const auto &b) { return a.position[0] < b.position[0]; };
      const auto ends      = std::minmax_element(edge.nodes.begin(), edge.nodes.end(), is_before);
      return ends.second->position[0] > begin && ends.first->position[0] < end;
    }

    /// Returns the part whose patches reach into `begin` ... `end` along xi [mm]. The face's nodes increase along xi. Throws
    /// AnalysisError where there is no such patch.
    FaceWindow window_of(const FrictionFace<3> &face, const double begin, const double end)
    {
      std::vector<std::size_t> chosen;
      auto first = static_cast<unsigned int>(face.nodes.size()), last = 0u;
      for (std::size_t i = 0; i < face.edges.size(); ++i)
        if (reaches_into(face.edges[i], begin, end))
        {
          chosen.push_back(i);
          for (const auto &node : face.edges[i].nodes)
            if (node.index != FaceEdge<3>::held)
            {
              first = std::min(first, node.index);
              last  = std::max(last, node.index + 1);
            }
        }
      if (first >= last)
        throw AnalysisError("the friction face ends before the contact at xi = " + mm(0.5 * (begin + end)));

      FaceWindow result{ {}, first };
      auto &part         = result.face;
      part.young_modulus = face.young_modulus;
      part.depth         = face.depth;
      part.nodes.assign(face.nodes.begin() + first, face.nodes.begin() + last);
      for (const std::size_t i : chosen)
      {
        const auto &patch = face.patches[i];
        const auto from   = static_cast<unsigned int>(part.points.size());
        for (unsigned int q = patch.begin; q < patch.end; ++q)
        {
          auto &point = part.points.emplace_back(face.points[q]);
          for (auto &node : point.nodes)
            node.first -= first;
        }
        part.patches.push_back({ from, static_cast<unsigned int>(part.points.size()), patch.length });
        auto &edge = part.edges.emplace_back(face.edges[i]);
        for (auto &node : edge.nodes)
          if (node.index != FaceEdge<3>::held)
            node.index -= first;
      }
      return result;
    }

    PortSelection ports_of(const FaceWindow &window)
    {
      PortSelection result(3 * window.face.nodes.size());
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = 3 * window.first_node + i;
      return result;
    }

    /// Layout of the ports of the window, the sensors, the cylinder's axis, the hub and its momentum.
    PortLayout layout_of(const FaceWindow &window, const SolidInTime &lever, const Device &device)
    {
      PortLayout result{ static_cast<unsigned int>(3 * window.face.nodes.size()), true, lever.sensors->number() };
      result.slopes = lever.body->is_half() || !device.cylinder.has_free_axis() ? 0 : 2;
      return result;
    }

    /// Shapes of the modes on these ports.
    FullMatrix<double> port_shapes(const SolidInTime &lever, const SolidModes &modes, const FaceWindow &window,
                                   const PortLayout &ports)
    {
      const auto &nodes = window.face.nodes;
      const auto m      = static_cast<unsigned int>(modes.stiffness.size());
      FullMatrix<double> result(ports.of_a_lever(), m);
      for (unsigned int j = 0; j < m; ++j)
      {
        for (unsigned int i = 0; i < ports.surface; ++i)
          result(i, j) = modes.displacements[j][nodes[i / 3].dofs[i % 3]];
        const auto compressions = lever.sensors->compressions(modes.displacements[j]);
        for (unsigned int i = 0; i < ports.sensors; ++i)
          result(ports.sensor(i), j) = compressions[i];
        result(ports.rotation(), j)     = modes.rotation[j];
        result(ports.momentum_eta(), j) = modes.momentum[j][1];
        result(ports.momentum_xi(), j)  = modes.momentum[j][0];
      }
      return result;
    }

    /// Static compliance of these ports up to the hub's rotation [mm/N].
    FullMatrix<double> port_compliance(const SolidInTime &lever, const FaceWindow &window, const PortLayout &ports,
                                       const Device &device)
    {
      FullMatrix<double> result(ports.rotation() + 1, ports.rotation() + 1);
      result.fill(*lever.compliance->among(ports_of(window)));
      const auto &of_sensors     = lever.sensors->compliance();
      const unsigned int in_face = 3 * window.first_node, of_face = static_cast<unsigned int>(of_sensors.n()) - ports.sensors;
      for (unsigned int s = 0; s < ports.sensors; ++s)
      {
        const unsigned int port = ports.sensor(s);
        for (unsigned int i = 0; i < ports.surface; ++i)
          result(port, i) = result(i, port) = of_sensors(s, in_face + i);
        for (unsigned int other = 0; other < ports.sensors; ++other)
          result(port, ports.sensor(other)) = of_sensors(s, of_face + other);
      }
      for (unsigned int i = 0; i < ports.slopes; ++i)
        result(ports.slope(i), ports.slope(i)) = slope_compliances(device.cylinder)[i];
      result(ports.rotation(), ports.rotation()) = 1. / device.spring.stiffness;
      return result;
    }

    /// The basis as of a lever in a plane whose face is the window.
    CondensedBasis basis_on(const FaceWindow &window, const SolidInTime &lever, const SolidModes &modes, const Device &device)
    {
      const auto ports = layout_of(window, lever, device);
      CondensedBasis result;
      result.sensors           = ports.sensors;
      result.slopes            = ports.slopes;
      result.stiffness         = modes.stiffness;
      result.shapes            = port_shapes(lever, modes, window, ports);
      result.layer_stiffness   = modes.layer_stiffness;
      result.density_factor    = modes.density_factor;
      result.lever_mass        = modes.total_mass;
      result.moment_of_inertia = modes.moment_of_inertia;
      result.face_compliance   = port_compliance(lever, window, ports, device);

      const auto n = ports.rotation() + 1, m = static_cast<unsigned int>(result.stiffness.size());
      FullMatrix<double> at_ports(n, m), scaled(n, m);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < m; ++j)
        {
          at_ports(i, j) = result.shapes(i, j);
          scaled(i, j)   = -result.shapes(i, j) / result.stiffness[j];
        }
      scaled.mTmult(result.face_compliance, at_ports, true);
      result.face_compliance.symmetrize();
      return result;
    }

    std::unique_ptr<SurfaceContact> contact_of(const Device &device, const SolidInTime &lever, const FrictionFace<3> &face,
                                               const PortLayout &ports, const unsigned int index)
    {
      const Device own = device_of_lever(device, index);
      return std::make_unique<SurfaceContact>(
          face, SurfaceContactProperties{ RigidCylinder(own.geometry, own.cylinder),
                                          [geometry = own.geometry](const double x, const double theta)
                                          { return cylinder_centre(geometry, x, theta); },
                                          own.geometry.cylinder_radius, ports, rest_inclination(device),
                                          penalties_in_time(own, lever.body->friction_face()), lever.body->is_half(),
                                          own.friction, device.layer.thickness });
    }

    LeverFrame frame_of(const Device &device, const SolidInTime &lever, const PortLayout &ports)
    {
      LeverFrame result       = lever_frame(device, ports, lever.modes.total_mass);
      result.sensor_stiffness = lever.sensors->stiffness();
      result.tell_sensors     = [&lever](const std::vector<double> &forces, Row &row) { lever.sensors->tell(forces, row); };
      return result;
    }

    /// Displacement of all degrees of freedom in a motion of a structure that has these modes [mm].
    Vector<double> displacement(const SolidBody &body, const SolidModes &modes, const std::vector<unsigned int> &face_dofs,
                                const Motion &motion)
    {
      // On the ports of the face, on those of sensors and of the cylinder's axis, which are not loaded or move no mode, and last
      // on the hub's rotation.
      const auto &forces  = motion.face_force;
      const bool has_face = forces.size() > 0;
      std::vector<double> loads(body.n_dofs(), 0.);
      for (unsigned int port = 0; port < face_dofs.size() && has_face; ++port)
        if (!body.is_held(face_dofs[port]))
          loads[face_dofs[port]] = forces[port];
      body.respond(loads);
      Vector<double> result(loads.begin(), loads.end());
      for (unsigned int j = 0; j < modes.stiffness.size(); ++j)
      {
        double work = 0.;
        for (unsigned int port = 0; port < face_dofs.size() && has_face; ++port)
          work += forces[port] * modes.displacements[j][face_dofs[port]];
        if (has_face)
          work += forces[forces.size() - 1] * modes.rotation[j];
        result.add(motion.coordinates.position[j] - work / modes.stiffness[j], modes.displacements[j]);
      }
      return result;
    }

    MeshedDynamics facts(const Device &device, const SolidInTime &lever, const unsigned int n_modes)
    {
      MeshedDynamics result;
      result.n_coordinates     = number_of_levers(device) * n_modes + (device.support.type == SupportType::sprung ? 1 : 0);
      result.density_factor    = lever.modes.density_factor;
      result.lever_mass        = lever.modes.total_mass;
      result.moment_of_inertia = lever.modes.moment_of_inertia;
      result.penalties         = penalties_in_time(device, lever.body->friction_face());
      return result;
    }
  } // namespace

  std::vector<const SolidModes *> modes_of_structures(const SolidInTime &lever, const unsigned int levers)
  {
    if (levers == 1)
      return { &lever.modes };
    return { &lever.modes, lever.swinging ? &*lever.swinging : &lever.modes };
  }

  SolidInTime make_solid_in_time(const Device &device, const Mesh &plane)
  {
    SolidInTime result;
    result.body                         = std::make_unique<const SolidBody>(device, plane);
    const double room                   = 0.1 * device.geometry.cylinder_radius;
    constexpr double spacing_over_depth = 0.5; // ringing adds up what the compliance leaves out
    const auto [first, last]            = swept_contact(device);
    result.compliance = std::make_unique<LayeredCompliance>(*result.body, first - room, last + room, spacing_over_depth);
    result.sensors    = std::make_unique<const SensorForces>(*result.body);
    const auto modes  = [&](const Device &of)
    { return solid_modes(*result.body, inertia_of(of), of.spring.stiffness, of.condensed.modes); };
    result.modes = modes(device);
    if (swings_otherwise(device))
      result.swinging = modes(swinging_device(device));
    return result;
  }

  MeshedDynamics make_solid_dynamics(const Device &device, const SolidInTime &lever, const std::array<double, 2> &reach,
                                     const double relaxation, const unsigned int n_modes)
  {
    const auto window    = std::make_shared<const FaceWindow>(window_of(lever.body->friction_face(), reach[0], reach[1]));
    const auto face      = std::shared_ptr<const FrictionFace<3>>(window, &window->face);
    const auto structure = [&](const SolidModes &modes)
    {
      const auto basis = truncated(basis_on(*window, lever, modes, device), n_modes);
      return std::make_unique<ModalStructure>(modal_data(basis, constants_of(device, relaxation, basis.lever_mass)));
    };
    std::vector<unsigned int> dofs;
    for (const auto &node : face->nodes)
      dofs.insert(dofs.end(), node.dofs.begin(), node.dofs.end());
    const auto contact = [&](const PortLayout &ports, const unsigned int index)
    { return contact_of(device, lever, *face, ports.of_one_lever(), index); };
    MeshedDynamics result = facts(device, lever, n_modes);
    if (number_of_levers(device) == 1)
    {
      auto alone                  = structure(lever.modes);
      const auto ports            = alone->ports();
      result.elastic_displacement = [&lever, dofs](const Motion &motion, unsigned int)
      { return displacement(*lever.body, lever.modes, dofs, motion); };
      result.model = std::make_unique<SolidDynamicLever<ModalStructure, SurfaceContact>>(
          std::move(alone), contact(ports, 0), frame_of(device, lever, ports), lever, face);
      return result;
    }
    using Pair                  = MirroredStructure<ModalStructure>;
    using OfPair                = MirroredContact<SurfaceContact>;
    const auto both             = modes_of_structures(lever, 2);
    auto pair                   = std::make_unique<Pair>(structure(*both[0]), structure(*both[1]), both[0] == both[1]);
    const auto ports            = pair->ports();
    result.elastic_displacement = [of = pair.get(), &lever, both, dofs](const Motion &motion, const unsigned int index)
    {
      return of->of_lever(motion, index,
                          [&](const unsigned int part, const Motion &of_part)
                          { return displacement(*lever.body, *both[part], dofs, of_part); });
    };
    auto contacts =
        std::make_unique<OfPair>(std::array<std::unique_ptr<SurfaceContact>, 2>{ { contact(ports, 0), contact(ports, 1) } },
                                 ports, static_cast<unsigned int>(face->points.size()));
    result.model = std::make_unique<SolidDynamicLever<Pair, OfPair>>(std::move(pair), std::move(contacts),
                                                                     frame_of(device, lever, ports), lever, face);
    return result;
  }

  ContactPenalties penalties_in_time(const Device &device, const FrictionFace<3> &face)
  {
    using namespace penalty_over_layer;
    const double factor = device.mesh.degree == 1 ? in_time_linear : in_time;
    return contact_penalties(face, device.contact, device.layer.thickness, factor);
  }

  FrictionFace<3> reached_face(const std::array<double, 2> &reach, const SolidBody &body)
  {
    return window_of(body.friction_face(), reach[0], reach[1]).face;
  }
} // namespace sprag
