#include "fe/solid/step_in_lanes_parts.h"

#include <algorithm>
#include <limits>

namespace sprag
{
  StepInLanes::StepInLanes(const Patches &patches_)
      : patches(patches_)
  {
    for (const auto &patch : patches.patches)
    {
      const auto first = static_cast<unsigned int>(blocks.size());
      for (unsigned int begin = patch.begin; begin < patch.end; begin += n_lanes)
      {
        auto &block = blocks.emplace_back();
        block.first = begin;
        block.n     = std::min(n_lanes, patch.end - begin);
        for (unsigned int i = 0; i < n_lanes; ++i)
        {
          const auto &point   = patches.points[begin + std::min(i, block.n - 1)];
          block.position.x[i] = point.position[0];
          block.position.y[i] = point.position[1];
          block.position.z[i] = point.position[2];
          block.weight[i]     = i < block.n ? point.weight : 0.;
          for (unsigned int a = 0; a < Patches::max_nodes; ++a)
            block.shapes[a][i] = point.shapes[a];
        }
      }
      ranges.push_back({ first, static_cast<unsigned int>(blocks.size()), false });
    }
    begins.resize(blocks.size());
    ends.resize(blocks.size());
  }

  StepInLanes::~StepInLanes() = default;

  void StepInLanes::begin(Memory memory)
  {
    remembered = std::move(memory);
    for (auto &range : ranges)
      range.is_placed = false;
  }

  bool StepInLanes::begins_with(const Memory &memory) const
  {
    const auto same = [](const PointMemory<2> &a, const PointMemory<2> &b)
    { return a.point == b.point && a.step == b.step && a.traction == b.traction && a.slip_speed == b.slip_speed; };
    return std::equal(memory.begin(), memory.end(), remembered.begin(), remembered.end(), same);
  }

  void StepInLanes::set(const Constants &constants)
  {
    of = constants;
  }

  SPRAG_FOR_ANY_PROCESSOR void StepInLanes::place(const unsigned int patch, const Patches::Nodal &nodal)
  {
    const auto &axes = of.begin.axes;
    for (unsigned int b = ranges[patch].begin; b < ranges[patch].end; ++b)
    {
      auto &begin                = begins[b];
      begin                      = Begin();
      begin.place                = at_points(blocks[b].shapes, blocks[b].position, nodal);
      const auto place           = places_of(of.cylinder, of.begin, begin.place);
      const PointsInLanes across = place.radius * place.normal;
      begin.gap                  = place.gap;
      begin.right                = dot(across, axes.right);
      begin.upward               = dot(across, axes.upward);
      begin.along                = place.along;
    }
  }

  void StepInLanes::recall(const unsigned int patch)
  {
    const unsigned int first = patches.patches[patch].begin;
    const auto is_before     = [](const PointMemory<2> &entry, const unsigned int q) { return entry.point < q; };
    for (auto entry = std::lower_bound(remembered.begin(), remembered.end(), first, is_before);
         entry != remembered.end() && entry->point < patches.patches[patch].end; ++entry)
    {
      const unsigned int q = entry->point - first, i = q % n_lanes;
      auto &begin    = begins[ranges[patch].begin + q / n_lanes];
      begin.known[i] = -1;
      begin.step[i]  = entry->step;
      for (unsigned int s = 0; s < 2; ++s)
      {
        begin.traction[s][i]   = entry->traction[s];
        begin.slip_speed[s][i] = entry->slip_speed[s];
      }
    }
  }

  namespace
  {
    /// mu and its derivative, lane by lane.
    void find_coefficients(const FrictionLaw &law, const Lanes &speed, Lanes &mu, Lanes &derivative)
    {
      for (unsigned int i = 0; i < n_lanes; ++i)
      {
        const auto value = friction_coefficient(law, speed[i]);
        mu[i]            = value.coefficient;
        derivative[i]    = value.derivative;
      }
    }
  } // namespace

  /// One lane of friction, by end_friction().
  void StepInLanes::find_friction(const Begin &begin, const End &end, const unsigned int i, Friction &result) const
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

