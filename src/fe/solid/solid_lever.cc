#include "fe/solid/solid_lever.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/statics/contact_penalties.h"
#include "fe/statics/static_terms.h"
#include "model/joined_memory.h"
#include "model/joined_ports.h"
#include "scene/across.h"
#include "scene/contact_width.h"
#include "scene/lever_shape.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Slopes of the cylinder's axis that a scene may have.
    constexpr double largest_slope = 0.1;

    PortLayout ports_of(const SolidBody &body, const Scene &scene)
    {
      PortLayout result{ 3 * static_cast<unsigned int>(body.friction_face().nodes.size()),
                         scene.support.type == SupportType::sprung };
      result.levers      = number_of_levers(scene);
      result.has_inertia = false;
      result.slopes      = body.is_half() || !scene.cylinder.has_free_axis() ? 0 : 2;
      return result;
    }

    SurfaceContactProperties contact_properties(const SolidBody &body, const Scene &own, const LeverProperties &properties,
                                                const PortLayout &ports)
    {
      return { RigidCylinder(own.geometry, own.cylinder),
               properties.centre,
               properties.radius,
               ports,
               properties.spring.rest,
               contact_penalties(body.friction_face(), properties.contact, properties.layer_thickness, properties.penalty_factor,
                                 properties.longest_face) };
    }

    PortSprings springs_of(const Scene &scene, const LeverProperties &properties)
    {
      return { properties.spring.law.linear_stiffness(), properties.support_stiffness.value_or(0.), properties.spring.arm,
               slope_compliances(scene.cylinder), 0.5 * scene.lever.width };
    }

    std::vector<std::vector<unsigned int>> lines_along(const FrictionFace<3> &face)
    {
      std::map<long, std::vector<unsigned int>> by_zeta;
      for (unsigned int i = 0; i < face.nodes.size(); ++i)
        by_zeta[std::lround(1e6 * face.nodes[i].position[2])].push_back(i);
      std::vector<std::vector<unsigned int>> result;
      for (const auto &line : by_zeta)
        if (line.second.size() >= 3)
          result.push_back(line.second);
      return result;
    }

    LayeredCompliance compliance_of(const SolidBody &body, const Scene &scene)
    {
      const double room        = 0.1 * scene.geometry.cylinder_radius;
      const auto [first, last] = swept_contact(scene);
      return { body, first - room, last + room };
    }
  } // namespace

  SolidLever::Lever::Lever(const SolidBody &body, const Scene &own, const PortLayout &ports, LeverProperties of_lever)
      : properties(std::move(of_lever))
      , contact(body.friction_face(), contact_properties(body, own, properties, ports))
      , view(body.friction_face(), contact, body.is_half())
  {
  }

  SolidLever::SolidLever(const SolidBody &body_, const Scene &scene)
      : body(body_)
      , ports(ports_of(body, scene))
      , compliance(compliance_of(body, scene))
      , node_lines(lines_along(body.friction_face()))
      , springs(springs_of(scene, lever_properties(scene)))
      , window(ports, springs,
               { { ports.surface, [this](const PortSelection &some) { return compliance.whole_tiles(some); },
                   [this](const PortSelection &tiles) { return compliance.among(tiles); } } })
      , multipliers(body.friction_face())
      , excess(ports, lever_properties(scene).spring.law, swings(scene), 0.)
      , joint_is_free(swings(scene))
      , sensors(body)
  {
    for (unsigned int i = 0; i < ports.levers; ++i)
      levers.emplace_back(body, scene_of_lever(scene, i), ports.of_one_lever(),
                          ports.levers == 1 ? lever_properties(scene) : properties_of_lever(scene, i));
    if (body.body_properties().material != MaterialModel::linear)
      finite.emplace(body);
  }

  State SolidLever::initial_state(const DrivePoint &drive) const
  {
    State state;
    state.drive = drive;
    state.coordinates.reinit(window.n_coordinates() + (finite ? ports.levers * body.n_dofs() : 0));
    for (unsigned int i = 0; i < ports.levers; ++i)
      state.coordinates[ports.rotation(i)] = levers[i].properties.ideal_theta(drive.x) - levers[i].properties.spring.rest;
    return state;
  }

  State SolidLever::begin_step(const State &accepted, const DrivePoint &end)
  {
    State trial    = accepted;
    trial.drive    = end;
    const double u = support_displacement(accepted);
    for (unsigned int i = 0; i < ports.levers; ++i)
    {
      const auto &ideal = levers[i].properties.ideal_theta;
      trial.coordinates[ports.rotation(i)] += ideal(end.x - u) - ideal(accepted.drive.x - u);
    }
    start        = accepted.drive;
    begin_forces = accepted.forces;
    begin        = accepted.coordinates;
    window.enter(reachable(trial));
    set_faces(begin_forces, accepted.coordinates, begin);
    set_faces(begin_forces, accepted.coordinates, trial.coordinates);
    begin_contacts();
    return trial;
  }

  void SolidLever::begin_contacts()
  {
    for (unsigned int i = 0; i < ports.levers; ++i)
      levers[i].contact.begin_step({ ports_of_lever(ports, i, begin), start.x });
  }

  /// At finite strain.
  Vector<double> SolidLever::of_body(const Vector<double> &coordinates, const unsigned int lever) const
  {
    const auto first = coordinates.begin() + window.n_coordinates() + lever * body.n_dofs();
    return { first, first + body.n_dofs() };
  }

  /// Index among the coordinates, at finite strain, of the body's displacement at a port of a lever's face.
  unsigned int SolidLever::of_body_at(const unsigned int lever, const unsigned int port) const
  {
    return window.n_coordinates() + lever * body.n_dofs() + dof_of_port(body, port);
  }

  /// Sets the ports of the faces to what forces on them make of linear bodies, or at finite strain to the displacements of the
  /// bodies in `from`.
  void SolidLever::set_faces(const PortLoads &acting, const Vector<double> &from, Vector<double> &coordinates) const
  {
    if (!finite)
      return window.set_faces(acting, coordinates);
    for (unsigned int i = 0; i < ports.levers; ++i)
      for (unsigned int port = 0; port < ports.surface; ++port)
        coordinates[ports.first(i) + port] = from[of_body_at(i, port)];
  }

  /// Ports within reach of the contacts in a step that ends near `trial`, and those of the forces it begins with.
  PortSelection SolidLever::reachable(const State &trial)
  {
    const double begin_x = start.x - (ports.sprung ? begin[ports.support()] : 0.);
    const double x       = trial.drive.x - support_displacement(trial);
    PortSelection result = begin_forces.ports;
    for (unsigned int i = 0; i < ports.levers; ++i)
    {
      const auto &properties = levers[i].properties;
      const double theta     = properties.spring.rest + turns(trial)[i];
      const double travel =
          properties.centre(x, theta).xi - properties.centre(begin_x, properties.spring.rest + begin[ports.rotation(i)]).xi;
      PortSelection of_lever;
      for (const unsigned int port : levers[i].contact.reachable_ports(x, { { theta } }, travel))
        of_lever.push_back(joined_port(ports, i, port));
      result = united(result, of_lever);
    }
    return result;
  }

  Unbalance SolidLever::evaluate(State &trial, const FrictionMode mode)
  {
    evaluate_contacts(trial, mode);
    excess.add_forces(turns(trial), !forces.ports.empty(), forces);
    trial.forces   = { forces.ports, forces.values };
    double overlap = 0.;
    for (const auto &lever : levers)
      overlap = std::max(overlap, lever.found.compression);
    return { finite ? unbalance_with_strain(trial) : window.unbalance(trial.coordinates, forces), overlap };
  }

  double SolidLever::unbalance_with_strain(const State &trial)
  {
    Vector<double> of_faces(ports.size());
    double squares = 0.;
    for (unsigned int i = 0; i < ports.levers; ++i)
    {
      auto &of_strain         = levers[i].of_strain;
      const auto displacement = of_body(trial.coordinates, i);
      of_strain               = finite->unbalance(displacement, on_face(trial.forces, i));
      squares += of_strain.norm_sqr();
      for (unsigned int port = 0; port < ports.surface; ++port)
        of_faces[ports.first(i) + port] = displacement[dof_of_port(body, port)] + of_strain[dof_of_port(body, port)];
    }
    return std::hypot(window.unbalance(trial.coordinates, forces, &of_faces), std::sqrt(squares));
  }

  void SolidLever::evaluate_contacts(State &trial, const FrictionMode mode)
  {
    std::vector<const PortForces *> of_levers;
    bool within_reach = true;
    for (unsigned int i = 0; i < ports.levers; ++i)
    {
      auto &[properties, contact, view, memory, found, of_strain] = levers[i];

      auto terms      = static_terms(properties.friction, properties.geometry, start, trial.drive, mode);
      terms.augmented = augments();
      memory          = memory_of_lever(i, n_face_points(), trial.surface_contact);
      found.duration  = trial.drive.time - start.time;
      contact.evaluate({ ports_of_lever(ports, i, trial.coordinates), trial.drive.x }, memory,
                       trial.drive.surface - start.surface, terms, found);
      of_levers.push_back(&found.forces);
      within_reach = within_reach && found.within_reach;
    }
    if (!within_reach)
      return widen_reach(trial, mode);
    join_forces(ports, of_levers, forces);
  }

  /// The last evaluation with its points: Newton's method needs none.
  const SurfaceEvaluation &SolidLever::Lever::with_points() const
  {
    if (found.points.empty())
      contact.add_points(found);
    return found;
  }

  /// Evaluates again with more ports, which begin with what the forces there make of them.
  void SolidLever::widen_reach(State &trial, const FrictionMode mode)
  {
    for (auto &lever : levers)
      lever.contact.widen_reach();
    const auto entered = window.enter(reachable(trial));
    set_faces(begin_forces, Vector<double>(begin), begin);
    begin_contacts();
    for (const unsigned int port : entered)
      trial.coordinates[port] = begin[port];
    evaluate_contacts(trial, mode);
  }

  Vector<double> SolidLever::correction()
  {
    auto result = window.correction(forces);
    if (!finite)
      return result;
    PortLoads change{ forces.ports, Vector<double>(forces.values.size()) };
    Vector<double> moved(forces.values.size());
    result.extract_subvector_to(forces.ports.begin(), forces.ports.end(), moved.begin());
    forces.tangent.vmult(change.values, moved);
    result.grow_or_shrink(window.n_coordinates() + ports.levers * body.n_dofs());
    for (unsigned int i = 0; i < ports.levers; ++i)
    {
      const auto of_strain = finite->correction(levers[i].of_strain, on_face(change, i));
      std::copy(of_strain.begin(), of_strain.end(), result.begin() + window.n_coordinates() + i * body.n_dofs());
    }
    return result;
  }

  /// With the numbers that its ports have alone.
  PortLoads SolidLever::on_face(const PortLoads &acting, const unsigned int lever) const
  {
    const auto &all  = acting.ports;
    const auto begin = std::lower_bound(all.begin(), all.end(), ports.first(lever));
    const auto end   = std::lower_bound(begin, all.end(), ports.first(lever) + ports.surface);
    PortLoads result{
      { begin, end }, Vector<double>(acting.values.begin() + (begin - all.begin()), acting.values.begin() + (end - all.begin()))
    };
    for (auto &port : result.ports)
      port -= ports.first(lever);
    return result;
  }

  OfLevers SolidLever::turns(const State &state) const
  {
    return turns_of(ports, state.coordinates);
  }

  double SolidLever::support_displacement(const State &state) const
  {
    return ports.sprung ? state.coordinates[ports.support()] : 0.;
  }

  double SolidLever::movement(const Vector<double> &correction) const
  {
    Vector<double> in_lengths = correction;
    for (unsigned int i = 0; i < ports.levers; ++i)
      in_lengths[ports.rotation(i)] *= springs.arm;
    for (unsigned int i = 0; i < ports.slopes; ++i)
      in_lengths[ports.slope(i)] *= springs.slope_arm;
    double result = window.largest(in_lengths);
    for (unsigned int i = 0; i < ports.levers && finite; ++i)
      result = std::max(result, of_body(correction, i).linfty_norm());
    return result;
  }

  double SolidLever::length_scale() const
  {
    return springs.arm;
  }

  double SolidLever::penetration() const
  {
    double result = 0.;
    for (const auto &lever : levers)
      result = std::max(result, augments() ? multipliers.largest_change(lever.with_points().points, lever.memory) /
                                                 lever.contact.penalties().normal
                                           : lever.found.compression);
    return result;
  }

  bool SolidLever::augments() const
  {
    return levers.front().properties.contact.enforcement == Enforcement::augmented_lagrangian;
  }

  std::string SolidLever::objection(const State &trial) const
  {
    for (unsigned int i = 0; i < ports.levers; ++i)
      if (const auto found = objection(levers[i], trial.drive); !found.empty())
        return (i == 0 ? "" : "of the pair's second lever, ") + found;
    return {};
  }

  std::string SolidLever::objection(const Lever &lever, const DrivePoint &drive) const
  {
    Row row;
    lever.view.observe_resultants(lever.with_points(), row);
    if (const auto locks = locking_objection(row, lever.properties.interface_offset, drive); !locks.empty())
      return locks;
    const double pressure = lever.found.compression * lever.contact.penalties().normal;
    if (const auto beyond = pressure_objection(pressure, body.friction_face().young_modulus); !finite && !beyond.empty())
      return beyond;
    const auto [tilt, skew] = lever.contact.slopes_in(lever.found);
    if (std::max(std::abs(tilt), std::abs(skew)) > largest_slope)
      return "the shaft lets the cylinder's axis turn to the slopes " + rounded_text(tilt) + " (tilt) and " + rounded_text(skew) +
             " (skew), of which " + rounded_text(largest_slope) +
             " are the most that is looked at. Try a larger Cylinder/Tilt stiffness or Skew stiffness";
    return {};
  }

  std::vector<SurfaceMemory> SolidLever::joined(const std::function<std::vector<SurfaceMemory>(const Lever &)> &memory) const
  {
    if (ports.levers == 1)
      return memory(levers[0]);
    return joined_memory(n_face_points(), memory(levers[0]), memory(levers[1]));
  }

  void SolidLever::augment(State &trial) const
  {
    trial.surface_contact = joined([&](const Lever &lever) { return multipliers.augmented(lever.with_points().points); });
  }

  void SolidLever::remember(State &state) const
  {
    state.surface_contact =
        joined([&](const Lever &lever)
               { return augments() ? multipliers.augmented(lever.with_points().points) : lever.with_points().memory(); });
  }

  void SolidLever::use_penalties(const ContactPenalties &penalties)
  {
    for (auto &lever : levers)
      lever.contact.use_penalties(penalties);
  }

  unsigned int SolidLever::n_face_points() const
  {
    return static_cast<unsigned int>(body.friction_face().points.size());
  }

  void SolidLever::visit_history(Archive &archive)
  {
    for (auto &lever : levers)
      lever.contact.visit_history(archive);
    window.visit_history(archive);
  }
} // namespace sprag
