#include "fe/statics/lever_model.h"

#include "base/text.h"
#include "fe/contact/face_observation.h"
#include "fe/statics/static_terms.h"
#include "scene/closed_form.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Over E/depth of the layer. The overlap is then a tenth of the layer's compression, which moves P by 0.03 % and the largest
    /// pressure by 3 %.
    constexpr double penalty_factor = 12.;

    /// Leaves 0.25 % of the largest pressure where the cells are as fine as that takes.
    constexpr double largest_penalty_factor = 200.;

    /// Over E/length of the cells, of degree 2. Much stiffer penalties make a contact narrower than the cells, which then tilts
    /// with each of them. Linear cells meet a circle with their chords, whose pressures would show.
    constexpr double penalty_over_cells = 12.5;

    double automatic_penalty(const FrictionFace<2> &face, const Enforcement enforcement, const double layer_thickness)
    {
      const double by_layer = penalty_factor * face.young_modulus / std::max(face.depth, layer_thickness);
      if (face.edges.front().nodes.size() == 2)
        return by_layer;
      const auto shorter    = [](const FacePatch &a, const FacePatch &b) { return a.length < b.length; };
      const double length   = std::min_element(face.patches.begin(), face.patches.end(), shorter)->length;
      const double by_cells = std::max(by_layer, penalty_over_cells * face.young_modulus / length);
      if (enforcement == Enforcement::augmented_lagrangian)
        return by_cells;
      return std::min(by_cells, largest_penalty_factor / penalty_factor * by_layer);
    }

    /// Compression of the friction face beyond which linear elasticity says nothing.
    constexpr double largest_strain = 0.5;

    bool has_elastic_cylinder(const ElasticBody<2> &body)
    {
      return !body.cylinder_face().patches.empty();
    }

    PortLayout static_ports(const ElasticBody<2> &body, const LeverProperties &properties)
    {
      PortLayout result{ static_cast<unsigned int>(surface_dofs(body).size()), properties.support_stiffness.has_value() };
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
               contact_penalties(body, properties.contact, properties.layer_thickness, properties.penalty_factor),
               properties.friction,
               properties.layer_thickness };
    }

    std::variant<FaceCompliance, FullStiffness> make_system(const ElasticBody<2> &body, const LeverProperties &properties,
                                                            const PortLayout &ports)
    {
      using System = std::variant<FaceCompliance, FullStiffness>;
      const PortSprings springs{ properties.spring.law.linear_stiffness(), properties.support_stiffness.value_or(0.),
                                 properties.spring.arm };
      if (properties.solution == Solution::automatic && properties.body.material == MaterialModel::linear)
        return System(std::in_place_type<FaceCompliance>, body, ports, springs);
      return System(std::in_place_type<FullStiffness>, body, ports, springs);
    }

    std::vector<ConnectorSettings> plate_connectors(const FrictionPlate &plate)
    {
      if (plate.type == PlateType::none)
        return {};
      std::vector<ConnectorSettings> result;
      for (const double middle : plate.sensors)
        result.push_back({ ConnectorType::sensor, middle, plate.sensor_length, plate.sensor_stiffness });
      result.push_back({ ConnectorType::guide, plate.guide, plate.sensor_length, plate.guide_stiffness });
      return result;
    }
  } // namespace

  ContactPenalties contact_penalties(const FrictionFace<2> &face, const ContactSettings &settings, const double layer_thickness,
                                     const std::optional<double> &over_layer)
  {
    const double automatic = over_layer && settings.enforcement == Enforcement::penalty
                                 ? *over_layer * face.young_modulus / std::max(face.depth, layer_thickness)
                                 : automatic_penalty(face, settings.enforcement, layer_thickness);
    const double normal    = settings.penalty.value_or(automatic);
    return { normal, settings.tangential_penalty.value_or(normal) };
  }

  ContactPenalties contact_penalties(const ElasticBody<2> &body, const ContactSettings &settings, const double layer_thickness,
                                     const std::optional<double> &over_layer)
  {
    const auto lever = contact_penalties(body.friction_face(), settings, layer_thickness, over_layer);
    if (!has_elastic_cylinder(body))
      return lever;
    const auto cylinder = contact_penalties(body.cylinder_face(), settings, 0., over_layer);
    return { std::min(lever.normal, cylinder.normal), std::min(lever.tangential, cylinder.tangential) };
  }

  LeverProperties lever_properties(const Scene &scene)
  {
    LeverProperties result;
    result.body.degree   = scene.mesh.degree;
    result.body.plane    = scene.analysis.plane;
    result.body.material = scene.lever.material;
    result.body.width    = scene.lever.width;
    const ElasticConstants metal{ scene.lever.young_modulus, scene.lever.poisson_ratio };
    result.body.constants  = { { material_id::lever, metal },
                               { material_id::web, metal },
                               { material_id::plate, { scene.plate.young_modulus, scene.plate.poisson_ratio } },
                               { material_id::layer, { scene.layer.young_modulus, scene.layer.poisson_ratio } } };
    result.body.widths     = { { material_id::web, scene.frame.web } };
    result.body.connectors = plate_connectors(scene.plate);

    if (scene.cylinder.type != CylinderType::rigid)
      result.body.constants[material_id::cylinder] = { scene.cylinder.young_modulus, scene.cylinder.poisson_ratio };
    result.body.curved = scene.cylinder.type != CylinderType::rigid;

    // Half a spacing off, the direction of a contact narrower than it is wrong by 1/8000 at most.
    result.body.point_spacing = scene.geometry.cylinder_radius / 4000.;

    const Geometry geometry = scene.geometry;
    result.obstacle         = cylinder(geometry);
    result.centre           = [geometry](double x, double theta) { return cylinder_centre(geometry, x, theta); };
    result.radius           = geometry.cylinder_radius;
    result.ideal_theta      = [geometry](double x) { return kinematics(geometry, x).theta; };
    const auto &law         = scene.spring.behaviour.law;
    result.spring           = { law.is_linear() ? MomentLaw(scene.spring.stiffness) : law, kinematics(geometry, 0.).theta,
                      geometry.pivot_distance };
    if (scene.support.type == SupportType::sprung)
      result.support_stiffness = scene.support.stiffness;
    result.friction         = scene.friction;
    result.contact          = scene.contact;
    result.solution         = scene.analysis.solution;
    result.layer_thickness  = scene.layer.thickness;
    result.interface_offset = geometry.interface_offset;
    result.geometry         = geometry;
    return result;
  }

  LeverModel::LeverModel(const Triangulation<2> &triangulation, LeverProperties lever)
      : properties(std::move(lever))
      , body(triangulation, properties.body)
      , ports(static_ports(body, properties))
      , contact(body, contact_properties(body, properties, ports))
      , multipliers(body.friction_face())
      , system(make_system(body, properties, ports))
      , excess(ports, properties.spring.law)
  {
  }

  State LeverModel::initial_state(const DrivePoint &drive) const
  {
    const double theta = properties.ideal_theta(drive.x);
    State state;
    state.drive = drive;
    state.coordinates.reinit(std::visit([](const auto &s) { return s.n_coordinates(); }, system));
    state.coordinates[rotation()] = theta - properties.spring.rest;
    return state;
  }

  void LeverModel::predict(State &trial, const State &accepted) const
  {
    const double u = support_displacement(accepted);
    trial.coordinates[rotation()] += properties.ideal_theta(trial.drive.x - u) - properties.ideal_theta(accepted.drive.x - u);
  }

  Unbalance LeverModel::evaluate(const State &trial, const State &accepted, const FrictionMode mode)
  {
    evaluate_contact(trial, accepted, mode);
    return unbalance(trial, excess.add_forces(contact.forces(), { { turn(trial), 0. } }));
  }

  Unbalance LeverModel::evaluate(const State &trial, const State &accepted, const FrictionMode mode, const MomentExcess &spring)
  {
    evaluate_contact(trial, accepted, mode);
    return unbalance(trial, forces_with(spring));
  }

  void LeverModel::evaluate_contact(const State &trial, const State &accepted, const FrictionMode mode)
  {
    const double duration = trial.drive.time - accepted.drive.time;
    begin                 = trial.contact;
    auto terms            = static_terms(properties.friction, properties.geometry, accepted.drive, trial.drive, mode);
    terms.augmented       = properties.contact.enforcement == Enforcement::augmented_lagrangian;
    std::visit(
        [&](const auto &s)
        {
          const Kinematic from{ s.port_displacements(accepted.coordinates), {}, {} };
          const auto &to = s.port_displacements(trial.coordinates);
          contact.evaluate(PortStep{ accepted.drive, begin, trial.drive, from, to, {}, StepWeights{ duration, 0., 0., 0., 0. } },
                           terms);
        },
        system);
  }

  Unbalance LeverModel::unbalance(const State &trial, const PortForces &loads)
  {
    forces = &loads;
    return { std::visit([&](auto &s) { return s.unbalance(trial.coordinates, loads); }, system), contact.overlap() };
  }

  const PortForces &LeverModel::forces_with(const MomentExcess &spring)
  {
    extend(contact.forces(), { ports.rotation() }, with_moment);
    const unsigned int hub = place_of(ports.rotation(), with_moment.ports);
    with_moment.values[hub] -= spring.moment;
    with_moment.tangent(hub, hub) -= spring.stiffness;
    return with_moment;
  }

  Vector<double> LeverModel::correction()
  {
    return std::visit([&](auto &s) { return s.correction(*forces); }, system);
  }

  Vector<double> LeverModel::moment_response()
  {
    return std::visit([&](auto &s) { return s.moment_response(*forces); }, system);
  }

  /// The coordinates end with hub and support.
  unsigned int LeverModel::rotation() const
  {
    const unsigned int n = std::visit([](const auto &s) { return s.n_coordinates(); }, system);
    return n - (ports.size() - ports.rotation());
  }

  double LeverModel::turn(const State &state) const
  {
    return state.coordinates[rotation()];
  }

  /// u along x [mm].
  double LeverModel::support_displacement(const State &state) const
  {
    return ports.sprung ? state.coordinates[rotation() + 1] : 0.;
  }

  double LeverModel::movement(const Vector<double> &correction) const
  {
    Vector<double> in_lengths = correction;
    in_lengths[rotation()] *= properties.spring.arm;
    return in_lengths.linfty_norm();
  }

  double LeverModel::length_scale() const
  {
    return properties.spring.arm;
  }

  double LeverModel::penetration() const
  {
    return properties.contact.enforcement == Enforcement::penalty
               ? contact.penetration()
               : multipliers.largest_change(contact.points(), begin) / contact.penalties().normal;
  }

  std::string LeverModel::objection(const State &trial) const
  {
    Row row;
    observe_resultants(contact.view(), row);
    const double s    = row[Column::s];
    const double mu_e = row[Column::mu] * properties.interface_offset;
    if (direction_of(trial.drive.v) < 0 && row[Column::F] < 0. && s <= mu_e)
      return "the lever locks: moving back, s = " + rounded_text(s) + " mm <= mu e = " + rounded_text(mu_e) + " mm";

    if (const auto beyond = contact.objection(); !beyond.empty())
      return beyond;

    // A linear material knows no limit of its own.
    const double pressure = contact.overlap() * contact.penalties().normal;
    const double limit    = largest_strain * body.friction_face().young_modulus;
    if (properties.body.material == MaterialModel::linear && pressure > limit)
      return "the pressure on the friction face exceeds " + rounded_text(limit) + " MPa, half of its Young's modulus";
    return {};
  }

  void LeverModel::augment(State &trial) const
  {
    trial.contact = multipliers.augmented(contact.points());
  }

  std::vector<ContactMemory> LeverModel::memory() const
  {
    return properties.contact.enforcement == Enforcement::augmented_lagrangian ? multipliers.augmented(contact.points())
                                                                               : contact.memory();
  }

  void LeverModel::observe(const State &trial, Row &row) const
  {
    const double theta         = properties.spring.rest + turn(trial);
    const double u             = support_displacement(trial);
    row[Column::theta]         = theta;
    row[Column::spring_energy] = properties.spring.law.energy(turn(trial));
    observe_face(contact.view(), properties.layer_thickness, row);
    row[Column::centre_offset]        = row[Column::s] - properties.centre(trial.drive.x - u, theta).xi;
    row[Column::Q]                    = row[Column::P] * std::sin(theta) + row[Column::F] * std::cos(theta);
    row[Column::support_displacement] = u;
    row[Column::Q_support]            = row[Column::Q];
    row[Column::support_energy]       = 0.;
    if (properties.support_stiffness)
    {
      row[Column::Q_support]      = *properties.support_stiffness * u;
      row[Column::support_energy] = 0.5 * *properties.support_stiffness * u * u;
    }
    row[Column::elastic_energy] += cylinder_energy();
    if (properties.body.material != MaterialModel::linear)
      row[Column::elastic_energy] = body.energy(body_displacement(trial));
    if (!body.connectors().empty())
      row.sensor_forces = std::visit([&](const auto &s) { return s.sensor_forces(trial.coordinates, contact.forces()); }, system);
  }

  /// Of a linear one: half the work of its forces [mJ].
  double LeverModel::cylinder_energy() const
  {
    const auto first = 2 * static_cast<unsigned int>(body.friction_face().nodes.size());
    const auto &on   = contact.forces();
    double result    = 0.;
    for (unsigned int i = 0; i < on.ports.size(); ++i)
      if (on.ports[i] >= first && on.ports[i] < ports.surface)
        result += 0.5 * on.values[i] * contact.displacements()[on.ports[i]];
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
    return sprag::face_state(contact.view(), trial.drive);
  }

  const ContactPenalties &LeverModel::penalties() const
  {
    return contact.penalties();
  }

  const ElasticBody<2> &LeverModel::elastic_body() const
  {
    return body;
  }

  Vector<double> LeverModel::body_displacement(const State &state) const
  {
    return std::visit([&](const auto &s) { return s.body_displacement(state.coordinates, contact.forces()); }, system);
  }

  std::function<Vector<double>()> LeverModel::recovery(const State &state) const
  {
    const PortForces loads{ contact.forces().ports, contact.forces().values, dealii::FullMatrix<double>() };
    return [this, loads, coordinates = state.coordinates]
    { return std::visit([&](const auto &s) { return s.body_displacement(coordinates, loads); }, system); };
  }
} // namespace sprag
