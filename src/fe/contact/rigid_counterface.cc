// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/rigid_counterface.h"

#include "fe/contact/face_pair.h"

#include <algorithm>

namespace sprag
{
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    LeverPoint to_lever_point(const dealii::Point<2> &position)
    {
      return { position[0], position[1] };
    }
  } // namespace

  RigidCounterface::RigidCounterface(const FrictionFace<2> &lever, const FaceElements<2> &face_,
                                     const FaceProperties<2> &properties_)
      : face(face_)
      , properties(properties_)
      , slopes(face.points.size())
      , begin_points(face.points.size())
  {
    for (std::size_t k = 0; k < lever.edges.size(); ++k)
    {
      const auto &element_points = face.elements[k];
      const auto &nodes          = lever.edges[k].nodes;
      const double origin        = nodes.front().position[0];
      const double length        = nodes.back().position[0] - origin;
      for (unsigned int q = element_points.begin; q < element_points.end; ++q)
      {
        const auto shapes = edge_shapes(static_cast<unsigned int>(nodes.size()), (face.points[q].position[0] - origin) / length);
        for (unsigned int a = 0; a < element_points.n_nodes; ++a)
          for (std::size_t node = 0; node < nodes.size(); ++node)
            if (nodes[node].index == element_points.nodes[a])
              slopes[q][a] = shapes.slopes[node] / length;
      }
    }
  }

  void RigidCounterface::set_places(const StepPlaces &places_, const bool begins_anew)
  {
    places = places_;
    moves  = places.moves();
    end    = properties.counterface(places.end.x, places.end.theta);
    if (begins_anew)
    {
      begin = properties.counterface(places.begin.x, places.begin.theta);
      is_begun.assign(face.elements.size(), false);
    }
    if (!places.balanced_at_end())
      balance = properties.counterface(places.balanced(places.begin.x, places.end.x),
                                       places.balanced(places.begin.theta, places.end.theta));
  }

  /// The gap along a straight element to a convex counterface lies above its tangent at the first point; the margin covers
  /// bending.
  FaceElements<2>::Indices RigidCounterface::near(const FaceConfiguration &at, const PlacedCounterface &counterface) const
  {
    const auto smallest_gap = [&](const unsigned int element_index)
    {
      const auto &chosen = face.elements[element_index];
      const auto nodal   = FaceElements<2>::nodal(chosen, *at.displacement);
      const auto first   = FaceElements<2>::position(face.points[chosen.begin], nodal);
      const auto along   = FaceElements<2>::position(face.points[chosen.end - 1], nodal) - first;
      const auto contact = counterface(to_lever_point(first));
      return contact.gap + std::min(0., contact.gap_row[0] * along[0] + contact.gap_row[1] * along[1]) - 0.02 * chosen.length;
    };
    return face.find_near({ at.centre.xi, at.centre.eta }, smallest_gap);
  }

  void RigidCounterface::begin_element(const unsigned int element_index)
  {
    element = element_index;
    at_end  = FaceElements<2>::nodal(face.elements[element], *places.end.displacement);
    if (moves)
      find_begin_points(element);
    has_forces = false;
    values     = {};
    tangent    = {};
    friction   = {};
  }

  bool RigidCounterface::place(FacePointState<2> &state)
  {
    state.position = FaceElements<2>::position(face.points[state.index], at_end);
    placed         = end(to_lever_point(state.position));
    state.gap      = placed.gap;
    return true;
  }

  /// Finds the points of an element where the step begins, if they are not known.
  void RigidCounterface::find_begin_points(const unsigned int element_index)
  {
    if (is_begun[element_index])
      return;
    is_begun[element_index] = true;
    const auto &chosen      = face.elements[element_index];
    const auto nodal        = FaceElements<2>::nodal(chosen, *places.begin.displacement);
    for (unsigned int q = chosen.begin; q < chosen.end; ++q)
    {
      const auto position = FaceElements<2>::position(face.points[q], nodal);
      const auto contact  = begin(to_lever_point(position));
      begin_points[q]     = { position, contact.gap, contact.slip };
    }
  }

  StepKinematics<4> RigidCounterface::over_step(const FacePointState<2> &state, const double slip_change) const
  {
    auto result = step_to(placed, placed.slip - slip_change);
    if (places.balanced_at_end())
      return result;
    const auto &first  = begin_points[state.index];
    const auto moved   = state.position - first.position;
    const auto between = first.position + places.balance * moved;
    result.gap_begin   = first.gap;
    set_balance(balance(to_lever_point(between)), places.balance,
                Tensor<1, 4>({ moved[0], moved[1], places.end.theta - places.begin.theta, places.end.x - places.begin.x }),
                result);
    return result;
  }

  /// Returns the derivative of a deformed point's position along the undeformed face.
  Tensor<1, 4> RigidCounterface::face_direction(const unsigned int point) const
  {
    Tensor<1, 4> result({ 1., 0., 0., 0. });
    for (unsigned int i = 0; i < at_end.size(); ++i)
      result[i % 2] += slopes[point][i / 2] * at_end[i];
    return result;
  }

  void RigidCounterface::step(FacePointState<2> &state, const ContactHistory &history, const FaceStep &step, ContactSums &sums)
  {
    const auto &point        = face.points[state.index];
    const double slip_change = (moves ? placed.slip - begin_points[state.index].slip : 0.) + step.surface_run;
    auto step_kinematics     = over_step(state, slip_change);
    SlipShift shift;
    Tensor<1, 4> direction;
    if (step.terms.travel != 0.)
    {
      direction                     = face_direction(state.index);
      shift                         = slip_shift(face, state.index, placed.slip_row * direction, step.terms.travel,
                                                 unwinding_stiffness(step.terms.augmented, step.law.slip.stiffness), step.history,
                                                 [this](const unsigned int q)
                                                 {
                           find_begin_points(face.point_elements[q]);
                           return begin_points[q].slip;
                         });
      step_kinematics.slip_shift[0] = shift.total();
    }
    auto response = step_response(step_kinematics, history, step.law);
    record(response, step, history, slip_change + shift.slip, point.weight, step.surface_run, state, sums);
    state.end_force = response.pressure * placed.gap_row - response.traction[0] * placed.slip_row;
    sums.force_on_counterface += point.weight * response.force[3];
    const double by_slope = shift.d_slope * response.d_shift[0][0];
    if (by_slope != 0.)
      response.tangent -= by_slope * outer_product(placed.slip_row, placed.slip_curvature * direction);
    add_force(point, response.force);
    add_tangent(point, response.tangent, tangent);
    if (by_slope != 0.)
      add_slope(state.index, by_slope);
  }

  /// Adds what a traction has in the tangent that changes with the slope of the slip along the face, as far as the face's
  /// direction goes with it.
  void RigidCounterface::add_slope(const unsigned int index, const double traction_by_slope)
  {
    const auto &point = face.points[index];
    Local slope;
    for (unsigned int i = 0; i < theta_index; ++i)
      slope[i] = point.weight * traction_by_slope * placed.slip_row[i % 2] * slopes[index][i / 2];
    tangent -= outer_product(spread(point, placed.slip_row), slope);
  }

  void RigidCounterface::slide(FacePointState<2> &state, const SlidingState &sliding, const FrictionLaw &law, ContactSums &sums)
  {
    const auto &point = face.points[state.index];
    double &speed     = state.slip_change[0];
    speed             = sliding.speed;
    if (sliding.rates != nullptr)
    {
      const auto nodal = FaceElements<2>::nodal(face.elements[element], *sliding.rates);
      const auto rate  = FaceElements<2>::position(point, nodal) - point.position;
      const auto &at   = properties.layout;
      speed += placed.slip_row[0] * rate[0] + placed.slip_row[1] * rate[1] +
               placed.slip_row[2] * (*sliding.rates)[at.rotation()] -
               (at.sprung ? placed.slip_row[3] * (*sliding.rates)[at.support()] : 0.);
    }
    const auto tangents = sprag::slide(properties, law, sliding, point.weight, state, sums);
    state.end_force     = state.pressure * placed.gap_row - state.traction[0] * placed.slip_row;
    add_force(point, state.end_force);
    const auto pressure = tangents.normal * outer_product(placed.gap_row, placed.gap_row) + state.pressure * placed.gap_curvature;
    const auto by_friction =
        outer_product(placed.slip_row, tangents.coupled * placed.gap_row + tangents.stuck * placed.slip_row) -
        state.traction[0] * placed.slip_curvature;
    if (!sums.in_parts)
      return add_tangent(point, pressure + by_friction, tangent);
    add_tangent(point, pressure, tangent);
    add_tangent(point, by_friction, friction.by_displacement);
    add_tangent(point, tangents.by_speed * outer_product(placed.slip_row, placed.slip_row), friction.by_velocity);
    if (tangents.lag.time > 0.)
      friction.delays.push_back(friction_delay(tangents, sliding.speed, rows(state)));
  }

  /// Returns a row over the point's coordinates as one over those of the element.
  RigidCounterface::Local RigidCounterface::spread(const FaceElements<2>::Point &point, const Tensor<1, 4> &row)
  {
    Local result;
    for (unsigned int i = 0; i < theta_index; ++i)
      result[i] = point.shapes[i / 2] * row[i % 2];
    result[theta_index] = row[2];
    result[x_index]     = row[3];
    return result;
  }

  void RigidCounterface::add_force(const FaceElements<2>::Point &point, const Tensor<1, 4> &force)
  {
    has_forces = true;
    values += point.weight * spread(point, force);
  }

  void RigidCounterface::add_tangent(const FaceElements<2>::Point &point, const Tensor<2, 4> &point_tangent, LocalMatrix &sum)
  {
    const auto share      = [&](const unsigned int i) { return i < theta_index ? point.shapes[i / 2] : 1.; };
    const auto coordinate = [](const unsigned int i) { return i < theta_index ? i % 2 : i - theta_index + 2; };
    for (unsigned int i = 0; i < n_local; ++i)
      for (unsigned int j = 0; j < n_local; ++j)
        sum[i][j] += point.weight * share(i) * share(j) * point_tangent[coordinate(i)][coordinate(j)];
  }

  /// Returns the interface coordinates of the element.
  InterfaceCoordinates RigidCounterface::interface_coordinates() const
  {
    InterfaceCoordinates result;
    const auto &element_points = face.elements[element];
    for (unsigned int i = 0; i < 2 * element_points.n_nodes; ++i)
      result.push_back({ i, 2 * element_points.nodes[i / 2] + i % 2, 1. });
    add_frame(properties.layout, theta_index, x_index, result);
    return result;
  }

  void RigidCounterface::end_element(ContactSums &sums)
  {
    if (has_forces)
      add_element(interface_coordinates(), values, tangent, friction, sums);
  }

  FacePointRows RigidCounterface::rows(const FacePointState<2> &state) const
  {
    const auto &point       = face.points[state.index];
    const auto contact      = end(to_lever_point(state.position));
    const auto on_interface = interface_coordinates();
    return { point.weight, collect_dofs(on_interface), row_on_dofs(on_interface, spread(point, contact.gap_row)),
             row_on_dofs(on_interface, spread(point, contact.slip_row)), row_on_dofs(on_interface, Local()) };
  }

  double RigidCounterface::slip(const FacePointState<2> &state) const
  {
    if (!moves)
      return 0.;
    const auto position = FaceElements<2>::position(face.points[state.index], at_end);
    return end(to_lever_point(position)).slip - begin_points[state.index].slip;
  }
} // namespace sprag
