#include "fe/pair_surface.h"

#include <algorithm>

namespace sprag
{
  using dealii::Tensor;
  using dealii::Vector;

  PairSurface::PairSurface(const ElasticBody<2> &body, const FacePatches &face_, const FaceStepProperties &properties_)
      : face(face_)
      , properties(properties_)
      , pair(body.friction_face(), body.cylinder_face())
  {
  }

  void PairSurface::enter(const FaceStepPlaces &places)
  {
    moves  = places.moves();
    end.at = pair.configuration(places.end);
    if (moves)
    {
      enter_begin(places.begin);
      enter_balance(places);
    }
  }

  FacePatches::Range PairSurface::near() const
  {
    const auto at_last = pair.near(end.at);
    return moves ? FacePatches::united(at_last, near_begin) : at_last;
  }

  /// The beginning of a step is the same in all its iterations.
  void PairSurface::enter_begin(const FaceConfiguration &at)
  {
    const bool same = known_begin.size() == at.displacement->size() && known_begin == *at.displacement && of_begin.at.x == at.x &&
                      of_begin.at.theta == at.theta;
    if (!same)
    {
      of_begin                 = pair.configuration(at);
      known_begin              = *at.displacement;
      of_begin.at.displacement = &known_begin;
      near_begin               = pair.near(of_begin);
      begin_facets.clear();
    }
  }

  void PairSurface::enter_balance(const FaceStepPlaces &places)
  {
    between = *places.begin.displacement;
    between.sadd(1. - places.balance, places.balance, *places.end.displacement);
    const double theta = places.balanced(places.begin.theta, places.end.theta);
    const double x     = places.balanced(places.begin.x, places.end.x);
    of_balance.at      = pair.configuration({ &between, theta, x, cylinder_centre(properties.geometry, x, theta) });
  }

  const PatchFacets &PairSurface::facets_at_begin()
  {
    if (!moves)
      return end.of;
    const auto found = begin_facets.try_emplace(patch);
    if (found.second)
      pair.find_facets(patch, of_begin, found.first->second);
    return found.first->second;
  }

  void PairSurface::enter(const unsigned int of_face)
  {
    patch   = of_face;
    first   = face.patches()[patch].begin;
    nodal   = FacePatches::nodal(face.patches()[patch], *end.at.at.displacement);
    touched = false;
    pair.find_facets(patch, end.at, end.of);
    at_begin = &facets_at_begin();
  }

  double PairSurface::place(FacePointState &state) const
  {
    state.position = FacePatches::position(face.points()[state.index], nodal);
    state.gap      = end.of.facets[state.index - first].gap;
    return at_begin->facets[state.index - first].gap;
  }

  /// Before the first forces of a patch.
  void PairSurface::touch()
  {
    if (touched)
      return;
    touched               = true;
    const auto is_opposed = [](const Facet &facet) { return facet.opposed; };
    at_end_of_face        = !std::all_of(end.of.facets.begin(), end.of.facets.end(), is_opposed);
    const auto &begin     = moves ? of_begin : end.at;
    const auto &balance   = moves ? of_balance : end;
    if (moves)
      pair.find_facets(patch, of_balance.at, of_balance.of);
    coordinates = pair.coordinates(patch, { at_begin, &end.of, &balance.of });
    values.reinit(coordinates.size());
    tangent.reinit(coordinates.size(), coordinates.size());
    force_row.reinit(coordinates.size());
    movement                      = change(*begin.at.displacement, *end.at.at.displacement);
    movement[coordinates.theta()] = end.at.at.theta - begin.at.theta;
    movement[coordinates.x()]     = end.at.at.x - begin.at.x;
  }

  /// Of the nodes of the patch.
  Vector<double> PairSurface::change(const Vector<double> &from, const Vector<double> &to) const
  {
    Vector<double> result(coordinates.size());
    for (unsigned int i = 0; i < coordinates.theta(); ++i)
      if (const unsigned int node = coordinates.nodes[i / 2]; node != FaceEdge<2>::held)
        result[i] = to[2 * node + i % 2] - from[2 * node + i % 2];
    return result;
  }

