#include "fe/solid/solid_dynamics.h"

#include "fe/dynamics/condensed_basis.h"
#include "fe/dynamics/lever_constants.h"
#include "fe/solid/face_window.h"
#include "fe/solid/solid_contact.h"
#include "fe/statics/contact_penalties.h"
#include "fe/statics/lever_properties.h"
#include "model/dynamic_lever.h"
#include "scene/across.h"
#include "scene/analysis_use.h"
#include "scene/held_slide.h"
#include "scene/lever_shape.h"
#include "scene/mirrored_pair.h"

#include <algorithm>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    FaceWindow window_of_scene(const Scene &scene, const FrictionFace<3> &face)
    {
      const auto [begin, end] = reachable_contact(scene);
      return window_of(face, begin, end);
    }

    PortSelection ports_of(const FaceWindow &window)
    {
      PortSelection result(3 * window.face.nodes.size());
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = 3 * window.first_node + i;
      return result;
    }

    /// Of the window, the sensors, the cylinder's axis, the hub and its momentum.
    PortLayout layout_of(const FaceWindow &window, const SolidInTime &lever, const Scene &scene)
    {
      PortLayout result{ static_cast<unsigned int>(3 * window.face.nodes.size()), true, lever.sensors->number() };
      result.slopes = lever.body->is_half() || !scene.cylinder.has_free_axis() ? 0 : 2;
      return result;
    }

    /// Shapes of the modes on these ports.
    FullMatrix<double> port_shapes(const SolidInTime &lever, const FaceWindow &window, const PortLayout &ports)
    {
      const auto &modes = lever.modes;
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
                                       const Scene &scene)
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
        result(ports.slope(i), ports.slope(i)) = slope_compliances(scene.cylinder)[i];
      result(ports.rotation(), ports.rotation()) = 1. / scene.spring.stiffness;
      return result;
    }

    /// The basis as of a lever in a plane whose face is the window.
    CondensedBasis basis_on(const FaceWindow &window, const SolidInTime &lever, const Scene &scene)
    {
      const auto ports = layout_of(window, lever, scene);
      CondensedBasis result;
      result.sensors           = ports.sensors;
      result.slopes            = ports.slopes;
      result.stiffness         = lever.modes.stiffness;
      result.shapes            = port_shapes(lever, window, ports);
      result.layer_stiffness   = lever.modes.layer_stiffness;
      result.density_factor    = lever.modes.density_factor;
      result.lever_mass        = lever.modes.total_mass;
      result.moment_of_inertia = lever.modes.moment_of_inertia;
      result.face_compliance   = port_compliance(lever, window, ports, scene);

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

    SurfaceContactProperties contact_properties(const Scene &scene, const FrictionFace<3> &face, const PortLayout &ports)
    {
      return { RigidCylinder(scene.geometry, scene.cylinder),
               [geometry = scene.geometry](const double x, const double theta) { return cylinder_centre(geometry, x, theta); },
               scene.geometry.cylinder_radius,
               ports,
               rest_inclination(scene),
               penalties_in_time(scene, face) };
    }

    /// Tells the sensors' forces as the lever without inertia does, and the shapes of modes along an edge of the whole face, by
    /// the modes of the free lever. What these leave out is the dent of the layer under the cylinder.
    class SolidDynamicLever : public DynamicLever<ModalStructure, SolidContact>
    {
    public:
      SolidDynamicLever(std::unique_ptr<ModalStructure> modes, std::unique_ptr<SolidContact> surface, LeverFrame of_scene,
                        const SolidInTime &lever_)
          : DynamicLever(std::move(modes), std::move(surface), std::move(of_scene))
          , lever(lever_)
      {
      }

      void observe(const Motion &motion, Row &row) const override
      {
        DynamicLever::observe(motion, row);
        lever.sensors->tell(row.sensor_forces, row);
      }

      ModeShape mode_shape(const Eigenmode &mode) const override
      {
        ModeShape result = DynamicLever::mode_shape(mode);
        auto &shape      = result.levers.front();
        result.xi.clear();
        const auto &nodes = lever.body->friction_face().nodes;
        for (unsigned int i = 0; i < 2; ++i)
        {
          shape.along[i].clear();
          shape.across[i].clear();
        }
        const double edge = std::max_element(nodes.begin(), nodes.end(),
                                             [](const auto &a, const auto &b) { return a.position[2] < b.position[2]; })
                                ->position[2];
        for (const auto &node : nodes)
          if (node.position[2] > edge - 1e-6)
          {
            result.xi.push_back(node.position[0]);
            for (unsigned int i = 0; i < 2; ++i)
            {
              shape.along[i].push_back(moved(mode.mode.coordinates[i], node.dofs[0]));
              shape.across[i].push_back(moved(mode.mode.coordinates[i], node.dofs[1]));
              shape.sideways[i].push_back(moved(mode.mode.coordinates[i], node.dofs[2]));
            }
          }
        return result;
      }

    private:
      const SolidInTime &lever;

      double moved(const Vector<double> &coordinates, const unsigned int dof) const
      {
        double result = 0.;
        for (unsigned int j = 0; j < coordinates.size(); ++j)
          result += coordinates[j] * lever.modes.displacements[j][dof];
        return result;
      }
    };
  } // namespace

  SolidInTime make_solid_in_time(const Scene &scene, const Mesh &plane)
  {
    SolidInTime result;
    result.body                         = std::make_unique<const SolidBody>(scene, plane);
    const double room                   = 0.1 * scene.geometry.cylinder_radius;
    constexpr double spacing_over_depth = 0.5; // ringing adds up what the compliance leaves out
    const auto [first, last]            = swept_contact(scene);
    result.compliance = std::make_unique<LayeredCompliance>(*result.body, first - room, last + room, spacing_over_depth);
    result.sensors    = std::make_unique<const SensorForces>(*result.body);
    result.modes      = solid_modes(*result.body, inertia_of(scene), scene.spring.stiffness, scene.condensed.modes);
    return result;
  }

  std::unique_ptr<DynamicModel> make_solid_dynamics(const Scene &scene, const SolidInTime &lever, const double relaxation,
                                                    const unsigned int n_modes)
  {
    auto window       = window_of_scene(scene, lever.body->friction_face());
    const auto basis  = truncated(basis_on(window, lever, scene), n_modes);
    auto structure    = std::make_unique<ModalStructure>(modal_data(basis, constants_of(scene, relaxation, basis.lever_mass)));
    const auto ports  = structure->ports();
    const auto &whole = lever.body->friction_face();
    auto properties   = contact_properties(scene, whole, ports);
    auto contact      = std::make_unique<SolidContact>(std::move(window.face), std::move(properties), scene.friction,
                                                  scene.layer.thickness, lever.body->is_half());
    auto frame        = lever_frame(scene, ports, basis.lever_mass);
    frame.sensor_stiffness = lever.sensors->stiffness();
    return std::make_unique<SolidDynamicLever>(std::move(structure), std::move(contact), std::move(frame), lever);
  }

  ContactPenalties penalties_in_time(const Scene &scene, const FrictionFace<3> &face)
  {
    using namespace penalty_over_layer;
    const double factor = scene.mesh.degree == 1 ? in_time_linear : in_time;
    return contact_penalties(face, scene.contact, scene.layer.thickness, factor);
  }

  FrictionFace<3> reached_face(const Scene &scene, const SolidBody &body)
  {
    return window_of_scene(scene, body.friction_face()).face;
  }

  std::function<Vector<double>(const Motion &, unsigned int)> solid_displacement(const Scene &scene, const SolidInTime &lever)
  {
    std::vector<unsigned int> dofs;
    for (const auto &node : reached_face(scene, *lever.body).nodes)
      dofs.insert(dofs.end(), node.dofs.begin(), node.dofs.end());
    return [&lever, dofs](const Motion &motion, unsigned int)
    {
      const auto &body  = lever.body;
      const auto &modes = lever.modes;
      // On the ports of the face, on those of sensors and of the cylinder's axis, which are not loaded or move no mode, and last
      // on the hub's rotation.
      const auto &forces = motion.face_force;
      std::vector<double> loads(body->n_dofs(), 0.);
      for (unsigned int port = 0; port < dofs.size() && forces.size() > 0; ++port)
        if (!body->is_held(dofs[port]))
          loads[dofs[port]] = forces[port];
      body->respond(loads);
      Vector<double> result(loads.begin(), loads.end());
      for (unsigned int j = 0; j < modes.stiffness.size(); ++j)
      {
        double work = 0.;
        for (unsigned int port = 0; port < dofs.size() && forces.size() > 0; ++port)
          work += forces[port] * modes.displacements[j][dofs[port]];
        if (forces.size() > 0)
          work += forces[forces.size() - 1] * modes.rotation[j];
        result.add(motion.coordinates.position[j] - work / modes.stiffness[j], modes.displacements[j]);
      }
      return result;
    };
  }
} // namespace sprag
