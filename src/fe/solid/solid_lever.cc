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

    PortLoads on_surface(const PortLayout &ports, const PortLoads &forces)
    {
      PortLoads result{ {}, forces.values };
      for (const unsigned int port : forces.ports)
        if (ports.is_surface(port))
          result.ports.push_back(port); // those of the face come first
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
  }

  State SolidLever::initial_state(const DrivePoint &drive) const
  {
    State state;
    state.drive = drive;
    state.coordinates.reinit(window.n_coordinates());
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
    window.set_faces(begin_forces, begin);
    window.set_faces(begin_forces, trial.coordinates);
    contact.begin_step({ begin, start.x });
    return trial;
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
    return { window.unbalance(trial.coordinates, forces), found.compression };
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

  /// Evaluates again with more ports, which begin with what the forces there make of them.
  void SolidLever::widen_reach(State &trial, const FrictionMode mode)
  {
    contact.widen_reach();
    const auto entered = window.enter(reachable(trial));
    window.set_faces(begin_forces, begin);
    contact.begin_step({ begin, start.x });
    for (const unsigned int port : entered)
      trial.coordinates[port] = begin[port];
    evaluate_contact(trial, mode);
  }

  Vector<double> SolidLever::correction()
  {
    return window.correction(forces);
  }

  double SolidLever::turn(const State &state) const
  {
    return state.coordinates[ports.rotation()];
  }

  double SolidLever::support_displacement(const State &state) const
  {
    return ports.sprung ? state.coordinates[ports.support()] : 0.;
  }

  /// Half of the moments on it times what it yields.
  double SolidLever::shaft_energy(const State &state) const
  {
    double result = 0.;
    for (unsigned int i = 0; i < state.forces.ports.size(); ++i)
      if (ports.is_slope(state.forces.ports[i]))
        result += 0.5 * state.forces.values[i] * state.coordinates[state.forces.ports[i]];
    return result;
  }

  double SolidLever::movement(const Vector<double> &correction) const
  {
    Vector<double> in_lengths = correction;
    in_lengths[ports.rotation()] *= properties.spring.arm;
    for (unsigned int i = 0; i < ports.slopes; ++i)
      in_lengths[ports.slope(i)] *= springs.slope_arm;
    return window.largest(in_lengths);
  }

  double SolidLever::length_scale() const
  {
    return properties.spring.arm;
  }

  double SolidLever::penetration() const
  {
    return augments() ? multipliers.largest_change(found.points, memory) / contact.penalties().normal : found.compression;
  }

  bool SolidLever::augments() const
  {
    return properties.contact.enforcement == Enforcement::augmented_lagrangian;
  }

  std::string SolidLever::objection(const State &trial) const
  {
    Row row;
    view.observe_resultants(found, row);
    const double s    = row[Column::s];
    const double mu_e = row[Column::mu] * properties.interface_offset;
    if (direction_of(trial.drive.v) < 0 && row[Column::F] < 0. && s <= mu_e)
      return "the lever locks: moving back, s = " + rounded_text(s) + " mm <= mu e = " + rounded_text(mu_e) + " mm";
    const double pressure = found.compression * contact.penalties().normal;
    const double limit    = largest_strain * body.friction_face().young_modulus;
    if (pressure > limit)
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
    trial.surface_contact = multipliers.augmented(found.points);
  }

  void SolidLever::remember(State &state) const
  {
    state.surface_contact = augments() ? multipliers.augmented(found.points) : found.memory();
  }

  void SolidLever::observe(const State &trial, Row &row) const
  {
    const double theta         = properties.spring.rest + turn(trial);
    const double u             = support_displacement(trial);
    const double support       = properties.support_stiffness.value_or(0.);
    row[Column::theta]         = theta;
    row[Column::spring_energy] = properties.spring.law.energy(turn(trial));
    view.observe(found, row);
    row[Column::elastic_energy] += shaft_energy(trial);
    row[Column::centre_offset]        = row[Column::s] - properties.centre(trial.drive.x - u, theta).xi;
    row[Column::indentation]          = indentation(row, on_surface(ports, trial.forces));
    row[Column::Q]                    = row[Column::P] * std::sin(theta) + row[Column::F] * std::cos(theta);
    row[Column::support_displacement] = u;
    row[Column::Q_support]            = ports.sprung ? support * u : row[Column::Q];
    row[Column::support_energy]       = 0.5 * support * u * u;
    row.sensor_forces.clear();
    for (const auto &[left, right] : sensors(trial.forces))
    {
      row.sensor_forces.push_back(left + right);
      row.across.insert(row.across.end(), { left, right });
    }
  }

  const std::vector<unsigned int> &SolidLever::line_at(const double zeta) const
  {
    const auto &nodes    = body.friction_face().nodes;
    const auto distance  = [&](const auto &line) { return std::abs(nodes[line.front()].position[2] - zeta); };
    const auto is_closer = [&](const auto &a, const auto &b) { return distance(a) < distance(b); };
    return *std::min_element(node_lines.begin(), node_lines.end(), is_closer);
  }

  /// The displacement along eta between the nodes of a line by those of three of them: their ports and shares.
  PortLoads SolidLever::interpolation(const std::vector<unsigned int> &line, const double xi) const
  {
    const auto &nodes    = body.friction_face().nodes;
    const auto xi_of     = [&](const std::size_t i) { return nodes[line[i]].position[0]; };
    const auto is_before = [&](const unsigned int node, const double value) { return nodes[node].position[0] < value; };
    const auto after     = std::lower_bound(line.begin(), line.end(), xi, is_before) - line.begin();
    const auto first     = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, line.size() - 3));
    PortLoads result{ {}, Vector<double>(3) };
    for (std::size_t i = first; i < first + 3; ++i)
    {
      double share = 1.;
      for (std::size_t j = first; j < first + 3; ++j)
        if (j != i)
          share *= (xi - xi_of(j)) / (xi_of(i) - xi_of(j));
      result.ports.push_back(3 * line[i] + 1);
      result.values[static_cast<unsigned int>(i - first)] = share;
    }
    return result;
  }

  /// Where the pressure is largest.
  double SolidLever::indentation(const Row &row, const PortLoads &on_face) const
  {
    if (properties.layer_thickness == 0. || on_face.ports.empty() || node_lines.empty())
      return 0.;
    const auto &line   = line_at(row.across[4]);
    const double s     = row[Column::s];
    const double aside = 0.5 * row[Column::contact_width] + 4. * properties.layer_thickness;
    const auto at      = [&](const double xi)
    {
      const auto shares = interpolation(line, xi);
      return shares.values * compliance.displacements(shares.ports, on_face);
    };
    return at(s) - 0.5 * (at(s - aside) + at(s + aside));
  }

  FacePoints SolidLever::face_points() const
  {
    return view.points();
  }

  FaceState SolidLever::face_state(const State &trial) const
  {
    return view.state(found, trial.drive);
  }

  void SolidLever::visit_history(Archive &archive)
  {
    contact.visit_history(archive);
    window.visit_history(archive);
  }

  Vector<double> SolidLever::body_displacement(const State &state) const
  {
    SparseColumns loads;
    const auto &nodes = body.friction_face().nodes;
    for (unsigned int i = 0; i < state.forces.ports.size(); ++i)
      if (const unsigned int port = state.forces.ports[i]; ports.is_surface(port))
        if (const unsigned int dof = nodes[port / 3].dofs[port % 3]; !body.is_held(dof))
          loads.add(dof, state.forces.values[i]);
    loads.end_column();
    const auto result = body.respond(loads);
    return { result.begin(), result.end() };
  }

  FaceSample SolidLever::sample(const State &state) const
  {
    FaceSample result{ on_surface(ports, state.forces), {} };
    auto &[forces_there, displacements] = result;
    displacements.reinit(static_cast<unsigned int>(forces_there.ports.size()));
    for (unsigned int i = 0; i < displacements.size(); ++i)
      displacements[i] = state.coordinates[forces_there.ports[i]];
    return result;
  }

  SolidLever::Exactness SolidLever::exactness(const std::vector<FaceSample> &samples) const
  {
    const auto &nodes = body.friction_face().nodes;
    const auto dof_of = [&](const unsigned int port) { return nodes[port / 3].dofs[port % 3]; };
    SparseColumns loads;
    for (const auto &[acting, displacements] : samples)
    {
      for (unsigned int i = 0; i < acting.ports.size(); ++i)
        if (const unsigned int dof = dof_of(acting.ports[i]); !body.is_held(dof))
          loads.add(dof, acting.values[i]);
      loads.end_column();
    }
    const auto of_whole = body.respond(loads);

    Exactness result{};
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      const auto &[acting, displacements] = samples[k];
      double difference = 0., largest = 0., missed = 0., work = 0.;
      for (unsigned int i = 0; i < acting.ports.size(); ++i)
      {
        const double exact = of_whole[k * body.n_dofs() + dof_of(acting.ports[i])];
        difference         = std::max(difference, std::abs(exact - displacements[i]));
        largest            = std::max(largest, std::abs(exact));
        missed += (exact - displacements[i]) * acting.values[i];
        work += exact * acting.values[i];
      }
      result.displacement = std::max(result.displacement, largest > 0. ? difference / largest : 0.);
      result.work         = std::max(result.work, work > 0. ? std::abs(missed) / work : 0.);
    }
    return result;
  }
} // namespace sprag