  void PairSurface::step(FacePointState &state, const double begin_gap, const ContactMemory &memory, const StepContactLaw &law,
                         const double surface_run, FaceStepSums &sums)
  {
    touch();
    const double R      = properties.geometry.cylinder_radius;
    const auto &balance = moves ? of_balance : end;
    const auto &at_0    = at_begin->facets[state.index - first];
    const auto &at_1    = end.of.facets[state.index - first];
    const auto &middle  = balance.of.facets[state.index - first];
    if (!at_0.opposed || !at_1.opposed || !middle.opposed)
      return;
    find_rows(end.of, at_1, end.at, coordinates, R, end_rows);
    find_rows(balance.of, middle, balance.at, coordinates, R, balance_rows);
    const auto bent = bends(balance.of, middle, balance.at, coordinates, R, movement);

    // Gap and slip as the only coordinates.
    const double stretch = 0.5 * (at_0.stretch + at_1.stretch);
    const double run     = at_1.arc - at_0.arc - R * movement[coordinates.theta()] + surface_run;
    StepKinematics<2> kinematics;
    kinematics.gap_begin       = begin_gap;
    kinematics.gap_end         = state.gap;
    kinematics.gap_row_end     = Tensor<1, 2>({ 1., 0. });
    kinematics.gap_row         = Tensor<1, 2>({ 1., 0. });
    kinematics.gap_bend        = bent.gap;
    kinematics.slip_change     = stretch * run;
    kinematics.slip_change_row = Tensor<1, 2>({ 0., 1. });
    kinematics.slip_row        = Tensor<1, 2>({ 0., 1. });
    kinematics.slip_bend       = bent.slip;
    const auto response        = step_response(kinematics, memory, law);

    record(response, kinematics.slip_change, middle.weight, stretch * surface_run, state, sums);
    sums.beyond_face = sums.beyond_face || (at_end_of_face && response.pressure > 0.);
    state.end_force  = on_lever(response.pressure, -response.traction, end_rows);
    add_force(middle.weight, response.force[0], response.force[1], balance_rows);
    sums.force_on_circle += middle.weight * (response.force[0] * balance_rows.gap[coordinates.x()] +
                                             response.force[1] * balance_rows.slip[coordinates.x()]);

    // The change of slip varies with the place on the cylinder, its own turn and the stretch.
    auto &slip_change_row = end_rows.arc;
    slip_change_row[coordinates.theta()] -= R;
    slip_change_row *= stretch;
    slip_change_row.add(0.5 * run, end_rows.stretch);
    for (const auto &[i, row] : { std::pair{ 0u, &balance_rows.gap }, { 1u, &balance_rows.slip } })
    {
      force_row.equ(response.tangent[i][0], end_rows.gap);
      force_row.add(response.tangent[i][1], slip_change_row);
      add_product(middle.weight, *row, force_row, tangent);
    }
    const double share = law.weights.stiffness() * middle.weight;
    add_curvature(balance.of, middle, balance.at, coordinates, R, share * response.force[0], share * response.force[1], tangent);
  }

