#include "fe/solid/solid_lever.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/statics/contact_penalties.h"
#include "fe/statics/static_terms.h"
#include "scene/across.h"
#include "scene/contact_width.h"
#include "scene/lever_shape.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Compression of the friction face beyond which linear elasticity says nothing.
    constexpr double largest_strain = 0.5;

    /// Slopes of the cylinder's axis that a scene may have.
    constexpr double largest_slope = 0.1;

    PortLayout ports_of(const SolidBody &body, const Scene &scene, const LeverProperties &properties)
    {
      PortLayout result{ 3 * static_cast<unsigned int>(body.friction_face().nodes.size()),
                         properties.support_stiffness.has_value() };
      result.has_inertia = false;
      result.slopes      = body.is_half() || !scene.cylinder.has_free_axis() ? 0 : 2;
      return result;
    }

    SurfaceContactProperties contact_properties(const SolidBody &body, const Scene &scene, const LeverProperties &properties,
                                                const PortLayout &ports)
    {
      return { RigidCylinder(scene.geometry, scene.cylinder),
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

  SolidLever::SolidLever(const SolidBody &body_, const Scene &scene)
      : body(body_)
      , properties(lever_properties(scene))
      , ports(ports_of(body, scene, properties))
      , compliance(compliance_of(body, scene))
      , node_lines(lines_along(body.friction_face()))
      , springs(springs_of(scene, properties))
      , window(ports, springs,
               { { ports.surface, [this](const PortSelection &some) { return compliance.whole_tiles(some); },
                   [this](const PortSelection &tiles) { return compliance.among(tiles); } } })
      , contact(body.friction_face(), contact_properties(body, scene, properties, ports))
      , multipliers(body.friction_face())
      , view(body.friction_face(), contact, body.is_half())
      , excess(ports, properties.spring.law)
      , sensors(body)
  {
    if (body.body_properties().material != MaterialModel::linear)
      finite.emplace(body);
  }

  State SolidLever::initial_state(const DrivePoint &drive) const
  {
    State state;
    state.drive = drive;
    state.coordinates.reinit(window.n_coordinates() + (finite ? body.n_dofs() : 0));
    state.coordinates[ports.rotation()] = properties.ideal_theta(drive.x) - properties.spring.rest;
    return state;
  }

  State SolidLever::begin_step(const State &accepted, const DrivePoint &end)
  {
    State trial    = accepted;
    trial.drive    = end;
    const double u = support_displacement(accepted);
    trial.coordinates[ports.rotation()] += properties.ideal_theta(end.x - u) - properties.ideal_theta(accepted.drive.x - u);
    start        = accepted.drive;
    begin_forces = accepted.forces;
    begin        = accepted.coordinates;
    window.enter(reachable(trial));
    const auto displacement = of_body(begin);
    set_face(begin_forces, displacement, begin);
    set_face(begin_forces, displacement, trial.coordinates);
    contact.begin_step({ begin, start.x });
    return trial;
  }

  /// At finite strain.
  Vector<double> SolidLever::of_body(const Vector<double> &coordinates) const
  {
    return { coordinates.begin() + window.n_coordinates(), coordinates.end() };
  }

  /// Sets the ports of the face to what forces on them make of a linear body, or to the body's displacement at finite strain.
  void SolidLever::set_face(const PortLoads &acting, const Vector<double> &displacement, Vector<double> &coordinates) const
  {
    if (!finite)
      return window.set_faces(acting, coordinates);
    for (unsigned int port = 0; port < ports.surface; ++port)
      coordinates[port] = displacement[finite->dof_of(port)];
  }

  /// Ports within reach of the contact in a step that ends near `trial`, and those of the forces it begins with.
  PortSelection SolidLever::reachable(const State &trial)
  {
    const double begin_x = start.x - (ports.sprung ? begin[ports.support()] : 0.);
    const double x       = trial.drive.x - support_displacement(trial);
    const double theta   = properties.spring.rest + turn(trial);
    const double travel =
        properties.centre(x, theta).xi - properties.centre(begin_x, properties.spring.rest + begin[ports.rotation()]).xi;
    return united(begin_forces.ports, contact.reachable_ports(x, theta, travel));
  }

  Unbalance SolidLever::evaluate(State &trial, const FrictionMode mode)
  {
    evaluate_contact(trial, mode);
    forces = found.forces;
    excess.add_forces({ { turn(trial), 0. } }, !forces.ports.empty(), forces);
    trial.forces = { forces.ports, forces.values };
    if (!finite)
      return { window.unbalance(trial.coordinates, forces), found.compression };
    const auto displacement = of_body(trial.coordinates);
    const auto &of_strain   = finite->unbalance(displacement, on_face(trial.forces));
    Vector<double> of_face(ports.surface);
    for (unsigned int port = 0; port < ports.surface; ++port)
      of_face[port] = displacement[finite->dof_of(port)] + of_strain[finite->dof_of(port)];
    return { std::hypot(window.unbalance(trial.coordinates, forces, &of_face), of_strain.l2_norm()), found.compression };
  }

  void SolidLever::evaluate_contact(State &trial, const FrictionMode mode)
  {
    auto terms      = static_terms(properties.friction, properties.geometry, start, trial.drive, mode);
    terms.augmented = augments();
    memory          = trial.surface_contact;
    found.duration  = trial.drive.time - start.time;
    contact.evaluate({ trial.coordinates, trial.drive.x }, memory, trial.drive.surface - start.surface, terms, found);
    if (!found.within_reach)
      widen_reach(trial, mode);
  }

  /// The last evaluation with its points: Newton's method needs none.
  const SurfaceEvaluation &SolidLever::with_points() const
  {
    if (found.points.empty())
      contact.add_points(found);
    return found;
  }

  /// Evaluates again with more ports, which begin with what the forces there make of them.
  void SolidLever::widen_reach(State &trial, const FrictionMode mode)
  {
    contact.widen_reach();
    const auto entered = window.enter(reachable(trial));
    set_face(begin_forces, of_body(begin), begin);
    contact.begin_step({ begin, start.x });
    for (const unsigned int port : entered)
      trial.coordinates[port] = begin[port];
    evaluate_contact(trial, mode);
  }

  Vector<double> SolidLever::correction()
  {
    auto of_ports = window.correction(forces);
    if (!finite)
      return of_ports;
    PortLoads change{ forces.ports, Vector<double>(forces.values.size()) };
    Vector<double> moved(forces.values.size());
    of_ports.extract_subvector_to(forces.ports.begin(), forces.ports.end(), moved.begin());
    forces.tangent.vmult(change.values, moved);
    const auto of_strain = finite->correction(on_face(change));
    Vector<double> result(of_ports.size() + of_strain.size());
    std::copy(of_strain.begin(), of_strain.end(), std::copy(of_ports.begin(), of_ports.end(), result.begin()));
    return result;
  }

  PortLoads SolidLever::on_face(const PortLoads &acting) const
  {
    PortLoads result{ {}, acting.values };
    for (const unsigned int port : acting.ports)
      if (ports.is_surface(port))
        result.ports.push_back(port); // those of the face come first
    return result;
  }

  double SolidLever::turn(const State &state) const
  {
    return state.coordinates[ports.rotation()];
  }

  double SolidLever::support_displacement(const State &state) const
  {
    return ports.sprung ? state.coordinates[ports.support()] : 0.;
  }

  double SolidLever::movement(const Vector<double> &correction) const
  {
    Vector<double> in_lengths = correction;
    in_lengths[ports.rotation()] *= properties.spring.arm;
    for (unsigned int i = 0; i < ports.slopes; ++i)
      in_lengths[ports.slope(i)] *= springs.slope_arm;
    return std::max(window.largest(in_lengths), finite ? of_body(correction).linfty_norm() : 0.);
  }

  double SolidLever::length_scale() const
  {
    return properties.spring.arm;
  }

  double SolidLever::penetration() const
  {
    return augments() ? multipliers.largest_change(with_points().points, memory) / contact.penalties().normal : found.compression;
  }

  bool SolidLever::augments() const
  {
    return properties.contact.enforcement == Enforcement::augmented_lagrangian;
  }

  std::string SolidLever::objection(const State &trial) const
  {
    Row row;
    view.observe_resultants(with_points(), row);
    const double s    = row[Column::s];
    const double mu_e = row[Column::mu] * properties.interface_offset;
    if (direction_of(trial.drive.v) < 0 && row[Column::F] < 0. && s <= mu_e)
      return "the lever locks: moving back, s = " + rounded_text(s) + " mm <= mu e = " + rounded_text(mu_e) + " mm";
    const double pressure = found.compression * contact.penalties().normal;
    const double limit    = largest_strain * body.friction_face().young_modulus;
    if (!finite && pressure > limit)
      return "the pressure on the friction face exceeds " + rounded_text(limit) +
             " MPa, half of Young's modulus there (Friction layer or Lever/Young's modulus), which linear theory does not bear";
    const auto [tilt, skew] = contact.slopes_in(found);
    if (std::max(std::abs(tilt), std::abs(skew)) > largest_slope)
      return "the shaft lets the cylinder's axis turn to the slopes " + rounded_text(tilt) + " (tilt) and " + rounded_text(skew) +
             " (skew), of which " + rounded_text(largest_slope) +
             " are the most that is looked at. Try a larger Cylinder/Tilt stiffness or Skew stiffness";
    return {};
  }

  void SolidLever::augment(State &trial) const
  {
    trial.surface_contact = multipliers.augmented(with_points().points);
  }

  void SolidLever::remember(State &state) const
  {
    state.surface_contact = augments() ? multipliers.augmented(with_points().points) : with_points().memory();
  }

  void SolidLever::visit_history(Archive &archive)
  {
    contact.visit_history(archive);
    window.visit_history(archive);
  }
} // namespace sprag
