#include "fe/face_step.h"

#include "laws/friction_of_step.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    constexpr unsigned int theta_index = 2 * FacePatches::max_nodes;
    constexpr unsigned int x_index     = theta_index + 1;
  } // namespace

  FaceStepContact::FaceStepContact(const ElasticBody<2> &body_, FaceStepProperties properties_)
      : body(body_)
      , properties(std::move(properties_))
      , face(body.friction_face())
      , place(body.friction_face().nodes.size())
  {
  }

  FaceConfiguration FaceStepContact::configuration(const Vector<double> &ports, const double x) const
  {
    const double inclination = properties.rest_inclination + ports[properties.ports.rotation()];
    const double relative    = x - (properties.ports.sprung ? ports[properties.ports.support()] : 0.);
    return { &ports, inclination, relative, cylinder_centre(properties.geometry, relative, inclination) };
  }

  void FaceStepContact::clear(const Vector<double> &ports, const double duration)
  {
    displacement  = ports;
    step_duration = duration;
    compression   = 0.;
    stored        = 0.;
    work          = {};
    remembered    = 0;
    states.clear();
    loaded.clear();
  }

  void FaceStepContact::evaluate(const PortStep &step)
  {
    clear(step.end, step.weights.dt);
    const auto begin   = configuration(step.begin.position, step.accepted.drive.x);
    const auto end     = configuration(step.end, step.to.x);
    const double R     = properties.geometry.cylinder_radius;
    const auto &memory = step.accepted.contact;
    theta              = end.theta;
    relative_x         = end.x;
    surface_run        = step.to.surface - step.accepted.drive.surface;

    StepContactLaw law;
    law.normal     = { properties.penalties.normal, 1. };
    law.tangential = properties.penalties.tangential;
    law.friction   = friction_of_step(properties.friction, step.to.v);
    law.weights    = step.weights;

    auto range       = face.near(end, R);
    const auto widen = [&](const FacePatches::Range &other) {
      range = { std::min(range.begin, other.begin), std::max(range.end, other.end) };
    };
    widen(face.near(begin, R));
    if (!memory.empty())
      widen(face.patches_of_points(memory.front().point, memory.back().point));
    range = clip(range);
    for (unsigned int patch = range.begin; patch < range.end; ++patch)
      step_patch(patch, begin, end, memory, law);
    sum_forces();

    double force_on_circle = 0.;
    for (const auto &of_patch : loaded)
      force_on_circle += of_patch.values[x_index];
    work.drive -= force_on_circle * (step.to.x - step.accepted.drive.x);
  }

  void FaceStepContact::step_patch(const unsigned int patch, const FaceConfiguration &begin, const FaceConfiguration &end,
                                   const std::vector<ContactMemory> &accepted, const StepContactLaw &law)
  {
    const ContactMemory open;
    const auto &chosen  = face.patches()[patch];
    const auto at_begin = FacePatches::nodal(chosen, *begin.displacement);
    const auto at_end   = FacePatches::nodal(chosen, *end.displacement);
    const double R      = properties.geometry.cylinder_radius;
    PatchForces of_patch;
    of_patch.patch = patch;
    bool touched   = false;
    for (unsigned int q = chosen.begin; q < chosen.end; ++q)
    {
      const auto &point         = face.points()[q];
      const auto begin_position = FacePatches::position(point, at_begin);
      const double begin_gap    = gap(begin_position, begin, R);
      while (remembered < accepted.size() && accepted[remembered].point < q)
        ++remembered;
      const bool has_memory = remembered < accepted.size() && accepted[remembered].point == q;

      PointState &state = states.emplace_back();
      state.index       = q;
      state.patch       = patch;
      state.position    = FacePatches::position(point, at_end);
      state.gap         = gap(state.position, end, R);
      if (state.gap >= 0. && begin_gap >= 0. && !has_memory)
        continue;
      touched     = true;
      compression = std::max(compression, -std::min(state.gap, begin_gap));
      step_point(state, begin_position, begin_gap, has_memory ? accepted[remembered] : open, begin, end, law, of_patch);
    }
    if (touched)
      loaded.push_back(of_patch);
  }

  void FaceStepContact::step_point(PointState &state, const LeverPoint &begin_position, const double begin_gap,
                                   const ContactMemory &memory, const FaceConfiguration &begin, const FaceConfiguration &end,
                                   const StepContactLaw &law, PatchForces &of_patch)
  {
    const auto &point   = face.points()[state.index];
    const auto &circle  = properties.geometry;
    const auto at_begin = moving_circle_contact(circle, begin_position, begin.x, begin.theta);
    const auto at_end   = moving_circle_contact(circle, state.position, end.x, end.theta);
    const double share  = law.weights.stiffness();
    const auto weighted = [&](const double at_0, const double at_1) { return (1. - share) * at_0 + share * at_1; };
    const Tensor<1, 4> change({ state.position.xi - begin_position.xi, state.position.eta - begin_position.eta,
                                end.theta - begin.theta, end.x - begin.x });
    const LeverPoint between = { weighted(begin_position.xi, state.position.xi),
                                 weighted(begin_position.eta, state.position.eta) };
    const auto balance       = moving_circle_contact(circle, between, weighted(begin.x, end.x), weighted(begin.theta, end.theta));

    StepKinematics<4> kinematics;
    kinematics.gap_begin       = begin_gap;
    kinematics.gap_end         = state.gap;
    kinematics.gap_row_end     = at_end.gap_row;
    kinematics.gap_row         = balance.gap_row;
    kinematics.gap_curvature   = share * balance.gap_curvature;
    kinematics.gap_bend        = change * (balance.gap_curvature * change);
    kinematics.slip_change     = at_end.slip - at_begin.slip + surface_run;
    kinematics.slip_change_row = at_end.slip_row;
    kinematics.slip_row        = balance.slip_row;
    kinematics.slip_curvature  = share * balance.slip_curvature;
    kinematics.slip_bend       = change * (balance.slip_curvature * change);
    const auto response        = step_response(kinematics, memory, law);

    state.slip_change  = kinematics.slip_change;
    state.pressure     = response.pressure;
    state.traction     = response.traction;
    state.mu           = response.mu;
    state.slipping     = response.slipping;
    state.end_force    = response.pressure * at_end.gap_row - response.traction * at_end.slip_row;
    state.memory       = response.memory;
    state.memory.point = state.index;

    stored += point.weight * response.energy;
    work.drive += point.weight * response.mean_traction * surface_run;
    work.friction += point.weight * response.friction;
    work.algorithmic += point.weight * response.algorithmic;
    work.creep = std::max(work.creep, response.creep);
    add(point, face.patches()[state.patch].n_nodes, response.force, response.tangent, of_patch);
  }

  /// Of a point by a change of the ports, in the coordinates of its contact.
  Tensor<1, 4> FaceStepContact::point_change(const FacePatches::Point &point, const FacePatches::Patch &patch,
                                             const Vector<double> &change_of_ports) const
  {
    const auto nodal = FacePatches::nodal(patch, change_of_ports);
    const auto moved = FacePatches::position(point, nodal);
    const auto &at   = properties.ports;
    return Tensor<1, 4>({ moved.xi - point.position.xi, moved.eta - point.position.eta, change_of_ports[at.rotation()],
                          at.sprung ? -change_of_ports[at.support()] : 0. });
  }

  void FaceStepContact::add(const FacePatches::Point &point, const unsigned int n_nodes, const Tensor<1, 4> &force,
                            const Tensor<2, 4> &tangent, PatchForces &of_patch) const
  {
    constexpr unsigned int rest[2][2] = { { 2, theta_index }, { 3, x_index } };
    for (const auto &[i, row] : rest)
    {
      of_patch.values[row] += point.weight * force[i];
      for (const auto &[j, column] : rest)
        of_patch.tangent[row][column] += point.weight * tangent[i][j];
    }
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int d = 0; d < 2; ++d)
      {
        const unsigned int row = 2 * a + d;
        const double weight    = point.weight * point.shapes[a];
        of_patch.values[row] += weight * force[d];
        for (const auto &[j, column] : rest)
        {
          of_patch.tangent[row][column] += weight * tangent[d][j];
          of_patch.tangent[column][row] += weight * tangent[j][d];
        }
        for (unsigned int b = 0; b < n_nodes; ++b)
          for (unsigned int e = 0; e < 2; ++e)
            of_patch.tangent[row][2 * b + e] += weight * point.shapes[b] * tangent[d][e];
      }
  }

  /// The support's coordinate moves the circle's position back.
  void FaceStepContact::sum_forces()
  {
    const auto &layout = properties.ports;
    summed.ports.clear();
    for (const auto &of_patch : loaded)
    {
      const auto &patch = face.patches()[of_patch.patch];
      summed.ports.insert(summed.ports.end(), patch.nodes.begin(), patch.nodes.begin() + patch.n_nodes);
    }
    std::sort(summed.ports.begin(), summed.ports.end());
    summed.ports.erase(std::unique(summed.ports.begin(), summed.ports.end()), summed.ports.end());
    const auto n_nodes = static_cast<unsigned int>(summed.ports.size());
    summed.ports.resize(n_nodes == 0 ? 0 : 2 * n_nodes + 1);
    for (unsigned int a = n_nodes; a-- > 0;)
    {
      const unsigned int node = summed.ports[a];
      place[node]             = 2 * a;
      for (unsigned int d = 0; d < 2; ++d)
        summed.ports[2 * a + d] = 2 * node + d;
    }
    if (n_nodes > 0)
      summed.ports.back() = layout.rotation();
    if (n_nodes > 0 && layout.sprung)
      summed.ports.push_back(layout.support());

    const auto n = static_cast<unsigned int>(summed.ports.size());
    summed.values.reinit(n);
    summed.tangent.reinit(n, n);
    for (const auto &of_patch : loaded)
    {
      const auto &patch = face.patches()[of_patch.patch];
      unsigned int local[n_local], target[n_local], used = 0;
      for (unsigned int i = 0; i < 2 * patch.n_nodes; ++i, ++used)
      {
        local[used]  = i;
        target[used] = place[patch.nodes[i / 2]] + i % 2;
      }
      local[used]    = theta_index;
      target[used++] = 2 * n_nodes;
      if (layout.sprung)
      {
        local[used]    = x_index;
        target[used++] = 2 * n_nodes + 1;
      }
      const auto sign = [](const unsigned int i) { return i == x_index ? -1. : 1.; };
      for (unsigned int i = 0; i < used; ++i)
      {
        summed.values[target[i]] += sign(local[i]) * of_patch.values[local[i]];
        for (unsigned int j = 0; j < used; ++j)
          summed.tangent(target[i], target[j]) += sign(local[i]) * sign(local[j]) * of_patch.tangent[local[i]][local[j]];
      }
    }
  }

  const PortSelection &FaceStepContact::reachable_ports(const double x, const double inclination)
  {
    const double margin = 0.1 * properties.geometry.cylinder_radius + 5. * properties.layer_thickness;
    const double xi     = cylinder_centre(properties.geometry, x, inclination).xi;
    const auto range    = face.patches_between(xi - margin, xi + margin);
    if (!reaches_everywhere && (range.begin != reached.begin || range.end != reached.end))
      reach(range);
    return reachable;
  }

  void FaceStepContact::reach(const FacePatches::Range &range)
  {
    reached   = range;
    reachable = face.displacements_of(range);
    for (unsigned int port = properties.ports.rotation(); port < properties.ports.size(); ++port)
      reachable.push_back(port);
  }

  /// Without a call of reachable_ports() all can be reached.
  FacePatches::Range FaceStepContact::clip(const FacePatches::Range &range)
  {
    clipped = !reachable.empty() && (range.begin < reached.begin || range.end > reached.end);
    return clipped ? FacePatches::Range{ std::max(range.begin, reached.begin), std::min(range.end, reached.end) } : range;
  }

  bool FaceStepContact::within_reach() const
  {
    return !clipped;
  }

  void FaceStepContact::widen_reach()
  {
    reaches_everywhere = true;
    reach({ 0, static_cast<unsigned int>(face.patches().size()) });
  }

  const PortForces &FaceStepContact::forces() const
  {
    return summed;
  }

  std::vector<ContactMemory> FaceStepContact::memory() const
  {
    std::vector<ContactMemory> result;
    for (const auto &state : states)
      if (state.pressure > 0.)
        result.push_back(state.memory);
    return result;
  }

  std::vector<ContactMemory> FaceStepContact::touch(const Vector<double> &ports, const DrivePoint &drive)
  {
    clear(ports, 0.);
    const double R   = properties.geometry.cylinder_radius;
    const auto at    = configuration(ports, drive.x);
    const auto range = face.near(at, R);
    theta            = at.theta;
    relative_x       = at.x;
    for (unsigned int patch = range.begin; patch < range.end; ++patch)
    {
      const auto &chosen = face.patches()[patch];
      const auto nodal   = FacePatches::nodal(chosen, ports);
      for (unsigned int q = chosen.begin; q < chosen.end; ++q)
      {
        PointState &state = states.emplace_back();
        state.index       = q;
        state.patch       = patch;
        state.position    = FacePatches::position(face.points()[q], nodal);
        state.gap         = gap(state.position, at, R);
      }
    }
    sum_forces();
    return {};
  }

  void FaceStepContact::add_work(StepWork &sum) const
  {
    sum.drive += work.drive;
    sum.friction += work.friction;
    sum.algorithmic += work.algorithmic;
    sum.creep += work.creep;
  }

  double FaceStepContact::energy() const
  {
    return stored;
  }

  double FaceStepContact::overlap() const
  {
    return compression;
  }

  /// Among `states`: of the points under pressure the one in the middle, else the closest.
  unsigned int FaceStepContact::middle_of_contact() const
  {
    const auto is_closed = [](const PointState &state) { return state.pressure > 0.; };
    const auto first     = std::find_if(states.begin(), states.end(), is_closed);
    const auto last      = std::find_if(states.rbegin(), states.rend(), is_closed);
    if (first != states.end())
      return static_cast<unsigned int>(((first - states.begin()) + (states.rend() - last - 1)) / 2);
    const auto closest =
        std::min_element(states.begin(), states.end(), [](const PointState &a, const PointState &b) { return a.gap < b.gap; });
    return static_cast<unsigned int>(closest - states.begin());
  }

  double FaceStepContact::gap_change(const Vector<double> &change_of_ports) const
  {
    const auto &state  = states[middle_of_contact()];
    const auto contact = moving_circle_contact(properties.geometry, state.position, relative_x, theta);
    return contact.gap_row * point_change(face.points()[state.index], face.patches()[state.patch], change_of_ports);
  }

  double FaceStepContact::mean_slip(const Vector<double> &from, const double from_x, const Vector<double> &to,
                                    const double to_x) const
  {
    const auto begin = configuration(from, from_x);
    const auto end   = configuration(to, to_x);
    double weighted  = 0.;
    double weights   = 0.;
    for (const auto &state : states)
      if (state.pressure > 0.)
      {
        const auto &point = face.points()[state.index];
        const auto &patch = face.patches()[state.patch];
        const auto slip   = [&](const FaceConfiguration &at)
        {
          const auto position = FacePatches::position(point, FacePatches::nodal(patch, *at.displacement));
          return moving_circle_contact(properties.geometry, position, at.x, at.theta).slip;
        };
        weighted += point.weight * state.pressure * (slip(end) - slip(begin));
        weights += point.weight * state.pressure;
      }
    return weights > 0. ? weighted / weights : 0.;
  }
} // namespace sprag
