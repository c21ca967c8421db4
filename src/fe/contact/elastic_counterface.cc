// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/elastic_counterface.h"

#include "laws/friction_law.h"

#include <algorithm>

namespace sprag
{
  using dealii::Tensor;
  using dealii::Vector;

  ElasticCounterface::ElasticCounterface(const FrictionFace<2> &lever, const FrictionFace<2> &cylinder,
                                         const FaceElements<2> &face_, const FaceCandidates<2> &candidates_,
                                         const FaceProperties &properties_)
      : lever_face(lever)
      , face(face_)
      , candidates(candidates_)
      , properties(properties_)
      , pair(lever, cylinder)
      , first_node(cylinder.edges.front().nodes.front().position)
  {
  }

  void ElasticCounterface::evaluate(const InterfaceStep &step, FaceEvaluation<2> &found,
                                    const std::optional<StaticTerms> &statics)
  {
    found.begin(step.end, step.to.x, step.weights.dt);
    const FaceStep face_step{ step_terms(properties, step, statics), step.history };
    set_places({ configuration(properties, step.begin.position, step.from.x), configuration(properties, step.end, step.to.x),
                 step.weights.stiffness(), statics.has_value() });
    // If forces are means over the step, elements near and in contact when it began belong to it.
    auto elements = near(end.at);
    if (!places.balanced_at_end())
      elements = united(elements, begin.near);
    if (!places.static_end)
      elements = united(elements, touched_elements(face, step.history));
    for (const unsigned int element_index : candidates.clip(std::move(elements), found.within_candidates))
    {
      begin_element(element_index);
      step_element(face_step, found);
    }
    sum_forces(loaded, found.forces);
    found.sums.work.drive -= force_on_cylinder * (step.to.x - step.from.x);
  }

  void ElasticCounterface::step_element(const FaceStep &face_step, FaceEvaluation<2> &found)
  {
    const double penalty    = properties.penalties.normal;
    const bool ends_balance = face_step.law.balance == ForceBalance::end;
    auto known              = find_history(face_step.history, first);
    for (unsigned int q = first; q < face.elements[element].end; ++q)
    {
      auto &state            = add_point(q, found);
      const bool has_history = known != face_step.history.end() && known->point == q;
      const auto history     = has_history ? *known++ : ContactHistory{};
      state.trial_pressure   = (facet_at_end(q).opposed ? history.normal_multiplier : 0.) - penalty * state.gap;
      const double begin_gap =
          ends_balance ? state.gap : (places.moves() ? facets_at_begin(element).facets[q - first] : facet_at_end(q)).gap;
      const bool stays_open = ends_balance ? state.trial_pressure <= 0. : state.gap >= 0. && begin_gap >= 0. && !has_history;
      if (stays_open)
        continue;
      found.sums.penetration =
          std::max(found.sums.penetration, ends_balance ? state.trial_pressure / penalty : -std::min(state.gap, begin_gap));
      step(state, history, face_step, found.sums);
    }
    end_element();
  }

  LinearisedForces ElasticCounterface::linearise(const SlidingState &sliding, FaceEvaluation<2> &found)
  {
    slide(sliding, true, found);
    LinearisedForces result(found.forces.dofs);
    for (const auto &element_sum : parts)
      result.add(element_sum);
    found.forces.tangent = result.stiffness();
    return result;
  }

  void ElasticCounterface::slide(const SlidingState &sliding, const bool wants_parts, FaceEvaluation<2> &found)
  {
    found.begin(sliding.displacements, sliding.drive.x, 1.); // slip in a second
    const auto at = configuration(properties, sliding.displacements, sliding.drive.x);
    set_places({ at, at });
    in_parts       = wants_parts;
    const auto law = slide_friction(properties.friction, sliding);
    for (const unsigned int element_index : in_parts ? near(end.at) : candidates.clip(near(end.at), found.within_candidates))
    {
      begin_element(element_index);
      for (unsigned int q = first; q < face.elements[element].end; ++q)
      {
        auto &state          = add_point(q, found);
        state.trial_pressure = -properties.penalties.normal * state.gap;
        state.slip_change[0] = sliding.speed;
        if (state.gap < 0.)
          slide_point(state, sliding, law, found.sums);
      }
      end_element();
    }
    sum_forces(loaded, found.forces);
  }

