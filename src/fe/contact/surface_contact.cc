// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/surface_contact.h"

#include "laws/friction_law.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace sprag
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  SurfaceContact::SurfaceContact(const FrictionFace<3> &face_, FaceProperties<3> properties_)
      : ContactFace<3>(face_, std::move(properties_))
      , batched(face, grid, properties.cylinder)
  {
    const auto is_before = [](const auto &a, const auto &b) { return a.position[0] < b.position[0]; };
    const auto ends      = std::minmax_element(face.nodes.begin(), face.nodes.end(), is_before);
    const double first = ends.first->position[0], last = ends.second->position[0];
    for (const auto &edge : face.edges)
      is_at_end.push_back(std::any_of(edge.nodes.begin(), edge.nodes.end(),
                                      [&](const auto &node) { return node.position[0] <= first || node.position[0] >= last; }));
    for (const auto &element : grid.elements)
    {
      std::set<unsigned int> lines;
      for (unsigned int q = element.begin; q < element.end; ++q)
        lines.insert(grid.point_lines[q]);
      element_lines.emplace_back(lines.begin(), lines.end());
    }
  }

  RigidCylinder::Pose SurfaceContact::pose(const FaceConfiguration &at) const
  {
    return properties.cylinder.pose(at.x, at.theta, axis_turn(*at.displacement));
  }

  /// Keeps the data of the beginning of the last step where this one begins equally.
  void SurfaceContact::begin_step(const InterfaceStep &step, const std::optional<StaticTerms> &statics)
  {
    const bool is_new = begin_at(step.begin.position, step.from.x);
    const auto shifts = statics ? std::optional(std::pair(statics->travel, statics->augmented)) : std::nullopt;
    if (!is_new && begin_shifts == shifts && batched.begins_with(step.history))
      return;
    begin_shifts  = shifts;
    const auto at = configuration(begin_displacements, begin_x);
    begin_pose    = pose(at);
    batched.begin(step.history);
    near_begin = statics ? Elements::Indices() : united(near(at, begin_pose), touched_elements(grid, step.history));
  }

  /// The gap is convex: over an element it lies above its tangent at the first node. The margin covers bending.
  SurfaceContact::Elements::Indices SurfaceContact::near(const FaceConfiguration &at,
                                                         const RigidCylinder::Pose &cylinder_pose) const
  {
    const auto position = [&](const FaceEdge<3>::Node &node)
    {
      auto result = node.position;
      if (node.index != FaceEdge<3>::held)
        for (unsigned int d = 0; d < 3; ++d)
          result[d] += (*at.displacement)[3 * node.index + d];
      return result;
    };
    const auto distance = [&](const unsigned int element)
    {
      const auto &nodes          = face.edges[element].nodes;
      const Point<3> first       = position(nodes.front());
      const auto [gap, gradient] = properties.cylinder.gap_and_gradient(cylinder_pose, first);
      double fall                = 0.;
      for (const auto &node : nodes)
        fall = std::min(fall, gradient * (position(node) - first));
      return gap + fall - 0.02 * grid.elements[element].length;
    };
    return grid.find_near({ at.centre.xi, at.centre.eta, 0. }, distance);
  }

  void SurfaceContact::evaluate(const InterfaceStep &step, FaceEvaluation<3> &found, const std::optional<StaticTerms> &statics)
  {
    begin_step(step, statics);
    const auto end       = configuration(step.end, step.to.x);
    const auto constants = step_constants(step, end, statics);
    batched.set(constants);
    found.begin(step.end, step.to.x, step.weights.dt);
    near_elements = candidates.clip(united(near(end, constants.end), near_begin), found.within_candidates);
    place_elements(begin_displacements, step.history, statics);
    press_elements(step.end, found);
    set_forces(step.request, found.forces);
    if (statics && statics->augmented) // multipliers spread over the cells
      add_points(found);
    else if (statics)
      add_points_in_contact(most_pressed, found);
    else if (step.request == Request::complete)
      complete(found);
  }

  /// Constants of a step that is balanced where it ends.
  BatchedStep::Constants SurfaceContact::constants(const Kind kind, const FaceConfiguration &end, StepTerms terms) const
  {
    BatchedStep::Constants result;
    static_cast<StepTerms &>(result) = std::move(terms);
    result.kind                      = kind;
    result.begin = result.balance = result.end = pose(end);
    result.slopes                              = properties.layout.slopes;
    return result;
  }

  const DofSelection &SurfaceContact::candidate_dofs(const double x, const PerLever &theta, const double travel)
  {
    constexpr double over_radius = 0.05;
    constexpr double infinity    = std::numeric_limits<double>::max();
    const double aside           = candidates.factor * over_radius * properties.radius;
    const double end             = properties.centre(x, theta.front()).xi;
    const double begin           = end - travel;
    const auto between           = [&](const double a, const double b) {
      return grid.elements_in({ { { a - aside, -infinity, -infinity }, { b + aside, infinity, infinity } } });
    };
    const auto [first, last] = std::minmax(begin, end);
    const auto now = last - first > 2. * aside ? united(between(first, first), between(last, last)) : between(first, last);
    candidates.set(grid, now, now, 3 * static_cast<unsigned int>(face.nodes.size()), properties.layout.size());
    return candidates.dofs;
  }

  BatchedStep::Constants SurfaceContact::step_constants(const InterfaceStep &step, const FaceConfiguration &end_at,
                                                        const std::optional<StaticTerms> &statics) const
  {
    auto result  = constants(statics ? Kind::at_end : Kind::in_time, end_at, step_terms(properties, step, statics));
    result.begin = begin_pose;
    if (statics)
      return result;
    result.share      = step.weights.stiffness();
    result.advance    = step.to.x - step.from.x;
    const auto &begin = result.begin, &end = result.end;
    const auto balanced = [share = result.share](const double a, const double b) { return (1. - share) * a + share * b; };
    result.balance =
        properties.cylinder.pose(balanced(begin.x, end.x), balanced(begin.theta, end.theta),
                                 { { balanced(begin.turned[0], end.turned[0]), balanced(begin.turned[1], end.turned[1]) } });
    return result;
  }

  void SurfaceContact::place_elements(const Vector<double> &begin, const std::vector<ContactHistory> &history,
                                      const std::optional<StaticTerms> &statics)
  {
    for (const unsigned int element : near_elements)
      if (!batched.is_placed(element))
      {
        std::vector<SlipShift> shifts;
        for (unsigned int point = grid.elements[element].begin; statics && point < grid.elements[element].end; ++point)
          shifts.push_back(slip_shift(grid, point, 0., statics->travel,
                                      unwinding_stiffness(statics->augmented, properties.penalties.tangential), history,
                                      [this](const unsigned int q) { return slip_at(q, begin_displacements, begin_pose); }));
        batched.place(element, Elements::nodal(grid.elements[element], begin), shifts);
      }
  }

  /// Presses the elements that are looked at, which are placed.
  void SurfaceContact::press_elements(const Vector<double> &end, FaceEvaluation<3> &found)
  {
    pressed.clear();
    most_pressed.reset();
    Elements::Indices touched;
    for (const unsigned int element : near_elements)
    {
      auto &forces        = pressed.emplace_back();
      const double before = found.sums.penetration;
      if (batched.press(element, Elements::nodal(grid.elements[element], end), forces, found.sums.penetration))
        touched.push_back(element);
      else
        pressed.pop_back();
      if (found.sums.penetration > before)
        most_pressed = element;
    }
    find_summed(std::move(touched));
  }

  /// The dofs of some elements and the places of their coordinates among these are found again only where the elements change.
  void SurfaceContact::find_summed(Elements::Indices touched)
  {
    if (touched == summed.elements)
      return;
    constexpr unsigned int n_displacements = BatchedStep::n_displacements;
    summed                                 = { std::move(touched), {}, {} };
    for (const unsigned int element : summed.elements)
    {
      auto &coordinates          = summed.coordinates.emplace_back();
      const auto &element_points = grid.elements[element];
      for (unsigned int i = 0; i < 3 * element_points.n_nodes; ++i)
        coordinates.push_back({ Elements::max_nodes * (i % 3) + i / 3, 3 * element_points.nodes[i / 3] + i % 3, 1. });
      add_frame(properties.layout, n_displacements, n_displacements + 1, coordinates);
      for (unsigned int i = 0; i < properties.layout.slopes; ++i)
        coordinates.push_back({ n_displacements + 2 + i, properties.layout.slope(i), 1. });
      const auto dofs = collect_dofs(coordinates);
      summed.dofs.insert(summed.dofs.end(), dofs.begin(), dofs.end());
    }
    std::sort(summed.dofs.begin(), summed.dofs.end());
    summed.dofs.erase(std::unique(summed.dofs.begin(), summed.dofs.end()), summed.dofs.end());
    for (auto &coordinates : summed.coordinates)
      for (auto &coordinate : coordinates)
        coordinate.dof = find_index(coordinate.dof, summed.dofs);
  }

  /// Sums forces, and the tangent if requested, over the elements as evaluated last.
  void SurfaceContact::set_forces(const Request request, InterfaceForces &forces) const
  {
    forces.has_tangent = request == Request::with_tangent;
    forces.tangent.reinit(0, 0);
    forces.dofs = summed.dofs;
    forces.values.reinit(static_cast<unsigned int>(summed.dofs.size()));
    for (unsigned int i = 0; i < summed.elements.size(); ++i)
      for (const auto &[index, place, sign] : summed.coordinates[i])
        forces.values[place] += sign * pressed[i][index];
    if (forces.has_tangent)
      forces.tangent = tangent(BatchedStep::Part::all);
  }

  dealii::FullMatrix<double> SurfaceContact::tangent(const BatchedStep::Part part) const
  {
    const auto n = static_cast<unsigned int>(summed.dofs.size());
    dealii::FullMatrix<double> result(n, n);
    batched.find_tangents(summed.elements, part,
                          [&](const unsigned int i, const BatchedStep::Tangent &element_tangent)
                          {
                            for (const auto &row : summed.coordinates[i])
                              for (const auto &column : summed.coordinates[i])
                                result(row.dof, column.dof) += row.sign * column.sign * element_tangent[row.index][column.index];
                          });
    return result;
  }

  void SurfaceContact::evaluate_sliding(const SlidingState &sliding, FaceEvaluation<3> &found)
  {
    press_slide(sliding, false, found);
    set_forces(Request::with_tangent, found.forces);
    complete(found);
  }

  LinearisedForces SurfaceContact::linearise(const SlidingState &sliding, FaceEvaluation<3> &found)
  {
    press_slide(sliding, true, found);
    set_forces(Request::forces, found.forces);
    complete(found);
    add_points(found);
    LinearisedForces result(found.forces.dofs);
    result.pressure      = tangent(BatchedStep::Part::pressure);
    result.friction      = tangent(BatchedStep::Part::friction);
    result.friction_rate = tangent(BatchedStep::Part::friction_rate);
    if (sliding.friction == ContactFriction::sliding)
      result.delays = friction_delays(slide_friction(properties.friction, sliding), sliding.speed);
    return result;
  }

  /// Returns one delay on each dof, of the sum of all points: a mu that falls with speed follows it over the memory length, which
  /// takes all points equally long. None for other laws.
  std::vector<FrictionDelay> SurfaceContact::friction_delays(const FrictionLaw &law, const double speed) const
  {
    std::vector<FrictionDelay> result;
    if (!falls_with_speed(law))
      return result;
    const auto by_rates = tangent(BatchedStep::Part::mu_rate);
    const auto n        = static_cast<unsigned int>(by_rates.m());
    for (unsigned int i = 0; i < n; ++i)
    {
      FrictionDelay delay{ law.memory_length / std::abs(speed), Vector<double>(n), Vector<double>(n), Vector<double>(n) };
      delay.force[i] = 1.;
      for (unsigned int j = 0; j < n; ++j)
        delay.rate_row[j] = by_rates(i, j);
      if (!delay.rate_row.all_zero())
        result.push_back(std::move(delay));
    }
    return result;
  }

  void SurfaceContact::press_slide(const SlidingState &sliding, const bool beyond_candidates, FaceEvaluation<3> &found)
  {
    const auto at = configuration(sliding.displacements, sliding.drive.x);
    found.begin(sliding.displacements, sliding.drive.x, 1.); // slips are those of a second
    auto step = constants(Kind::slide, at, { contact_law(properties.penalties, slide_friction(properties.friction, sliding)) });
    step.slide.speed    = sliding.speed;
    step.slide.friction = sliding.friction;
    if (sliding.rates != nullptr)
    {
      step.slide.rates       = sliding.rates;
      step.slide.theta_rate  = (*sliding.rates)[properties.layout.rotation()];
      step.slide.x_rate      = properties.layout.sprung ? -(*sliding.rates)[properties.layout.support()] : 0.;
      step.slide.slope_rates = axis_turn(*sliding.rates);
    }
    auto elements_near = near(at, step.end);
    if (!beyond_candidates)
      elements_near = candidates.clip(std::move(elements_near), found.within_candidates);
    press(step, sliding.displacements, std::move(elements_near), found);
  }

  void SurfaceContact::touch(const Vector<double> &z, const DrivePoint &drive, FaceEvaluation<3> &found)
  {
    const auto at   = configuration(z, drive.x);
    const auto step = constants(Kind::touch, at, { contact_law(properties.penalties, {}) });
    found.begin(z, drive.x, 0.);
    press(step, z, near(at, step.end), found);
    add_points(found);
  }

  /// Presses where the step begins.
  void SurfaceContact::press(const BatchedStep::Constants &step, const Vector<double> &displacements,
                             Elements::Indices elements_near, FaceEvaluation<3> &found)
  {
    near_elements = std::move(elements_near);
    begin_displacements.reinit(0); // a step that follows begins anew
    batched.set(step);
    batched.begin({});
    place_elements(displacements);
    press_elements(displacements, found);
  }

  double SurfaceContact::gap_change(const FaceEvaluation<3> &found, const Vector<double> &change, unsigned int) const
  {
    const auto &point =
        *std::min_element(found.points.begin(), found.points.end(), [](const auto &a, const auto &b) { return a.gap < b.gap; });
    const auto &element_points = grid.points[point.index];
    const auto &at             = properties.layout;
    const auto nodal           = Elements::nodal(grid.elements[point.element], change);
    return properties.cylinder.changes(pose(configuration(found.displacement, found.x)), point.position,
                                       Elements::position(element_points, nodal) - element_points.position,
                                       at.sprung ? -change[at.support()] : 0., change[at.rotation()], axis_turn(change))[0];
  }

  double SurfaceContact::mean_slip(const FaceEvaluation<3> &found, const Vector<double> &from, const double from_x,
                                   const Vector<double> &to, const double to_x) const
  {
    const auto begin = pose(configuration(from, from_x)), end = pose(configuration(to, to_x));
    return pressure_mean(found, [&](const FacePointState<3> &point)
                         { return slip_at(point.index, to, end) - slip_at(point.index, from, begin); });
  }

  /// Returns the slip coordinate round the cylinder of a point, by its index in the face [mm].
  double SurfaceContact::slip_at(const unsigned int point, const Vector<double> &displacements,
                                 const RigidCylinder::Pose &cylinder_pose) const
  {
    const auto nodal = Elements::nodal(grid.elements[grid.point_elements[point]], displacements);
    return properties.cylinder.slip(cylinder_pose, Elements::position(grid.points[point], nodal));
  }

  void SurfaceContact::add_points(FaceEvaluation<3> &found) const
  {
    found.points.clear();
    for (const unsigned int element : near_elements)
      batched.add_points(element, true, found.points);
  }

  /// `peak`: element where the pressure is largest, if there is any.
  void SurfaceContact::add_points_in_contact(const std::optional<unsigned int> &peak, FaceEvaluation<3> &found) const
  {
    const auto share_line = [&](const std::vector<unsigned int> &a, const std::vector<unsigned int> &b)
    { return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end(); };
    found.points.clear();
    for (const unsigned int element : near_elements)
      batched.add_points(element, !peak || share_line(element_lines[element], element_lines[*peak]), found.points);
  }

  /// Finds works, energy and points of the elements as they were pressed last.
  void SurfaceContact::complete(FaceEvaluation<3> &found) const
  {
    double largest = 0.;
    std::optional<unsigned int> peak;
    for (const unsigned int element : near_elements)
      if (const double pressure = batched.add_sums(element, found.sums); pressure > largest)
      {
        largest = pressure;
        peak    = element;
      }
    add_points_in_contact(peak, found);
    found.sums.beyond_face = std::any_of(found.points.begin(), found.points.end(),
                                         [&](const auto &point) { return point.pressure > 0. && is_at_end[point.element]; });
  }
} // namespace sprag
