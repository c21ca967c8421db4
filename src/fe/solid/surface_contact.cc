#include "fe/solid/surface_sums.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace sprag
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  std::vector<SurfaceMemory> SurfaceEvaluation::memory() const
  {
    if (beyond_face)
      throw AnalysisError("the contact reaches the end of the friction face, or of the part of it that is looked at");
    std::vector<SurfaceMemory> result;
    for (const auto &point : points)
      if (point.pressure > 0.)
        result.push_back(point.memory);
    return result;
  }

  SurfaceContact::SurfaceContact(const FrictionFace<3> &face_, SurfaceContactProperties properties_)
      : face(face_)
      , properties(std::move(properties_))
      , patches(face)
      , in_lanes(face, patches)
      , place_of_port(properties.ports.size())
  {
    find_lines();
    find_ends();
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

  void SurfaceContact::find_lines()
  {
    std::map<long, std::vector<unsigned int>> by_zeta;
    for (unsigned int q = 0; q < face.points.size(); ++q)
      by_zeta[std::lround(1e6 * face.points[q].position[2])].push_back(q);
    place_in_line.resize(face.points.size());
    for (auto &[zeta, points] : by_zeta)
    {
      const auto by_xi = [&](const unsigned int a, const unsigned int b)
      { return face.points[a].position[0] < face.points[b].position[0]; };
      std::sort(points.begin(), points.end(), by_xi);
      for (unsigned int i = 0; i < points.size(); ++i)
        place_in_line[points[i]] = { static_cast<unsigned int>(points_of_line.size()), i };
      points_of_line.push_back(std::move(points));
    }
    for (const auto &patch : patches.patches)
    {
      std::set<unsigned int> lines;
      for (unsigned int q = patch.begin; q < patch.end; ++q)
        lines.insert(place_in_line[q].first);
      lines_of_patch.emplace_back(lines.begin(), lines.end());
    }
  }

  RigidCylinder::Pose SurfaceContact::pose_of(const SurfacePlace &place) const
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

  AxisSlopes SurfaceContact::slopes_in(const SurfaceEvaluation &found) const
  {
    auto result = turned_by(found.displacement);
    for (unsigned int i = 0; i < 2; ++i)
      result[i] += properties.cylinder.slopes()[i];
    return result;
  }

  void SurfaceContact::begin_step(const SurfacePlace &begin)
  {
    begin_ports = begin.ports;
    begin_x     = begin.x;
    begin_pose  = pose_of(begin);
    begin_slips.resize(patches.patches.size());
    for (auto &of_patch : begin_slips)
      of_patch.clear();
    in_lanes.begin({});
  }

  const std::vector<SurfaceContact::Slips> &SurfaceContact::slips_of_patch_at_begin(const unsigned int patch) const
  {
    auto &known    = begin_slips[patch];
    const auto &of = patches.patches[patch];
    if (known.empty())
    {
      const auto nodal = Patches::nodal(of, begin_ports);
      for (unsigned int q = of.begin; q < of.end; ++q)
        known.push_back(properties.cylinder.slips(begin_pose, Patches::position(patches.points[q], nodal)));
    }
    return known;
  }

  const std::array<double, 2> &SurfaceContact::slips_at_begin(const unsigned int point) const
  {
    const unsigned int patch = patches.patch_of_point(point);
    return slips_of_patch_at_begin(patch)[point - patches.patches[patch].begin];
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

  void SurfaceContact::evaluate(const PortStep &step, SurfaceEvaluation &found, const StaticTerms &terms)
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
      add_points_in_contact(found);
  }

  void SurfaceContact::evaluate(const SurfacePlace &end, const std::vector<SurfaceMemory> &memory, const double surface_run,
                                const StaticTerms &terms, SurfaceEvaluation &found)
  {
    if (!in_lanes.begins_with(memory))
      in_lanes.begin(memory);
    StepInLanes::Constants step = constants();
    step.law.friction           = terms.friction;
    step.law.balance            = ForceBalance::end;
    step.law.mode               = terms.mode;
    step.law.weights.dt         = terms.duration;
    step.begin                  = begin_pose;
    step.balance = step.end = pose_of(end);
    step.share              = 1.;
    step.surface_run        = surface_run;
    step.augmented          = terms.augmented;
    step.speed_ratio        = terms.speed_ratio;
    in_lanes.set(step);

    found.displacement = end.ports;
    found.x            = end.x;
    found.compression  = 0.;
    found.points.clear();
    looked_at = clip(near(end, step.end), found);
    for (const unsigned int patch : looked_at)
      if (!in_lanes.is_placed(patch))
        in_lanes.place(patch, Patches::nodal(patches.patches[patch], begin_ports), shifts_of(patch, memory, terms));
    press_patches(end.ports, found);
    set_forces(Wanted::with_tangent, found.forces);
  }

  /// What is the same in every step.
  StepInLanes::Constants SurfaceContact::constants() const
  {
    StepInLanes::Constants result;
    result.law.normal     = { properties.penalties.normal, 1. };
    result.law.tangential = properties.penalties.tangential;
    result.law.weights    = StepWeights();
    result.cylinder       = properties.cylinder.shape();
    result.slopes         = properties.ports.slopes;
    return result;
  }

  FacePointState<3> &SurfaceContact::add_point(const unsigned int patch, const unsigned int point, const Patches::Nodal &nodal,
                                               const RigidCylinder::Pose &pose, SurfaceEvaluation &found) const
  {
    auto &state          = found.points.emplace_back();
    state.index          = point;
    state.patch          = patch;
    state.position       = Patches::position(patches.points[point], nodal);
    state.gap            = properties.cylinder.gap(pose, state.position);
    state.trial_pressure = -properties.penalties.normal * state.gap;
    return state;
  }

  void SurfaceContact::add_patch(const unsigned int patch, const Sums &sums, std::vector<PortForces> &loaded) const
  {
    if (!sums.touched)
      return;
    const auto coordinates = coordinates_of(patch);
    loaded.push_back(
        { ports_of(coordinates), row_on_ports(coordinates, sums.values), matrix_on_ports(coordinates, sums.tangent) });
  }

  /// See slip_shift(): the place that had the same distance from the contact when the step began has the same zeta.
  std::vector<SlipShift> SurfaceContact::shifts_of(const unsigned int patch, const std::vector<SurfaceMemory> &memory,
                                                   const StaticTerms &terms) const
  {
    const auto traction_of = [&](const unsigned int point)
    {
      const auto is_before = [](const SurfaceMemory &entry, const unsigned int q) { return entry.point < q; };
      const auto found     = std::lower_bound(memory.begin(), memory.end(), point, is_before);
      return found != memory.end() && found->point == point ? found->traction[0] : 0.;
    };
    const auto xi_of = [&](const unsigned int q) { return face.points[q].position[0]; };
    std::vector<SlipShift> result;
    for (unsigned int point = patches.patches[patch].begin; point < patches.patches[patch].end; ++point)
    {
      auto &shift      = result.emplace_back();
      const auto &line = points_of_line[place_in_line[point].first];
      const double xi  = xi_of(point) - terms.travel;
      if (terms.travel == 0. || line.size() < 2 || xi < xi_of(line.front()) || xi > xi_of(line.back()))
        continue;
      const auto after     = std::upper_bound(line.begin() + 1, line.end() - 1, xi,
                                              [&](const double value, const unsigned int q) { return value < xi_of(q); });
      const unsigned int a = *(after - 1), b = *after;
      const double share   = (xi - xi_of(a)) / (xi_of(b) - xi_of(a));
      const auto between   = [share](const double first, const double second) { return (1. - share) * first + share * second; };
      const double winding = traction_of(point) - between(traction_of(a), traction_of(b));
      shift.slip           = slips_at_begin(point)[0] - between(slips_at_begin(a)[0], slips_at_begin(b)[0]);
      shift.elastic        = terms.augmented ? 0. : -winding / properties.penalties.tangential;
      shift.d_slope        = -terms.travel;
    }
    return result;
  }

  PortCoordinates SurfaceContact::coordinates_of(const unsigned int patch) const
  {
    PortCoordinates result;
    const auto &of = patches.patches[patch];
    for (unsigned int i = 0; i < 3 * of.n_nodes; ++i)
      result.push_back({ Sums::place(i / 3, i % 3), 3 * of.nodes[i / 3] + i % 3, 1. });
    add_frame(properties.ports, n_displacements, n_displacements + 1, result);
    for (unsigned int i = 0; i < properties.ports.slopes; ++i)
      result.push_back({ n_displacements + 2 + i, properties.ports.slope(i), 1. });
    return result;
  }

  const PortSelection &SurfaceContact::reachable_ports(const double x, const OfLevers &theta, const double travel)
  {
    constexpr double over_radius = 0.05;
    constexpr double infinity    = std::numeric_limits<double>::max();
    const double aside           = reach_factor * over_radius * properties.radius;
    const double end             = properties.centre(x, theta.front()).xi;
    const double begin           = end - travel;
    const auto between           = [&](const double a, const double b) {
      return patches.patches_in({ { { a - aside, -infinity, -infinity }, { b + aside, infinity, infinity } } });
    };
    const auto [first, last] = std::minmax(begin, end);
    auto now = last - first > 2. * aside ? united(between(first, first), between(last, last)) : between(first, last);
    if (reachable.empty() || now != reached)
    {
      reached   = std::move(now);
      reachable = patches.displacements_of(reached);
      for (auto port = 3 * static_cast<unsigned int>(face.nodes.size()); port < properties.ports.size(); ++port)
        reachable.push_back(port);
    }
    return reachable;
  }

  SurfaceContact::Patches::Indices SurfaceContact::clip(Patches::Indices near, SurfaceEvaluation &found) const
  {
    found.within_reach = reachable.empty() || std::includes(reached.begin(), reached.end(), near.begin(), near.end());
    if (found.within_reach)
      return near;
    Patches::Indices result;
    std::set_intersection(near.begin(), near.end(), reached.begin(), reached.end(), std::back_inserter(result));
    return result;
  }

  void SurfaceContact::widen_reach()
  {
    reach_factor *= 2.;
  }
} // namespace sprag