  void ElasticCounterface::touch(const Vector<double> &displacements, const DrivePoint &drive, FaceEvaluation<2> &found)
  {
    found.begin(displacements, drive.x, 0.);
    const auto at = configuration(properties, displacements, drive.x);
    set_places({ at, at });
    for (const unsigned int element_index : near(end.at))
    {
      begin_element(element_index);
      for (unsigned int q = first; q < face.elements[element].end; ++q)
        add_point(q, found);
    }
    sum_forces(loaded, found.forces);
  }

  double ElasticCounterface::gap_change(const FacePointState<2> &point, const FaceEvaluation<2> &found,
                                        const Vector<double> &moved)
  {
    const auto at = configuration(properties, found.displacement, found.x);
    set_places({ at, at });
    begin_element(point.element);
    prepare_sums();
    find_rows(end.element_facets, facet_at_end(point.index), end.at, coordinates, properties.radius, end_rows);
    const auto on_interface = interface_coordinates();
    const auto dofs         = collect_dofs(on_interface);
    const auto row          = row_on_dofs(on_interface, end_rows.gap);
    double result           = 0.;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      result += row[i] * moved[dofs[i]];
    return result;
  }

  double ElasticCounterface::mean_slip(const FaceEvaluation<2> &found, const Vector<double> &from, const double from_x,
                                       const Vector<double> &to, const double to_x)
  {
    set_places({ configuration(properties, from, from_x), configuration(properties, to, to_x) });
    element = dealii::numbers::invalid_unsigned_int;
    return pressure_mean(lever_face, found,
                         [&](const FacePointState<2> &point)
                         {
                           if (point.element != element)
                             begin_element(point.element);
                           return slip(point);
                         });
  }

  /// Begins a step. The data of the beginning of the last one are kept where this one begins equally.
  void ElasticCounterface::set_places(const StepPlaces &places_)
  {
    places            = places_;
    end.at            = pair.configuration(places.end);
    end.first_slip    = first_slip(places.end);
    force_on_cylinder = 0.;
    in_parts          = false;
    loaded.clear();
    parts.clear();
    if (places.moves() && begin.set(*places.begin.displacement, places.begin.x))
    {
      begin_side.at         = pair.configuration(places.begin);
      begin_side.first_slip = first_slip(places.begin);
      begin_facets.clear();
      begin.near = near(begin_side.at);
    }
    begin_side.at.at = places.begin;
    if (places.balanced_at_end())
      return;
    between = *places.begin.displacement;
    between.sadd(1. - places.balance, places.balance, *places.end.displacement);
    const double theta = places.balanced(places.begin.theta, places.end.theta);
    const double x     = places.balanced(places.begin.x, places.end.x);
    balance_side.at    = pair.configuration({ &between, theta, x, properties.centre(x, theta) });
  }

  FaceElements<2>::Indices ElasticCounterface::near(const PairConfiguration &at) const
  {
    PairPlace place;
    return face.find_near({ at.at.centre.xi, at.at.centre.eta },
                          [&](const unsigned int element_index) { return pair.smallest_gap(element_index, at, place); });
  }

  double ElasticCounterface::first_slip(const FaceConfiguration &at) const
  {
    return undeformed_slip(at, { at.centre.xi + first_node[0], at.centre.eta + first_node[1] });
  }

  /// Returns the slip of a place in lever axes on the undeformed cylinder [mm].
  double ElasticCounterface::undeformed_slip(const FaceConfiguration &at, const dealii::Point<2> &place) const
  {
    return properties.cylinder.slip(properties.cylinder.pose(at.x, at.theta), in_space(place));
  }

  const ElementFacets &ElasticCounterface::facets_at_begin(const unsigned int element_index)
  {
    const auto [found, is_new] = begin_facets.try_emplace(element_index);
    if (is_new)
      pair.find_facets(element_index, begin_side.at, found->second);
    return found->second;
  }