  /// The same as end_friction() where stick is resolved and mu nowhere falls: then the slip speed is the only root, and Newton's
  /// method finds it from that of a contact without elastic slip.
  SPRAG_PART void StepInLanes::return_to_cone(const Begin &begin, const End &end, Friction &result) const
  {
    const double stiffness = of.law.tangential, dt = of.law.weights.dt;
    const double round_off = 4. * std::numeric_limits<double>::epsilon();
    const Lanes &t_0 = begin.traction[0], &t_1 = begin.traction[1];
    const Lanes &g_0 = end.slip_change[0], &g_1 = end.slip_change[1];
    const Lanes trial_0 = t_0 + stiffness * g_0, trial_1 = t_1 + stiffness * g_1;
    const Lanes trial      = square_root(trial_0 * trial_0 + trial_1 * trial_1);
    const LaneMask is_none = trial == 0.;
    const Lanes one        = all_lanes(1.);
    const Lanes inverse    = 1. / (is_none ? one : trial);
    const Lanes d_0 = is_none ? one : trial_0 * inverse, d_1 = trial_1 * inverse;

    // The slip speed at the end of the step, extrapolated from its mean and that of the last.
    const Lanes before         = begin.slip_speed[0] * d_0 + begin.slip_speed[1] * d_1;
    const LaneMask goes_on     = (begin.step > 0.) & (before >= 0.);
    const Lanes share          = goes_on ? dt / (dt + begin.step) : Lanes{};
    const Lanes duration       = dt / (1. + share);
    const Lanes shift_of_speed = -duration * share;
    const Lanes shift          = shift_of_speed * before;
    const Lanes &p             = end.pressure;
    const double mu_at_rest    = friction_coefficient(of.law.friction, 0.).coefficient;
    const Lanes shifted        = trial + stiffness * shift;
    const LaneMask pressed     = p > 0.;
    const LaneMask sticks      = trial <= mu_at_rest * p;
    const LaneMask at_rest     = ~sticks & (shifted <= mu_at_rest * p);
    const LaneMask slips       = pressed & ~sticks & ~at_rest;

    Lanes mu = all_lanes(mu_at_rest), rate{}; // derivative of mu p by the speed over the resistance
    LaneMask unknown{};
    if (any(slips))
    {
      const Lanes resistance = stiffness * duration;
      const Lanes fastest    = slips ? shifted / resistance : Lanes{};
      Lanes speed            = smaller(larger(Lanes{}, (g_0 * d_0 + g_1 * d_1 + shift) / duration), fastest);
      Lanes of_speed{}, derivative{};
      unknown = slips;
      for (unsigned int i = 0; i < 6 && any(unknown); ++i)
      {
        find_coefficients(of.law.friction, speed, of_speed, derivative);
        const Lanes excess = shifted - resistance * speed - of_speed * p;
        unknown            = slips & (absolute(excess) > round_off * shifted);
        speed += unknown ? excess / (resistance + derivative * p) : Lanes{};
        speed = smaller(larger(Lanes{}, speed), fastest);
      }
      mu   = slips ? of_speed : mu;
      rate = slips ? derivative * p / resistance : Lanes{};
    }
    const LaneMask slipping = pressed & ~sticks & (at_rest | (mu * p <= trial));
    const Lanes traction    = slipping ? mu * p : trial;
    result.traction         = { { pressed ? traction * d_0 : Lanes{}, pressed ? traction * d_1 : Lanes{} } };
    result.mu               = pressed ? mu : Lanes{};
    result.slipping         = slipping;
    const Lanes s_0 = g_0 - (result.traction[0] - t_0) / stiffness, s_1 = g_1 - (result.traction[1] - t_1) / stiffness;
    result.slip_speed = { { slipping ? s_0 / dt : Lanes{}, slipping ? s_1 / dt : Lanes{} } };
    result.energy     = pressed ? 0.5 / stiffness * traction * traction : Lanes{};
    result.dissipated = 0.5 * ((t_0 + result.traction[0]) * s_0 + (t_1 + result.traction[1]) * s_1);
    result.creep      = Lanes{};

    const Lanes by_size      = rate / (1. + rate);
    const Lanes by_pressure  = slipping ? mu / (1. + rate) : Lanes{};
    const Lanes across       = traction * inverse;
    const Lanes turned       = stiffness * by_size * shift_of_speed * inverse;
    const Lanes turned_along = turned * before;
    result.by_pressure       = { { by_pressure * d_0, by_pressure * d_1 } };
    const Lanes d[2]         = { d_0, d_1 };
    for (unsigned int q = 0; q < 2; ++q)
      for (unsigned int r = 0; r < 2; ++r)
      {
        const Lanes along = d[q] * d[r];
        const Lanes same  = all_lanes(q == r ? 1. : 0.);
        const Lanes slip =
            by_size * along + across * (same - along) + d[q] * (turned * begin.slip_speed[r] - turned_along * d[r]);
        result.by_slip[2 * q + r] = pressed ? stiffness * (slipping ? slip : same) : Lanes{};
      }
    if (any(unknown))
      for (unsigned int i = 0; i < n_lanes; ++i)
        if (unknown[i])
          find_friction(begin, end, i, result);
  }

