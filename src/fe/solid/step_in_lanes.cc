#include "fe/solid/step_in_lanes_parts.h"

#include <algorithm>

namespace sprag
{
  StepInLanes::StepInLanes(const FrictionFace<3> &face_, const Patches &patches_)
      : face(face_)
      , patches(patches_)
      , blocks(patches.patches.size())
  {
  }

  StepInLanes::~StepInLanes() = default;

  void StepInLanes::make_blocks(const unsigned int patch)
  {
    const auto &of_patch = patches.patches[patch];
    for (unsigned int first = of_patch.begin; first < of_patch.end; first += n_lanes)
    {
      auto &block = blocks[patch].all.emplace_back();
      block       = Block();
      block.first = first;
      block.n     = std::min(n_lanes, of_patch.end - first);
      for (unsigned int i = 0; i < n_lanes; ++i)
      {
        const unsigned int q = first + std::min(i, block.n - 1);
        const auto &point    = patches.points[q];
        const auto &slopes   = face.points[q].slopes;
        block.position.x[i]  = point.position[0];
        block.position.y[i]  = point.position[1];
        block.position.z[i]  = point.position[2];
        block.weight[i]      = i < block.n ? point.weight : 0.;
        for (unsigned int a = 0; a < Patches::max_nodes; ++a)
          block.shapes[a][i] = point.shapes[a];
        for (unsigned int a = 0; a < slopes.size(); ++a)
          block.slopes[a][i] = slopes[a];
      }
    }
  }

  void StepInLanes::begin(Memory memory)
  {
    remembered = std::move(memory);
    for (const unsigned int patch : placed)
      blocks[patch].first = dealii::numbers::invalid_unsigned_int;
    placed.clear();
    n_placed = 0;
  }

  bool StepInLanes::begins_with(const Memory &memory) const
  {
    const auto same = [](const PointMemory<2> &a, const PointMemory<2> &b)
    {
      return a.point == b.point && a.step == b.step && a.traction == b.traction && a.slip_speed == b.slip_speed &&
             a.normal_multiplier == b.normal_multiplier;
    };
    return std::equal(memory.begin(), memory.end(), remembered.begin(), remembered.end(), same);
  }

  void StepInLanes::set(const Constants &constants)
  {
    of = constants;
  }

  bool StepInLanes::is_placed(const unsigned int patch) const
  {
    return blocks[patch].first != dealii::numbers::invalid_unsigned_int;
  }

  SPRAG_FOR_ANY_PROCESSOR void StepInLanes::place(const unsigned int patch, const Patches::Nodal &nodal,
                                                  const std::vector<SlipShift> &shifts)
  {
    if (blocks[patch].all.empty())
      make_blocks(patch);
    placed.push_back(patch);
    blocks[patch].first = n_placed;
    n_placed += static_cast<unsigned int>(blocks[patch].all.size());
    if (n_placed > begins.size())
    {
      begins.resize(n_placed);
      ends.resize(n_placed);
    }
    const auto &axes = of.begin.axes;
    for (unsigned int b = 0; b < blocks[patch].all.size(); ++b)
    {
      const auto &block = blocks[patch].all[b];
      auto &begin       = begins[blocks[patch].first + b];
      begin             = Begin();
      if (of.slide)
        continue;
      begin.place                = at_points(block.shapes, block.position, nodal);
      const auto place           = places_of(of.cylinder, of.begin, begin.place);
      const PointsInLanes across = place.radius * place.normal;
      begin.gap                  = place.gap;
      begin.right                = dot(across, axes.right);
      begin.upward               = dot(across, axes.upward);
      begin.along                = place.along;
      for (unsigned int i = 0; i < block.n && !shifts.empty(); ++i)
      {
        const auto &shift      = shifts[block.first - blocks[patch].all.front().first + i];
        begin.shift[i]         = shift.slip;
        begin.elastic_shift[i] = shift.elastic;
        begin.by_slope[i]      = shift.d_slope;
      }
    }
    recall(patch);
  }

  void StepInLanes::recall(const unsigned int patch)
  {
    const unsigned int first = patches.patches[patch].begin;
    const auto is_before     = [](const PointMemory<2> &entry, const unsigned int q) { return entry.point < q; };
    for (auto entry = std::lower_bound(remembered.begin(), remembered.end(), first, is_before);
         entry != remembered.end() && entry->point < patches.patches[patch].end; ++entry)
    {
      const unsigned int q = entry->point - first, i = q % n_lanes;
      auto &begin         = begins[blocks[patch].first + q / n_lanes];
      begin.known[i]      = -1;
      begin.step[i]       = entry->step;
      begin.multiplier[i] = entry->normal_multiplier;
      for (unsigned int s = 0; s < 2; ++s)
      {
        begin.traction[s][i]   = entry->traction[s];
        begin.slip_speed[s][i] = entry->slip_speed[s];
      }
    }
  }