  void ElasticCounterface::begin_element(const unsigned int element_index)
  {
    element    = element_index;
    first      = face.elements[element].begin;
    nodal      = FaceElements<2>::nodal(face.elements[element], *places.end.displacement);
    has_forces = false;
    pair.find_facets(element, end.at, end.element_facets);
  }

  /// Adds a point of the element, with its position and gap.
  FacePointState<2> &ElasticCounterface::add_point(const unsigned int point, FaceEvaluation<2> &found) const
  {
    auto &state    = found.points.emplace_back();
    state.index    = point;
    state.element  = element;
    state.position = FaceElements<2>::position(face.points[point], nodal);
    state.gap      = facet_at_end(point).gap;
    return state;
  }

  /// Returns how far the cylinder's undeformed surface has run past a facet, from where its first node without load counts 0
  /// against the undeformed body. Beside the cylinder's face that of the undeformed body.
  double ElasticCounterface::slip_coordinate(const Facet &facet, const FaceConfiguration &at, const double slip_offset,
                                             const unsigned int point) const
  {
    if (facet.opposed)
      return facet.arc + slip_offset;
    const auto &element_points = face.elements[face.point_elements[point]];
    return undeformed_slip(
        at, FaceElements<2>::position(face.points[point], FaceElements<2>::nodal(element_points, *at.displacement)));
  }

  double ElasticCounterface::slip_at_begin(const unsigned int point)
  {
    const unsigned int element_index = face.point_elements[point];
    const auto &facets               = facets_at_begin(element_index).facets;
    return slip_coordinate(facets[point - face.elements[element_index].begin], begin_side.at.at, begin_side.first_slip, point);
  }

  double ElasticCounterface::slip(const FacePointState<2> &state)
  {
    if (!places.moves())
      return 0.;
    const double stretch_at_begin = facets_at_begin(element).facets[state.index - first].stretch;
    return 0.5 * (stretch_at_begin + facet_at_end(state.index).stretch) * (slip_at_end(state.index) - slip_at_begin(state.index));
  }

  /// Returns the facets of the element beside one; the slope is the difference of their slips.
  std::array<unsigned int, 2> ElasticCounterface::neighbours(const unsigned int point) const
  {
    const auto &element_points = face.elements[element];
    return { { std::max(point, element_points.begin + 1) - 1, std::min(point + 1, element_points.end - 1) } };
  }

  /// Returns the distance of two facets along the undeformed face, which the facets of an element share evenly [mm].
  double ElasticCounterface::distance(const unsigned int from, const unsigned int to) const
  {
    const auto &element_points = face.elements[element];
    return element_points.length * (to - from) / (element_points.end - element_points.begin);
  }

  /// Returns the slope of the slip along the face [1].
  double ElasticCounterface::slope(const unsigned int point) const
  {
    const auto [before, after] = neighbours(point);
    return before == after ? 1. : (slip_at_end(after) - slip_at_end(before)) / distance(before, after);
  }

  /// Prepares the sums of an element before its first forces.
  void ElasticCounterface::prepare_sums()
  {
    if (has_forces)
      return;
    has_forces            = true;
    const auto is_opposed = [](const Facet &facet) { return facet.opposed; };
    at_face_end           = !std::all_of(end.element_facets.facets.begin(), end.element_facets.facets.end(), is_opposed);
    if (places.balanced_at_end())
      coordinates = pair.coordinates(element, { &end.element_facets });
    else
    {
      pair.find_facets(element, balance_side.at, balance_side.element_facets);
      coordinates = pair.coordinates(element, { &facets_at_begin(element), &end.element_facets, &balance_side.element_facets });
    }
    values.reinit(coordinates.size());
    for (auto *const matrix : { &tangent, &friction.by_displacement, &friction.by_velocity })
      matrix->reinit(coordinates.size(), coordinates.size());
    friction.delays.clear();
    force_row.reinit(coordinates.size());
    if (!places.balanced_at_end())
    {
      movement                      = change(*places.begin.displacement, *places.end.displacement);
      movement[coordinates.theta()] = places.end.theta - places.begin.theta;
      movement[coordinates.x()]     = places.end.x - places.begin.x;
    }
  }

