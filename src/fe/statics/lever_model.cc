#include "fe/statics/lever_model.h"

#include "base/text.h"
#include "fe/contact/face_observation.h"
#include "fe/statics/contact_penalties.h"
#include "fe/statics/observe_levers.h"
#include "fe/statics/static_terms.h"
#include "model/joined_memory.h"
#include "model/joined_ports.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    PortLayout static_ports(const ElasticBody<2> &body, const LeverProperties &properties, const unsigned int levers)
    {
      PortLayout result{ static_cast<unsigned int>(surface_dofs(body).size()), properties.support_stiffness.has_value() };
      result.levers      = levers;
      result.has_inertia = false;
      return result;
    }

    FaceContactProperties contact_properties(const ElasticBody<2> &body, const LeverProperties &properties,
                                             const PortLayout &ports)
    {
      return { properties.obstacle,
               properties.centre,
               properties.radius,
               ports,
               properties.spring.rest,
               contact_penalties(body, properties.contact, properties.layer_thickness, properties.penalty_factor,
                                 properties.longest_face),
               properties.friction,
               properties.layer_thickness };
    }

    std::variant<StaticStructure, FullStiffness> make_structure(const ElasticBody<2> &body, const LeverProperties &properties,
                                                                const PortLayout &ports)
    {
      using Structure = std::variant<StaticStructure, FullStiffness>;
      const PortSprings springs{ properties.spring.law.linear_stiffness(), properties.support_stiffness.value_or(0.),
                                 properties.spring.arm };
      if (properties.solution == Solution::automatic && properties.body.material == MaterialModel::linear)
        return Structure(std::in_place_type<StaticStructure>, body, ports, springs);
      return Structure(std::in_place_type<FullStiffness>, body, ports, springs);
    }

    std::vector<LeverProperties> properties_of_levers(const Scene &scene)
    {
      if (number_of_levers(scene) == 1)
        return { lever_properties(scene) };
      return { properties_of_lever(scene, 0), properties_of_lever(scene, 1) };
    }
  } // namespace

  LeverModel::Lever::Lever(const ElasticBody<2> &body, const PortLayout &ports, LeverProperties lever)
      : properties(std::move(lever))
      , contact(body, contact_properties(body, properties, ports.of_one_lever()))
      , multipliers(body.friction_face())
  {
  }

  LeverModel::LeverModel(const Triangulation<2> &triangulation, LeverProperties properties)
      : LeverModel(triangulation, std::vector<LeverProperties>{ std::move(properties) }, false)
  {
  }

  LeverModel::LeverModel(const Triangulation<2> &triangulation, const Scene &scene)
      : LeverModel(triangulation, properties_of_levers(scene), swings(scene))
  {
  }

  LeverModel::LeverModel(const Triangulation<2> &triangulation, std::vector<LeverProperties> properties, const bool swings)
      : body(triangulation, properties.front().body)
      , ports(static_ports(body, properties.front(), static_cast<unsigned int>(properties.size())))
      , structure(make_structure(body, properties.front(), ports))
      , excess(ports, properties.front().spring.law, swings, 0.)
      , joint_is_free(swings)
  {
    for (auto &of_lever : properties)
      levers.emplace_back(body, ports, std::move(of_lever));
  }

  State LeverModel::initial_state(const DrivePoint &drive) const
  {
    State state;
    state.drive = drive;
    state.coordinates.reinit(std::visit([](const auto &s) { return s.n_coordinates(); }, structure));
    for (unsigned int i = 0; i < levers.size(); ++i)
      state.coordinates[rotation(i)] = levers[i].properties.ideal_theta(drive.x) - levers[i].properties.spring.rest;
    return state;
  }

  State LeverModel::begin_step(const State &accepted, const DrivePoint &end)
  {
    State trial    = accepted;
    trial.drive    = end;
    const double u = support_displacement(accepted);
    for (unsigned int i = 0; i < levers.size(); ++i)
    {
      const auto &ideal = levers[i].properties.ideal_theta;
      trial.coordinates[rotation(i)] += ideal(end.x - u) - ideal(accepted.drive.x - u);
    }
    start        = accepted.drive;
    begin_forces = accepted.forces;
    begin        = port_displacements(accepted);
    if (auto *const linear = std::get_if<StaticStructure>(&structure))
    {
      linear->enter(reachable(trial));
      linear->set_faces(begin_forces, begin);
      linear->set_faces(begin_forces, trial.coordinates);
    }
    return trial;
  }

  Vector<double> LeverModel::port_displacements(const State &state) const
  {
    return std::visit([&](const auto &s) -> Vector<double> { return s.port_displacements(state.coordinates); }, structure);
  }

  /// Ports within reach of the contacts in a step that ends near `trial`, and those of the forces it begins with.
  PortSelection LeverModel::reachable(const State &trial)
  {
    std::vector<unsigned int> result = begin_forces.ports;
    const double begin_x             = start.x - (ports.sprung ? begin[ports.support()] : 0.);
    const double x                   = trial.drive.x - support_displacement(trial);
    for (unsigned int i = 0; i < levers.size(); ++i)
    {
      const auto &properties = levers[i].properties;
      const double theta     = properties.spring.rest + turns(trial)[i];
      const double travel =
          properties.centre(x, theta).xi - properties.centre(begin_x, properties.spring.rest + begin[ports.rotation(i)]).xi;
      for (const unsigned int port : levers[i].contact.reachable_ports(x, { { theta } }, std::abs(travel)))
        result.push_back(joined_port(ports, i, port));
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  Unbalance LeverModel::evaluate(State &trial, const FrictionMode mode)
  {
    evaluate_contacts(trial, mode);
    excess.add_forces(turns(trial), !forces.ports.empty(), forces);
    trial.forces   = { forces.ports, forces.values };
    double overlap = 0.;
    for (const auto &lever : levers)
      overlap = std::max(overlap, lever.found.overlap());
    return { std::visit([&](auto &s) { return s.unbalance(trial.coordinates, forces); }, structure), overlap };
  }

  void LeverModel::evaluate_contacts(State &trial, const FrictionMode mode)
  {
    const auto end = port_displacements(trial);
    std::vector<const PortForces *> of_levers;
    bool within_reach = true;
    for (unsigned int i = 0; i < levers.size(); ++i)
    {
      auto &lever     = levers[i];
      lever.memory    = memory_of_lever(i, n_face_points(), trial.contact);
      auto terms      = static_terms(lever.properties.friction, lever.properties.geometry, start, trial.drive, mode);
      terms.augmented = lever.properties.contact.enforcement == Enforcement::augmented_lagrangian;
      const Kinematic from{ ports_of_lever(ports, i, begin), {}, {} };
      const StepWeights weights{ trial.drive.time - start.time, 0., 0., 0., 0. };
      lever.contact.evaluate(PortStep{ start, lever.memory, trial.drive, from, ports_of_lever(ports, i, end), {}, weights },
                             lever.found, terms);
      of_levers.push_back(&lever.found.forces);
      within_reach = within_reach && lever.found.within_reach;
    }
    if (!within_reach)
      return widen_reach(trial, mode);
    join_forces(ports, of_levers, forces);
  }

  /// Evaluates again with more ports, which begin with what the forces there make of them.
  void LeverModel::widen_reach(State &trial, const FrictionMode mode)
  {
    for (auto &lever : levers)
      lever.contact.widen_reach();
    auto &linear       = std::get<StaticStructure>(structure);
    const auto entered = linear.enter(reachable(trial));
    linear.set_faces(begin_forces, begin);
    for (const unsigned int port : entered)
      trial.coordinates[port] = begin[port];
    evaluate_contacts(trial, mode);
  }

  Vector<double> LeverModel::correction()
  {
    return std::visit([&](auto &s) { return s.correction(forces); }, structure);
  }

  unsigned int LeverModel::rotation(const unsigned int lever) const
  {
    return std::visit([&](const auto &s) { return s.coordinate(ports.rotation(lever)); }, structure);
  }

  OfLevers LeverModel::turns(const State &state) const
  {
    OfLevers result{};
    for (unsigned int i = 0; i < levers.size(); ++i)
      result[i] = state.coordinates[rotation(i)];
    return result;
  }

  /// u along x [mm].
  double LeverModel::support_displacement(const State &state) const
  {
    return ports.sprung ? std::visit([&](const auto &s) { return state.coordinates[s.coordinate(ports.support())]; }, structure)
                        : 0.;
  }

  double LeverModel::movement(const Vector<double> &correction) const
  {
    Vector<double> in_lengths = correction;
    for (unsigned int i = 0; i < levers.size(); ++i)
      in_lengths[rotation(i)] *= levers[i].properties.spring.arm;
    return std::visit([&](const auto &s) { return s.largest(in_lengths); }, structure);
  }

  double LeverModel::length_scale() const
  {
    return levers.front().properties.spring.arm;
  }

  double LeverModel::penetration() const
  {
    double largest = 0.;
    for (const auto &lever : levers)
      largest = std::max(largest, lever.properties.contact.enforcement == Enforcement::penalty
                                      ? lever.found.penetration()
                                      : lever.multipliers.largest_change(lever.found.points, lever.memory) /
                                            lever.contact.penalties().normal);
    return largest;
  }

  std::string LeverModel::objection(const State &trial) const
  {
    for (unsigned int i = 0; i < levers.size(); ++i)
      if (const auto found = objection(levers[i], trial.drive); !found.empty())
        return (i == 0 ? "" : "of the pair's second lever, ") + found;
    return {};
  }

  std::string LeverModel::objection(const Lever &lever, const DrivePoint &drive) const
  {
    Row row;
    observe_resultants(body, lever.found, row);
    if (const auto locks = locking_objection(row, lever.properties.interface_offset, drive); !locks.empty())
      return locks;

    if (const auto beyond = lever.found.objection(); !beyond.empty())
      return beyond;

    // A linear material knows no limit of its own.
    if (lever.properties.body.material == MaterialModel::linear)
      return pressure_objection(lever.found.overlap() * lever.contact.penalties().normal, body.friction_face().young_modulus);
    return {};
  }

  std::vector<ContactMemory> LeverModel::joined(const std::function<std::vector<ContactMemory>(const Lever &)> &memory) const
  {
    if (levers.size() == 1)
      return memory(levers[0]);
    return joined_memory(n_face_points(), memory(levers[0]), memory(levers[1]));
  }

  void LeverModel::augment(State &trial) const
  {
    trial.contact = joined([](const Lever &lever) { return lever.multipliers.augmented(lever.found.points); });
  }

  void LeverModel::remember(State &state) const
  {
    state.contact = joined(
        [](const Lever &lever)
        {
          return lever.properties.contact.enforcement == Enforcement::augmented_lagrangian
                     ? lever.multipliers.augmented(lever.found.points)
                     : lever.found.memory();
        });
  }

  void LeverModel::observe(const State &trial, Row &row) const
  {
    observe_levers(
        static_cast<unsigned int>(levers.size()),
        [&](const unsigned int lever, Row &of_lever) { observe(lever, trial, of_lever); }, row);
    if (joint_is_free)
      row[Column::spring_energy] = 2. * levers[0].properties.spring.law.energy(0.5 * (turns(trial)[0] + turns(trial)[1]));
  }

  void LeverModel::observe(const unsigned int index, const State &trial, Row &row) const
  {
    const auto &[properties, contact, multipliers, memory, found] = levers[index];
    const double turn                                             = turns(trial)[index];
    const double theta                                            = properties.spring.rest + turn;
    const double u                                                = support_displacement(trial);
    row[Column::theta]                                            = theta;
    row[Column::spring_energy]                                    = properties.spring.law.energy(turn);
    observe_face(body, found, properties.layer_thickness, row);
    row[Column::centre_offset]        = row[Column::s] - properties.centre(trial.drive.x - u, theta).xi;
    row[Column::Q]                    = row[Column::P] * std::sin(theta) + row[Column::F] * std::cos(theta);
    row[Column::support_displacement] = u;
    const double support              = properties.support_stiffness.value_or(0.);
    row[Column::Q_support]            = ports.sprung ? support * u : row[Column::Q];
    row[Column::support_energy]       = 0.5 * support * u * u;
    row[Column::elastic_energy] += cylinder_energy(found);
    if (properties.body.material != MaterialModel::linear)
      row[Column::elastic_energy] = body.energy(body_displacements(trial)[index]);
    if (!body.connectors().empty())
      row.sensor_forces =
          std::visit([&](const auto &s) { return s.sensor_forces(index, trial.coordinates, trial.forces); }, structure);
  }

  /// Of a linear one: half the work of its forces [mJ].
  double LeverModel::cylinder_energy(const FaceEvaluation &found) const
  {
    const auto first = 2 * static_cast<unsigned int>(body.friction_face().nodes.size());
    const auto &on   = found.forces;
    double result    = 0.;
    for (unsigned int i = 0; i < on.ports.size(); ++i)
      if (on.ports[i] >= first && on.ports[i] < ports.surface)
        result += 0.5 * on.values[i] * found.displacement[on.ports[i]];
    return result;
  }

  unsigned int LeverModel::n_face_points() const
  {
    return static_cast<unsigned int>(body.friction_face().points.size());
  }

  FacePoints LeverModel::face_points() const
  {
    return sprag::face_points(body);
  }

  FaceState LeverModel::face_state(const State &trial) const
  {
    const auto of_lever = [&](const Lever &lever) { return sprag::face_state(body, lever.found, trial.drive); };
    return levers.size() == 1 ? of_lever(levers[0]) : joined_faces(of_lever(levers[0]), of_lever(levers[1]));
  }

  void LeverModel::visit_history(Archive &archive)
  {
    for (auto &lever : levers)
      lever.contact.visit_history(archive);
    std::visit([&](auto &s) { s.visit_history(archive); }, structure);
  }

  void LeverModel::use_penalties(const ContactPenalties &penalties)
  {
    for (auto &lever : levers)
      lever.contact.use_penalties(penalties);
  }

  const ContactPenalties &LeverModel::penalties() const
  {
    return levers.front().contact.penalties();
  }

  const ElasticBody<2> &LeverModel::elastic_body() const
  {
    return body;
  }

  std::vector<Vector<double>> LeverModel::body_displacements(const State &state) const
  {
    std::vector<Vector<double>> result;
    for (unsigned int i = 0; i < levers.size(); ++i)
      result.push_back(
          std::visit([&](const auto &s) { return s.body_displacement(i, state.coordinates, state.forces); }, structure));
    return result;
  }
} // namespace sprag