  /// Nothing changes in a steady slide: it begins as it ends, so that it takes up no work.
  SPRAG_PART void StepInLanes::slide_on(Begin &begin, End &end) const
  {
    auto &result          = end.friction;
    result                = Friction{};
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

  SPRAG_PART void StepInLanes::rub(const Begin &begin, const PlacesInLanes &ended, const bool in_lanes, End &end) const
  {
    const auto &axes           = of.end.axes;
    const PointsInLanes across = ended.radius * ended.normal;
    end.slip_change            = { { of.cylinder.radius *
                                             angle_between(begin.upward, -begin.right, dot(across, axes.upward), -dot(across, axes.right)) +
                                         of.surface_run,
                                     ended.along - begin.along } };
    if (in_lanes)
      return return_to_cone(begin, end, end.friction);
    for (unsigned int i = 0; i < n_lanes; ++i)
      find_friction(begin, end, i, end.friction);
  }

  SPRAG_FOR_ANY_PROCESSOR bool StepInLanes::press(const unsigned int patch, const Patches::Nodal &from, const Patches::Nodal &to,
                                                  Forces &forces, double &compression)
  {
    auto &range = ranges[patch];
    if (!of.slide && !range.is_placed)
    {
      place(patch, from);
      recall(patch);
    }
    range.is_placed     = !of.slide;
    const double normal = of.law.normal.stiffness, delay = of.law.weights.delay();
    const bool in_lanes = of.law.friction.regularisation_speed == 0. && never_falls(of.law.friction);
    const double c = of.balance.cosine, s = of.balance.sine;
    bool takes_part = false;
    for (unsigned int b = range.begin; b < range.end; ++b)
    {
      const auto &block = blocks[b];
      auto &begin       = begins[b];
      auto &end         = ends[b];
      end.place         = at_points(block.shapes, block.position, to);
      const auto ended  = places_of(of.cylinder, of.end, end.place);
      end.gap           = ended.gap;
      end.pressure      = pressure_of(normal, end.gap);
      if (of.slide)
        slide_on(begin, end);
      end.takes_part = (end.gap < 0.) | (begin.gap < 0.) | begin.known;
      if (!any(end.takes_part))
        continue;
      takes_part  = true;
      compression = std::max(compression, largest(-smaller(end.gap, begin.gap)));
      if (!of.slide)
        rub(begin, ended, in_lanes, end);
      end.mean_pressure = mean_pressure_of(normal, begin.gap, end.gap) + delay * (end.pressure - pressure_of(normal, begin.gap));
      for (unsigned int d = 0; d < 2; ++d)
        end.mean_traction[d] = (0.5 - delay) * begin.traction[d] + (0.5 + delay) * end.friction.traction[d];

      const auto at       = begin.place + of.share * (end.place - begin.place);
      const auto balanced = places_of(of.cylinder, of.balance, at);
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