  /// Returns how the displacements of the element's nodes change.
  Vector<double> ElasticCounterface::change(const Vector<double> &from, const Vector<double> &to) const
  {
    Vector<double> result(coordinates.size());
    for (unsigned int i = 0; i < coordinates.theta(); ++i)
      if (const unsigned int node = coordinates.nodes[i / 2]; node != FaceEdge<2>::held)
        result[i] = to[2 * node + i % 2] - from[2 * node + i % 2];
    return result;
  }

  void ElasticCounterface::step(FacePointState<2> &state, const ContactHistory &history, const FaceStep &step, ContactSums &sums)
  {
    prepare_sums();
    const double R     = properties.radius;
    const bool at_end  = places.balanced_at_end();
    const auto &last   = facet_at_end(state.index);
    const auto &side   = at_end ? end : balance_side;
    const auto &force  = side.element_facets.facets[state.index - first];
    const auto &before = places.moves() ? facets_at_begin(element).facets[state.index - first] : last;
    if (!last.opposed || !force.opposed || (!at_end && !before.opposed))
      return;
    find_rows(end.element_facets, last, end.at, coordinates, R, end_rows);
    if (!at_end)
      find_rows(side.element_facets, force, side.at, coordinates, R, balance_rows);
    const auto &rows = at_end ? end_rows : balance_rows;

    // Gap and slip as the only coordinates.
    const double share   = at_end ? 1. : 0.5; // of the stretch at the end
    const double stretch = (1. - share) * before.stretch + share * last.stretch;
    const double run     = (places.moves() ? slip_at_end(state.index) - slip_at_begin(state.index) : 0.) + step.surface_run;
    ContactKinematics<2> kinematics{};
    kinematics.gap         = state.gap;
    kinematics.slip        = stretch * run;
    kinematics.gap_row[0]  = 1.;
    kinematics.slip_row[1] = 1.;
    auto over_step         = step_to(kinematics, 0.);
    if (!at_end)
    {
      const auto bent     = bends(side.element_facets, force, side.at, coordinates, R, movement);
      over_step.gap_begin = before.gap;
      over_step.gap_bend  = bent.gap;
      over_step.slip_bend = bent.slip;
    }
    SlipShift shift;
    if (step.terms.travel != 0.)
      shift = slip_shift(face, state.index, slope(state.index), step.terms.travel,
                         unwinding_stiffness(step.terms.augmented, step.law.slip.stiffness), step.history,
                         [this](const unsigned int q) { return slip_at_begin(q); });
    over_step.slip_shift = stretch * shift.slip + shift.elastic;
    const auto response  = step_response(over_step, history, step.law);

    static_cast<PointTraction &>(state) = response;
    state.history.point                 = state.index;
    state.slip_change[0]                = stretch * (run + shift.slip) * step.terms.speed_ratio;
    state.elastic_slip =
        (response.traction - (step.terms.augmented ? history.traction : Slip())).norm() / step.law.slip.stiffness;
    sums.stored += force.weight * response.energy;
    sums.work.drive += force.weight * response.mean_traction * stretch * step.surface_run;
    sums.work.friction += force.weight * response.friction;
    sums.work.algorithmic += force.weight * response.algorithmic;
    sums.work.creep  = std::max(sums.work.creep, response.creep);
    sums.beyond_face = sums.beyond_face || (at_face_end && response.pressure > 0.);
    state.end_force  = on_lever(response.pressure, -response.traction[0], end_rows);
    values.add(force.weight * response.force[0], rows.gap, force.weight * response.force[1], rows.slip);
    force_on_cylinder +=
        force.weight * (response.force[0] * rows.gap[coordinates.x()] + response.force[1] * rows.slip[coordinates.x()]);
    const double d_shift = response.d_shift;
    if (shift.d_slope * d_shift != 0.)
      add_shift(last, state.index, shift, d_shift);
    add_tangent(response, force, stretch, run, share);
  }

