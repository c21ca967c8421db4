// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_contact.h"

#include "base/ranges.h"

#include "laws/friction_law.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace sprag
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  template <int dim>
  FaceContact<dim>::FaceContact(const FrictionFace<dim> &face_, FaceProperties properties_,
                                const FrictionFace<dim> &elastic_cylinder)
      : ContactFace<dim>(face_, std::move(properties_))
      , batched(grid, properties.cylinder)
  {
    if constexpr (dim == 2)
      if (!elastic_cylinder.elements.empty())
        elastic = std::make_unique<ElasticCounterface>(face, elastic_cylinder, grid, candidates, properties);
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

  template <int dim>
  RigidCylinder::Pose FaceContact<dim>::pose(const FaceConfiguration &at) const
  {
    return properties.cylinder.pose(at.x, at.theta, axis_turn(*at.displacement));
  }

  /// Keeps the data of the beginning of the last step where this one begins equally.
  template <int dim>
  void FaceContact<dim>::begin_step(const InterfaceStep &step, const std::optional<StaticTerms> &statics)
  {
    const bool is_new = begin.set(step.begin.position, step.from.x);
    const auto shifts = statics ? std::optional(std::pair(statics->travel, statics->augmented)) : std::nullopt;
    if (!is_new && begin_shifts == shifts && batched.begins_with(step.history))
      return;
    begin_shifts  = shifts;
    const auto at = configuration(properties, begin.displacements, begin.x);
    begin_pose    = pose(at);
    batched.begin(step.history);
    begin.near = statics ? Indices() : united(near(at, begin_pose), touched_elements(grid, step.history));
  }

  /// The gap is convex: over an element it lies above its tangent at the first node. The margin covers bending.
  template <int dim>
  typename FaceContact<dim>::Indices FaceContact<dim>::near(const FaceConfiguration &at,
                                                            const RigidCylinder::Pose &cylinder_pose) const
  {
    const auto position = [&](const typename FaceEdge<dim>::Node &node)
    {
      Point<3> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = node.position[d] + (node.index != FaceEdge<dim>::held ? (*at.displacement)[dim * node.index + d] : 0.);
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
    Point<dim> centre;
    centre[0] = at.centre.xi;
    centre[1] = at.centre.eta;
    return grid.find_near(centre, distance);
  }

  template <int dim>
  void FaceContact<dim>::evaluate(const InterfaceStep &step, FaceEvaluation<dim> &found,
                                  const std::optional<StaticTerms> &statics)
  {
    if constexpr (dim == 2)
      if (elastic)
        return elastic->evaluate(step, found, statics);
    begin_step(step, statics);
    const auto end       = configuration(properties, step.end, step.to.x);
    const auto constants = step_constants(step, end, statics);
    batched.set(constants);
    found.begin(step.end, step.to.x, step.weights.dt);
    near_elements = candidates.clip(united(near(end, constants.end), begin.near), found.within_candidates);
    place_elements(begin.displacements, step.history, statics);
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
  template <int dim>
  typename FaceContact<dim>::Constants FaceContact<dim>::constants(const Kind kind, const FaceConfiguration &end,
                                                                   StepTerms terms) const
  {
    Constants result;
    static_cast<StepTerms &>(result) = std::move(terms);
    result.kind                      = kind;
    result.begin = result.balance = result.end = pose(end);
    result.slopes                              = properties.layout.slopes;
    return result;
  }

  /// The elements that the contact only passes between beginning and end are no candidates. Without dofs that are looked at
  /// besides, the indentation takes them beside the contact.
  template <int dim>
  const DofSelection &FaceContact<dim>::candidate_dofs(const double x, const PerLever &theta, const double travel)
  {
    constexpr double over_radius = 0.05, infinity = std::numeric_limits<double>::max();
    const double reach         = properties.radius > 0. ? candidates.factor * over_radius * properties.radius : infinity;
    const double end           = properties.centre(x, theta.front()).xi;
    const auto [first, last]   = std::minmax(end - travel, end);
    const auto elements_within = [&, a = first, b = last](const double aside)
    {
      const auto between = [&](const double from, const double to)
      {
        Point<dim> low, high;
        for (unsigned int d = 0; d < dim; ++d)
          high[d] = infinity, low[d] = -infinity;
        low[0]  = from - aside;
        high[0] = to + aside;
        return grid.elements_in({ { low, high } });
      };
      return b - a > 2. * aside ? united(between(a, a), between(b, b)) : between(a, b);
    };
    const double beside = ContactFace<dim>::looks_beside ? 0. : 4. * properties.layer_thickness;
    candidates.set(grid, elements_within(reach), elements_within(reach + beside),
                   dim * static_cast<unsigned int>(face.nodes.size()), properties.layout.size());
    return candidates.dofs;
  }

  template <int dim>
  typename FaceContact<dim>::Constants FaceContact<dim>::step_constants(const InterfaceStep &step,
                                                                        const FaceConfiguration &end_at,
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

  template <int dim>
  void FaceContact<dim>::place_elements(const Vector<double> &displacements, const std::vector<ContactHistory> &history,
                                        const std::optional<StaticTerms> &statics)
  {
    for (const unsigned int element : near_elements)
      if (!batched.is_placed(element))
      {
        std::vector<SlipShift> shifts;
        for (unsigned int point = grid.elements[element].begin; statics && point < grid.elements[element].end; ++point)
          shifts.push_back(slip_shift(grid, point, 0., statics->travel,
                                      unwinding_stiffness(statics->augmented, properties.penalties.tangential), history,
                                      [this](const unsigned int q) { return slip_at(q, begin.displacements, begin_pose); }));
        batched.place(element, Elements::nodal(grid.elements[element], displacements), shifts);
      }
  }

  /// Presses the elements that are looked at, which are placed.
  template <int dim>
  void FaceContact<dim>::press_elements(const Vector<double> &end, FaceEvaluation<dim> &found)
  {
    pressed.clear();
    most_pressed.reset();
    Indices touched;
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
  template <int dim>
  void FaceContact<dim>::find_summed(Indices touched)
  {
    if (touched == summed.elements)
      return;
    constexpr unsigned int n_displacements = Batched::n_displacements;
    summed                                 = { std::move(touched), {}, {} };
    for (const unsigned int element : summed.elements)
    {
      auto &coordinates          = summed.coordinates.emplace_back();
      const auto &element_points = grid.elements[element];
      for (unsigned int i = 0; i < dim * element_points.n_nodes; ++i)
        coordinates.push_back({ Elements::max_nodes * (i % dim) + i / dim, dim * element_points.nodes[i / dim] + i % dim, 1. });
      add_frame(properties.layout, n_displacements, n_displacements + 1, coordinates);
      for (unsigned int i = 0; i < properties.layout.slopes; ++i)
        coordinates.push_back({ n_displacements + 2 + i, properties.layout.slope(i), 1. });
      append(summed.dofs, collect_dofs(coordinates));
    }
    sort_unique(summed.dofs);
    for (auto &coordinates : summed.coordinates)
      for (auto &coordinate : coordinates)
        coordinate.dof = find_index(coordinate.dof, summed.dofs);
  }

  /// Sums forces, and the tangent if requested, over the elements as evaluated last.
  template <int dim>
  void FaceContact<dim>::set_forces(const Request request, InterfaceForces &forces) const
  {
    forces.has_tangent = request == Request::with_tangent;
    forces.tangent.reinit(0, 0);
    forces.dofs = summed.dofs;
    forces.values.reinit(static_cast<unsigned int>(summed.dofs.size()));
    for (unsigned int i = 0; i < summed.elements.size(); ++i)
      for (const auto &[index, place, sign] : summed.coordinates[i])
        forces.values[place] += sign * pressed[i][index];
    if (forces.has_tangent)
      forces.tangent = tangent(Part::all);
  }

  template <int dim>
  dealii::FullMatrix<double> FaceContact<dim>::tangent(const Part part) const
  {
    const auto n = static_cast<unsigned int>(summed.dofs.size());
    dealii::FullMatrix<double> result(n, n);
    batched.find_tangents(summed.elements, part,
                          [&](const unsigned int i, const typename Batched::Tangent &element_tangent)
                          {
                            for (const auto &row : summed.coordinates[i])
                              for (const auto &column : summed.coordinates[i])
                                result(row.dof, column.dof) += row.sign * column.sign * element_tangent[row.index][column.index];
                          });
    return result;
  }

  template <int dim>
  void FaceContact<dim>::evaluate_sliding(const SlidingState &sliding, FaceEvaluation<dim> &found)
  {
    if constexpr (dim == 2)
      if (elastic)
        return elastic->evaluate_sliding(sliding, found);
    press_slide(sliding, false, found);
    set_forces(Request::with_tangent, found.forces);
    complete(found);
  }

  template <int dim>
  LinearisedForces FaceContact<dim>::linearise(const SlidingState &sliding, FaceEvaluation<dim> &found)
  {
    if constexpr (dim == 2)
      if (elastic)
        return elastic->linearise(sliding, found);
    press_slide(sliding, true, found);
    set_forces(Request::forces, found.forces);
    complete(found);
    add_points(found);
    LinearisedForces result(found.forces.dofs);
    result.pressure = tangent(Part::pressure);
    result.friction = tangent(Part::friction);
    if (sliding.friction != ContactFriction::sliding)
      return result;
    result.friction_rate = tangent(Part::friction_rate);
    result.delays        = friction_delays(slide_friction(properties.friction, sliding), found);
    return result;
  }

  /// The traction along the slip of a point lags. The delay of its direction by the spring of stick is left out.
  template <int dim>
  std::vector<FrictionDelay> FaceContact<dim>::friction_delays(const FrictionLaw &law, const FaceEvaluation<dim> &found) const
  {
    constexpr unsigned int n_displacements = Batched::n_displacements;
    const auto n                           = static_cast<unsigned int>(summed.dofs.size());
    const auto at                          = pose(configuration(properties, found.displacement, found.x));
    std::vector<FrictionDelay> result;
    for (const auto &point : found.points)
    {
      const double speed = point.slip_change.norm(); // of a second
      if (!(point.pressure > 0.) || speed == 0.)
        continue;
      const auto friction = sliding_friction(law, speed);
      const auto &penalty = properties.penalties;
      const auto lag      = friction_lag(law, penalty.tangential, false, friction.by_mu * point.pressure, speed);
      if (lag.time == 0.)
        continue;
      // Derivatives of gap and slip by the coordinates of the point.
      std::array<std::pair<double, double>, dim + 4> rows;
      for (unsigned int k = 0; k < dim + 4; ++k)
      {
        const auto unit = [&](const unsigned int i) { return k == i ? 1. : 0.; };
        const auto changes =
            properties.cylinder.changes(at, in_space(point.position), Tensor<1, 3>({ unit(0), unit(1), dim == 3 ? unit(2) : 0. }),
                                        unit(dim + 1), unit(dim), { { unit(dim + 2), unit(dim + 3) } });
        rows[k] = { changes[0], (changes[1] * point.slip_change[0] + changes[2] * point.slip_change[1]) / speed };
      }
      auto &delay = result.emplace_back(FrictionDelay{ lag.time, Vector<double>(n), Vector<double>(n), Vector<double>(n) });
      const auto &shapes = grid.points[point.index].shapes;
      for (const auto &[index, place, sign] : summed.coordinates[find_index(point.element, summed.elements)])
      {
        const bool is_node      = index < n_displacements;
        const auto &[gap, slip] = rows[is_node ? index / Elements::max_nodes : dim + index - n_displacements];
        const double share      = sign * (is_node ? shapes[index % Elements::max_nodes] : 1.);
        delay.force[place] -= share * face.points[point.index].weight * slip;
        delay.stiffness_row[place] -= share * lag.pressure * friction.coefficient * penalty.normal * gap;
        delay.rate_row[place] += share * friction.by_mu * point.pressure * slip;
      }
    }
    return result;
  }

  template <int dim>
  void FaceContact<dim>::press_slide(const SlidingState &sliding, const bool beyond_candidates, FaceEvaluation<dim> &found)
  {
    const auto at = configuration(properties, sliding.displacements, sliding.drive.x);
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

  template <int dim>
  void FaceContact<dim>::touch(const Vector<double> &z, const DrivePoint &drive, FaceEvaluation<dim> &found)
  {
    if constexpr (dim == 2)
      if (elastic)
        return elastic->touch(z, drive, found);
    const auto at   = configuration(properties, z, drive.x);
    const auto step = constants(Kind::touch, at, { contact_law(properties.penalties, {}) });
    found.begin(z, drive.x, 0.);
    press(step, z, near(at, step.end), found);
    add_points(found);
  }

  /// Presses where the step begins.
  template <int dim>
  void FaceContact<dim>::press(const Constants &step, const Vector<double> &displacements, Indices elements_near,
                               FaceEvaluation<dim> &found)
  {
    near_elements = std::move(elements_near);
    begin.displacements.reinit(0); // a step that follows begins anew
    batched.set(step);
    batched.begin({});
    place_elements(displacements);
    press_elements(displacements, found);
  }

  namespace
  {
    /// Returns the point closest to the middle of those under pressure, without any the one with the smallest gap.
    template <int dim>
    const FacePointState<dim> &contact_middle(const std::vector<FacePointState<dim>> &points)
    {
      std::vector<Point<dim>> closed;
      for (const auto &point : points)
        if (point.pressure > 0.)
          closed.push_back(point.position);
      const auto middle = closed.empty() ? Point<dim>() : dealii::BoundingBox<dim>(closed).center();
      const auto order  = [&](const FacePointState<dim> &point)
      { return closed.empty() ? point.gap : point.position.distance_square(middle); };
      return *std::min_element(points.begin(), points.end(), [&](const auto &a, const auto &b) { return order(a) < order(b); });
    }
  } // namespace

  template <int dim>
  double FaceContact<dim>::gap_change(const FaceEvaluation<dim> &found, const Vector<double> &change, unsigned int) const
  {
    const auto &point = contact_middle(found.points);
    if constexpr (dim == 2)
      if (elastic)
        return elastic->gap_change(point, found, change);
    const auto &at   = properties.layout;
    const auto moved = Elements::position(grid.points[point.index], Elements::nodal(grid.elements[point.element], change)) -
                       grid.points[point.index].position;
    return properties.cylinder.changes(pose(configuration(properties, found.displacement, found.x)), in_space(point.position),
                                       in_space(Point<dim>(moved)), at.sprung ? -change[at.support()] : 0., change[at.rotation()],
                                       axis_turn(change))[0];
  }

  template <int dim>
  double FaceContact<dim>::mean_slip(const FaceEvaluation<dim> &found, const Vector<double> &from, const double from_x,
                                     const Vector<double> &to, const double to_x) const
  {
    if constexpr (dim == 2)
      if (elastic)
        return elastic->mean_slip(found, from, from_x, to, to_x);
    const auto begin = pose(configuration(properties, from, from_x)), end = pose(configuration(properties, to, to_x));
    return pressure_mean(face, found,
                         [&](const FacePointState<dim> &point)
                         { return slip_at(point.index, to, end) - slip_at(point.index, from, begin); });
  }

  /// Returns the slip coordinate round the cylinder of a point, by its index in the face [mm].
  template <int dim>
  double FaceContact<dim>::slip_at(const unsigned int point, const Vector<double> &displacements,
                                   const RigidCylinder::Pose &cylinder_pose) const
  {
    const auto nodal = Elements::nodal(grid.elements[grid.point_elements[point]], displacements);
    return properties.cylinder.slip(cylinder_pose, in_space(Elements::position(grid.points[point], nodal)));
  }

  template <int dim>
  void FaceContact<dim>::add_points(FaceEvaluation<dim> &found) const
  {
    found.points.clear();
    for (const unsigned int element : near_elements)
      batched.add_points(element, true, found.points);
  }

  /// `peak`: element where the pressure is largest, if there is any.
  template <int dim>
  void FaceContact<dim>::add_points_in_contact(const std::optional<unsigned int> &peak, FaceEvaluation<dim> &found) const
  {
    const auto share_line = [&](const std::vector<unsigned int> &a, const std::vector<unsigned int> &b)
    { return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end(); };
    found.points.clear();
    for (const unsigned int element : near_elements)
      batched.add_points(element, !peak || share_line(element_lines[element], element_lines[*peak]), found.points);
  }

  /// Finds works, energy and points of the elements as they were pressed last.
  template <int dim>
  void FaceContact<dim>::complete(FaceEvaluation<dim> &found) const
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
    found.sums.beyond_face =
        dim == 3 && std::any_of(found.points.begin(), found.points.end(),
                                [&](const auto &point) { return point.pressure > 0. && is_at_end[point.element]; });
  }

  template class FaceContact<2>;
  template class FaceContact<3>;
} // namespace sprag
