#include "fe/solid/step_in_lanes.h"

#include <algorithm>
#include <limits>

namespace sprag
{
  using dealii::Tensor;

  using TwoLanes = SomeLanes<2>;

  struct StepInLanes::Block
  {
    PointsInLanes position; ///< undeformed
    Lanes weight;           ///< 0 beyond the patch's last point
    SomeLanes<Patches::max_nodes> shapes;
    unsigned int first; ///< point
    unsigned int n;     ///< of points
  };

  struct StepInLanes::Begin
  {
    PointsInLanes place;
    Lanes gap;
    Lanes right, upward, along; ///< parts of the place in the cylinder's axes
    LaneMask known;             ///< whether the point remembers a contact
    TwoLanes traction;
    TwoLanes slip_speed;
    Lanes step;
  };

  struct StepInLanes::Friction
  {
    TwoLanes traction;
    Lanes mu;
    LaneMask slipping;
    TwoLanes slip_speed;
    SomeLanes<4> by_slip; ///< derivatives of the traction, row by row
    SomeLanes<2> by_pressure;
    Lanes energy;
    Lanes dissipated;
    Lanes creep;
  };

  struct StepInLanes::End
  {
    PointsInLanes place;
    Lanes gap;
    LaneMask takes_part;
    Lanes pressure;
    TwoLanes slip_change;
    Friction friction;
    Lanes mean_pressure; ///< of the step
    TwoLanes mean_traction;
  };

  namespace
  {
    /// Linear unilateral spring, see mean_normal_force().
    SPRAG_PART Lanes pressure_of(const double stiffness, const Lanes &gap)
    {
      return gap < 0. ? -stiffness * gap : Lanes{};
    }

    SPRAG_PART Lanes mean_pressure_of(const double stiffness, const Lanes &begin, const Lanes &end)
    {
      const Lanes p_begin = pressure_of(stiffness, begin), p_end = pressure_of(stiffness, end);
      const Lanes change   = end - begin;
      const Lanes by_end   = (p_begin + 4. * pressure_of(stiffness, 0.5 * (begin + end)) + p_end) / 6.;
      const LaneMask small = (absolute(change) < 1e-3 * larger(-begin, -end)) | (change == 0.);
      const Lanes quotient = 0.5 / stiffness * (p_begin * p_begin - p_end * p_end) / (small ? all_lanes(1.) : change);
      return small ? by_end : quotient;
    }

    SPRAG_PART Lanes d_mean_pressure_of(const double stiffness, const Lanes &begin, const Lanes &end)
    {
      const auto slope     = [stiffness](const Lanes &gap) { return gap < 0. ? all_lanes(-stiffness) : Lanes{}; };
      const Lanes change   = end - begin;
      const LaneMask small = (absolute(change) < 1e-3 * larger(-begin, -end)) | (change == 0.);
      const Lanes quotient =
          (pressure_of(stiffness, end) - mean_pressure_of(stiffness, begin, end)) / (small ? all_lanes(1.) : change);
      return small ? (2. * slope(0.5 * (begin + end)) + slope(end)) / 6. : quotient;
    }

    /// A vector along the axes of the lever.
    SPRAG_PART PointsInLanes in_lever(const PointsInLanes &a, const double c, const double s)
    {
      return { s * a.y - c * a.x, s * a.x + c * a.y, a.z };
    }

    /// How a point moves with theta.
    SPRAG_PART PointsInLanes with_theta(const PointsInLanes &at, const double c, const double s)
    {
      return { at.x * s + at.y * c, at.x * c - at.y * s, Lanes{} };
    }

    SPRAG_PART PointsInLanes at_points(const SomeLanes<FacePatches<3>::max_nodes> &shapes, const PointsInLanes &position,
                                       const FacePatches<3>::Nodal &displacement)
    {
      PointsInLanes result = position;
      for (unsigned int a = 0; a < FacePatches<3>::max_nodes; ++a)
      {
        result.x += shapes[a] * displacement[3 * a];
        result.y += shapes[a] * displacement[3 * a + 1];
        result.z += shapes[a] * displacement[3 * a + 2];
      }
      return result;
    }