  /// One lane of friction in time, by end_friction().
  void StepInLanes::find_friction(const Begin &begin, const End &end, const unsigned int i, FrictionInLanes &result) const
  {
    const auto of_lane = [i](const TwoLanes &lanes) { return Tensor<1, 2>({ lanes[0][i], lanes[1][i] }); };
    const FrictionHistory<2> history{ of_lane(begin.traction), of_lane(begin.slip_speed), begin.step[i] };
    const auto found =
        end_friction(history, of.law.tangential, of_lane(end.slip_change), end.pressure[i], of.law.friction, of.law.weights.dt);
    for (unsigned int s = 0; s < 2; ++s)
    {
      result.traction[s][i]    = found.traction[s];
      result.slip_speed[s][i]  = found.slip_speed[s];
      result.by_pressure[s][i] = found.d_pressure[s];
      for (unsigned int r = 0; r < 2; ++r)
        result.by_slip[2 * s + r][i] = found.d_slip[s][r];
    }
    result.mu[i]         = found.mu;
    result.slipping[i]   = found.slipping ? -1 : 0;
    result.energy[i]     = found.energy;
    result.dissipated[i] = found.dissipated;
    result.creep[i]      = found.creep;
  }

  /// As end_friction() where stick is resolved: the slip speed at the end is extrapolated from the step's mean and the last
  /// one's.
  SPRAG_PART void StepInLanes::rub_in_time(const Begin &begin, const bool in_lanes, End &end) const
  {
    auto &result     = end.friction;
    LaneMask unknown = ~LaneMask{};
    if (in_lanes)
    {
      const double stiffness = of.law.tangential, dt = of.law.weights.dt;
      const Lanes &t_0 = begin.traction[0], &t_1 = begin.traction[1];
      const Lanes &g_0 = end.slip_change[0], &g_1 = end.slip_change[1];
      const Lanes before     = begin.slip_speed[0] * (t_0 + stiffness * g_0) + begin.slip_speed[1] * (t_1 + stiffness * g_1);
      const LaneMask goes_on = (begin.step > 0.) & (before >= 0.);
      const Lanes share      = goes_on ? dt / (dt + begin.step) : Lanes{};
      const Lanes duration   = dt / (1. + share);
      const Lanes shift      = -duration * share;
      const TrialInLanes trial{
        begin.traction, end.slip_change, { { shift * begin.slip_speed[0], shift * begin.slip_speed[1] } }, duration, end.pressure
      };
      unknown              = return_to_cone(trial, of.law.friction, stiffness, result);
      const Lanes traction = result.traction[0] * result.traction[0] + result.traction[1] * result.traction[1];
      const Lanes s_0 = g_0 - (result.traction[0] - t_0) / stiffness, s_1 = g_1 - (result.traction[1] - t_1) / stiffness;
      const LaneMask &slips = result.slipping;
      result.slip_speed     = { { slips ? s_0 / dt : Lanes{}, slips ? s_1 / dt : Lanes{} } };
      result.energy         = 0.5 / stiffness * traction;
      result.dissipated     = 0.5 * ((t_0 + result.traction[0]) * s_0 + (t_1 + result.traction[1]) * s_1);
      result.creep          = Lanes{};
    }
    if (any(unknown))
      for (unsigned int i = 0; i < n_lanes; ++i)
        if (unknown[i])
          find_friction(begin, end, i, result);
  }

  /// Without inertia, as end_response().
  SPRAG_PART void StepInLanes::rub_at_end(const Block &block, const Begin &begin, const PlacesInLanes &ended,
                                          const Patches::Nodal &nodal, const bool in_lanes, End &end) const
  {
    const double stiffness = of.law.tangential;
    auto &result           = end.friction;
    result                 = FrictionInLanes();
    // Derivative of the deformed place along the undeformed face.
    const PointsInLanes along_xi{ all_lanes(1.), Lanes{}, Lanes{} };
    end.direction     = in_lever(at_points(block.slopes, along_xi, nodal), of.end.cosine, of.end.sine);
    const auto round  = cross(of.end.axes.axis, ended.normal);
    const Lanes slope = of.cylinder.radius / ended.radius * dot(end.direction, round);
    end.shift         = begin.shift + begin.by_slope * slope;
    if (of.law.mode == FrictionMode::stick)
    {
      for (unsigned int s = 0; s < 2; ++s)
      {
        result.traction[s]        = begin.traction[s] + stiffness * end.slip_change[s];
        result.by_slip[2 * s + s] = all_lanes(stiffness);
      }
      return;
    }
    const TrialInLanes trial{ begin.traction,
                              end.slip_change,
                              { { end.shift + begin.elastic_shift, Lanes{} } },
                              all_lanes(of.law.weights.dt),
                              end.pressure };
    const LaneMask unknown = in_lanes ? return_to_cone(trial, of.law.friction, stiffness, result) : end.takes_part;
    if (any(unknown))
      for (unsigned int i = 0; i < n_lanes; ++i)
        if (unknown[i])
          return_to_cone(trial, of.law.friction, stiffness, i, result);
  }

