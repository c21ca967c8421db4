// SPDX-License-Identifier: GPL-3.0-only
#include "model/contact/point_contact.h"

#include "laws/friction_law.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr int n_element_dofs = 4;

    /// Cubic shapes of an element of length h at s h from its first node, 0 <= s <= 1, and their derivatives along it; for
    /// deflection and slope of the first node, then of the second.
    template <class N>
    struct HermiteShapes
    {
      HermiteShapes(const double h, const N &s)
          : shape{ 1. - s * s * (3. - 2. * s), h * (s * (1. - s) * (1. - s)), s * s * (3. - 2. * s), -h * (s * s * (1. - s)) }
          , slope{ 6. / h * (s * (s - 1.)), 1. + s * (3. * s - 4.), 6. / h * (s * (1. - s)), s * (3. * s - 2.) }
          , curvature{ 1. / (h * h) * (12. * s - 6.), 1. / h * (6. * s - 4.), 1. / (h * h) * (6. - 12. * s),
                       1. / h * (6. * s - 2.) }
      {
      }

      N shape[n_element_dofs], slope[n_element_dofs], curvature[n_element_dofs];
    };
  } // namespace

  /// The bent surface at a place, in numbers of some kind.
  template <class N>
  struct PointContact::Surface
  {
    N xi, eta;
    N tangent[2];            ///< d(xi, eta)/d(place)
    N shape[n_element_dofs]; ///< deflection by the element's coordinates, and its derivative along the lever
    N slope[n_element_dofs];
  };

  /// Two elements around the point across from the circle's centre: the contact stays between their ends for a step.
  unsigned int PointContact::find_node(const Vector<double> &z, const double x) const
  {
    const auto &mesh = properties.mesh;
    if (mesh.elements == 0)
      return 0;
    const Local q       = coordinates(0, z, x);
    const double xi     = cylinder_centre(properties.geometry, q[x_index], q[theta_index]).xi;
    const double before = std::round(xi / mesh.element_length()) - 1.;
    return static_cast<unsigned int>(std::clamp(before, 0., mesh.elements - 2.));
  }

  PointContact::Local PointContact::coordinates(const unsigned int node, const Vector<double> &z, const double x) const
  {
    Local q = rates(node, z, x);
    q[theta_index] += properties.rest_inclination;
    return q;
  }

  PointContact::Local PointContact::rates(const unsigned int node, const Vector<double> &interface_rates, const double v) const
  {
    Local q;
    if (properties.mesh.elements > 0)
      for (unsigned int i = 0; i < n_nodal; ++i)
        if (node + i / 2 > 0)
          q[i] = interface_rates[2 * node + i - 2];
    q[theta_index] = interface_rates[properties.layout.rotation()];
    q[x_index]     = v - (properties.layout.sprung ? interface_rates[properties.layout.support()] : 0.);
    return q;
  }

  unsigned int PointContact::first_element_dof(const unsigned int node, const double xi) const
  {
    return properties.mesh.elements > 0 && xi >= (node + 1) * properties.mesh.element_length() ? 2 : 0;
  }

  template <class N, class Nodal>
  PointContact::Surface<N> PointContact::surface(const unsigned int node, const unsigned int first, const Nodal &nodal,
                                                 const N &xi) const
  {
    Surface<N> at{};
    const auto &mesh = properties.mesh;
    const double e   = properties.geometry.interface_offset;
    const double arm = e - properties.neutral_axis_offset;
    N w{}, w_slope{}, w_curvature{};
    if (mesh.elements > 0)
    {
      const double h = mesh.element_length();
      const HermiteShapes<N> shapes(h, 1. / h * xi - (node + first / 2));
      for (unsigned int a = 0; a < n_element_dofs; ++a)
      {
        at.shape[a] = shapes.shape[a];
        at.slope[a] = shapes.slope[a];
        w           = w + nodal[a] * shapes.shape[a];
        w_slope     = w_slope + nodal[a] * shapes.slope[a];
        w_curvature = w_curvature + nodal[a] * shapes.curvature[a];
      }
    }
    at.xi         = xi - arm * w_slope;
    at.eta        = w + e;
    at.tangent[0] = 1. - arm * w_curvature;
    at.tangent[1] = w_slope;
    return at;
  }

  /// Newton's method for (p - c) . p' = 0 from the point across from the circle's centre, in one element, and in the other if
  /// it leads there. Where each leads to the other the curvature jumps at their node: the second goes on a little beyond it.
  PointContact::Closest PointContact::closest(const unsigned int node, const Local &q) const
  {
    using N      = Dual<double, 1>;
    const auto c = cylinder_centre(properties.geometry, q[x_index], q[theta_index]);
    Closest result{ c.xi, 1., first_element_dof(node, c.xi) };
    const auto iterate = [&]
    {
      for (unsigned int i = 0; i < 20 && properties.mesh.elements > 0; ++i)
      {
        const auto at       = surface(node, result.first, &q[result.first], variable<N>(result.xi, 0));
        const N slope       = (at.xi - c.xi) * at.tangent[0] + (at.eta - c.eta) * at.tangent[1];
        const double change = slope.v / slope.d[0];
        result.d_slope      = slope.d[0];
        result.xi -= change;
        if (std::abs(change) < 1e-12 * properties.geometry.pivot_distance)
          break;
      }
    };
    iterate();
    if (const unsigned int other = first_element_dof(node, result.xi); other != result.first)
    {
      result.first = other;
      iterate();
    }
    return result;
  }

  double PointContact::gap(const unsigned int node, const Local &q) const
  {
    const auto foot = closest(node, q);
    const auto at   = surface(node, foot.first, &q[foot.first], foot.xi);
    const auto c    = cylinder_centre(properties.geometry, q[x_index], q[theta_index]);
    return std::hypot(at.xi - c.xi, at.eta - c.eta) - properties.geometry.cylinder_radius;
  }

  PointContact::Configuration PointContact::configure(const unsigned int node, const Local &q) const
  {
    constexpr int n_used = n_element_dofs + 2; // coordinates of the element, theta, x
    using N              = Dual<double, n_used>;
    const auto foot      = closest(node, q);
    const auto first     = foot.first;
    const auto circle    = placed_circle(properties.geometry, variable<N>(q[x_index], 5), variable<N>(q[theta_index], 4));
    Several<N, n_element_dofs> nodal;
    for (unsigned int a = 0; a < n_element_dofs; ++a)
      nodal[a] = variable<N>(q[first + a], a);

    // Another step of Newton's method gives the motion of the closest point with the coordinates.
    const auto fixed = surface(node, first, nodal, N{} + foot.xi);
    const N slope    = (fixed.xi - circle.xi) * fixed.tangent[0] + (fixed.eta - circle.eta) * fixed.tangent[1];
    const auto at    = surface(node, first, nodal, N(foot.xi - 1. / foot.d_slope * slope));
    const auto point = on_circle(circle, at.xi, at.eta);
    const double arm = properties.geometry.interface_offset - properties.neutral_axis_offset;

    Configuration result;
    result.along       = at.xi.v;
    result.gap         = point.gap.v;
    const auto set_row = [&](const unsigned int i, const Several<N, 4> &at_point, Local &row, LocalMatrix &curvature)
    {
      const unsigned int index[n_used] = { first, first + 1, first + 2, first + 3, theta_index, x_index };
      const bool is_nodal              = i < n_element_dofs;
      const N number =
          is_nodal ? at.shape[i] * at_point[1] - arm * (at.slope[i] * at_point[0]) : at_point[i - n_element_dofs + 2];
      row[index[i]] = number.v;
      for (unsigned int j = 0; j < n_used; ++j)
        curvature[index[i]][index[j]] = number.d[j];
    };
    for (unsigned int i = properties.mesh.elements > 0 ? 0 : n_element_dofs; i < n_used; ++i)
    {
      set_row(i, point.gap_row, result.gap_row, result.gap_curvature);
      set_row(i, point.slip_row, result.slip_row, result.slip_curvature);
    }
    for (unsigned int i = 0; i < 4; ++i)
    {
      result.gap_at_point[i]  = point.gap_row[i].v;
      result.slip_at_point[i] = point.slip_row[i].v;
    }
    return result;
  }

  double PointContact::gap_change(const Evaluation &found, const Vector<double> &change, unsigned int) const
  {
    return found.end.gap_row * rates(found.node, change, 0.);
  }

  double PointContact::mean_slip(const Evaluation &found, const Vector<double> &from, const double from_x,
                                 const Vector<double> &to, const double to_x) const
  {
    const Local q_0 = coordinates(found.node, from, from_x);
    const Local q_1 = coordinates(found.node, to, to_x);
    return configure(found.node, 0.5 * (q_0 + q_1)).slip_row * (q_1 - q_0);
  }

  SurfaceShape PointContact::surface_shape(const Vector<double> &displacements, unsigned int) const
  {
    constexpr unsigned int parts = 8;
    const auto &mesh             = properties.mesh;
    const double arm             = properties.geometry.interface_offset - properties.neutral_axis_offset;
    SurfaceShape shape{ { 0. }, { 0. }, { 0. } };
    for (unsigned int i = 1; i <= parts * mesh.elements; ++i)
    {
      const unsigned int element = (i - 1) / parts;
      const HermiteShapes<double> shapes(mesh.element_length(), static_cast<double>(i) / parts - element);
      double w     = 0.;
      double slope = 0.;
      for (unsigned int a = 0; a < 4; ++a)
        if (const unsigned int dof = 2 * element + a; dof >= 2)
        {
          w += shapes.shape[a] * displacements[dof - 2];
          slope += shapes.slope[a] * displacements[dof - 2];
        }
      shape.xi.push_back(i * mesh.element_length() / parts);
      shape.across.push_back(w);
      shape.along.push_back(-arm * slope);
    }
    return shape;
  }

  PointContact::PointContact(PointContactProperties point_properties)
      : properties(std::move(point_properties))
      , all(all_dofs(properties.layout.size()))
  {
  }

  StepKinematics<PointContact::n> PointContact::step_kinematics(const InterfaceStep &step, const Local &end_rates,
                                                                Evaluation &found) const
  {
    const Local q_0    = coordinates(found.node, step.begin.position, step.from.x);
    const Local q_1    = coordinates(found.node, step.end, step.to.x);
    const Local change = q_1 - q_0;
    const double share = step.weights.stiffness();
    const double delay = step.weights.delay();
    const auto balance = configure(found.node, share * q_1 + (1. - share) * q_0);
    const auto &end = found.end = configure(found.node, q_1);

    StepKinematics<n> k;
    set_balance(balance, share, change, k);
    k.gap_begin       = gap(found.node, q_0);
    k.gap_end         = end.gap;
    k.gap_row_end     = end.gap_row;
    k.slip_change     = balance.slip_row * change - delay * k.slip_bend;
    k.slip_change_row = balance.slip_row + change * k.slip_curvature -
                        delay * (balance.slip_curvature * change + change * balance.slip_curvature);
    k.gap_rate_end = end.gap_row * end_rates;
    k.gap_rate_row = step.weights.rate() * end.gap_row + end.gap_curvature * end_rates;
    return k;
  }

  void PointContact::evaluate(const InterfaceStep &step, Evaluation &found) const
  {
    found.node            = find_node(step.begin.position, step.from.x);
    const Local end_rates = rates(found.node, step.end_rate, step.to.v);
    const double surface  = step.to.surface - step.from.surface;
    auto kinematics       = step_kinematics(step, end_rates, found);
    kinematics.slip_change += surface;
    StepContactLaw law;
    law.normal              = properties.normal;
    law.damping             = properties.damping;
    law.slip                = slip_law(step_friction(properties.friction, step.to.v), properties.tangential, true);
    law.weights             = step.weights;
    auto &response          = found.response;
    response                = step_response(kinematics, step.history.front(), law);
    found.slip_rate         = found.end.slip_row * end_rates + surface / step.weights.dt;
    const double drive_work = -response.force[x_index] * (step.to.x - step.from.x) + response.mean_traction * surface;
    found.works             = { drive_work, response.friction, response.damping, response.algorithmic, response.creep };
    sum_forces(found);
  }

  void PointContact::evaluate_sliding(const SlidingState &state, Evaluation &found) const
  {
    const bool slides = state.friction == ContactFriction::sliding;
    found.node        = find_node(state.displacements, state.drive.x);
    const auto &end = found.end = configure(found.node, coordinates(found.node, state.displacements, state.drive.x));
    const Local rate            = state.rates == nullptr ? Local() : rates(found.node, *state.rates, 0.);
    const auto law              = slide_friction(properties.friction, state);
    using N                     = Dual<double, 2>; // of the gap and its rate
    const auto gap              = variable<N>(end.gap, 0);
    const auto spring           = spring_force(properties.normal, gap);
    const double damping        = state.relaxation ? -*state.relaxation * spring.d[0] : properties.damping;
    const auto dashpot          = dashpot_force(damping, spring, gap, variable<N>(end.gap_row * rate, 1));
    const auto pressure         = spring + dashpot;
    found.slip_rate             = state.speed; // -0 at rest after moving back
    if (state.rates != nullptr)
      found.slip_rate += end.slip_row * rate;
    found.sliding         = slides ? sliding_friction(law, found.slip_rate) : SlidingFriction{};
    found.d_pressure      = pressure.d[0] * end.gap_row;
    found.d_pressure_rate = pressure.d[1] * end.gap_row;

    auto &response                 = found.response;
    response                       = {};
    response.mu                    = found.sliding.mu;
    response.pressure              = pressure.v;
    response.traction[0]           = found.sliding.coefficient * response.pressure;
    response.slipping              = slides;
    response.history.traction      = response.traction;
    response.history.damping       = dashpot.v;
    response.history.slip_speed[0] = state.speed;
    const double stretched         = law.regularisation_speed > 0. ? 0. : response.traction[0];
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

  LinearisedForces PointContact::linearise(const SlidingState &state, Evaluation &found) const
  {
    evaluate_sliding(state, found);
    const auto places           = interface_coordinates(found.node);
    const Local d_traction_rate = found.sliding.coefficient * found.d_pressure_rate +
                                  found.sliding.derivative * found.response.pressure * found.end.slip_row;
    LinearisedForces result(found.forces.dofs);
    result.pressure      = matrix_on_dofs(places, pressure_tangent(found));
    result.friction      = matrix_on_dofs(places, friction_tangent(state.friction, found));
    result.pressure_rate = matrix_on_dofs(places, outer_product(found.end.gap_row, found.d_pressure_rate));
    result.friction_rate = matrix_on_dofs(places, -1. * outer_product(found.end.slip_row, d_traction_rate));
    result.delays        = friction_delays(places, slide_friction(properties.friction, state), found);
    return result;
  }

  std::vector<FrictionDelay> PointContact::friction_delays(const InterfaceCoordinates &places, const FrictionLaw &law,
                                                           const Evaluation &found) const
  {
    const double slope    = found.sliding.by_mu * found.response.pressure;
    const auto lag        = friction_lag(law, properties.tangential, true, slope, found.slip_rate);
    const double friction = lag.pressure * found.sliding.coefficient;
    if (lag.time == 0.)
      return {};
    return { { lag.time, row_on_dofs(places, -1. * found.end.slip_row), row_on_dofs(places, friction * found.d_pressure),
               row_on_dofs(places, friction * found.d_pressure_rate + slope * found.end.slip_row) } };
  }

  /// Returns the local coordinates that are dofs of the interface.
  InterfaceCoordinates PointContact::interface_coordinates(const unsigned int node) const
  {
    InterfaceCoordinates result;
    result.reserve(n);
    for (unsigned int i = 0; i < n_nodal && properties.mesh.elements > 0; ++i)
      if (node + i / 2 > 0)
        result.push_back({ i, 2 * node + i - 2, 1. });
    add_frame(properties.layout, theta_index, x_index, result);
    return result;
  }

  void PointContact::sum_forces(Evaluation &found) const
  {
    const auto places = interface_coordinates(found.node);
    auto &forces      = found.forces;
    forces.values     = row_on_dofs(places, found.response.force);
    forces.tangent    = matrix_on_dofs(places, found.response.tangent);
    forces.dofs.clear();
    for (const auto &place : places)
      forces.dofs.push_back(place.dof);
  }

  const DofSelection &PointContact::candidate_dofs(double, const PerLever &) const
  {
    return all;
  }

  void PointContact::touch(const Vector<double> &z, const DrivePoint &drive, Evaluation &found) const
  {
    found.node     = find_node(z, drive.x);
    found.end      = configure(found.node, coordinates(found.node, z, drive.x));
    found.response = {};
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
    row[Column::indentation]        = found.penetration();
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