  /// The change of slip varies with the place on the cylinder, its own turn and the stretch.
  void ElasticCounterface::add_tangent(const StepResponse<2> &response, const Facet &facet, const double stretch,
                                       const double run, const double end_stretch)
  {
    const bool at_end = places.balanced_at_end();
    const auto &side  = at_end ? end : balance_side;
    const auto &rows  = at_end ? end_rows : balance_rows;
    auto &slip_change = end_rows.arc;
    slip_change[coordinates.theta()] -= properties.radius;
    slip_change *= stretch;
    slip_change.add(end_stretch * run, end_rows.stretch);
    for (const auto &[i, row] : { std::pair{ 0u, &rows.gap }, { 1u, &rows.slip } })
    {
      force_row.equ(response.tangent[i][0], end_rows.gap);
      force_row.add(response.tangent[i][1], slip_change);
      add_product(facet.weight, *row, force_row, tangent);
    }
    const double share = (at_end ? 1. : places.balance) * facet.weight;
    add_curvature(side.element_facets, facet, side.at, coordinates, properties.radius, share * response.force[0],
                  share * response.force[1], tangent);
  }

  /// Adds how the traction on a facet changes with the slip's shift, by the stretch and by the slip's slope. Turning moves both
  /// neighbours equally.
  void ElasticCounterface::add_shift(const Facet &facet, const unsigned int point, const SlipShift &shift, const double d_shift)
  {
    add_product(-facet.weight * shift.slip * d_shift, end_rows.slip, end_rows.stretch, tangent);
    const auto [before, after] = neighbours(point);
    const auto &left           = facet_at_end(before);
    const auto &right          = facet_at_end(after);
    if (before == after || !left.opposed || !right.opposed)
      return;
    find_rows(end.element_facets, left, end.at, coordinates, properties.radius, at_left);
    find_rows(end.element_facets, right, end.at, coordinates, properties.radius, at_right);
    at_right.arc -= at_left.arc;
    add_product(-facet.weight * shift.d_slope * facet.stretch * d_shift / distance(before, after), end_rows.slip, at_right.arc,
                tangent);
  }

