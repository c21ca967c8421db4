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

  StepKinematics<PointContact::n> PointContact::step_kinematics(const PortStep &step, const Local &end_rates)
  {
    const Local q_0    = coordinates(step.begin.position, step.from.x);
    const Local q_1    = coordinates(step.end, step.to.x);
    const Local change = q_1 - q_0;
    const double share = step.weights.stiffness();
    const double delay = step.weights.delay();
    const auto balance = configure(share * q_1 + (1. - share) * q_0);
    end                = configure(q_1);

    auto k = step_to(end, end.slip);
    set_balance(balance, share, change, k);
    k.gap_begin          = gap(q_0);
    k.slip_change[0]     = balance.slip_row * change - delay * k.slip_bend[0];
    k.slip_change_row[0] = balance.slip_row + change * k.slip_curvature[0] -
                           delay * (balance.slip_curvature * change + change * balance.slip_curvature);
    k.gap_rate_end = end.gap_row * end_rates;
    k.gap_rate_row = step.weights.rate() * end.gap_row + end.gap_curvature * end_rates;
    return k;
  }

  void PointContact::evaluate(const PortStep &step)
  {
    choose_window(step.begin.position, step.from.x);
    const Local end_rates = rates(step.end_rate, step.to.v);
    const double surface  = step.to.surface - step.from.surface;
    auto kinematics       = step_kinematics(step, end_rates);
    kinematics.slip_change[0] += surface;
    StepContactLaw law;
    law.normal            = properties.normal;
    law.damping           = properties.damping;
    law.tangential        = properties.tangential;
    law.friction          = friction_of_step(properties.friction, step.to.v);
    law.weights           = step.weights;
    response              = step_response(kinematics, step.memory.front(), law);
    slip_rate             = end.slip_row * end_rates + surface / step.weights.dt;
    const double of_drive = -response.force[x_index] * (step.to.x - step.from.x) + response.mean_traction[0] * surface;
    work                  = { of_drive, response.friction, response.damping, response.algorithmic, response.creep };
    sum_forces(response.force, response.tangent);
  }

  void PointContact::evaluate_sliding(const SlidingState &state)
  {
    const bool slides = state.friction == ContactFriction::sliding;
    choose_window(state.ports, state.drive.x);
    end                = configure(coordinates(state.ports, state.drive.x));
    const Local rate   = state.rates == nullptr ? Local() : rates(*state.rates, 0.);
    const auto law     = friction_of_step(properties.friction, state.drive.v);
    const auto normal  = mean_normal_force(properties.normal, end.gap, end.gap);
    const auto dashpot = end_damping(properties.damping, normal.end, end.gap, end.gap_row * rate);
    slip_rate          = state.speed + end.slip_row * rate;
    sliding            = slides ? sliding_friction(law, slip_rate) : SlidingFriction{};
    sticks             = slides && law.regularisation_speed == 0.;
    d_pressure         = (1. + dashpot.d_normal) * normal.d_end * end.gap_row;
    d_pressure_rate    = dashpot.d_rate * end.gap_row;

    response                      = {};
    response.mu                   = std::abs(sliding.coefficient);
    response.pressure             = normal.end + dashpot.force;
    response.traction[0]          = sliding.coefficient * response.pressure;
    response.slipping             = slides;
    response.memory.traction      = response.traction;
    response.memory.damping       = dashpot.force;
    response.memory.slip_speed[0] = state.speed;
    const double stretched        = law.regularisation_speed > 0. ? 0. : response.traction[0];
    response.energy               = normal.energy + 0.5 * stretched * stretched / properties.tangential;
    response.force                = response.pressure * end.gap_row - response.traction[0] * end.slip_row;
    response.tangent              = pressure_tangent() + friction_tangent(state.friction);
    work                          = {};
    sum_forces(response.force, response.tangent);
  }

  PointContact::LocalMatrix PointContact::pressure_tangent() const
  {
    return outer_product(end.gap_row, d_pressure) + response.pressure * end.gap_curvature;
  }

  PointContact::LocalMatrix PointContact::friction_tangent(const ContactFriction friction) const
  {
    if (friction == ContactFriction::stuck)
      return -properties.tangential * outer_product(end.slip_row, end.slip_row);
    return -sliding.coefficient * outer_product(end.slip_row, d_pressure) - response.traction[0] * end.slip_curvature;
  }

  PortPerturbation PointContact::linearise(const SlidingState &state)
  {
    evaluate_sliding(state);
    const auto places           = local_ports();
    const Local d_traction_rate = sliding.coefficient * d_pressure_rate + sliding.derivative * response.pressure * end.slip_row;
    PortPerturbation result(summed.ports);
    result.pressure      = on_ports(places, pressure_tangent());
    result.friction      = on_ports(places, friction_tangent(state.friction));
    result.pressure_rate = on_ports(places, outer_product(end.gap_row, d_pressure_rate));
    result.friction_rate = on_ports(places, -1. * outer_product(end.slip_row, d_traction_rate));
    result.delays        = friction_delays(places, d_traction_rate);
    return result;
  }

  std::vector<FrictionDelay> PointContact::friction_delays(const std::vector<LocalPort> &places,
                                                           const Local &d_traction_rate) const
  {
    const double time = sliding.derivative * response.pressure / properties.tangential;
    if (!sticks || !(time > 0.))
      return {};
    const auto n_used = static_cast<unsigned int>(places.size());
    FrictionDelay delay{ time, Vector<double>(n_used), Vector<double>(n_used), Vector<double>(n_used) };
    for (unsigned int i = 0; i < n_used; ++i)
    {
      const auto &[local, port, sign] = places[i];
      delay.force[i]                  = -sign * end.slip_row[local];
      delay.stiffness_row[i]          = sign * sliding.coefficient * d_pressure[local];
      delay.rate_row[i]               = sign * d_traction_rate[local];
    }
    return { delay };
  }

  std::vector<PointContact::LocalPort> PointContact::local_ports() const
  {
    std::vector<LocalPort> result;
    for (unsigned int i = 0; i < n_nodal && properties.mesh.elements > 0; ++i)
      if (window + i / 2 > 0)
        result.push_back({ i, 2 * window + i - 2, 1. });
    result.push_back({ theta_index, properties.ports.rotation(), 1. });
    if (properties.ports.sprung)
      result.push_back({ x_index, properties.ports.support(), -1. });
    return result;
  }

  FullMatrix<double> PointContact::on_ports(const std::vector<LocalPort> &places, const LocalMatrix &matrix)
  {
    const auto used = static_cast<unsigned int>(places.size());
    FullMatrix<double> result(used, used);
    for (unsigned int i = 0; i < used; ++i)
      for (unsigned int j = 0; j < used; ++j)
        result(i, j) = places[i].sign * places[j].sign * matrix[places[i].local][places[j].local];
    return result;
  }

  void PointContact::sum_forces(const Local &force, const LocalMatrix &tangent)
  {
    const auto places = local_ports();
    summed.ports.clear();
    summed.values.reinit(static_cast<unsigned int>(places.size()));
    for (unsigned int i = 0; i < places.size(); ++i)
    {
      summed.ports.push_back(places[i].port);
      summed.values[i] = places[i].sign * force[places[i].local];
    }
    summed.tangent = on_ports(places, tangent);
  }

  const PortForces &PointContact::forces() const
  {
    return summed;
  }

  const PortSelection &PointContact::reachable_ports(double, double)
  {
    return all;
  }

  bool PointContact::within_reach() const
  {
    return true;
  }

  void PointContact::widen_reach()
  {
  }

  std::vector<ContactMemory> PointContact::memory() const
  {
    return { response.memory };
  }

  std::vector<ContactMemory> PointContact::touch(const Vector<double> &ports, const DrivePoint &drive)
  {
    choose_window(ports, drive.x);
    end      = configure(coordinates(ports, drive.x));
    response = {};
    return { ContactMemory{} };
  }

  void PointContact::add_work(StepWork &sum) const
  {
    sum.drive += work.drive;
    sum.friction += work.friction;
    sum.damping += work.damping;
    sum.algorithmic += work.algorithmic;
    sum.creep += work.creep;
  }

  double PointContact::energy() const
  {
    return response.energy;
  }

  double PointContact::overlap() const
  {
    return std::max(0., -end.gap);
  }

  void PointContact::observe(Row &row) const
  {
    const auto force                = response.pressure * end.gap_at_point - response.traction[0] * end.slip_at_point;
    row[Column::P]                  = force[1];
    row[Column::F]                  = -force[0];
    row[Column::Q]                  = -force[3];
    row[Column::normal_resultant]   = response.pressure;
    row[Column::friction_resultant] = response.traction[0];
    row[Column::friction_power]     = response.traction[0] * slip_rate;
    row[Column::indentation]        = overlap();
    row[Column::penetration]        = 0.;
    row[Column::active_points]      = end.gap < 0. ? 1. : 0.;
    row[Column::elastic_slip]       = 0.;
    if (response.pressure > 0.)
    {
      row[Column::s]              = end.along;
      row[Column::mu]             = response.mu;
      row[Column::v_rel]          = slip_rate;
      row[Column::cone_violation] = std::max(0., response.traction.norm() / (response.mu * response.pressure) - 1.);
    }
  }

  FacePoints PointContact::face_points() const
  {
    return {};
  }

  FaceState PointContact::face_state(const DrivePoint &) const
  {
    return {};
  }
} // namespace sprag
