// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  using dealii::Vector;

  namespace
  {
    std::variant<RigidCounterface, ElasticCounterface> make_counterface(const ElasticBody<2> &body, const FaceElements<2> &grid,
                                                                        const FaceProperties<2> &properties)
    {
      using Counterfaces = std::variant<RigidCounterface, ElasticCounterface>;
      if (body.cylinder_face().elements.empty())
        return Counterfaces(std::in_place_type<RigidCounterface>, body.friction_face(), grid, properties);
      return Counterfaces(std::in_place_type<ElasticCounterface>, body.friction_face(), body.cylinder_face(), grid, properties);
    }
  } // namespace

  FaceContact::FaceContact(const ElasticBody<2> &body, FaceProperties<2> properties_)
      : ContactFace<2>(body.friction_face(), std::move(properties_))
      , counterface(make_counterface(body, grid, properties))
      , dof_places(properties.layout.size())
  {
  }

  template <class ElementVisitor>
  void FaceContact::visit_elements(const FaceElements<2>::Indices &elements, const ElementVisitor &visit_element) const
  {
    std::visit(
        [&](auto &below)
        {
          for (const unsigned int element : elements)
          {
            below.begin_element(element);
            visit_element(below, element);
          }
        },
        counterface);
  }

  void FaceContact::evaluate(const InterfaceStep &step, FaceEvaluation<2> &found, const std::optional<StaticTerms> &statics) const
  {
    found.begin(step.end, step.to.x, step.weights.dt);
    const FaceStep face_step{ step_terms(properties, step, statics), step.history };
    const StepPlaces places{ configuration(step.begin.position, step.from.x), configuration(step.end, step.to.x),
                             step.weights.stiffness(), statics.has_value() };
    set_places(places);
    // If forces are means over the step, elements near and in contact when it began belong to it.
    auto elements = near_end();
    if (!places.balanced_at_end())
      elements = united(elements, near_begin);
    if (!places.static_end)
      elements = united(elements, touched_elements(grid, step.history));
    visit_elements(candidates.clip(std::move(elements), found.within_candidates),
                   [&](auto &below, const unsigned int element) { step_element(below, element, face_step, found); });
    sum_forces(found.sums.loaded, dof_places, found.forces);
    found.sums.work.drive -= found.sums.force_on_counterface * (step.to.x - step.from.x);
  }

  /// Begins a step. The data of the beginning of the last one are kept where this one begins equally.
  void FaceContact::set_places(const StepPlaces &places) const
  {
    const bool begins_anew = places.moves() && begin_at(*places.begin.displacement, places.begin.x);
    std::visit(
        [&](auto &below)
        {
          below.set_places(places, begins_anew);
          if (begins_anew)
            near_begin = below.near_begin();
        },
        counterface);
  }

  FacePointState<2> &FaceContact::add_point(const unsigned int element, const unsigned int point, FaceEvaluation<2> &found)
  {
    FacePointState<2> &state = found.points.emplace_back();
    state.index              = point;
    state.element            = element;
    return state;
  }

  template <class CounterfaceBelow>
  void FaceContact::step_element(CounterfaceBelow &below, const unsigned int element, const FaceStep &step,
                                 FaceEvaluation<2> &found) const
  {
    const double penalty    = properties.penalties.normal;
    const bool ends_balance = step.law.balance == ForceBalance::end;
    auto known              = find_history(step.history, grid.elements[element].begin);
    for (unsigned int q = grid.elements[element].begin; q < grid.elements[element].end; ++q)
    {
      auto &state            = add_point(element, q, found);
      const bool can_touch   = below.place(state);
      const bool has_history = known != step.history.end() && known->point == q;
      const auto history     = has_history ? *known++ : ContactHistory{};
      state.trial_pressure   = (can_touch ? history.normal_multiplier : 0.) - penalty * state.gap;
      const double begin_gap = ends_balance ? state.gap : below.gap_at_begin(q);
      const bool stays_open  = ends_balance ? state.trial_pressure <= 0. : state.gap >= 0. && begin_gap >= 0. && !has_history;
      if (stays_open)
        continue;
      found.sums.penetration =
          std::max(found.sums.penetration, ends_balance ? state.trial_pressure / penalty : -std::min(state.gap, begin_gap));
      below.step(state, history, step, found.sums);
    }
    below.end_element(found.sums);
  }

  LinearisedForces FaceContact::linearise(const SlidingState &state, FaceEvaluation<2> &found) const
  {
    slide(state, true, found);
    LinearisedForces result(found.forces.dofs);
    for (const auto &element_sum : found.sums.parts)
      result.add(element_sum);
    found.forces.tangent = result.stiffness();
    return result;
  }

  void FaceContact::slide(const SlidingState &sliding, const bool in_parts, FaceEvaluation<2> &found) const
  {
    found.begin(sliding.displacements, sliding.drive.x, 1.); // slip in a second
    found.sums.in_parts = in_parts;
    const auto at       = configuration(sliding.displacements, sliding.drive.x);
    set_places({ at, at });
    const auto law = slide_friction(properties.friction, sliding);
    visit_elements(in_parts ? near_end() : candidates.clip(near_end(), found.within_candidates),
                   [&](auto &below, const unsigned int element)
                   {
                     for (unsigned int q = grid.elements[element].begin; q < grid.elements[element].end; ++q)
                     {
                       auto &state = add_point(element, q, found);
                       below.place(state);
                       state.trial_pressure = -properties.penalties.normal * state.gap;
                       state.slip_change[0] = sliding.speed;
                       if (state.gap < 0.)
                         below.slide(state, sliding, law, found.sums);
                     }
                     below.end_element(found.sums);
                   });
    sum_forces(found.sums.loaded, dof_places, found.forces);
  }

  const DofSelection &FaceContact::candidate_dofs(const double x, const PerLever &inclinations, const double travel)
  {
    const double radius_limit  = properties.radius > 0. ? 0.05 * properties.radius : std::numeric_limits<double>::infinity();
    const double near_distance = candidates.factor * radius_limit + std::abs(travel);
    const double aside         = 4. * properties.layer_thickness; // where the face is looked at besides
    const double xi            = properties.centre(x, inclinations.front()).xi;
    const auto elements_within = [&](const double distance)
    {
      constexpr double infinity = std::numeric_limits<double>::max();
      return grid.elements_in({ { { xi - distance, -infinity }, { xi + distance, infinity } } });
    };
    candidates.set(grid, elements_within(near_distance), elements_within(near_distance + aside),
                   2 * static_cast<unsigned int>(face.nodes.size()), properties.layout.size());
    return candidates.dofs;
  }

  void FaceContact::touch(const Vector<double> &displacements, const DrivePoint &drive, FaceEvaluation<2> &found) const
  {
    found.begin(displacements, drive.x, 0.);
    const auto at = configuration(displacements, drive.x);
    set_places({ at, at });
    visit_elements(near_end(),
                   [&](auto &below, const unsigned int element)
                   {
                     for (unsigned int q = grid.elements[element].begin; q < grid.elements[element].end; ++q)
                       below.place(add_point(element, q, found));
                   });
    sum_forces(found.sums.loaded, dof_places, found.forces);
  }

  namespace
  {
    /// Returns the point in the middle of those under pressure, or the closest one if there are none.
    const FacePointState<2> &contact_middle(const std::vector<FacePointState<2>> &points)
    {
      const auto is_closed = [](const auto &point) { return point.pressure > 0.; };
      const auto first     = std::find_if(points.begin(), points.end(), is_closed);
      const auto last      = std::find_if(points.rbegin(), points.rend(), is_closed);
      if (first != points.end())
        return points[((first - points.begin()) + (points.rend() - last - 1)) / 2];
      return *std::min_element(points.begin(), points.end(), [](const auto &a, const auto &b) { return a.gap < b.gap; });
    }
  } // namespace

  double FaceContact::gap_change(const FaceEvaluation<2> &found, const Vector<double> &moved, unsigned int) const
  {
    const auto at = configuration(found.displacement, found.x);
    set_places({ at, at });
    const auto &point = contact_middle(found.points);
    double change     = 0.;
    visit_elements({ point.element },
                   [&](auto &below, unsigned int)
                   {
                     const auto rows = below.rows(point);
                     for (unsigned int i = 0; i < rows.dofs.size(); ++i)
                       change += rows.gap[i] * moved[rows.dofs[i]];
                   });
    return change;
  }

  double FaceContact::mean_slip(const FaceEvaluation<2> &found, const Vector<double> &from, const double from_x,
                                const Vector<double> &to, const double to_x) const
  {
    set_places({ configuration(from, from_x), configuration(to, to_x) });
    return std::visit(
        [&](auto &below)
        {
          unsigned int element = dealii::numbers::invalid_unsigned_int;
          return pressure_mean(found,
                               [&](const FacePointState<2> &point)
                               {
                                 if (point.element != element)
                                   below.begin_element(element = point.element);
                                 return below.slip(point);
                               });
        },
        counterface);
  }
} // namespace sprag
