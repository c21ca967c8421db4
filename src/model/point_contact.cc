// SPDX-License-Identifier: GPL-3.0-only
#include "model/point_contact.h"

#include "laws/friction_of_step.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  PointContact::PointContact(PointContactProperties point_properties)
      : properties(std::move(point_properties))
      , all(all_ports(properties.ports.size()))
  {
  }

  StepKinematics<PointContact::n> PointContact::step_kinematics(const PortStep &step, const Local &end_rates,
                                                                Evaluation &found) const
  {
    const Local q_0    = coordinates(found.window, step.begin.position, step.from.x);
    const Local q_1    = coordinates(found.window, step.end, step.to.x);
    const Local change = q_1 - q_0;
    const double share = step.weights.stiffness();
    const double delay = step.weights.delay();
    const auto balance = configure(found.window, share * q_1 + (1. - share) * q_0);
    const auto &end = found.end = configure(found.window, q_1);

    StepKinematics<n> k;
    set_balance(balance, share, change, k);
    k.gap_begin          = gap(found.window, q_0);
    k.gap_end            = end.gap;
    k.gap_row_end        = end.gap_row;
    k.slip_change[0]     = balance.slip_row * change - delay * k.slip_bend[0];
    k.slip_change_row[0] = balance.slip_row + change * k.slip_curvature[0] -
                           delay * (balance.slip_curvature * change + change * balance.slip_curvature);
    k.gap_rate_end = end.gap_row * end_rates;
    k.gap_rate_row = step.weights.rate() * end.gap_row + end.gap_curvature * end_rates;
    return k;
  }

  void PointContact::evaluate(const PortStep &step, Evaluation &found) const
  {
    found.window          = window_at(step.begin.position, step.from.x);
    const Local end_rates = rates(found.window, step.end_rate, step.to.v);
    const double surface  = step.to.surface - step.from.surface;
    auto kinematics       = step_kinematics(step, end_rates, found);
    kinematics.slip_change[0] += surface;
    StepContactLaw law;
    law.normal            = properties.normal;
    law.damping           = properties.damping;
    law.slip              = { friction_of_step(properties.friction, step.to.v), properties.tangential };
    law.weights           = step.weights;
    auto &response        = found.response;
    response              = step_response(kinematics, step.memory.front(), law);
    found.slip_rate       = found.end.slip_row * end_rates + surface / step.weights.dt;
    const double of_drive = -response.force[x_index] * (step.to.x - step.from.x) + response.mean_traction[0] * surface;
    found.works           = { of_drive, response.friction, response.damping, response.algorithmic, response.creep };
    sum_forces(found);
  }

  void PointContact::evaluate_sliding(const SlidingState &state, Evaluation &found) const
  {
    const bool slides = state.friction == ContactFriction::sliding;
    found.window      = window_at(state.ports, state.drive.x);
    const auto &end = found.end = configure(found.window, coordinates(found.window, state.ports, state.drive.x));
    const Local rate            = state.rates == nullptr ? Local() : rates(found.window, *state.rates, 0.);
    const auto law              = friction_of_step(properties.friction, state.drive.v);
    using N                     = Dual<double, 2>; // of the gap and its rate
    const auto gap              = variable<N>(end.gap, 0);
    const auto spring           = spring_force(properties.normal, gap);
    const auto dashpot          = dashpot_force(properties.damping, spring, gap, variable<N>(end.gap_row * rate, 1));
    const auto pressure         = spring + dashpot;
    found.slip_rate             = state.speed + end.slip_row * rate;
    found.sliding               = slides ? sliding_friction(law, found.slip_rate) : SlidingFriction{};
    found.sticks                = slides && law.regularisation_speed == 0.;
    found.d_pressure            = pressure.d[0] * end.gap_row;
    found.d_pressure_rate       = pressure.d[1] * end.gap_row;

    auto &response                = found.response;
    response                      = {};
    response.mu                   = std::abs(found.sliding.coefficient);
    response.pressure             = pressure.v;
    response.traction[0]          = found.sliding.coefficient * response.pressure;
    response.slipping             = slides;
    response.memory.traction      = response.traction;
    response.memory.damping       = dashpot.v;
    response.memory.slip_speed[0] = state.speed;
    const double stretched        = law.regularisation_speed > 0. ? 0. : response.traction[0];
    response.energy  = spring_energy(properties.normal, end.gap) + 0.5 * stretched * stretched / properties.tangential;
    response.force   = response.pressure * end.gap_row - response.traction[0] * end.slip_row;
    response.tangent = pressure_tangent(found) + friction_tangent(state.friction, found);
    found.works      = {};
    sum_forces(found);
  }

  PointContact::LocalMatrix PointContact::pressure_tangent(const Evaluation &found)
  {
    return outer_product(found.end.gap_row, found.d_pressure) + found.response.pressure * found.end.gap_curvature;
  }

  PointContact::LocalMatrix PointContact::friction_tangent(const ContactFriction friction, const Evaluation &found) const
  {
    const auto &slip_row = found.end.slip_row;
    if (friction == ContactFriction::stuck)
      return -properties.tangential * outer_product(slip_row, slip_row);
    return -found.sliding.coefficient * outer_product(slip_row, found.d_pressure) -
           found.response.traction[0] * found.end.slip_curvature;
  }

  PortPerturbation PointContact::linearise(const SlidingState &state, Evaluation &found) const
  {
    evaluate_sliding(state, found);
    const auto places           = ports(found.window);
    const Local d_traction_rate = found.sliding.coefficient * found.d_pressure_rate +
                                  found.sliding.derivative * found.response.pressure * found.end.slip_row;
    PortPerturbation result(found.forces.ports);
    result.pressure      = matrix_on_ports(places, pressure_tangent(found));
    result.friction      = matrix_on_ports(places, friction_tangent(state.friction, found));
    result.pressure_rate = matrix_on_ports(places, outer_product(found.end.gap_row, found.d_pressure_rate));
    result.friction_rate = matrix_on_ports(places, -1. * outer_product(found.end.slip_row, d_traction_rate));
    result.delays        = friction_delays(places, d_traction_rate, found);
    return result;
  }

  std::vector<FrictionDelay> PointContact::friction_delays(const PortCoordinates &places, const Local &d_traction_rate,
                                                           const Evaluation &found) const
  {
    const double time = found.sliding.derivative * found.response.pressure / properties.tangential;
    if (!found.sticks || !(time > 0.))
      return {};
    return { { time, row_on_ports(places, -1. * found.end.slip_row),
               row_on_ports(places, found.sliding.coefficient * found.d_pressure), row_on_ports(places, d_traction_rate) } };
  }

  /// Returns the local coordinates that are ports.
  PortCoordinates PointContact::ports(const unsigned int window) const
  {
    PortCoordinates result;
    result.reserve(n);
    for (unsigned int i = 0; i < n_nodal && properties.mesh.elements > 0; ++i)
      if (window + i / 2 > 0)
        result.push_back({ i, 2 * window + i - 2, 1. });
    add_frame(properties.ports, theta_index, x_index, result);
    return result;
  }

  void PointContact::sum_forces(Evaluation &found) const
  {
    const auto places = ports(found.window);
    auto &forces      = found.forces;
    forces.values     = row_on_ports(places, found.response.force);
    forces.tangent    = matrix_on_ports(places, found.response.tangent);
    forces.ports.clear();
    for (const auto &place : places)
      forces.ports.push_back(place.port);
  }

  const PortSelection &PointContact::reachable_ports(double, const OfLevers &) const
  {
    return all;
  }

  std::vector<ContactMemory> PointContact::touch(const Vector<double> &ports, const DrivePoint &drive, Evaluation &found) const
  {
    found.window   = window_at(ports, drive.x);
    found.end      = configure(found.window, coordinates(found.window, ports, drive.x));
    found.response = {};
    return { ContactMemory{} };
  }

  double PointContact::drive_force(const Evaluation &found) const
  {
    return found.response.traction[0] * found.end.slip_at_point[3] - found.response.pressure * found.end.gap_at_point[3];
  }

  void PointContact::observe(const Evaluation &found, Row &row, unsigned int) const
  {
    const auto &end                 = found.end;
    const auto &response            = found.response;
    const auto force                = response.pressure * end.gap_at_point - response.traction[0] * end.slip_at_point;
    row[Column::P]                  = force[1];
    row[Column::F]                  = -force[0];
    row[Column::Q]                  = drive_force(found);
    row[Column::normal_resultant]   = response.pressure;
    row[Column::friction_resultant] = response.traction[0];
    row[Column::friction_power]     = response.traction[0] * found.slip_rate;
    row[Column::indentation]        = found.overlap();
    row[Column::penetration]        = 0.;
    row[Column::active_points]      = end.gap < 0. ? 1. : 0.;
    row[Column::elastic_slip]       = 0.;
    if (response.pressure > 0.)
    {
      row[Column::s]              = end.along;
      row[Column::mu]             = response.mu;
      row[Column::v_rel]          = found.slip_rate;
      row[Column::cone_violation] = std::max(0., response.traction.norm() / (response.mu * response.pressure) - 1.);
    }
  }
} // namespace sprag