  void PairSurface::slide(FacePointState &state, const SlidingState &sliding, const FrictionLaw &law, FaceStepSums &sums)
  {
    touch();
    const double R    = properties.geometry.cylinder_radius;
    const auto &facet = end.of.facets[state.index - first];
    find_rows(end.of, facet, end.at, coordinates, R, end_rows);
    state.slip_change = facet.stretch * sliding.speed;
    if (sliding.rates != nullptr)
    {
      auto rates                 = change(Vector<double>(sliding.rates->size()), *sliding.rates);
      rates[coordinates.theta()] = (*sliding.rates)[properties.ports.rotation()];
      rates[coordinates.x()]     = properties.ports.sprung ? -(*sliding.rates)[properties.ports.support()] : 0.;
      state.slip_change += end_rows.slip * rates;
    }
    sums.beyond_face = sums.beyond_face || at_end_of_face;
    const auto of    = sprag::slide(properties, law, sliding, facet.weight, state, sums);
    state.end_force  = on_lever(state.pressure, -state.traction, end_rows);
    add_force(facet.weight, state.pressure, -state.traction, end_rows);
    add_product(facet.weight * of.normal, end_rows.gap, end_rows.gap, tangent);
    add_product(facet.weight * of.coupled, end_rows.slip, end_rows.gap, tangent);
    add_product(facet.weight * of.tangential, end_rows.slip, end_rows.slip, tangent);
    add_product(facet.weight * of.by_speed * sliding.speed, end_rows.slip, end_rows.stretch, tangent);
    add_curvature(end.of, facet, end.at, coordinates, R, facet.weight * of.gap_curvature, facet.weight * of.slip_gradient,
                  tangent);
  }

  void PairSurface::add_force(const double weight, const double normal, const double along_slip, const FacetRows &rows)
  {
    values.add(weight * normal, rows.gap, weight * along_slip, rows.slip);
  }

  Tensor<1, 4> PairSurface::on_lever(const double normal, const double along_slip, const FacetRows &rows) const
  {
    Tensor<1, 4> result;
    const auto force = [&](const unsigned int i) { return normal * rows.gap[i] + along_slip * rows.slip[i]; };
    for (unsigned int i = 0; i < 2 * coordinates.n_lever; ++i)
      result[i % 2] += force(i);
    result[2] = force(coordinates.theta());
    result[3] = force(coordinates.x());
    return result;
  }

  /// Coordinates of the patch that are ports. The support's moves the circle's position back.
  std::vector<FaceCoordinate> PairSurface::ports() const
  {
    std::vector<FaceCoordinate> result;
    for (unsigned int i = 0; i < coordinates.theta(); ++i)
      if (const unsigned int node = coordinates.nodes[i / 2]; node != FaceEdge<2>::held)
        result.push_back({ i, 2 * node + i % 2, 1. });
    result.push_back({ coordinates.theta(), properties.ports.rotation(), 1. });
    if (properties.ports.sprung)
      result.push_back({ coordinates.x(), properties.ports.support(), -1. });
    return result;
  }

  void PairSurface::leave(FaceStepSums &sums)
  {
    if (touched)
      sums.loaded.push_back(forces_on_ports(
          ports(), [&](const unsigned int i) { return values[i]; },
          [&](const unsigned int i, const unsigned int j) { return tangent(i, j); }));
  }

  FacePointRows PairSurface::rows(const FacePointState &state)
  {
    touch();
    const auto &facet = end.of.facets[state.index - first];
    find_rows(end.of, facet, end.at, coordinates, properties.geometry.cylinder_radius, end_rows);
    const auto of_patch = ports();
    const auto n        = static_cast<unsigned int>(of_patch.size());
    FacePointRows result{ facet.weight, {}, Vector<double>(n), Vector<double>(n), Vector<double>(n) };
    for (unsigned int i = 0; i < n; ++i)
    {
      const auto &[coordinate, port, sign] = of_patch[i];
      result.ports.push_back(port);
      result.gap[i]     = sign * end_rows.gap[coordinate];
      result.slip[i]    = sign * end_rows.slip[coordinate];
      result.stretch[i] = sign * end_rows.stretch[coordinate];
    }
    return result;
  }

  double PairSurface::slip(const FacePointState &state) const
  {
    const auto &begin = moves ? of_begin : end.at;
    const auto &at_0  = at_begin->facets[state.index - first];
    const auto &at_1  = end.of.facets[state.index - first];
    const double run  = at_1.arc - at_0.arc - properties.geometry.cylinder_radius * (end.at.at.theta - begin.at.theta);
    return 0.5 * (at_0.stretch + at_1.stretch) * run;
  }
} // namespace sprag
