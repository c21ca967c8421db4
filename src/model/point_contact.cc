#include "model/point_contact.h"

#include "laws/friction_of_step.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int theta_index = 6;
    constexpr unsigned int x_index     = 7;

    /// Cubic shapes of an element of length h at s h from its first node, 0 <= s <= 1, and their derivatives along it; for
    /// deflection and slope of the first node, then of the second.
    struct HermiteShapes
    {
      HermiteShapes(const double h, const double s)
          : shape{ 1. - s * s * (3. - 2. * s), h * s * (1. - s) * (1. - s), s * s * (3. - 2. * s), -h * s * s * (1. - s) }
          , slope{ 6. * s * (s - 1.) / h, 1. + s * (3. * s - 4.), 6. * s * (1. - s) / h, s * (3. * s - 2.) }
          , curvature{ (12. * s - 6.) / (h * h), (6. * s - 4.) / h, (6. - 12. * s) / (h * h), (6. * s - 2.) / h }
          , third{ 12. / (h * h * h), 6. / (h * h), -12. / (h * h * h), 6. / (h * h) }
      {
      }

      double shape[4], slope[4], curvature[4], third[4];
    };
  } // namespace

  struct PointContact::Surface
  {
    unsigned int nodal; ///< first local coordinate of the element
    double shape[4];    ///< deflection by them, and its derivatives along the lever
    double slope[4];
    double curvature[4];
    LeverPoint point;
    double tangent[2]; ///< d(point)/dxi
    double bend[2];    ///< d2(point)/dxi2
  };

  PointContact::PointContact(PointContactProperties point_properties)
      : properties(std::move(point_properties))
      , all(all_ports(properties.ports.size()))
  {
  }

  /// Two elements around the point across from the circle's centre: the contact stays between their ends for a step.
  void PointContact::choose_window(const Vector<double> &ports, const double x)
  {
    const auto &mesh = properties.mesh;
    if (mesh.elements == 0)
      return;
    const Local q       = coordinates(ports, x);
    const double xi     = cylinder_centre(properties.geometry, q[x_index], q[theta_index]).xi;
    const double before = std::round(xi / mesh.element_length()) - 1.;
    window              = static_cast<unsigned int>(std::clamp(before, 0., mesh.elements - 2.));
  }

  PointContact::Local PointContact::coordinates(const Vector<double> &ports, const double x) const
  {
    Local q = rates(ports, x);
    q[theta_index] += properties.rest_inclination;
    return q;
  }

  PointContact::Local PointContact::rates(const Vector<double> &port_rates, const double v) const
  {
    Local q;
    if (properties.mesh.elements > 0)
      for (unsigned int i = 0; i < n_nodal; ++i)
        if (window + i / 2 > 0)
          q[i] = port_rates[2 * window + i - 2];
    q[theta_index] = port_rates[properties.ports.rotation()];
    q[x_index]     = v - (properties.ports.sprung ? port_rates[properties.ports.support()] : 0.);
    return q;
  }

  PointContact::Surface PointContact::surface(const Local &q, const double xi) const
  {
    Surface result{};
    const auto &mesh = properties.mesh;
    const double e   = properties.geometry.interface_offset;
    const double arm = e - properties.neutral_axis_offset;
    double w[4]      = { 0., 0., 0., 0. };
    if (mesh.elements > 0)
    {
      const double h          = mesh.element_length();
      const bool second       = xi >= (window + 1) * h;
      const double s          = xi / h - window - (second ? 1. : 0.);
      const unsigned int base = second ? 2 : 0;
      result.nodal            = base;
      const HermiteShapes of(h, s);
      for (unsigned int a = 0; a < 4; ++a)
      {
        const double value  = q[base + a];
        result.shape[a]     = of.shape[a];
        result.slope[a]     = of.slope[a];
        result.curvature[a] = of.curvature[a];
        w[0] += of.shape[a] * value;
        w[1] += of.slope[a] * value;
        w[2] += of.curvature[a] * value;
        w[3] += of.third[a] * value;
      }
    }
    result.point      = { xi - arm * w[1], e + w[0] };
    result.tangent[0] = 1. - arm * w[2];
    result.tangent[1] = w[1];
    result.bend[0]    = -arm * w[3];
    result.bend[1]    = w[2];
    return result;
  }

  /// Newton's method for (p - c) . p' = 0 from the point across from the circle's centre.
  double PointContact::closest(const Local &q) const
  {
    const auto c = cylinder_centre(properties.geometry, q[x_index], q[theta_index]);
    double xi    = c.xi;
    for (unsigned int i = 0; i < 20 && properties.mesh.elements > 0; ++i)
    {
      const auto at      = surface(q, xi);
      const double r[2]  = { at.point.xi - c.xi, at.point.eta - c.eta };
      const double slope = r[0] * at.tangent[0] + r[1] * at.tangent[1];
      const double d_slope =
          at.tangent[0] * at.tangent[0] + at.tangent[1] * at.tangent[1] + r[0] * at.bend[0] + r[1] * at.bend[1];
      const double change = slope / d_slope;
      xi -= change;
      if (std::abs(change) < 1e-12 * properties.geometry.pivot_distance)
        break;
    }
    return xi;
  }

  double PointContact::gap(const Local &q) const
  {
    const auto c     = cylinder_centre(properties.geometry, q[x_index], q[theta_index]);
    const auto point = surface(q, closest(q)).point;
    return std::hypot(point.xi - c.xi, point.eta - c.eta) - properties.geometry.cylinder_radius;
  }

  PointContact::Configuration PointContact::configure(const Local &q) const
  {
    const double xi   = closest(q);
    const auto at     = surface(q, xi);
    const auto circle = moving_circle_contact(properties.geometry, at.point, q[x_index], q[theta_index]);
    const double arm  = properties.geometry.interface_offset - properties.neutral_axis_offset;

    // How the local coordinates move the material point, and how that changes along the lever.
    constexpr unsigned int n_used = 6;
    unsigned int index[n_used];
    Tensor<1, 4> move[n_used];
    Tensor<1, 4> change[n_used];
    unsigned int used = 0;
    if (properties.mesh.elements > 0)
      for (unsigned int a = 0; a < 4; ++a, ++used)
      {
        index[used]  = at.nodal + a;
        move[used]   = Tensor<1, 4>({ -arm * at.slope[a], at.shape[a], 0., 0. });
        change[used] = Tensor<1, 4>({ -arm * at.curvature[a], at.slope[a], 0., 0. });
      }
    index[used]  = theta_index;
    move[used++] = Tensor<1, 4>({ 0., 0., 1., 0. });
    index[used]  = x_index;
    move[used++] = Tensor<1, 4>({ 0., 0., 0., 1. });

    const Tensor<1, 4> tangent({ at.tangent[0], at.tangent[1], 0., 0. });
    const Tensor<1, 4> bend({ at.bend[0], at.bend[1], 0., 0. });
    const Tensor<1, 4> gap_along  = circle.gap_curvature * tangent;
    const Tensor<1, 4> slip_along = circle.slip_curvature * tangent;
    const double stiffness        = tangent * gap_along + circle.gap_row * bend;
    double gap_shift[n_used];
    double slip_shift[n_used];
    for (unsigned int i = 0; i < used; ++i)
    {
      gap_shift[i]  = change[i] * circle.gap_row + move[i] * gap_along;
      slip_shift[i] = change[i] * circle.slip_row + move[i] * slip_along;
    }

    Configuration result;
    result.along         = at.point.xi;
    result.gap           = circle.gap;
    result.gap_at_point  = circle.gap_row;
    result.slip_at_point = circle.slip_row;
    for (unsigned int i = 0; i < used; ++i)
    {
      result.gap_row[index[i]]   = move[i] * circle.gap_row;
      result.slip_row[index[i]]  = move[i] * circle.slip_row;
      const Tensor<1, 4> of_gap  = circle.gap_curvature * move[i];
      const Tensor<1, 4> of_slip = circle.slip_curvature * move[i];
      for (unsigned int j = 0; j < used; ++j)
      {
        result.gap_curvature[index[i]][index[j]]  = of_gap * move[j] - gap_shift[i] * gap_shift[j] / stiffness;
        result.slip_curvature[index[i]][index[j]] = of_slip * move[j] - slip_shift[i] * gap_shift[j] / stiffness;
      }
    }
    return result;
  }

  StepKinematics<PointContact::n> PointContact::step_kinematics(const PortStep &step, const Local &end_rates)
  {
    const Local q_0    = coordinates(step.begin.position, step.from.x);
    const Local q_1    = coordinates(step.end, step.to.x);
    const Local change = q_1 - q_0;
    const double share = step.weights.stiffness();
    const auto balance = configure(share * q_1 + (1. - share) * q_0);
    end                = configure(q_1);

    StepKinematics<n> k;
    k.gap_begin       = gap(q_0);
    k.gap_end         = end.gap;
    k.gap_row_end     = end.gap_row;
    k.gap_row         = balance.gap_row;
    k.gap_curvature   = share * balance.gap_curvature;
    k.gap_bend        = change * (balance.gap_curvature * change);
    k.slip_row        = balance.slip_row;
    k.slip_curvature  = share * balance.slip_curvature;
    k.slip_bend       = change * (balance.slip_curvature * change);
    k.slip_change     = balance.slip_row * change - step.weights.delay() * k.slip_bend;
    k.slip_change_row = balance.slip_row + change * k.slip_curvature -
                        step.weights.delay() * (balance.slip_curvature * change + change * balance.slip_curvature);
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
    kinematics.slip_change += surface;
    StepContactLaw law;
    law.normal            = properties.normal;
    law.damping           = properties.damping;
    law.tangential        = properties.tangential;
    law.friction          = friction_of_step(properties.friction, step.to.v);
    law.weights           = step.weights;
    response              = step_response(kinematics, step.memory.front(), law);
    slip_rate             = end.slip_row * end_rates + surface / step.weights.dt;
    const double of_drive = -response.force[x_index] * (step.to.x - step.from.x) + response.mean_traction * surface;
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

    response                   = {};
    response.mu                = std::abs(sliding.coefficient);
    response.pressure          = normal.end + dashpot.force;
    response.traction          = sliding.coefficient * response.pressure;
    response.slipping          = slides;
    response.memory.traction   = response.traction;
    response.memory.damping    = dashpot.force;
    response.memory.slip_speed = state.speed;
    const double stretched     = law.regularisation_speed > 0. ? 0. : response.traction;
    response.energy            = normal.energy + 0.5 * stretched * stretched / properties.tangential;
    response.force             = response.pressure * end.gap_row - response.traction * end.slip_row;
    response.tangent           = sliding_tangent(state.part, state.friction);
    work                       = {};
    sum_forces(response.force, response.tangent);
  }

  PointContact::LocalMatrix PointContact::sliding_tangent(const TangentPart part, const ContactFriction friction) const
  {
    switch (part)
    {
    case TangentPart::all:
      return sliding_tangent(TangentPart::pressure, friction) + sliding_tangent(TangentPart::friction, friction);
    case TangentPart::pressure:
      return outer_product(end.gap_row, d_pressure) + response.pressure * end.gap_curvature;
    case TangentPart::friction:
      if (friction == ContactFriction::stuck)
        return -properties.tangential * outer_product(end.slip_row, end.slip_row);
      return -sliding.coefficient * outer_product(end.slip_row, d_pressure) - response.traction * end.slip_curvature;
    case TangentPart::pressure_rate:
      return outer_product(end.gap_row, d_pressure_rate);
    case TangentPart::friction_rate:
      return -sliding.coefficient * outer_product(end.slip_row, d_pressure_rate) -
             sliding.derivative * response.pressure * outer_product(end.slip_row, end.slip_row);
    }
    return {};
  }

  std::vector<FrictionDelay> PointContact::friction_delays() const
  {
    const double time = sliding.derivative * response.pressure / properties.tangential;
    if (!sticks || !(time > 0.))
      return {};
    const auto places = local_ports();
    const auto n_used = static_cast<unsigned int>(places.size());
    FrictionDelay delay{ time, Vector<double>(n_used), Vector<double>(n_used), Vector<double>(n_used) };
    const Local by_rate = sliding.coefficient * d_pressure_rate + sliding.derivative * response.pressure * end.slip_row;
    for (unsigned int i = 0; i < n_used; ++i)
    {
      const auto &[local, port, sign] = places[i];
      delay.force[i]                  = -sign * end.slip_row[local];
      delay.stiffness_row[i]          = sign * sliding.coefficient * d_pressure[local];
      delay.rate_row[i]               = sign * by_rate[local];
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

  void PointContact::sum_forces(const Local &force, const LocalMatrix &tangent)
  {
    const auto places = local_ports();
    const auto used   = static_cast<unsigned int>(places.size());
    summed.ports.clear();
    summed.values.reinit(used);
    summed.tangent.reinit(used, used);
    for (unsigned int i = 0; i < used; ++i)
    {
      const auto &row = places[i];
      summed.ports.push_back(row.port);
      summed.values[i] = row.sign * force[row.local];
      for (unsigned int j = 0; j < used; ++j)
        summed.tangent(i, j) = row.sign * places[j].sign * tangent[row.local][places[j].local];
    }
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

  double PointContact::gap_change(const Vector<double> &change_of_ports) const
  {
    return end.gap_row * rates(change_of_ports, 0.);
  }

  double PointContact::mean_slip(const Vector<double> &from, const double from_x, const Vector<double> &to,
                                 const double to_x) const
  {
    const Local q_0 = coordinates(from, from_x);
    const Local q_1 = coordinates(to, to_x);
    return configure(0.5 * (q_0 + q_1)).slip_row * (q_1 - q_0);
  }

  SurfaceShape PointContact::surface_shape(const Vector<double> &displacements) const
  {
    constexpr unsigned int parts = 8;
    const auto &mesh             = properties.mesh;
    const double arm             = properties.geometry.interface_offset - properties.neutral_axis_offset;
    SurfaceShape shape{ { 0. }, { 0. }, { 0. } };
    for (unsigned int i = 1; i <= parts * mesh.elements; ++i)
    {
      const unsigned int element = (i - 1) / parts;
      const HermiteShapes of(mesh.element_length(), static_cast<double>(i) / parts - element);
      double w     = 0.;
      double slope = 0.;
      for (unsigned int a = 0; a < 4; ++a)
        if (const unsigned int port = 2 * element + a; port >= 2)
        {
          w += of.shape[a] * displacements[port - 2];
          slope += of.slope[a] * displacements[port - 2];
        }
      shape.xi.push_back(i * mesh.element_length() / parts);
      shape.across.push_back(w);
      shape.along.push_back(-arm * slope);
    }
    return shape;
  }

  void PointContact::observe(Row &row) const
  {
    const auto force                = response.pressure * end.gap_at_point - response.traction * end.slip_at_point;
    row[Column::P]                  = force[1];
    row[Column::F]                  = -force[0];
    row[Column::Q]                  = -force[3];
    row[Column::normal_resultant]   = response.pressure;
    row[Column::friction_resultant] = response.traction;
    row[Column::friction_power]     = response.traction * slip_rate;
    row[Column::indentation]        = overlap();
    row[Column::penetration]        = 0.;
    row[Column::active_points]      = end.gap < 0. ? 1. : 0.;
    row[Column::elastic_slip]       = 0.;
    if (response.pressure > 0.)
    {
      row[Column::s]              = end.along;
      row[Column::mu]             = response.mu;
      row[Column::v_rel]          = slip_rate;
      row[Column::cone_violation] = std::max(0., std::abs(response.traction) / (response.mu * response.pressure) - 1.);
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
