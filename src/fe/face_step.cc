#include "fe/face_step.h"

#include "base/errors.h"
#include "base/text.h"
#include "laws/friction_of_step.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using dealii::Vector;

  template <class Surface>
  FaceStep<Surface>::FaceStep(const ElasticBody<2> &body_, FaceStepProperties properties_)
      : body(body_)
      , properties(std::move(properties_))
      , face(body.friction_face())
      , surface(body, face, properties)
      , place_of_port(properties.ports.size())
  {
  }

  template <class Surface>
  FaceConfiguration FaceStep<Surface>::configuration(const Vector<double> &ports, const double x) const
  {
    const double inclination = properties.rest_inclination + ports[properties.ports.rotation()];
    const double relative    = x - (properties.ports.sprung ? ports[properties.ports.support()] : 0.);
    return { &ports, inclination, relative, cylinder_centre(properties.geometry, relative, inclination) };
  }

  template <class Surface>
  void FaceStep<Surface>::clear(const Vector<double> &ports, const double x, const double duration)
  {
    displacement  = ports;
    last_x        = x;
    step_duration = duration;
    remembered    = 0;
    sums          = {};
    states.clear();
  }

  template <class Surface>
  void FaceStep<Surface>::evaluate(const PortStep &step)
  {
    clear(step.end, step.to.x, step.weights.dt);
    const auto begin   = configuration(step.begin.position, step.from.x);
    const auto end     = configuration(step.end, step.to.x);
    const auto &memory = step.memory;
    surface_run        = step.to.surface - step.from.surface;

    StepContactLaw law;
    law.normal     = { properties.penalties.normal, 1. };
    law.tangential = properties.penalties.tangential;
    law.friction   = friction_of_step(properties.friction, step.to.v);
    law.weights    = step.weights;

    surface.enter({ begin, end, step.weights.stiffness() });
    auto range = surface.near();
    if (!memory.empty())
      range = FacePatches::united(range, face.patches_of_points(memory.front().point, memory.back().point));
    range = clip(range);
    for (unsigned int patch = range.begin; patch < range.end; ++patch)
      step_patch(patch, memory, law);
    sum_forces();
    sums.work.drive -= sums.force_on_circle * (step.to.x - step.from.x);
  }

  template <class Surface>
  FacePointState &FaceStep<Surface>::add_state(const unsigned int patch, const unsigned int point)
  {
    FacePointState &state = states.emplace_back();
    state.index           = point;
    state.patch           = patch;
    return state;
  }

  template <class Surface>
  void FaceStep<Surface>::step_patch(const unsigned int patch, const std::vector<ContactMemory> &accepted,
                                     const StepContactLaw &law)
  {
    const ContactMemory open;
    surface.enter(patch);
    for (unsigned int q = face.patches()[patch].begin; q < face.patches()[patch].end; ++q)
    {
      auto &state            = add_state(patch, q);
      const double begin_gap = surface.place(state);
      while (remembered < accepted.size() && accepted[remembered].point < q)
        ++remembered;
      const bool has_memory = remembered < accepted.size() && accepted[remembered].point == q;
      if (state.gap >= 0. && begin_gap >= 0. && !has_memory)
        continue;
      sums.compression = std::max(sums.compression, -std::min(state.gap, begin_gap));
      surface.step(state, begin_gap, has_memory ? accepted[remembered] : open, law, surface_run, sums);
    }
    surface.leave(sums);
  }

  template <class Surface>
  void FaceStep<Surface>::sum_forces()
  {
    summed.ports.clear();
    for (const auto &of_patch : sums.loaded)
      summed.ports.insert(summed.ports.end(), of_patch.ports.begin(), of_patch.ports.end());
    std::sort(summed.ports.begin(), summed.ports.end());
    summed.ports.erase(std::unique(summed.ports.begin(), summed.ports.end()), summed.ports.end());
    const auto n = static_cast<unsigned int>(summed.ports.size());
    for (unsigned int a = 0; a < n; ++a)
      place_of_port[summed.ports[a]] = a;

    summed.values.reinit(n);
    summed.tangent.reinit(n, n);
    for (const auto &of_patch : sums.loaded)
      for (unsigned int i = 0; i < of_patch.ports.size(); ++i)
      {
        const unsigned int row = place_of_port[of_patch.ports[i]];
        summed.values[row] += of_patch.values[i];
        for (unsigned int j = 0; j < of_patch.ports.size(); ++j)
          summed.tangent(row, place_of_port[of_patch.ports[j]]) += of_patch.tangent(i, j);
      }
  }

  template <class Surface>
  const PortSelection &FaceStep<Surface>::reachable_ports(const double x, const double inclination)
  {
    const double margin = 0.1 * properties.geometry.cylinder_radius + 5. * properties.layer_thickness;
    const double xi     = cylinder_centre(properties.geometry, x, inclination).xi;
    const auto range    = face.patches_between(xi - margin, xi + margin);
    if (!reaches_everywhere && (range.begin != reached.begin || range.end != reached.end))
      reach(range);
    return reachable;
  }

  template <class Surface>
  void FaceStep<Surface>::reach(const FacePatches::Range &range)
  {
    reached   = range;
    reachable = face.displacements_of(range);
    for (auto port = 2 * static_cast<unsigned int>(body.friction_face().nodes.size()); port < properties.ports.size(); ++port)
      reachable.push_back(port);
  }

  /// Without a call of reachable_ports() all can be reached.
  template <class Surface>
  FacePatches::Range FaceStep<Surface>::clip(const FacePatches::Range &range)
  {
    clipped = !reachable.empty() && (range.begin < reached.begin || range.end > reached.end);
    return clipped ? FacePatches::Range{ std::max(range.begin, reached.begin), std::min(range.end, reached.end) } : range;
  }

  template <class Surface>
  bool FaceStep<Surface>::within_reach() const
  {
    return !clipped;
  }

  template <class Surface>
  void FaceStep<Surface>::widen_reach()
  {
    reaches_everywhere = true;
    reach({ 0, static_cast<unsigned int>(face.patches().size()) });
  }

  template <class Surface>
  const PortForces &FaceStep<Surface>::forces() const
  {
    return summed;
  }

  template <class Surface>
  std::vector<ContactMemory> FaceStep<Surface>::memory() const
  {
    if (sums.beyond_face)
      throw AnalysisError("the contact reaches the end of the part of the elastic cylinder's surface that is meshed to touch " +
                          ("the lever, at x = " + rounded_text(last_x)) +
                          " mm: the cylinder yields or the lever bends too much. Try a larger Cylinder/Young modulus or a " +
                          "rigid cylinder.");
    std::vector<ContactMemory> result;
    for (const auto &state : states)
      if (state.pressure > 0.)
        result.push_back(state.memory);
    return result;
  }

  template <class Surface>
  std::vector<ContactMemory> FaceStep<Surface>::touch(const Vector<double> &ports, const DrivePoint &drive)
  {
    clear(ports, drive.x, 0.);
    const auto at = configuration(displacement, drive.x);
    surface.enter({ at, at });
    const auto range = surface.near();
    for (unsigned int patch = range.begin; patch < range.end; ++patch)
    {
      surface.enter(patch);
      for (unsigned int q = face.patches()[patch].begin; q < face.patches()[patch].end; ++q)
        surface.place(add_state(patch, q));
    }
    sum_forces();
    return {};
  }

  template <class Surface>
  void FaceStep<Surface>::add_work(StepWork &sum) const
  {
    sum.drive += sums.work.drive;
    sum.friction += sums.work.friction;
    sum.algorithmic += sums.work.algorithmic;
    sum.creep += sums.work.creep;
  }

  template <class Surface>
  double FaceStep<Surface>::energy() const
  {
    return sums.stored;
  }

  template <class Surface>
  double FaceStep<Surface>::overlap() const
  {
    return sums.compression;
  }

  /// Among `states`: of the points under pressure the one in the middle, else the closest.
  template <class Surface>
  unsigned int FaceStep<Surface>::middle_of_contact() const
  {
    const auto is_closed = [](const FacePointState &state) { return state.pressure > 0.; };
    const auto first     = std::find_if(states.begin(), states.end(), is_closed);
    const auto last      = std::find_if(states.rbegin(), states.rend(), is_closed);
    if (first != states.end())
      return static_cast<unsigned int>(((first - states.begin()) + (states.rend() - last - 1)) / 2);
    const auto closest = std::min_element(states.begin(), states.end(),
                                          [](const FacePointState &a, const FacePointState &b) { return a.gap < b.gap; });
    return static_cast<unsigned int>(closest - states.begin());
  }

  template <class Surface>
  double FaceStep<Surface>::gap_change(const Vector<double> &change_of_ports) const
  {
    const auto at = configuration(displacement, last_x);
    surface.enter({ at, at });
    const auto &state = states[middle_of_contact()];
    surface.enter(state.patch);
    const auto rows = surface.rows(state);
    double change   = 0.;
    for (unsigned int i = 0; i < rows.ports.size(); ++i)
      change += rows.gap[i] * change_of_ports[rows.ports[i]];
    return change;
  }

  template <class Surface>
  double FaceStep<Surface>::mean_slip(const Vector<double> &from, const double from_x, const Vector<double> &to,
                                      const double to_x) const
  {
    const auto begin = configuration(from, from_x);
    const auto end   = configuration(to, to_x);
    surface.enter({ begin, end });
    double weighted    = 0.;
    double weights     = 0.;
    unsigned int patch = dealii::numbers::invalid_unsigned_int;
    for (const auto &state : states)
      if (state.pressure > 0.)
      {
        if (state.patch != patch)
          surface.enter(patch = state.patch);
        const double weight = face.points()[state.index].weight * state.pressure;
        weighted += weight * surface.slip(state);
        weights += weight;
      }
    return weights > 0. ? weighted / weights : 0.;
  }

  template class FaceStep<CircleSurface>;
  template class FaceStep<PairSurface>;
} // namespace sprag
