// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/surface_contact.h"

#include "laws/friction.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace sprag
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    const std::vector<SurfaceMemory> no_memory;
  } // namespace

  SurfaceContact::SurfaceContact(const FrictionFace<3> &face_, SurfaceContactProperties properties_)
      : face(face_)
      , properties(std::move(properties_))
      , patches(face)
      , view(face, patches, properties.half)
      , in_lanes(face, patches, properties.cylinder)
  {
    find_ends();
    for (const auto &patch : patches.patches)
    {
      std::set<unsigned int> lines;
      for (unsigned int q = patch.begin; q < patch.end; ++q)
        lines.insert(patches.point_lines[q]);
      patch_lines.emplace_back(lines.begin(), lines.end());
    }
  }

  void SurfaceContact::find_ends()
  {
    const auto is_before = [](const auto &a, const auto &b) { return a.position[0] < b.position[0]; };
    const auto ends      = std::minmax_element(face.nodes.begin(), face.nodes.end(), is_before);
    const double first = ends.first->position[0], last = ends.second->position[0];
    for (const auto &edge : face.edges)
      is_at_end.push_back(std::any_of(edge.nodes.begin(), edge.nodes.end(),
                                      [&](const auto &node) { return node.position[0] <= first || node.position[0] >= last; }));
  }

  RigidCylinder::Pose SurfaceContact::to_pose(const SurfacePlace &place) const
  {
    const double u = properties.ports.sprung ? place.ports[properties.ports.support()] : 0.;
    return properties.cylinder.pose(place.x - u, properties.rest_inclination + place.ports[properties.ports.rotation()],
                                    turned_by(place.ports));
  }

  AxisSlopes SurfaceContact::turned_by(const Vector<double> &ports) const
  {
    AxisSlopes result{};
    for (unsigned int i = 0; i < properties.ports.slopes; ++i)
      result[i] = ports[properties.ports.slope(i)];
    return result;
  }

  AxisSlopes SurfaceContact::slopes_in(const FaceEvaluation<3> &found) const
  {
    auto result = turned_by(found.displacement);
    for (unsigned int i = 0; i < 2; ++i)
      result[i] += properties.cylinder.slopes()[i];
    return result;
  }

  std::vector<unsigned int> SurfaceContact::nodes_at(const double zeta) const
  {
    double closest = std::numeric_limits<double>::max();
    for (const auto &node : face.nodes)
      closest = std::min(closest, std::abs(node.position[2] - zeta));
    std::vector<unsigned int> result;
    for (unsigned int i = 0; i < face.nodes.size(); ++i)
      if (std::abs(face.nodes[i].position[2] - zeta) < closest + 1e-6)
        result.push_back(i);
    return result;
  }

  /// Deflection under the contact beyond that on both sides of it, between the nodes closest to these places.
  double SurfaceContact::indentation(const FaceEvaluation<3> &found, const Row &row) const
  {
    if (properties.layer_thickness == 0. || !(row[Column::normal_resultant] > 0.))
      return 0.;
    const auto line       = nodes_at(row.across[4]);
    const double s        = row[Column::s];
    const double aside    = 0.5 * row[Column::contact_width] + 4. * properties.layer_thickness;
    const auto deflection = [&](const double xi)
    {
      const auto is_closer = [&](const unsigned int a, const unsigned int b)
      { return std::abs(face.nodes[a].position[0] - xi) < std::abs(face.nodes[b].position[0] - xi); };
      return found.displacement[3 * *std::min_element(line.begin(), line.end(), is_closer) + 1];
    };
    return deflection(s) - 0.5 * (deflection(s - aside) + deflection(s + aside));
  }

  SurfaceShape SurfaceContact::surface_shape(const Vector<double> &displacements, unsigned int) const
  {
    SurfaceShape shape;
    for (const unsigned int node : nodes_at(0.))
    {
      shape.xi.push_back(face.nodes[node].position[0]);
      shape.along.push_back(displacements[3 * node]);
      shape.across.push_back(displacements[3 * node + 1]);
    }
    return shape;
  }

  void SurfaceContact::observe(const FaceEvaluation<3> &found, Row &row, unsigned int) const
  {
    view.observe(found, row);
    row[Column::Q]           = drive_force(found);
    row[Column::indentation] = indentation(found, row);
    if (!properties.cylinder.has_free_axis())
      return;
    const auto slopes = slopes_in(found);
    row.across.insert(row.across.end(), slopes.begin(), slopes.end());
  }

  void SurfaceContact::begin_step(const SurfacePlace &begin)
  {
    begin_ports = begin.ports;
    begin_x     = begin.x;
    begin_pose  = to_pose(begin);
    begin_slips.resize(patches.patches.size());
    for (auto &patch_slips : begin_slips)
      patch_slips.clear();
    in_lanes.begin({});
  }

  double SurfaceContact::slip_at_begin(const unsigned int point) const
  {
    const unsigned int patch = patches.point_patch(point);
    const auto &patch_points = patches.patches[patch];
    auto &known              = begin_slips[patch];
    if (known.empty())
    {
      const auto nodal = Patches::nodal(patch_points, begin_ports);
      for (unsigned int q = patch_points.begin; q < patch_points.end; ++q)
        known.push_back(properties.cylinder.slip(begin_pose, Patches::position(patches.points[q], nodal)));
    }
    return known[point - patch_points.begin];
  }

  /// The gap is convex: over a patch it lies above its tangent at the first node. The margin covers bending.
  SurfaceContact::Patches::Indices SurfaceContact::near(const SurfacePlace &place, const RigidCylinder::Pose &pose) const
  {
    const auto position = [&](const FaceEdge<3>::Node &node)
    {
      auto result = node.position;
      if (node.index != FaceEdge<3>::held)
        for (unsigned int d = 0; d < 3; ++d)
          result[d] += place.ports[3 * node.index + d];
      return result;
    };
    const auto distance = [&](const unsigned int patch)
    {
      const auto &nodes          = face.edges[patch].nodes;
      const Point<3> first       = position(nodes.front());
      const auto [gap, gradient] = properties.cylinder.gap_and_gradient(pose, first);
      double fall                = 0.;
      for (const auto &node : nodes)
        fall = std::min(fall, gradient * (position(node) - first));
      return gap + fall - 0.02 * patches.patches[patch].length;
    };
    const auto centre = properties.centre(pose.x, pose.theta);
    return patches.find_near({ centre.xi, centre.eta, 0. }, distance);
  }

  void SurfaceContact::evaluate(const PortStep &step, FaceEvaluation<3> &found, const StaticTerms &terms)
  {
    if (begin_x != step.from.x || begin_ports.size() != step.begin.position.size() || begin_ports != step.begin.position ||
        begin_travel != terms.travel || begin_augmented != terms.augmented)
    {
      begin_step({ step.begin.position, step.from.x });
      begin_travel    = terms.travel;
      begin_augmented = terms.augmented;
    }
    found.duration = step.to.time - step.from.time;
    evaluate({ step.end, step.to.x }, *step.surface_memory, step.to.surface - step.from.surface, terms, found);
    if (terms.augmented) // multipliers spread over the cells
      add_points(found);
    else
      add_points_in_contact(most_pressed, found);
  }

  void SurfaceContact::evaluate(const SurfacePlace &end, const std::vector<SurfaceMemory> &memory, const double surface_run,
                                const StaticTerms &terms, FaceEvaluation<3> &found)
  {
    if (!in_lanes.begins_with(memory))
      in_lanes.begin(memory);
    auto step        = constants(Kind::at_end, end, terms.friction);
    step.begin       = begin_pose;
    step.sticks      = terms.mode == FrictionMode::stick;
    step.weights.dt  = terms.duration;
    step.surface_run = surface_run;
    step.augmented   = terms.augmented;
    step.speed_ratio = terms.speed_ratio;
    in_lanes.set(step);

    found.displacement     = end.ports;
    found.x                = end.x;
    found.sums.compression = 0.;
    found.points.clear();
    looked_at = reach.clip(near(end, step.end), found.within_reach);
    for (const unsigned int patch : looked_at)
      if (!in_lanes.is_placed(patch))
        in_lanes.place(patch, Patches::nodal(patches.patches[patch], begin_ports), slip_shifts(patch, memory, terms));
    press_patches(end.ports, found);
    set_forces(Request::with_tangent, found.forces);
  }

  /// Constants of a step that is balanced where it ends.
  StepInLanes::Constants SurfaceContact::constants(const Kind kind, const SurfacePlace &end, const FrictionLaw &friction) const
  {
    StepInLanes::Constants result;
    result.kind  = kind;
    result.begin = result.balance = result.end = to_pose(end);
    result.normal                              = { properties.penalties.normal, 1. };
    result.slip                                = slip_law(friction, properties.penalties.tangential);
    result.slopes                              = properties.ports.slopes;
    return result;
  }

  std::vector<SlipShift> SurfaceContact::slip_shifts(const unsigned int patch, const std::vector<SurfaceMemory> &memory,
                                                     const StaticTerms &terms) const
  {
    const double stiffness = unwinding_stiffness(terms.augmented, properties.penalties.tangential);
    std::vector<SlipShift> result;
    for (unsigned int point = patches.patches[patch].begin; point < patches.patches[patch].end; ++point)
      result.push_back(slip_shift(patches, point, 0., terms.travel, stiffness, memory,
                                  [this](const unsigned int q) { return slip_at_begin(q); }));
    return result;
  }

  PortCoordinates SurfaceContact::patch_coordinates(const unsigned int patch) const
  {
    PortCoordinates result;
    const auto &patch_points = patches.patches[patch];
    for (unsigned int i = 0; i < 3 * patch_points.n_nodes; ++i)
      result.push_back({ Patches::max_nodes * (i % 3) + i / 3, 3 * patch_points.nodes[i / 3] + i % 3, 1. });
    constexpr unsigned int n_displacements = StepInLanes::n_displacements;
    add_frame(properties.ports, n_displacements, n_displacements + 1, result);
    for (unsigned int i = 0; i < properties.ports.slopes; ++i)
      result.push_back({ n_displacements + 2 + i, properties.ports.slope(i), 1. });
    return result;
  }

  const PortSelection &SurfaceContact::reachable_ports(const double x, const PerLever &theta, const double travel)
  {
    constexpr double over_radius = 0.05;
    constexpr double infinity    = std::numeric_limits<double>::max();
    const double aside           = reach.factor * over_radius * properties.radius;
    const double end             = properties.centre(x, theta.front()).xi;
    const double begin           = end - travel;
    const auto between           = [&](const double a, const double b) {
      return patches.patches_in({ { { a - aside, -infinity, -infinity }, { b + aside, infinity, infinity } } });
    };
    const auto [first, last] = std::minmax(begin, end);
    const auto now = last - first > 2. * aside ? united(between(first, first), between(last, last)) : between(first, last);
    reach.set(patches, now, now, 3 * static_cast<unsigned int>(face.nodes.size()), properties.ports.size());
    return reach.ports;
  }

  StepInLanes::Constants SurfaceContact::step_constants(const PortStep &port_step) const
  {
    auto result = constants(Kind::in_time, { port_step.end, port_step.to.x }, step_friction(properties.friction, port_step.to.v));
    result.weights    = port_step.weights;
    result.begin      = begin_pose;
    result.share      = port_step.weights.stiffness();
    const auto &begin = result.begin, &end = result.end;
    const auto balanced = [share = result.share](const double a, const double b) { return (1. - share) * a + share * b; };
    result.balance =
        properties.cylinder.pose(balanced(begin.x, end.x), balanced(begin.theta, end.theta),
                                 { { balanced(begin.turned[0], end.turned[0]), balanced(begin.turned[1], end.turned[1]) } });
    result.surface_run = port_step.to.surface - port_step.from.surface;
    result.advance     = port_step.to.x - port_step.from.x;
    return result;
  }

  void SurfaceContact::evaluate(const PortStep &port_step, FaceEvaluation<3> &found)
  {
    const auto &memory  = port_step.surface_memory != nullptr ? *port_step.surface_memory : no_memory;
    const bool is_first = begin_ports.size() != port_step.begin.position.size();
    if (is_first || begin_x != port_step.from.x || begin_ports != port_step.begin.position || !in_lanes.begins_with(memory))
    {
      begin_step({ port_step.begin.position, port_step.from.x });
      in_lanes.begin(memory);
      looked_at_first = united(near({ begin_ports, begin_x }, begin_pose), touched_patches(patches, memory));
    }
    const auto step = step_constants(port_step);
    in_lanes.set(step);

    found.displacement     = port_step.end;
    found.x                = port_step.to.x;
    found.duration         = port_step.weights.dt;
    found.sums.compression = 0.;
    looked_at = reach.clip(united(near({ port_step.end, port_step.to.x }, step.end), looked_at_first), found.within_reach);
    place_patches(port_step.begin.position);
    press_patches(port_step.end, found);
    set_forces(port_step.request, found.forces);
    if (port_step.request == Request::complete)
      complete(found);
  }

  void SurfaceContact::place_patches(const Vector<double> &begin)
  {
    for (const unsigned int patch : looked_at)
      if (!in_lanes.is_placed(patch))
        in_lanes.place(patch, Patches::nodal(patches.patches[patch], begin));
  }

  /// Presses the patches that are looked at, which are placed.
  void SurfaceContact::press_patches(const Vector<double> &end, FaceEvaluation<3> &found)
  {
    pressed.clear();
    most_pressed.reset();
    Patches::Indices touched;
    for (const unsigned int patch : looked_at)
    {
      auto &forces        = pressed.emplace_back();
      const double before = found.sums.compression;
      if (in_lanes.press(patch, Patches::nodal(patches.patches[patch], end), forces, found.sums.compression))
        touched.push_back(patch);
      else
        pressed.pop_back();
      if (found.sums.compression > before)
        most_pressed = patch;
    }
    find_summed(std::move(touched));
  }

  /// The ports of some patches and the places of their coordinates among these are found again where the patches change alone.
  void SurfaceContact::find_summed(Patches::Indices touched)
  {
    if (touched == summed.patches)
      return;
    summed = { std::move(touched), {}, {} };
    for (const unsigned int patch : summed.patches)
    {
      summed.coordinates.push_back(patch_coordinates(patch));
      const auto ports = collect_ports(summed.coordinates.back());
      summed.ports.insert(summed.ports.end(), ports.begin(), ports.end());
    }
    std::sort(summed.ports.begin(), summed.ports.end());
    summed.ports.erase(std::unique(summed.ports.begin(), summed.ports.end()), summed.ports.end());
    for (auto &coordinates : summed.coordinates)
      for (auto &coordinate : coordinates)
        coordinate.port = find_index(coordinate.port, summed.ports);
  }

  /// From the patches that were pressed last.
  void SurfaceContact::set_forces(const Request request, PortForces &forces) const
  {
    forces.has_tangent = request == Request::with_tangent;
    forces.tangent.reinit(0, 0);
    forces.ports = summed.ports;
    forces.values.reinit(static_cast<unsigned int>(summed.ports.size()));
    for (unsigned int i = 0; i < summed.patches.size(); ++i)
      for (const auto &[index, place, sign] : summed.coordinates[i])
        forces.values[place] += sign * pressed[i][index];
    if (forces.has_tangent)
      forces.tangent = tangent(StepInLanes::Part::all);
  }

  dealii::FullMatrix<double> SurfaceContact::tangent(const StepInLanes::Part part) const
  {
    const auto n = static_cast<unsigned int>(summed.ports.size());
    dealii::FullMatrix<double> result(n, n);
    in_lanes.find_tangents(summed.patches, part,
                           [&](const unsigned int i, const StepInLanes::Tangent &patch_tangent)
                           {
                             for (const auto &row : summed.coordinates[i])
                               for (const auto &column : summed.coordinates[i])
                                 result(row.port, column.port) += row.sign * column.sign * patch_tangent[row.index][column.index];
                           });
    return result;
  }

  void SurfaceContact::evaluate_sliding(const SlidingState &sliding, FaceEvaluation<3> &found)
  {
    press_slide(sliding, found);
    set_forces(sliding.request, found.forces);
    if (sliding.request != Request::forces)
      complete(found);
  }

  PortPerturbation SurfaceContact::linearise(const SlidingState &sliding, FaceEvaluation<3> &found)
  {
    press_slide(sliding, found);
    set_forces(Request::forces, found.forces);
    complete(found);
    add_points(found);
    PortPerturbation result(found.forces.ports);
    result.pressure      = tangent(StepInLanes::Part::pressure);
    result.friction      = tangent(StepInLanes::Part::friction);
    result.friction_rate = tangent(StepInLanes::Part::friction_rate);
    return result;
  }

  void SurfaceContact::press_slide(const SlidingState &sliding, FaceEvaluation<3> &found)
  {
    const SurfacePlace place{ sliding.ports, sliding.drive.x };
    found.begin(sliding.ports, sliding.drive.x, 1.); // slips are those of a second
    auto step           = constants(Kind::slide, place, slide_friction(properties.friction, sliding));
    step.slide.speed    = sliding.speed;
    step.slide.friction = sliding.friction;
    if (sliding.rates != nullptr)
    {
      step.slide.rates       = sliding.rates;
      step.slide.theta_rate  = (*sliding.rates)[properties.ports.rotation()];
      step.slide.x_rate      = properties.ports.sprung ? -(*sliding.rates)[properties.ports.support()] : 0.;
      step.slide.slope_rates = turned_by(*sliding.rates);
    }
    press(step, place, reach.clip(near(place, step.end), found.within_reach), found);
  }

  std::vector<SurfaceMemory> SurfaceContact::touch(const Vector<double> &ports, const DrivePoint &drive, FaceEvaluation<3> &found)
  {
    const SurfacePlace place{ ports, drive.x };
    const auto step = constants(Kind::touch, place, {});
    found.begin(ports, drive.x, 0.);
    press(step, place, near(place, step.end), found);
    add_points(found);
    return {};
  }

  /// Presses where the step begins.
  void SurfaceContact::press(const StepInLanes::Constants &step, const SurfacePlace &place, Patches::Indices patches_near,
                             FaceEvaluation<3> &found)
  {
    looked_at = std::move(patches_near);
    begin_ports.reinit(0); // a step in time that follows begins anew
    in_lanes.set(step);
    in_lanes.begin({});
    place_patches(place.ports);
    press_patches(place.ports, found);
  }

  double SurfaceContact::gap_change(const FaceEvaluation<3> &found, const Vector<double> &port_change, unsigned int) const
  {
    const auto &point =
        *std::min_element(found.points.begin(), found.points.end(), [](const auto &a, const auto &b) { return a.gap < b.gap; });
    const auto &patch_points = patches.points[point.index];
    const auto &at           = properties.ports;
    const auto nodal         = Patches::nodal(patches.patches[point.patch], port_change);
    return properties.cylinder.changes(
        to_pose({ found.displacement, found.x }), point.position, Patches::position(patch_points, nodal) - patch_points.position,
        at.sprung ? -port_change[at.support()] : 0., port_change[at.rotation()], turned_by(port_change))[0];
  }

  double SurfaceContact::mean_slip(const FaceEvaluation<3> &found, const Vector<double> &from, const double from_x,
                                   const Vector<double> &to, const double to_x) const
  {
    double weighted = 0., weights = 0.;
    for (const auto &point : found.points)
      if (point.pressure > 0.)
      {
        const double weight = face.points[point.index].weight * point.pressure;
        weighted += weight * (slip_at(point, { to, to_x }) - slip_at(point, { from, from_x }));
        weights += weight;
      }
    return weights > 0. ? weighted / weights : 0.;
  }

  /// The slip coordinate round the cylinder of a point, in another configuration [mm].
  double SurfaceContact::slip_at(const FacePointState<3> &point, const SurfacePlace &place) const
  {
    const auto nodal = Patches::nodal(patches.patches[point.patch], place.ports);
    return properties.cylinder.slip(to_pose(place), Patches::position(patches.points[point.index], nodal));
  }

  void SurfaceContact::add_points(FaceEvaluation<3> &found) const
  {
    found.points.clear();
    for (const unsigned int patch : looked_at)
      in_lanes.add_points(patch, true, found.points);
  }

  bool SurfaceContact::share_line(const unsigned int patch, const unsigned int other) const
  {
    const auto &a = patch_lines[patch], &b = patch_lines[other];
    return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
  }

  /// `peak`: patch where the pressure is largest, if there is any.
  void SurfaceContact::add_points_in_contact(const std::optional<unsigned int> &peak, FaceEvaluation<3> &found) const
  {
    found.points.clear();
    for (const unsigned int patch : looked_at)
      in_lanes.add_points(patch, !peak || share_line(patch, *peak), found.points);
  }

  /// Finds works, energy and points of the patches as they were pressed last.
  void SurfaceContact::complete(FaceEvaluation<3> &found) const
  {
    StepInLanes::Sums sums;
    std::optional<unsigned int> peak;
    for (const unsigned int patch : looked_at)
    {
      const double before = sums.pressure;
      in_lanes.add_sums(patch, sums);
      if (sums.pressure > before)
        peak = patch;
    }
    add_points_in_contact(peak, found);
    found.sums.stored           = sums.stored;
    found.sums.beyond_face      = reaches_end(found);
    found.sums.work             = StepWork();
    found.sums.work.drive       = sums.drive;
    found.sums.work.friction    = sums.friction;
    found.sums.work.algorithmic = sums.algorithmic;
    found.sums.work.creep       = sums.creep;
  }

  bool SurfaceContact::reaches_end(const FaceEvaluation<3> &found) const
  {
    return std::any_of(found.points.begin(), found.points.end(),
                       [&](const auto &point) { return point.pressure > 0. && is_at_end[point.patch]; });
  }
} // namespace sprag
