#include "fe/contact/face_contact.h"

#include "base/errors.h"
#include "base/text.h"
#include "laws/friction_of_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  using dealii::Vector;

  namespace
  {
    std::variant<RigidObstacle, ElasticObstacle> make_obstacle(const ElasticBody<2> &body, const FacePatches<2> &face,
                                                               const FaceContactProperties &properties)
    {
      using Obstacles = std::variant<RigidObstacle, ElasticObstacle>;
      if (body.cylinder_face().patches.empty())
        return Obstacles(std::in_place_type<RigidObstacle>, body.friction_face(), face, properties);
      return Obstacles(std::in_place_type<ElasticObstacle>, body.friction_face(), body.cylinder_face(), face, properties);
    }
  } // namespace

  FaceContact::FaceContact(const ElasticBody<2> &body_, FaceContactProperties properties_)
      : body(body_)
      , properties(std::move(properties_))
      , face(body.friction_face())
      , obstacle(make_obstacle(body, face, properties))
      , place_of_port(properties.ports.size())
  {
  }

  void FaceContact::enter(const StepPlaces &places) const
  {
    std::visit([&](auto &below) { below.enter(places); }, obstacle);
  }

  FacePatches<2>::Indices FaceContact::near() const
  {
    return std::visit([](const auto &below) { return below.near(); }, obstacle);
  }

  FaceConfiguration FaceContact::configuration(const Vector<double> &ports, const double x) const
  {
    const double inclination = properties.rest_inclination + ports[properties.ports.rotation()];
    const double relative    = x - (properties.ports.sprung ? ports[properties.ports.support()] : 0.);
    return { &ports, inclination, relative, properties.centre(relative, inclination) };
  }

  void FaceContact::clear(const Vector<double> &ports, const double x, const double duration)
  {
    displacement  = ports;
    last_x        = x;
    step_duration = duration;
    sums          = {};
    states.clear();
  }

  namespace
  {
    StepContactLaw law_of_step(const FaceContactProperties &properties, const PortStep &step,
                               const std::optional<StaticTerms> &statics)
    {
      StepContactLaw law;
      law.normal     = { properties.penalties.normal, 1. };
      law.tangential = properties.penalties.tangential;
      law.friction   = statics ? statics->friction : friction_of_step(properties.friction, step.to.v);
      law.weights    = step.weights;
      if (statics)
      {
        law.balance    = ForceBalance::end;
        law.mode       = statics->mode;
        law.weights.dt = statics->duration;
      }
      return law;
    }
  } // namespace

  void FaceContact::evaluate(const PortStep &step, const std::optional<StaticTerms> &statics)
  {
    clear(step.end, step.to.x, step.weights.dt);
    FaceStep of_contact{ law_of_step(properties, step, statics), step.memory, step.to.surface - step.from.surface };
    if (statics)
    {
      of_contact.augmented   = statics->augmented;
      of_contact.travel      = statics->travel;
      of_contact.speed_ratio = statics->speed_ratio;
    }
    enter({ configuration(step.begin.position, step.from.x), configuration(step.end, step.to.x), step.weights.stiffness(),
            statics.has_value() });
    const auto patches = near_step(step.memory, of_contact.law.balance);
    std::visit(
        [&](auto &below)
        {
          for (const unsigned int patch : patches)
            step_patch(below, patch, of_contact);
        },
        obstacle);
    sum_forces();
    sums.work.drive -= sums.force_on_obstacle * (step.to.x - step.from.x);
  }

  /// A mean over the step counts what was in contact when it began.
  FacePatches<2>::Indices FaceContact::near_step(const std::vector<ContactMemory> &memory, const ForceBalance balance)
  {
    if (balance == ForceBalance::end)
      return clip(near());
    FacePatches<2>::Indices remembered;
    for (const auto &entry : memory)
      if (remembered.empty() || entry.point >= face.patches()[remembered.back()].end)
        remembered.push_back(face.patch_of_point(entry.point));
    return clip(united(near(), remembered));
  }

  FacePointState<2> &FaceContact::add_state(const unsigned int patch, const unsigned int point)
  {
    FacePointState<2> &state = states.emplace_back();
    state.index              = point;
    state.patch              = patch;
    return state;
  }

  namespace
  {
    std::vector<ContactMemory>::const_iterator first_memory(const std::vector<ContactMemory> &memory, const unsigned int point)
    {
      const auto is_before = [](const ContactMemory &entry, const unsigned int q) { return entry.point < q; };
      return std::lower_bound(memory.begin(), memory.end(), point, is_before);
    }
  } // namespace

  template <class ObstacleBelow>
  void FaceContact::step_patch(ObstacleBelow &below, const unsigned int patch, const FaceStep &step)
  {
    const double penalty    = properties.penalties.normal;
    const bool ends_balance = step.law.balance == ForceBalance::end;
    below.enter(patch);
    auto remembered = first_memory(step.memory, face.patches()[patch].begin);
    for (unsigned int q = face.patches()[patch].begin; q < face.patches()[patch].end; ++q)
    {
      auto &state            = add_state(patch, q);
      const bool can_touch   = below.place(state);
      const bool has_memory  = remembered != step.memory.end() && remembered->point == q;
      const auto memory      = has_memory ? *remembered++ : ContactMemory{};
      state.trial_pressure   = (can_touch ? memory.normal_multiplier : 0.) - penalty * state.gap;
      const double begin_gap = ends_balance ? state.gap : below.gap_at_begin(q);
      const bool stays_open  = ends_balance ? state.trial_pressure <= 0. : state.gap >= 0. && begin_gap >= 0. && !has_memory;
      if (stays_open)
        continue;
      sums.compression =
          std::max(sums.compression, ends_balance ? state.trial_pressure / penalty : -std::min(state.gap, begin_gap));
      below.step(state, memory, step, sums);
    }
    below.leave(sums);
  }

  void FaceContact::sum_forces()
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

  const PortSelection &FaceContact::reachable_ports(const double x, const double inclination, const double travel)
  {
    const double of_radius    = properties.radius > 0. ? 0.05 * properties.radius : std::numeric_limits<double>::infinity();
    const double of_contact   = reach_factor * of_radius + travel;
    const double aside        = 4. * properties.layer_thickness; // where the face is looked at besides
    const double xi           = properties.centre(x, inclination).xi;
    const auto patches_within = [&](const double distance)
    {
      constexpr double infinity = std::numeric_limits<double>::max();
      return face.patches_in({ { { xi - distance, -infinity }, { xi + distance, infinity } } });
    };
    reached      = patches_within(of_contact);
    auto patches = patches_within(of_contact + aside);
    if (reachable.empty() || patches != looked_at)
    {
      looked_at = std::move(patches);
      reachable = face.displacements_of(looked_at);
      for (auto port = 2 * static_cast<unsigned int>(body.friction_face().nodes.size()); port < properties.ports.size(); ++port)
        reachable.push_back(port);
    }
    return reachable;
  }

  /// Without a call of reachable_ports() all can be reached.
  FacePatches<2>::Indices FaceContact::clip(FacePatches<2>::Indices near)
  {
    clipped = !reachable.empty() && !std::includes(reached.begin(), reached.end(), near.begin(), near.end());
    if (!clipped)
      return near;
    FacePatches<2>::Indices result;
    std::set_intersection(near.begin(), near.end(), reached.begin(), reached.end(), std::back_inserter(result));
    return result;
  }

  bool FaceContact::within_reach() const
  {
    return !clipped;
  }

  void FaceContact::widen_reach()
  {
    reach_factor *= 2.;
  }

  const PortForces &FaceContact::forces() const
  {
    return summed;
  }

  std::string FaceContact::objection() const
  {
    return sums.beyond_face ? "the contact reaches the end of the cylinder's face" : std::string();
  }

  std::vector<ContactMemory> FaceContact::memory() const
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

  std::vector<ContactMemory> FaceContact::touch(const Vector<double> &ports, const DrivePoint &drive)
  {
    clear(ports, drive.x, 0.);
    const auto at = configuration(displacement, drive.x);
    enter({ at, at });
    const auto patches = near();
    std::visit(
        [&](auto &below)
        {
          for (const unsigned int patch : patches)
          {
            below.enter(patch);
            for (unsigned int q = face.patches()[patch].begin; q < face.patches()[patch].end; ++q)
              below.place(add_state(patch, q));
          }
        },
        obstacle);
    sum_forces();
    return {};
  }

  void FaceContact::add_work(StepWork &sum) const
  {
    sum.drive += sums.work.drive;
    sum.friction += sums.work.friction;
    sum.algorithmic += sums.work.algorithmic;
    sum.creep += sums.work.creep;
  }

  double FaceContact::energy() const
  {
    return sums.stored;
  }

  double FaceContact::overlap() const
  {
    return sums.compression;
  }

  double FaceContact::penetration() const
  {
    double largest = 0.;
    for (const auto &state : states)
      largest = std::max(largest, -state.gap);
    return largest;
  }

  const std::vector<FacePointState<2>> &FaceContact::points() const
  {
    return states;
  }

  const Vector<double> &FaceContact::displacements() const
  {
    return displacement;
  }

  const ContactPenalties &FaceContact::penalties() const
  {
    return properties.penalties;
  }

  /// Among `states`: of the points under pressure the one in the middle, else the closest.
  unsigned int FaceContact::middle_of_contact() const
  {
    const auto is_closed = [](const FacePointState<2> &state) { return state.pressure > 0.; };
    const auto first     = std::find_if(states.begin(), states.end(), is_closed);
    const auto last      = std::find_if(states.rbegin(), states.rend(), is_closed);
    if (first != states.end())
      return static_cast<unsigned int>(((first - states.begin()) + (states.rend() - last - 1)) / 2);
    const auto closest = std::min_element(states.begin(), states.end(),
                                          [](const FacePointState<2> &a, const FacePointState<2> &b) { return a.gap < b.gap; });
    return static_cast<unsigned int>(closest - states.begin());
  }

  double FaceContact::gap_change(const Vector<double> &change_of_ports) const
  {
    const auto at = configuration(displacement, last_x);
    enter({ at, at });
    const auto &state = states[middle_of_contact()];
    const auto rows   = std::visit(
        [&](auto &below)
        {
          below.enter(state.patch);
          return below.rows(state);
        },
        obstacle);
    double change = 0.;
    for (unsigned int i = 0; i < rows.ports.size(); ++i)
      change += rows.gap[i] * change_of_ports[rows.ports[i]];
    return change;
  }

  double FaceContact::mean_slip(const Vector<double> &from, const double from_x, const Vector<double> &to,
                                const double to_x) const
  {
    enter({ configuration(from, from_x), configuration(to, to_x) });
    double weighted = 0.;
    double weights  = 0.;
    std::visit(
        [&](auto &below)
        {
          unsigned int patch = dealii::numbers::invalid_unsigned_int;
          for (const auto &state : states)
            if (state.pressure > 0.)
            {
              if (state.patch != patch)
                below.enter(patch = state.patch);
              const double weight = face.points()[state.index].weight * state.pressure;
              weighted += weight * below.slip(state);
              weights += weight;
            }
        },
        obstacle);
    return weights > 0. ? weighted / weights : 0.;
  }
} // namespace sprag
