#include "fe/solid/surface_sums.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

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

  /// What evaluates one patch after another.
  struct SurfaceContact::Step
  {
    RigidCylinder::Pose pose;
    double surface_run;
    const StaticTerms &terms;
    StepContactLaw law;
    const std::vector<SurfaceMemory> &memory;
    Patches::Nodal nodal{}; ///< displacements of the patch

    const SurfaceMemory *memory_of(const unsigned int point) const
    {
      const auto is_before = [](const SurfaceMemory &entry, const unsigned int q) { return entry.point < q; };
      const auto found     = std::lower_bound(memory.begin(), memory.end(), point, is_before);
      return found != memory.end() && found->point == point ? &*found : nullptr;
    }

    double traction_of(const unsigned int point) const
    {
      const auto *const found = memory_of(point);
      return found != nullptr ? found->traction[0] : 0.;
    }
  };

  SurfaceContact::SurfaceContact(const FrictionFace<3> &face_, SurfaceContactProperties properties_)
      : face(face_)
      , properties(std::move(properties_))
      , patches(face)
      , in_time(patches)
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

  void SurfaceContact::evaluate(const SurfacePlace &end, const std::vector<SurfaceMemory> &memory, const double surface_run,
                                const StaticTerms &terms, SurfaceEvaluation &found)
  {
    StepContactLaw law;
    law.normal     = { properties.penalties.normal, 1. };
    law.tangential = properties.penalties.tangential;
    law.friction   = terms.friction;
    law.balance    = ForceBalance::end;
    law.mode       = terms.mode;
    law.weights.dt = terms.duration;
    Step step{ pose_of(end), surface_run, terms, law, memory };

    found.displacement = end.ports;
    found.x            = end.x;
    found.compression  = 0.;
    found.points.clear();
    std::vector<PortForces> loaded;
    for (const unsigned int patch : clip(near(end, step.pose), found))
    {
      step.nodal = Patches::nodal(patches.patches[patch], end.ports);
      Sums sums;
      for (unsigned int q = patches.patches[patch].begin; q < patches.patches[patch].end; ++q)
      {
        auto &state = add_point(patch, q, step.nodal, step.pose, found);
        if (const auto *const was = step.memory_of(q))
          state.trial_pressure += was->normal_multiplier;
        evaluate_point(step, state, sums, found);
      }
      add_patch(patch, sums, loaded);
    }
    sum_forces(loaded, place_of_port, found.forces);
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

  template <int n>
  void SurfaceContact::evaluate_in(const Step &step, FacePointState<3> &state, Sums &sums, SurfaceEvaluation &found) const
  {
    const auto &point = patches.points[state.index];
    if (state.trial_pressure <= 0.)
      return;
    found.compression     = std::max(found.compression, state.trial_pressure / properties.penalties.normal);
    const auto placed     = properties.cylinder.kinematics<n>(step.pose, state.position);
    const auto &begin     = slips_of_patch_at_begin(state.patch)[state.index - patches.patches[state.patch].begin];
    const auto *const was = step.memory_of(state.index);

    StepKinematics<n, 2> kinematics;
    kinematics.gap_begin = kinematics.gap_end = placed.gap;
    kinematics.gap_row_end = kinematics.gap_row = placed.gap_row;
    kinematics.gap_curvature                    = placed.gap_curvature;
    for (unsigned int s = 0; s < 2; ++s)
      kinematics.slip_change[s] = placed.slip[s] - begin[s];
    kinematics.slip_change[0] += step.surface_run;
    kinematics.slip_change_row = kinematics.slip_row = placed.slip_row;
    kinematics.slip_curvature                        = placed.slip_curvature;

    // Derivative of the deformed place along the undeformed face.
    const auto &slopes = face.points[state.index].slopes;
    Tensor<1, n> direction;
    direction[0] = 1.;
    for (unsigned int i = 0; i < 3 * slopes.size(); ++i)
      direction[i % 3] += slopes[i / 3] * step.nodal[i];
    const auto shift         = shift_of(state.index, placed.slip_row[0] * direction, step);
    kinematics.slip_shift[0] = shift.total();

    const auto response = step_response(kinematics, was != nullptr ? *was : SurfaceMemory{}, step.law);

    static_cast<PointTraction<2> &>(state) = response;
    state.memory.point                     = state.index;
    state.slip_change                      = step.terms.speed_ratio * kinematics.slip_change;
    state.slip_change[0] += step.terms.speed_ratio * shift.slip;
    state.elastic_slip = (response.traction - (was != nullptr && step.terms.augmented ? was->traction : Tensor<1, 2>())).norm() /
                         step.law.tangential;
    state.end_force = on_lever(response.force);
    auto tangent    = response.tangent;
    Tensor<1, n> by_slope;
    for (unsigned int s = 0; s < 2; ++s)
      by_slope -= shift.d_slope * response.d_shift[s][0] * placed.slip_row[s];
    tangent += outer_product(by_slope, placed.slip_curvature[0] * direction);
    sums.add(point, response.force, tangent);
    if (shift.d_slope != 0.)
      sums.add_slope(point, slopes, by_slope, placed.slip_row[0]);
  }

  /// Slopes are coordinates where the axis is free: they cost a third of a point.
  void SurfaceContact::evaluate_point(const Step &step, FacePointState<3> &state, Sums &sums, SurfaceEvaluation &found) const
  {
    if (properties.ports.slopes > 0)
      evaluate_in<SurfaceKinematics::n>(step, state, sums, found);
    else
      evaluate_in<FixedSurfaceKinematics::n>(step, state, sums, found);
  }
  /// See slip_shift(): the place that had the same distance from the contact when the step began has the same zeta.
  SlipShift SurfaceContact::shift_of(const unsigned int point, const double slope, const Step &step) const
  {
    const double travel = step.terms.travel;
    const auto &line    = points_of_line[place_in_line[point].first];
    const auto xi_of    = [&](const unsigned int q) { return face.points[q].position[0]; };
    const double xi     = xi_of(point) - travel;
    if (travel == 0. || line.size() < 2 || xi < xi_of(line.front()) || xi > xi_of(line.back()))
      return {};
    const auto after     = std::upper_bound(line.begin() + 1, line.end() - 1, xi,
                                            [&](const double value, const unsigned int q) { return value < xi_of(q); });
    const unsigned int a = *(after - 1), b = *after;
    const double share     = (xi - xi_of(a)) / (xi_of(b) - xi_of(a));
    const auto between     = [share](const double first, const double second) { return (1. - share) * first + share * second; };
    const double slip      = slips_at_begin(point)[0] - between(slips_at_begin(a)[0], slips_at_begin(b)[0]) - travel * slope;
    const double unwinding = between(step.traction_of(a), step.traction_of(b)) - step.traction_of(point);
    return { slip, step.terms.augmented ? 0. : unwinding / step.law.tangential, -travel };
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

  const PortSelection &SurfaceContact::reachable_ports(const double x, const double theta, const double travel)
  {
    constexpr double over_radius = 0.05;
    constexpr double infinity    = std::numeric_limits<double>::max();
    const double aside           = reach_factor * over_radius * properties.radius;
    const double end             = properties.centre(x, theta).xi;
    const auto [first, last]     = std::minmax({ end, end - travel });
    auto now = patches.patches_in({ { { first - aside, -infinity, -infinity }, { last + aside, infinity, infinity } } });
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