  /// Nothing changes in a steady slide: it begins as it ends, so that it takes up no work.
  SPRAG_PART void StepInLanes::slide_on(Begin &begin, End &end) const
  {
    auto &result          = end.friction;
    result                = FrictionInLanes();
    result.traction[0]    = of.slide->coefficient * end.pressure;
    result.mu             = all_lanes(of.slide->mu);
    result.slipping       = of.slide->rubs ? ~LaneMask{} : LaneMask{};
    result.slip_speed[0]  = all_lanes(of.slide->speed);
    result.by_pressure[0] = all_lanes(of.slide->coefficient);
    result.energy         = 0.5 * of.slide->compliance * result.traction[0] * result.traction[0];
    end.slip_change       = result.slip_speed;
    begin                 = Begin();
    begin.place           = end.place;
    begin.gap             = end.gap;
    begin.traction        = result.traction;
  }

  SPRAG_PART void StepInLanes::find_slip(const Begin &begin, const PlacesInLanes &ended, End &end) const
  {
    const auto &axes           = of.end.axes;
    const PointsInLanes across = ended.radius * ended.normal;
    end.slip_change            = { { of.cylinder.radius *
                                             angle_between(begin.upward, -begin.right, dot(across, axes.upward), -dot(across, axes.right)) +
                                         of.surface_run,
                                     ended.along - begin.along } };
  }

  SPRAG_PART void StepInLanes::press_in_time(const PlacesInLanes &ended, const bool in_lanes, Begin &begin, End &end) const
  {
    const double normal = of.law.normal.stiffness, delay = of.law.weights.delay();
    end.pressure = pressure_of(normal, end.gap);
    if (of.slide)
      slide_on(begin, end);
    end.takes_part = (end.gap < 0.) | (begin.gap < 0.) | begin.known;
    if (!any(end.takes_part))
      return;
    if (!of.slide)
    {
      find_slip(begin, ended, end);
      rub_in_time(begin, in_lanes, end);
    }
    end.mean_pressure = mean_pressure_of(normal, begin.gap, end.gap) + delay * (end.pressure - pressure_of(normal, begin.gap));
    for (unsigned int d = 0; d < 2; ++d)
      end.mean_traction[d] = (0.5 - delay) * begin.traction[d] + (0.5 + delay) * end.friction.traction[d];
  }

  SPRAG_PART void StepInLanes::press_at_end(const Block &block, const PlacesInLanes &ended, const Patches::Nodal &nodal,
                                            const bool in_lanes, const Begin &begin, End &end) const
  {
    const Lanes trial = begin.multiplier - of.law.normal.stiffness * end.gap;
    end.takes_part    = trial > 0.;
    if (!any(end.takes_part))
      return;
    end.pressure = end.mean_pressure = end.takes_part ? trial : Lanes{};
    find_slip(begin, ended, end);
    rub_at_end(block, begin, ended, nodal, in_lanes, end);
    end.mean_traction = end.friction.traction;
  }

  SPRAG_FOR_ANY_PROCESSOR bool StepInLanes::press(const unsigned int patch, const Patches::Nodal &to, Forces &forces,
                                                  double &compression)
  {
    const bool is_static = of.law.balance == ForceBalance::end;
    const bool in_lanes  = (is_static || of.law.friction.regularisation_speed == 0.) && never_falls(of.law.friction);
    const double c = of.balance.cosine, s = of.balance.sine;
    bool takes_part = false;
    for (unsigned int b = 0; b < blocks[patch].all.size(); ++b)
    {
      const auto &block = blocks[patch].all[b];
      auto &begin       = begins[blocks[patch].first + b];
      auto &end         = ends[blocks[patch].first + b];
      end.place         = at_points(block.shapes, block.position, to);
      const auto ended  = places_of(of.cylinder, of.end, end.place);
      end.gap           = ended.gap;
      if (is_static)
        press_at_end(block, ended, to, in_lanes, begin, end);
      else
        press_in_time(ended, in_lanes, begin, end);
      if (!any(end.takes_part))
        continue;
      takes_part       = true;
      const Lanes most = is_static ? end.pressure / of.law.normal.stiffness : -smaller(end.gap, begin.gap);
      compression      = std::max(compression, largest(most));

      const auto at       = of.share == 1. ? end.place : begin.place + of.share * (end.place - begin.place);
      const auto balanced = of.share == 1. ? ended : places_of(of.cylinder, of.balance, at);
      const auto of_point = force_of(balanced, of.balance.axes.axis, of.cylinder.radius, end.mean_pressure, end.mean_traction);
      const Lanes weight  = end.takes_part ? block.weight : Lanes{};
      const auto force    = weight * of_point;
      const auto along    = in_lever(force, c, s);
      for (unsigned int a = 0; a < Patches::max_nodes; ++a)
      {
        forces[a] += sum(along.x * block.shapes[a]);
        forces[Patches::max_nodes + a] += sum(along.y * block.shapes[a]);
        forces[2 * Patches::max_nodes + a] += sum(along.z * block.shapes[a]);
      }
      forces[n_displacements] += sum(dot(force, with_theta(at, c, s)));
      forces[n_displacements + 1] -= sum(force.x);
      for (unsigned int i = 0; i < of.slopes; ++i)
        forces[n_displacements + 2 + i] += sum(dot(force, times(of.balance.axes.turn[i], balanced.from_centre)));
    }
    return takes_part;
  }
} // namespace sprag