  /// Sets the tractions of a point with a gap < 0 that slides and adds its forces. Derivatives of the forces per area p G - t S,
  /// G and S the rows of gap and slip, v the slip speed at displacements at rest:
  ///   pressure       -eps G G + p dG/dq
  ///   friction       S (mu eps G + (dt/dv) dv/dq) - t dS/dq, in stick with the tangential penalty S S in place of dt/dv
  ///   friction_rate  -(dt/dv) S S
  void ElasticCounterface::slide_point(FacePointState<2> &state, const SlidingState &sliding, const FrictionLaw &law,
                                       ContactSums &sums)
  {
    prepare_sums();
    const double R      = properties.radius;
    const auto &penalty = properties.penalties;
    const auto &facet   = facet_at_end(state.index);
    find_rows(end.element_facets, facet, end.at, coordinates, R, end_rows);
    double &speed = state.slip_change[0];
    speed         = facet.stretch * sliding.speed;
    if (sliding.rates != nullptr)
    {
      auto rates                 = change(Vector<double>(sliding.rates->size()), *sliding.rates);
      rates[coordinates.theta()] = (*sliding.rates)[properties.layout.rotation()];
      rates[coordinates.x()]     = properties.layout.sprung ? -(*sliding.rates)[properties.layout.support()] : 0.;
      speed += end_rows.slip * rates;
    }
    sums.beyond_face            = sums.beyond_face || at_face_end;
    const bool slides           = sliding.friction == ContactFriction::sliding;
    const auto share            = slides ? sliding_friction(law, speed) : SlidingFriction{};
    state.pressure              = -penalty.normal * state.gap;
    state.traction[0]           = share.coefficient * state.pressure;
    state.mu                    = share.mu;
    state.slipping              = slides;
    state.history.traction      = state.traction;
    state.history.slip_speed[0] = sliding.speed;
    state.history.point         = state.index;
    state.elastic_slip          = state.traction.norm() / penalty.tangential;
    const double elastic        = law.regularisation_speed > 0. ? 0. : 0.5 * state.traction.norm_square() / penalty.tangential;
    sums.stored += facet.weight * (0.5 * penalty.normal * state.gap * state.gap + elastic);
    sums.penetration = std::max(sums.penetration, -state.gap);

    state.end_force         = on_lever(state.pressure, -state.traction[0], end_rows);
    const double normal     = facet.weight * state.pressure;
    const double tangential = -facet.weight * state.traction[0];
    const double by_speed   = -share.derivative * state.pressure;
    values.add(normal, end_rows.gap, tangential, end_rows.slip);
    add_product(-facet.weight * penalty.normal, end_rows.gap, end_rows.gap, tangent);
    force_row.equ(share.coefficient * penalty.normal, end_rows.gap);
    force_row.add(sliding.friction == ContactFriction::stuck ? -penalty.tangential : 0., end_rows.slip, by_speed * sliding.speed,
                  end_rows.stretch);
    add_product(facet.weight, end_rows.slip, force_row, in_parts ? friction.by_displacement : tangent);
    if (!in_parts)
      return add_curvature(end.element_facets, facet, end.at, coordinates, R, normal, tangential, tangent);
    add_curvature(end.element_facets, facet, end.at, coordinates, R, normal, 0., tangent);
    add_curvature(end.element_facets, facet, end.at, coordinates, R, 0., tangential, friction.by_displacement);
    add_product(facet.weight * by_speed, end_rows.slip, end_rows.slip, friction.by_velocity);
    const auto lag = friction_lag(law, penalty.tangential, false, share.by_mu * state.pressure, speed);
    if (lag.time == 0.)
      return;
    const auto on_interface = interface_coordinates();
    const auto on_dofs      = [&](const Vector<double> &row) { return row_on_dofs(on_interface, row); };
    auto &delay             = friction.delays.emplace_back(
                    FrictionDelay{ lag.time, on_dofs(end_rows.slip), on_dofs(end_rows.gap), on_dofs(end_rows.slip) });
    delay.force *= -facet.weight;
    delay.stiffness_row *= -lag.pressure * share.coefficient * penalty.normal;
    delay.stiffness_row.add(share.by_mu * state.pressure * sliding.speed, on_dofs(end_rows.stretch));
    delay.rate_row *= share.by_mu * state.pressure;
  }

  Tensor<1, 4> ElasticCounterface::on_lever(const double normal, const double along_slip, const FacetRows &rows) const
  {
    Tensor<1, 4> result;
    const auto force = [&](const unsigned int i) { return normal * rows.gap[i] + along_slip * rows.slip[i]; };
    for (unsigned int i = 0; i < 2 * coordinates.n_lever; ++i)
      result[i % 2] += force(i);
    result[2] = force(coordinates.theta());
    result[3] = force(coordinates.x());
    return result;
  }

  /// Returns the interface coordinates of the element.
  InterfaceCoordinates ElasticCounterface::interface_coordinates() const
  {
    InterfaceCoordinates result;
    for (unsigned int i = 0; i < coordinates.theta(); ++i)
      if (const unsigned int node = coordinates.nodes[i / 2]; node != FaceEdge<2>::held)
        result.push_back({ i, 2 * node + i % 2, 1. });
    add_frame(properties.layout, coordinates.theta(), coordinates.x(), result);
    return result;
  }

  /// Adds the forces of the element, if it has any: where they are wanted in parts the tangent is that of pressure alone.
  void ElasticCounterface::end_element()
  {
    if (!has_forces)
      return;
    const auto on_interface = interface_coordinates();
    InterfaceForces forces{ { collect_dofs(on_interface), row_on_dofs(on_interface, values) },
                            matrix_on_dofs(on_interface, tangent) };
    if (in_parts)
    {
      auto &part         = parts.emplace_back(forces.dofs);
      part.pressure      = forces.tangent;
      part.friction      = matrix_on_dofs(on_interface, friction.by_displacement);
      part.friction_rate = matrix_on_dofs(on_interface, friction.by_velocity);
      part.delays        = friction.delays;
    }
    loaded.push_back(std::move(forces));
  }
} // namespace sprag