    /// The force of a pressure and of tractions on a point, in the axes of the world.
    SPRAG_PART PointsInLanes force_of(const PlacesInLanes &place, const Tensor<1, 3> &axis, const double radius,
                                      const Lanes &pressure, const TwoLanes &traction)
    {
      const PointsInLanes round = cross(axis, place.normal);
      return pressure * place.normal - (traction[0] * radius / place.radius) * round -
             times(traction[1] - pressure * place.profile_slope, axis);
    }
  } // namespace

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

  SPRAG_FOR_ANY_PROCESSOR bool StepInLanes::press(const unsigned int patch, const Patches::Nodal &from, const Patches::Nodal &to,
                                                  Forces &forces, double &compression)
  {
    auto &range = ranges[patch];
    if (!range.is_placed)
    {
      place(patch, from);
      recall(patch);
      range.is_placed = true;
    }
    const double normal = of.law.normal.stiffness, delay = of.law.weights.delay();
    const bool in_lanes = of.law.friction.regularisation_speed == 0. && never_falls(of.law.friction);
    const double c = of.balance.cosine, s = of.balance.sine;
    const auto &axes = of.end.axes;
    bool takes_part  = false;
    for (unsigned int b = range.begin; b < range.end; ++b)
    {
      const auto &block = blocks[b];
      const auto &begin = begins[b];
      auto &end         = ends[b];
      end.place         = at_points(block.shapes, block.position, to);
      const auto ended  = places_of(of.cylinder, of.end, end.place);
      end.gap           = ended.gap;
      end.takes_part    = (end.gap < 0.) | (begin.gap < 0.) | begin.known;
      if (!any(end.takes_part))
        continue;
      takes_part                 = true;
      compression                = std::max(compression, largest(-smaller(end.gap, begin.gap)));
      const PointsInLanes across = ended.radius * ended.normal;
      end.slip_change            = { { of.cylinder.radius * angle_between(begin.upward, -begin.right, dot(across, axes.upward),
                                                                          -dot(across, axes.right)) +
                                           of.surface_run,
                                       ended.along - begin.along } };
      end.pressure               = pressure_of(normal, end.gap);
      end.mean_pressure = mean_pressure_of(normal, begin.gap, end.gap) + delay * (end.pressure - pressure_of(normal, begin.gap));
      if (in_lanes)
        return_to_cone(begin, end, end.friction);
      else
        for (unsigned int i = 0; i < n_lanes; ++i)
          find_friction(begin, end, i, end.friction);
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

  /// Products of shapes of two nodes are summed for pairs of them: these are alike in both orders.
  struct StepInLanes::TangentSums
  {
    static constexpr unsigned int n_pairs = Patches::max_nodes * (Patches::max_nodes + 1) / 2;
    static constexpr unsigned int n_frame = n_coordinates - n_displacements;

    Lanes displacements[9][n_pairs];
    Lanes columns[n_frame][n_displacements]; ///< derivatives of the nodes' forces by theta, x and slopes
    Lanes rows[n_frame][n_displacements];    ///< of the forces on these by the nodes' displacements
    Lanes frame[n_frame][n_frame];
  };

  namespace
  {
    /// 3 by 3.
    struct MatrixInLanes
    {
      PointsInLanes rows[3];

      SPRAG_PART void add_product(const PointsInLanes &a, const PointsInLanes &b)
      {
        rows[0] = rows[0] + a.x * b;
        rows[1] = rows[1] + a.y * b;
        rows[2] = rows[2] + a.z * b;
      }

      SPRAG_PART PointsInLanes operator*(const PointsInLanes &a) const
      {
        return { dot(rows[0], a), dot(rows[1], a), dot(rows[2], a) };
      }

      SPRAG_PART PointsInLanes transposed(const PointsInLanes &a) const
      {
        return a.x * rows[0] + a.y * rows[1] + a.z * rows[2];
      }
    };
  } // namespace

  SPRAG_FOR_ANY_PROCESSOR StepInLanes::Tangent StepInLanes::tangent(const unsigned int patch) const
  {
    constexpr unsigned int n_nodes = Patches::max_nodes;
    const double normal = of.law.normal.stiffness, delay = of.law.weights.delay(), radius = of.cylinder.radius;
    const double c = of.balance.cosine, s = of.balance.sine, c_end = of.end.cosine, s_end = of.end.sine;
    const auto &axes = of.balance.axes, &axes_end = of.end.axes;
    const unsigned int n_frame = 2 + of.slopes;
    TangentSums sums{};
    for (unsigned int b = ranges[patch].begin; b < ranges[patch].end; ++b)
    {
      const auto &block = blocks[b];
      const auto &begin = begins[b];
      const auto &end   = ends[b];
      if (!any(end.takes_part))
        continue;
      const auto at            = begin.place + of.share * (end.place - begin.place);
      const auto balanced      = places_of(of.cylinder, of.balance, at);
      const auto ended         = places_of(of.cylinder, of.end, end.place);
      const auto round         = cross(axes.axis, balanced.normal);
      const PointsInLanes axis = times(all_lanes(1.), axes.axis), axis_end = times(all_lanes(1.), axes_end.axis);
      const PointsInLanes slip[2]     = { (radius / balanced.radius) * round, axis };
      const PointsInLanes slip_end[2] = { (radius / ended.radius) * cross(axes_end.axis, ended.normal), axis_end };
      const PointsInLanes gap         = balanced.normal + balanced.profile_slope * axis;
      const PointsInLanes gap_end     = ended.normal + ended.profile_slope * axis_end;
      const auto &friction            = end.friction;

      // Of the force by the displacement of the point, in the axes of the world.
      const Lanes d_end = end.gap < 0. ? all_lanes(-normal) : Lanes{};
      MatrixInLanes by_place{};
      by_place.add_product((d_mean_pressure_of(normal, begin.gap, end.gap) + delay * d_end) * gap, gap_end);
      for (unsigned int q = 0; q < 2; ++q)
        by_place.add_product((-0.5 - delay) * slip[q], friction.by_pressure[q] * d_end * gap_end +
                                                           friction.by_slip[2 * q] * slip_end[0] +
                                                           friction.by_slip[2 * q + 1] * slip_end[1]);
      const Lanes pressed = of.share * end.mean_pressure, rubbed = of.share * end.mean_traction[0];
      const Lanes turned = rubbed * radius / (balanced.radius * balanced.radius);
      by_place.add_product(pressed / balanced.radius * round + turned * balanced.normal, round);
      by_place.add_product(turned * round, balanced.normal);
      by_place.add_product(pressed * balanced.profile_curvature * axis, axis);

      const auto force = of.share * force_of(balanced, axes.axis, radius, end.mean_pressure, end.mean_traction);
      PointsInLanes frame[TangentSums::n_frame]{}, frame_end[TangentSums::n_frame]{};
      frame[0]     = with_theta(at, c, s);
      frame_end[0] = with_theta(end.place, c_end, s_end);
      frame[1].x = frame_end[1].x = all_lanes(-1.);
      for (unsigned int i = 0; i < of.slopes; ++i)
      {
        frame[2 + i]     = times(axes.turn[i], balanced.from_centre);
        frame_end[2 + i] = times(axes_end.turn[i], ended.from_centre);
      }

      const Lanes weight = end.takes_part ? block.weight : Lanes{};
      for (unsigned int k = 0; k < n_frame; ++k)
      {
        auto column = in_lever(by_place * frame_end[k], c, s);
        auto row    = in_lever(by_place.transposed(frame[k]), c_end, s_end);
        for (unsigned int l = 0; l < n_frame; ++l)
          sums.frame[k][l] += weight * dot(frame[k], by_place * frame_end[l]);
        // The force on a place that turns.
        PointsInLanes bend{};
        if (k == 0)
        {
          bend = { s * force.x + c * force.y, c * force.x - s * force.y, Lanes{} };
          sums.frame[0][0] += weight * (force.x * (at.x * c - at.y * s) - force.y * (at.x * s + at.y * c));
        }
        else if (k >= 2)
        {
          const auto turned_force = transposed_times(axes.turn[k - 2], force);
          bend                    = in_lever(turned_force, c, s);
          for (unsigned int l = 0; l < 2; ++l)
          {
            const Lanes mixed = weight * dot(turned_force, frame[l]);
            sums.frame[k][l] += mixed;
            sums.frame[l][k] += mixed;
          }
          for (unsigned int j = 0; j < of.slopes; ++j)
            sums.frame[k][2 + j] += weight * dot(force, times(axes.bend[k - 2][j], balanced.from_centre));
        }
        column = weight * (column + bend);
        row    = weight * (row + bend);
        for (unsigned int a = 0; a < n_nodes; ++a)
        {
          const Lanes &shape = block.shapes[a];
          sums.columns[k][a] += shape * column.x;
          sums.columns[k][n_nodes + a] += shape * column.y;
          sums.columns[k][2 * n_nodes + a] += shape * column.z;
          sums.rows[k][a] += shape * row.x;
          sums.rows[k][n_nodes + a] += shape * row.y;
          sums.rows[k][2 * n_nodes + a] += shape * row.z;
        }
      }

      const PointsInLanes along[3] = { by_place.transposed({ all_lanes(-c), all_lanes(s), Lanes{} }),
                                       by_place.transposed({ all_lanes(s), all_lanes(c), Lanes{} }), by_place.rows[2] };
      Lanes of_point[9];
      for (unsigned int d = 0; d < 3; ++d)
      {
        const auto row      = weight * in_lever(along[d], c_end, s_end);
        of_point[3 * d]     = row.x;
        of_point[3 * d + 1] = row.y;
        of_point[3 * d + 2] = row.z;
      }
      for (unsigned int a = 0, pair = 0; a < n_nodes; ++a)
        for (unsigned int other = 0; other <= a; ++other, ++pair)
        {
          const Lanes shapes = block.shapes[a] * block.shapes[other];
          for (unsigned int de = 0; de < 9; ++de)
            sums.displacements[de][pair] += shapes * of_point[de];
        }
    }

    Tangent result{};
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int e = 0; e < 3; ++e)
        for (unsigned int a = 0, pair = 0; a < n_nodes; ++a)
          for (unsigned int other = 0; other <= a; ++other, ++pair)
            result[n_nodes * d + a][n_nodes * e + other] = result[n_nodes * d + other][n_nodes * e + a] =
                sum(sums.displacements[3 * d + e][pair]);
    for (unsigned int k = 0; k < n_frame; ++k)
    {
      for (unsigned int i = 0; i < n_displacements; ++i)
      {
        result[i][n_displacements + k] = sum(sums.columns[k][i]);
        result[n_displacements + k][i] = sum(sums.rows[k][i]);
      }
      for (unsigned int l = 0; l < n_frame; ++l)
        result[n_displacements + k][n_displacements + l] = sum(sums.frame[k][l]);
    }
    return result;
  }

  SPRAG_FOR_ANY_PROCESSOR void StepInLanes::complete(const unsigned int patch, Sums &sums, std::vector<FacePointState<3>> &points)
  {
    const double normal = of.law.normal.stiffness, delay = of.law.weights.delay(), radius = of.cylinder.radius;
    const double c = of.balance.cosine, s = of.balance.sine;
    const double d_theta = of.end.theta - of.begin.theta, d_x = of.end.x - of.begin.x;
    const auto &axes = of.balance.axes;
    for (unsigned int b = ranges[patch].begin; b < ranges[patch].end; ++b)
    {
      const auto &block = blocks[b];
      const auto &begin = begins[b];
      const auto &end   = ends[b];
      PointsInLanes at_end{};
      Lanes theta{};
      if (any(end.takes_part))
      {
        // How the points move past the cylinder in the step, and of second order.
        const auto moved    = end.place - begin.place;
        const auto at       = begin.place + of.share * moved;
        const auto balanced = places_of(of.cylinder, of.balance, at);
        PointsInLanes rate  = { s * moved.y - c * moved.x + d_theta * (at.x * s + at.y * c) - d_x,
                                s * moved.x + c * moved.y + d_theta * (at.x * c - at.y * s), moved.z };
        PointsInLanes bend  = { d_theta * (2. * (s * moved.x + c * moved.y) + d_theta * (at.x * c - at.y * s)),
                                d_theta * (2. * (c * moved.x - s * moved.y) - d_theta * (at.x * s + at.y * c)), Lanes{} };
        const auto of_lever = rate;
        for (unsigned int i = 0; i < of.slopes; ++i)
        {
          const double turned = of.end.turned[i] - of.begin.turned[i];
          rate                = rate + turned * times(axes.turn[i], balanced.from_centre);
          bend                = bend + 2. * turned * times(axes.turn[i], of_lever);
          for (unsigned int j = 0; j < 2; ++j)
            bend = bend + turned * (of.end.turned[j] - of.begin.turned[j]) * times(axes.bend[i][j], balanced.from_centre);
        }
        const auto round     = cross(axes.axis, balanced.normal);
        const Lanes by_round = dot(rate, round), by_normal = dot(rate, balanced.normal), by_axis = dot(rate, axes.axis);
        const Lanes bend_round = dot(bend, round), bend_axis = dot(bend, axes.axis);
        const Lanes ratio    = radius / balanced.radius;
        const Lanes gap_bend = by_round * by_round / balanced.radius + balanced.profile_curvature * by_axis * by_axis +
                               dot(bend, balanced.normal) + balanced.profile_slope * bend_axis;
        const Lanes slip_bend = ratio * (bend_round - 2. * by_normal * by_round / balanced.radius);

        const auto &friction    = end.friction;
        const Lanes weight      = end.takes_part ? block.weight : Lanes{};
        const Lanes by_traction = (friction.traction[0] - begin.traction[0]) * end.slip_change[0] +
                                  (friction.traction[1] - begin.traction[1]) * end.slip_change[1] +
                                  end.mean_traction[0] * slip_bend + end.mean_traction[1] * bend_axis;
        const Lanes by_pressure =
            (end.pressure - pressure_of(normal, begin.gap)) * (end.gap - begin.gap) + end.mean_pressure * gap_bend;
        const auto force = force_of(balanced, axes.axis, radius, end.mean_pressure, end.mean_traction);
        sums.stored += sum(weight * (0.5 / normal * end.pressure * end.pressure + friction.energy));
        sums.friction += sum(weight * friction.dissipated);
        sums.algorithmic += delay * sum(weight * (by_traction - by_pressure));
        sums.drive += sum(weight * (of.surface_run * end.mean_traction[0] + of.advance * force.x));
        sums.creep = std::max(sums.creep, largest(end.takes_part ? friction.creep : Lanes{}));

        const auto ended = places_of(of.cylinder, of.end, end.place);
        at_end           = force_of(ended, of.end.axes.axis, radius, end.pressure, friction.traction);
        theta            = dot(at_end, with_theta(end.place, of.end.cosine, of.end.sine));
      }
      for (unsigned int i = 0; i < block.n; ++i)
        add_point(patch, b, i, { { at_end.x[i], at_end.y[i], at_end.z[i], theta[i] } }, points);
    }
  }

  void StepInLanes::add_point(const unsigned int patch, const unsigned int b, const unsigned int i,
                              const std::array<double, 4> &force, std::vector<FacePointState<3>> &points) const
  {
    const auto &end      = ends[b];
    auto &state          = points.emplace_back();
    state.index          = blocks[b].first + i;
    state.patch          = patch;
    state.position       = dealii::Point<3>(end.place.x[i], end.place.y[i], end.place.z[i]);
    state.gap            = end.gap[i];
    state.trial_pressure = -of.law.normal.stiffness * state.gap;
    if (!end.takes_part[i])
      return;
    const auto &friction = end.friction;
    state.pressure       = end.pressure[i];
    state.mu             = friction.mu[i];
    state.slipping       = friction.slipping[i] != 0;
    for (unsigned int d = 0; d < 2; ++d)
    {
      state.traction[d]          = friction.traction[d][i];
      state.memory.slip_speed[d] = friction.slip_speed[d][i];
      state.slip_change[d]       = end.slip_change[d][i];
    }
    state.memory.traction = state.traction;
    state.memory.step     = of.law.weights.dt;
    state.memory.point    = state.index;
    state.elastic_slip    = state.traction.norm() / of.law.tangential;
    const double c = of.end.cosine, s = of.end.sine;
    state.end_force =
        dealii::Tensor<1, 5>({ s * force[1] - c * force[0], s * force[0] + c * force[1], force[2], force[3], -force[0] });
  }
} // namespace sprag
