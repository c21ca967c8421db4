// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_lever.h"

#include "base/ranges.h"
#include "base/text.h"
#include "fe/contact/face_contact.h"
#include "fe/statics/contact_penalties.h"
#include "laws/friction_law.h"
#include "model/structure/joined_interfaces.h"
#include "scene/closed_form.h"
#include "scene/device.h"
#include "scene/lever_shape.h"
#include "scene/mirrored_pair.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  /// The terms that a step without inertia adds to the contact. With the damper's `geometry` friction takes the speeds of sliding
  /// of a rigid lever at the end of the step, see StaticTerms, without it their means over the step. In the cone mode nothing has
  /// been rubbed yet where no time has passed.
  StaticTerms static_terms(const FrictionLaw &friction, const Geometry *geometry, const DrivePoint &begin, const DrivePoint &end,
                           const FrictionMode mode)
  {
    constexpr double least_ratio = 1e-6;
    const double duration        = end.time - begin.time;
    StaticTerms result{ step_friction(friction, end.v), duration, mode };
    // A step holds no mass against a mu that falls with the speed of single points: it takes that of a rigid lever.
    if (falls_with_speed(result.friction))
    {
      const double speed = geometry ? sliding_speed(*geometry, end.x, end.v) : end.v;
      result.friction    = friction_at_speed(friction, speed);
    }
    if (duration == 0.)
    {
      if (mode == FrictionMode::cone)
        result.friction = { CoulombFriction{ 0. } };
      result.duration = 1.;
      return result;
    }
    if (!geometry || end.x == begin.x)
      return result;
    const auto from    = kinematics(*geometry, begin.x);
    const auto to      = kinematics(*geometry, end.x);
    result.travel      = to.s - from.s;
    const double slid  = -result.travel - geometry->cylinder_radius * (to.theta - from.theta);
    result.speed_ratio = std::max(least_ratio, sliding_speed(*geometry, end.x, end.v) * duration / slid);
    result.duration /= result.speed_ratio;
    return result;
  }

  namespace
  {
    /// Slopes of the cylinder's axis that a scene may have.
    constexpr double largest_slope = 0.1;

    // The following functions differ between plane and space.

    ElasticBody<2> make_body(const Triangulation<2> &triangulation, const LeverProperties &properties)
    {
      return ElasticBody<2>(triangulation, properties.body);
    }

    const SolidBody &make_body(const SolidBody &body, const LeverProperties &)
    {
      return body;
    }

    template <class Body>
    InterfaceLayout make_layout(const Body &body, const std::vector<LeverProperties> &levers)
    {
      InterfaceLayout result{ static_cast<unsigned int>(surface_dofs(body).size()),
                              levers.front().support_stiffness.has_value() };
      result.levers      = static_cast<unsigned int>(levers.size());
      result.has_inertia = false;
      result.slopes      = count_slopes(body, levers.front().cylinder);
      return result;
    }

    LeverParts<2>::Structure make_structure(const ElasticBody<2> &body, const LeverProperties &properties,
                                            const InterfaceLayout &layout, const JointSprings &springs,
                                            const std::array<double, 2> &)
    {
      using Structure = LeverParts<2>::Structure;
      if (properties.solution == Solution::automatic && properties.body.material == MaterialModel::linear)
        return Structure(std::in_place_type<StaticStructure>, body, layout, springs);
      return Structure(std::in_place_type<FullStiffness>, body, layout, springs);
    }

    LeverParts<3>::Structure make_structure(const SolidBody &body, const LeverProperties &, const InterfaceLayout &layout,
                                            const JointSprings &springs, const std::array<double, 2> &surroundings)
    {
      return LeverParts<3>::Structure(std::in_place_type<SolidStructure>, body, surroundings[0], surroundings[1], layout,
                                      springs);
    }

    JointSprings make_springs(const LeverProperties &properties)
    {
      return { properties.spring.law.linear_stiffness(), properties.support_stiffness.value_or(0.), properties.spring.arm,
               properties.cylinder.slope_compliances(), 0.5 * properties.body.width };
    }
  } // namespace

  template <int dim>
  StaticLever<dim>::Lever::Lever(const typename Parts::Body &body, const InterfaceLayout &layout, LeverProperties lever)
      : properties(std::move(lever))
      , contact(body.friction_face(),
                face_properties(body, properties, layout,
                                contact_penalties(body, properties.contact, properties.layer_thickness, properties.penalty_factor,
                                                  properties.longest_face)),
                body.cylinder_face())
  {
  }

  template <int dim>
  StaticLever<dim>::StaticLever(const typename Parts::Source &source, const Device &device)
      : StaticLever(source, all_lever_properties(device), swings(device),
                    dim == 3 ? contact_surroundings(device) : std::array<double, 2>{})
  {
  }

  template <int dim>
  StaticLever<dim>::StaticLever(const typename Parts::Source &source, LeverProperties properties)
      : StaticLever(source, std::vector<LeverProperties>{ std::move(properties) }, false, {})
  {
  }

  template <int dim>
  StaticLever<dim>::StaticLever(const typename Parts::Source &source, std::vector<LeverProperties> properties, const bool swings,
                                const std::array<double, 2> &surroundings)
      : own_body(make_body(source, properties.front()))
      , layout(make_layout(own_body, properties))
      , springs(make_springs(properties.front()))
      , own_structure(make_structure(own_body, properties.front(), layout, springs, surroundings))
      , face_lines(lines_along(own_body.friction_face()))
      , multipliers(own_body.friction_face())
      , excess(layout, mapped(properties, [](const LeverProperties &lever) { return lever.spring.law; }), swings, 0.)
      , joint_is_free(swings)
  {
    for (auto &lever_data : properties)
      levers.emplace_back(own_body, layout.single_lever(), std::move(lever_data));
  }

  template <int dim>
  State StaticLever<dim>::initial_state(const DrivePoint &drive) const
  {
    State state;
    state.drive = drive;
    state.coordinates.reinit(std::visit([](const auto &s) { return s.n_coordinates(); }, own_structure));
    for (unsigned int i = 0; i < layout.levers; ++i)
      state.coordinates[rotation(i)] = levers[i].properties.ideal_theta(drive.x) - levers[i].properties.spring.rest;
    return state;
  }

  template <int dim>
  Step StaticLever<dim>::begin_step(const State &accepted, const DrivePoint &end)
  {
    Step step{ accepted, accepted.drive, accepted.forces, interface_displacements(accepted.coordinates), {} };
    step.trial.drive = end;
    const double u   = support_displacement(step.displacements);
    for (unsigned int i = 0; i < layout.levers; ++i)
    {
      const auto &ideal = levers[i].properties.ideal_theta;
      step.trial.coordinates[rotation(i)] += ideal(end.x - u) - ideal(accepted.drive.x - u);
    }
    if (!has_candidates())
      return step;
    look_at(step);
    if (levers.front().properties.body.material == MaterialModel::linear && !accepted.forces.dofs.empty())
      shift_faces(step);
    return step;
  }

  /// Guesses that the displacements of the friction faces travel along them with the contact, u(xi) = u_begin(xi - travel),
  /// linear between the nodes of a line. Newton's method then begins near the contact that it ends with. A guess without contact
  /// is dropped: its correction would return the lever to rest, deep in the cylinder.
  template <int dim>
  void StaticLever<dim>::shift_faces(Step &step)
  {
    const auto unmoved = step.trial.coordinates;
    const auto end     = interface_displacements(unmoved);
    const auto &nodes  = own_body.friction_face().nodes;
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
    {
      const double distance = travel(lever, step, end);
      for (const auto &line : face_lines)
      {
        std::vector<unsigned int> dofs; // the first of each node that is looked at
        std::vector<double> xi;
        for (const unsigned int node : line)
          if (const unsigned int dof = layout.first(lever) + dim * node;
              std::binary_search(step.near.begin(), step.near.end(), dof))
          {
            dofs.push_back(dof);
            xi.push_back(nodes[node].position[0]);
          }
        for (std::size_t i = 0; i < dofs.size(); ++i)
        {
          const double from = xi[i] - distance;
          const auto after  = std::upper_bound(xi.begin(), xi.end(), from) - xi.begin();
          if (after == 0 || after == static_cast<std::ptrdiff_t>(xi.size()))
            continue;
          const double share = (from - xi[after - 1]) / (xi[after] - xi[after - 1]);
          for (unsigned int d = 0; d < dim; ++d)
            step.trial.coordinates[dofs[i] + d] =
                (1. - share) * step.displacements[dofs[after - 1] + d] + share * step.displacements[dofs[after] + d];
        }
      }
    }
    Balance found;
    const bool is_near = evaluate_levers(step, FrictionMode::cone, found);
    const auto touches = [](const Found &lever) { return lever.contact.penetration() > 0.; };
    if (!is_near || !std::all_of(found.levers.begin(), found.levers.end(), touches))
      step.trial.coordinates = unmoved;
  }

  /// Returns how far the contact's centre travels along a lever's face up to the trial state [mm].
  template <int dim>
  double StaticLever<dim>::travel(const unsigned int lever, const Step &step, const Vector<double> &end) const
  {
    const auto &properties = levers[lever].properties;
    const auto centre      = [&](const double x, const Vector<double> &displacements)
    {
      const double theta = properties.spring.rest + displacements[layout.rotation(lever)];
      return properties.centre(x - support_displacement(displacements), theta).xi;
    };
    return centre(step.trial.drive.x, end) - centre(step.start.x, step.displacements);
  }

  /// Makes contacts and step look at the candidate dofs of the contacts. New ones of a face begin at the displacements by the
  /// forces there.
  template <int dim>
  void StaticLever<dim>::look_at(Step &step)
  {
    const auto before     = step.near;
    const auto end        = interface_displacements(step.trial.coordinates);
    const double relative = step.trial.drive.x - support_displacement(end);
    candidates            = step.forces.dofs;
    for (unsigned int i = 0; i < layout.levers; ++i)
    {
      auto &[properties, contact] = levers[i];
      const double theta          = properties.spring.rest + end[layout.rotation(i)];
      const auto to_joined        = [&](const unsigned int dof) { return joined_dof(layout, i, dof); };
      const auto near             = contact.candidate_dofs(relative, { { theta } }, travel(i, step, end));
      candidates                  = united(candidates, mapped(near, to_joined));
    }
    step.near = candidates;
    std::visit(
        [&](auto &s)
        {
          if constexpr (std::decay_t<decltype(s)>::has_candidates)
            s.set_faces(step.forces, step.near, step.displacements);
        },
        own_structure);
    for (const unsigned int dof : step.near)
      if (layout.is_surface(dof) && !std::binary_search(before.begin(), before.end(), dof))
        step.trial.coordinates[dof] = step.displacements[dof];
  }

  template <int dim>
  Evaluation StaticLever<dim>::evaluate(Step &step, const FrictionMode mode)
  {
    Balance found;
    if (has_candidates() && step.near != candidates)
      look_at(step);
    evaluate_contacts(step, mode, found);
    excess.add_forces(turns(step.trial), !found.forces.dofs.empty(), found.forces);
    step.trial.forces = found.forces;
    found.near        = step.near;
    found.residual =
        std::visit([&](auto &s) { return s.residual(step.trial.coordinates, found.forces, found.near); }, own_structure);
    const double penetration = largest(found.levers, [](const auto &lever) { return lever.contact.penetration(); });
    return { found.residual.norm, penetration, std::move(found) };
  }

  /// Evaluates the contact of each lever. Returns whether they are within the candidates.
  template <int dim>
  bool StaticLever<dim>::evaluate_levers(const Step &step, const FrictionMode mode, Balance &found)
  {
    const auto &trial      = step.trial;
    const auto end         = interface_displacements(trial.coordinates);
    bool within_candidates = true;
    found.levers.resize(layout.levers);
    for (unsigned int i = 0; i < layout.levers; ++i)
    {
      auto &[properties, lever] = levers[i];
      auto &[history, contact]  = found.levers[i];

      history = lever_history(i, n_face_points(), trial.contact);
      auto terms =
          static_terms(properties.friction, properties.is_damper ? &properties.geometry : nullptr, step.start, trial.drive, mode);
      terms.augmented = augments();
      const Kinematic begin{ extract_lever(layout, i, step.displacements), {}, {} };
      const auto own_end = extract_lever(layout, i, end);
      const StepWeights weights{ trial.drive.time - step.start.time, 0., 0., 0., 0. };
      const Vector<double> no_rates;
      lever.evaluate(InterfaceStep{ step.start, history, trial.drive, begin, own_end, no_rates, weights }, contact, terms);
      within_candidates = within_candidates && contact.within_candidates;
    }
    return within_candidates;
  }

  template <int dim>
  void StaticLever<dim>::evaluate_contacts(Step &step, const FrictionMode mode, Balance &found)
  {
    if (evaluate_levers(step, mode, found))
      return join_forces(layout, mapped(found.levers, [](const Found &lever) { return &lever.contact.forces; }), found.forces);
    for (auto &lever : levers)
      lever.contact.widen_candidates();
    look_at(step);
    evaluate_contacts(step, mode, found);
  }

  template <int dim>
  Vector<double> StaticLever<dim>::correction(const Evaluation &evaluation)
  {
    const auto &[found, forces, near, residual] = get_balance(evaluation);
    return std::visit([&, &f = forces, &n = near, &r = residual](auto &s) { return s.correction(r, f, n); }, own_structure);
  }

  template <int dim>
  double StaticLever<dim>::movement(const Vector<double> &correction) const
  {
    Vector<double> in_lengths = correction;
    for (unsigned int i = 0; i < layout.levers; ++i)
      in_lengths[rotation(i)] *= springs.arm;
    for (unsigned int i = 0; i < layout.slopes; ++i)
      in_lengths[layout.slope(i)] *= springs.slope_arm;
    return in_lengths.linfty_norm();
  }

  template <int dim>
  double StaticLever<dim>::penetration(const Evaluation &evaluation) const
  {
    if (!augments())
      return evaluation.penetration;
    double result = 0.;
    for (const auto &[history, contact] : get_balance(evaluation).levers)
      result = std::max(result, multipliers.largest_change(contact.points, history) / penalties().normal);
    return result;
  }

  template <int dim>
  std::string StaticLever<dim>::check_validity(const State &state, const Evaluation &evaluation) const
  {
    for (unsigned int i = 0; i < layout.levers; ++i)
      if (const auto found = check_validity(i, state.drive, get_balance(evaluation).levers[i].contact); !found.empty())
        return (i == 0 ? "" : "of the pair's second lever, ") + found;
    return {};
  }

  template <int dim>
  std::string StaticLever<dim>::check_validity(const unsigned int lever, const DrivePoint &drive,
                                               const FaceEvaluation<dim> &found) const
  {
    const auto &[properties, contact] = levers[lever];
    if (const auto beyond = found.check_validity(); !beyond.empty())
      return beyond;
    Row row;
    contact.observe_resultants(found, row);
    // A linear material knows no limit of its own.
    const double pressure = found.penetration() * penalties().normal;
    if (const auto beyond = check_pressure(pressure, own_body.friction_face().young_modulus);
        properties.body.material == MaterialModel::linear && !beyond.empty())
      return check_locking(row, properties.interface_offset, drive) + beyond;
    if constexpr (dim == 3)
      if (const auto [tilt, skew] = contact.slopes_in(found); std::max(std::abs(tilt), std::abs(skew)) > largest_slope)
        return "the shaft lets the cylinder's axis turn to the slopes " + rounded_text(tilt) + " (tilt) and " +
               rounded_text(skew) + " (skew), of which " + rounded_text(largest_slope) +
               " are the most that is looked at. Try a larger Cylinder/Tilt stiffness or Skew stiffness";
    return {};
  }

  /// Joins the histories that `history`(lever) returns.
  template <int dim>
  typename StaticLever<dim>::History StaticLever<dim>::joined(const std::function<History(std::size_t)> &history) const
  {
    return layout.levers == 1 ? history(0) : joined_history(n_face_points(), history(0), history(1));
  }

  template <int dim>
  typename StaticLever<dim>::History StaticLever<dim>::augmented(const Evaluation &evaluation) const
  {
    const auto &found = get_balance(evaluation).levers;
    return joined([&](const std::size_t lever) { return multipliers.augmented(found[lever].contact.points); });
  }

  template <int dim>
  void StaticLever<dim>::store_history(const Evaluation &evaluation, State &state) const
  {
    const auto &found = get_balance(evaluation).levers;
    state.contact =
        augments() ? augmented(evaluation) : joined([&](const std::size_t lever) { return found[lever].contact.history(); });
  }

  template <int dim>
  void StaticLever<dim>::observe(const State &state, const Evaluation &evaluation, Row &row) const
  {
    const auto &found = get_balance(evaluation).levers;
    observe(0, state, found[0].contact, row);
    if (layout.levers == 2)
    {
      Row second;
      second[Column::friction_work] = 0.;
      second[Column::drive_work]    = 0.;
      observe(1, state, found[1].contact, second);
      row.add_second_lever(second);
    }
    if (joint_is_free)
      row[Column::spring_energy] = 2. * levers[0].properties.spring.law.energy(0.5 * (turns(state)[0] + turns(state)[1]));
  }

  template <int dim>
  void StaticLever<dim>::observe(const unsigned int lever, const State &state, const FaceEvaluation<dim> &found, Row &row) const
  {
    const auto &[properties, contact] = levers[lever];

    const double turn          = turns(state)[lever];
    const double theta         = properties.spring.rest + turn;
    const double u             = support_displacement(interface_displacements(state.coordinates));
    const double support       = properties.support_stiffness.value_or(0.);
    row[Column::theta]         = theta;
    row[Column::spring_energy] = properties.spring.law.energy(turn);
    const auto sensor_forces =
        std::visit([&](const auto &s) { return s.sensor_forces(lever, state.coordinates, state.forces); }, own_structure);
    if constexpr (dim == 2)
    {
      contact.observe(found, row);
      row.sensor_forces = sensor_forces;
    }
    else
    {
      contact.observe_contact(found, row);
      observe_sensors(sensor_forces, own_body.is_half(), row);
      row[Column::indentation] = std::get<SolidStructure>(own_structure)
                                     .displacement(lever, contact.indentation_shares(row), state.coordinates, state.forces);
    }
    row[Column::centre_offset]        = row[Column::s] - properties.centre(state.drive.x - u, theta).xi;
    row[Column::Q]                    = row[Column::P] * std::sin(theta) + row[Column::F] * std::cos(theta);
    row[Column::support_displacement] = u;
    row[Column::Q_support]            = layout.sprung ? support * u : row[Column::Q];
    row[Column::support_energy]       = 0.5 * support * u * u;
    const bool is_linear              = properties.body.material == MaterialModel::linear;
    if (!is_linear)
      row[Column::elastic_energy] = own_body.energy(body_displacements(state.coordinates, state.forces)[lever]);
    if (is_linear || dim == 3) // a body in a plane has its elastic cylinder
      row[Column::elastic_energy] += cylinder_energy(lever, state);
  }

  /// Returns the energy of a linear elastic cylinder or of the rigid one's shaft [mJ]: half of the work of the interface forces
  /// on it.
  template <int dim>
  double StaticLever<dim>::cylinder_energy(const unsigned int lever, const State &state) const
  {
    const auto displacements = interface_displacements(state.coordinates);
    const auto &on           = state.forces;
    const unsigned int first = layout.first(lever) + dim * static_cast<unsigned int>(own_body.friction_face().nodes.size());
    double result            = 0.;
    for (unsigned int i = 0; i < on.dofs.size(); ++i)
      if (on.dofs[i] >= first && on.dofs[i] < layout.rotation(lever))
        result += 0.5 * on.values[i] * displacements[on.dofs[i]];
    return result;
  }

  template <int dim>
  FaceState StaticLever<dim>::face_state(const State &state, const Evaluation &evaluation) const
  {
    const auto lever_faces = [&](const std::size_t lever)
    { return levers[lever].contact.face_state(get_balance(evaluation).levers[lever].contact, state.drive); };
    return layout.levers == 1 ? lever_faces(0) : joined_faces(lever_faces(0), lever_faces(1));
  }

  template class StaticLever<2>;
  template class StaticLever<3>;
} // namespace sprag
