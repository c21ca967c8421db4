// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/elastic_counterface.h"

#include <algorithm>

namespace sprag
{
  using dealii::Tensor;
  using dealii::Vector;

  ElasticCounterface::ElasticCounterface(const FrictionFace<2> &lever, const FrictionFace<2> &cylinder,
                                         const FaceElements<2> &face_, const FaceProperties<2> &properties_)
      : face(face_)
      , properties(properties_)
      , pair(lever, cylinder)
      , first_node(cylinder.edges.front().nodes.front().position)
  {
  }

  void ElasticCounterface::set_places(const StepPlaces &places_, const bool begins_anew)
  {
    places         = places_;
    end.at         = pair.configuration(places.end);
    end.first_slip = first_slip(places.end);
    if (begins_anew)
    {
      begin_side.at         = pair.configuration(places.begin);
      begin_side.first_slip = first_slip(places.begin);
      begin_facets.clear();
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
    return properties.counterface(at.x, at.theta)({ at.centre.xi + first_node[0], at.centre.eta + first_node[1] }).slip;
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

  bool ElasticCounterface::place(FacePointState<2> &state) const
  {
    const auto &facet = facet_at_end(state.index);
    state.position    = FaceElements<2>::position(face.points[state.index], nodal);
    state.gap         = facet.gap;
    return facet.opposed;
  }

  /// Returns how far the cylinder's undeformed surface has run past a facet, from where its first node without load counts 0
  /// against the undeformed body. Beside the cylinder's face that of the undeformed body.
  double ElasticCounterface::slip_coordinate(const Facet &facet, const FaceConfiguration &at, const double slip_offset,
                                             const unsigned int point) const
  {
    if (facet.opposed)
      return facet.arc + slip_offset;
    const auto &element_points = face.elements[face.point_elements[point]];
    const auto position = FaceElements<2>::position(face.points[point], FaceElements<2>::nodal(element_points, *at.displacement));
    return properties.counterface(at.x, at.theta)({ position[0], position[1] }).slip;
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
    const double R    = properties.radius;
    const bool at_end = places.balanced_at_end();
    const auto &last  = facet_at_end(state.index);
    const auto &side  = at_end ? end : balance_side;
    const auto &force = side.element_facets.facets[state.index - first];
    const auto *begin = places.moves() ? &facets_at_begin(element).facets[state.index - first] : &last;
    if (!last.opposed || !force.opposed || (!at_end && !begin->opposed))
      return;
    find_rows(end.element_facets, last, end.at, coordinates, R, end_rows);
    if (!at_end)
      find_rows(side.element_facets, force, side.at, coordinates, R, balance_rows);
    const auto &rows = at_end ? end_rows : balance_rows;

    // Gap and slip as the only coordinates.
    const double share   = at_end ? 1. : 0.5; // of the stretch at the end
    const double stretch = (1. - share) * begin->stretch + share * last.stretch;
    const double run     = (places.moves() ? slip_at_end(state.index) - slip_at_begin(state.index) : 0.) + step.surface_run;
    ContactKinematics<2> kinematics{};
    kinematics.gap         = state.gap;
    kinematics.slip        = stretch * run;
    kinematics.gap_row[0]  = 1.;
    kinematics.slip_row[1] = 1.;
    auto over_step         = step_to(kinematics, 0.);
    if (!at_end)
    {
      const auto bent        = bends(side.element_facets, force, side.at, coordinates, R, movement);
      over_step.gap_begin    = begin->gap;
      over_step.gap_bend     = bent.gap;
      over_step.slip_bend[0] = bent.slip;
    }
    SlipShift shift;
    if (step.terms.travel != 0.)
      shift = slip_shift(face, state.index, slope(state.index), step.terms.travel,
                         unwinding_stiffness(step.terms.augmented, step.law.slip.stiffness), step.history,
                         [this](const unsigned int q) { return slip_at_begin(q); });
    over_step.slip_shift[0] = stretch * shift.slip + shift.elastic;
    const auto response     = step_response(over_step, history, step.law);

    record(response, step, history, stretch * (run + shift.slip), force.weight, stretch * step.surface_run, state, sums);
    sums.beyond_face = sums.beyond_face || (at_face_end && response.pressure > 0.);
    state.end_force  = on_lever(response.pressure, -response.traction[0], end_rows);
    values.add(force.weight * response.force[0], rows.gap, force.weight * response.force[1], rows.slip);
    sums.force_on_counterface +=
        force.weight * (response.force[0] * rows.gap[coordinates.x()] + response.force[1] * rows.slip[coordinates.x()]);
    const double d_shift = response.d_shift[0][0];
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

  void ElasticCounterface::slide(FacePointState<2> &state, const SlidingState &sliding, const FrictionLaw &law, ContactSums &sums)
  {
    prepare_sums();
    const double R    = properties.radius;
    const auto &facet = facet_at_end(state.index);
    find_rows(end.element_facets, facet, end.at, coordinates, R, end_rows);
    state.slip_change[0] = facet.stretch * sliding.speed;
    if (sliding.rates != nullptr)
    {
      auto rates                 = change(Vector<double>(sliding.rates->size()), *sliding.rates);
      rates[coordinates.theta()] = (*sliding.rates)[properties.layout.rotation()];
      rates[coordinates.x()]     = properties.layout.sprung ? -(*sliding.rates)[properties.layout.support()] : 0.;
      state.slip_change[0] += end_rows.slip * rates;
    }
    sums.beyond_face        = sums.beyond_face || at_face_end;
    const auto tangents     = sprag::slide(properties, law, sliding, facet.weight, state, sums);
    state.end_force         = on_lever(state.pressure, -state.traction[0], end_rows);
    const double normal     = facet.weight * state.pressure;
    const double tangential = -facet.weight * state.traction[0];
    values.add(normal, end_rows.gap, tangential, end_rows.slip);
    add_product(facet.weight * tangents.normal, end_rows.gap, end_rows.gap, tangent);
    force_row.equ(tangents.coupled, end_rows.gap);
    force_row.add(tangents.stuck, end_rows.slip, tangents.by_speed * sliding.speed, end_rows.stretch);
    add_product(facet.weight, end_rows.slip, force_row, sums.in_parts ? friction.by_displacement : tangent);
    if (!sums.in_parts)
      return add_curvature(end.element_facets, facet, end.at, coordinates, R, normal, tangential, tangent);
    add_curvature(end.element_facets, facet, end.at, coordinates, R, normal, 0., tangent);
    add_curvature(end.element_facets, facet, end.at, coordinates, R, 0., tangential, friction.by_displacement);
    add_product(facet.weight * tangents.by_speed, end_rows.slip, end_rows.slip, friction.by_velocity);
    if (tangents.lag.time > 0.)
      friction.delays.push_back(friction_delay(tangents, sliding.speed, rows_on_dofs(facet)));
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

  void ElasticCounterface::end_element(ContactSums &sums)
  {
    if (has_forces)
      add_element(interface_coordinates(), values, tangent, friction, sums);
  }

  FacePointRows ElasticCounterface::rows(const FacePointState<2> &state)
  {
    prepare_sums();
    const auto &facet = facet_at_end(state.index);
    find_rows(end.element_facets, facet, end.at, coordinates, properties.radius, end_rows);
    return rows_on_dofs(facet);
  }

  /// Returns the rows that were found last, over the interface dofs.
  FacePointRows ElasticCounterface::rows_on_dofs(const Facet &facet) const
  {
    const auto on_interface = interface_coordinates();
    return { facet.weight, collect_dofs(on_interface), row_on_dofs(on_interface, end_rows.gap),
             row_on_dofs(on_interface, end_rows.slip), row_on_dofs(on_interface, end_rows.stretch) };
  }
} // namespace sprag
