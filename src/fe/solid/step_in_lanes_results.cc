#include "fe/solid/step_in_lanes_parts.h"

#include <algorithm>

namespace sprag
{
  /// Products of shapes of two nodes are summed for pairs of them: these are alike in both orders.
  struct StepInLanes::TangentSums
  {
    static constexpr unsigned int n_pairs = Patches::max_nodes * (Patches::max_nodes + 1) / 2;

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

  /// Adds what follows from the slope of the slip round the cylinder along the face, which shifts the slip of a step without
  /// inertia: of each point a product of how forces grow with it and of its derivatives.
  SPRAG_PART void StepInLanes::add_slope_of_slip(const unsigned int patch, Tangent &tangent) const
  {
    const unsigned int n           = n_displacements + 2 + of.slopes;
    constexpr unsigned int n_nodes = Patches::max_nodes;
    const double radius = of.cylinder.radius, c = of.end.cosine, s = of.end.sine;
    const auto &axes = of.end.axes;
    std::vector<SomeLanes<n_coordinates>> by_slope, slope_by;
    for (unsigned int b = 0; b < blocks[patch].all.size(); ++b)
    {
      const auto of_block             = pressed(patch, b);
      const auto &[block, begin, end] = of_block;
      if (!of_block.takes_part() || !any(end.takes_part & (begin.by_slope != 0.)))
        continue;
      const auto ended     = places_of(of.cylinder, of.end, end.place);
      const auto round     = cross(axes.axis, ended.normal);
      const auto slip      = (radius / ended.radius) * round;
      const auto &friction = end.friction;
      const auto force     = (end.takes_part ? -block.weight * begin.by_slope : Lanes{}) *
                         (friction.by_shift[0] * slip + times(friction.by_shift[1], axes.axis));
      const auto by_place = (-radius / (ended.radius * ended.radius)) *
                            (dot(end.direction, round) * ended.normal + dot(end.direction, ended.normal) * round);
      PointsInLanes moved[n_frame]{}, turned[n_frame]{}; // place and direction, by theta, x and slopes
      moved[0]   = with_theta(end.place, c, s);
      turned[0]  = with_theta(in_lever(end.direction, c, s), c, s);
      moved[1].x = all_lanes(-1.);
      for (unsigned int i = 0; i < of.slopes; ++i)
      {
        moved[2 + i]  = times(axes.turn[i], ended.from_centre);
        turned[2 + i] = times(axes.turn[i], end.direction);
      }
      const auto force_in_lever = in_lever(force, c, s), place_in_lever = in_lever(by_place, c, s),
                 slip_in_lever = in_lever(slip, c, s);
      auto &forces             = by_slope.emplace_back();
      auto &slopes             = slope_by.emplace_back();
      for (unsigned int a = 0; a < n_nodes; ++a)
      {
        const auto of_force = block.shapes[a] * force_in_lever;
        const auto of_slope = block.shapes[a] * place_in_lever + block.slopes[a] * slip_in_lever;
        forces[a] = of_force.x, forces[n_nodes + a] = of_force.y, forces[2 * n_nodes + a] = of_force.z;
        slopes[a] = of_slope.x, slopes[n_nodes + a] = of_slope.y, slopes[2 * n_nodes + a] = of_slope.z;
      }
      for (unsigned int k = 0; k < n - n_displacements; ++k)
      {
        forces[n_displacements + k] = dot(force, moved[k]);
        slopes[n_displacements + k] = dot(by_place, moved[k]) + dot(slip, turned[k]);
      }
    }
    for (unsigned int i = 0; i < n && !by_slope.empty(); ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        Lanes products{};
        for (std::size_t b = 0; b < by_slope.size(); ++b)
          products += by_slope[b][i] * slope_by[b][j];
        tangent[i][j] += sum(products);
      }
  }

  SPRAG_FOR_ANY_PROCESSOR StepInLanes::Tangent StepInLanes::tangent(const unsigned int patch) const
  {
    constexpr unsigned int n_nodes = Patches::max_nodes;
    const double normal = of.law.normal.stiffness, delay = of.law.weights.delay(), radius = of.cylinder.radius;
    const double c = of.balance.cosine, s = of.balance.sine, c_end = of.end.cosine, s_end = of.end.sine;
    const auto &axes = of.balance.axes, &axes_end = of.end.axes;
    const unsigned int n_moved = 2 + of.slopes;
    const bool is_static       = of.law.balance == ForceBalance::end;
    TangentSums sums{};
    for (unsigned int b = 0; b < blocks[patch].all.size(); ++b)
    {
      const auto of_block             = pressed(patch, b);
      const auto &[block, begin, end] = of_block;
      if (!of_block.takes_part())
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
      const Lanes d_end  = (is_static ? end.takes_part : end.gap < 0.) ? all_lanes(-normal) : Lanes{};
      const Lanes d_mean = is_static ? d_end : d_mean_pressure_of(normal, begin.gap, end.gap) + delay * d_end;
      MatrixInLanes by_place{};
      by_place.add_product(d_mean * gap, gap_end);
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
      PointsInLanes frame[n_frame]{}, frame_end[n_frame]{};
      frame[0]     = with_theta(at, c, s);
      frame_end[0] = with_theta(end.place, c_end, s_end);
      frame[1].x = frame_end[1].x = all_lanes(-1.);
      for (unsigned int i = 0; i < of.slopes; ++i)
      {
        frame[2 + i]     = times(axes.turn[i], balanced.from_centre);
        frame_end[2 + i] = times(axes_end.turn[i], ended.from_centre);
      }

      const Lanes weight = end.takes_part ? block.weight : Lanes{};
      for (unsigned int k = 0; k < n_moved; ++k)
      {
        auto column = in_lever(by_place * frame_end[k], c, s);
        auto row    = in_lever(by_place.transposed(frame[k]), c_end, s_end);
        for (unsigned int l = 0; l < n_moved; ++l)
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
    for (unsigned int k = 0; k < n_moved; ++k)
    {
      for (unsigned int i = 0; i < n_displacements; ++i)
      {
        result[i][n_displacements + k] = sum(sums.columns[k][i]);
        result[n_displacements + k][i] = sum(sums.rows[k][i]);
      }
      for (unsigned int l = 0; l < n_moved; ++l)
        result[n_displacements + k][n_displacements + l] = sum(sums.frame[k][l]);
    }
    if (is_static && of.law.mode == FrictionMode::cone)
      add_slope_of_slip(patch, result);
    return result;
  }

  SPRAG_FOR_ANY_PROCESSOR void StepInLanes::add_works(const unsigned int patch, Sums &sums) const
  {
    const double normal = of.law.normal.stiffness, delay = of.law.weights.delay(), radius = of.cylinder.radius;
    const double c = of.balance.cosine, s = of.balance.sine;
    const double d_theta = of.end.theta - of.begin.theta, d_x = of.end.x - of.begin.x;
    const auto &axes = of.balance.axes;
    for (unsigned int b = 0; b < blocks[patch].all.size(); ++b)
    {
      const auto of_block             = pressed(patch, b);
      const auto &[block, begin, end] = of_block;
      if (!of_block.takes_part())
        continue;
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
    }
  }

  SPRAG_FOR_ANY_PROCESSOR double StepInLanes::largest_pressure(const unsigned int patch) const
  {
    double result = 0.;
    for (unsigned int b = 0; b < blocks[patch].all.size(); ++b)
      if (const auto of_block = pressed(patch, b); of_block.takes_part())
        result = std::max(result, largest(of_block.end.takes_part ? of_block.end.pressure : Lanes{}));
    return result;
  }

  SPRAG_FOR_ANY_PROCESSOR void StepInLanes::add_points(const unsigned int patch, const bool all,
                                                       std::vector<FacePointState<3>> &points) const
  {
    const Begin nowhere{};
    for (unsigned int b = 0; b < blocks[patch].all.size(); ++b)
    {
      const auto of_block = pressed(patch, b);
      const auto &block   = of_block.block;
      if (!all && !of_block.takes_part())
        continue;
      PointsInLanes force{};
      Lanes theta{};
      if (of_block.takes_part())
      {
        const auto &end  = of_block.end;
        const auto ended = places_of(of.cylinder, of.end, end.place);
        force            = force_of(ended, of.end.axes.axis, of.cylinder.radius, end.pressure, end.friction.traction);
        theta            = dot(force, with_theta(end.place, of.end.cosine, of.end.sine));
      }
      End clear{};
      if (block.is_clear)
      {
        clear.place = at_points(block.shapes, block.position, blocks[patch].travel.displacement());
        clear.gap   = places_of(of.cylinder, of.end, clear.place).gap;
      }
      const auto &begin = block.is_clear ? nowhere : of_block.begin;
      const auto &end   = block.is_clear ? clear : of_block.end;
      for (unsigned int i = 0; i < block.n; ++i)
      {
        auto &state = points.emplace_back();
        state.patch = patch;
        set_point(block, begin, end, i, { { force.x[i], force.y[i], force.z[i], theta[i] } }, state);
      }
    }
  }

  void StepInLanes::set_point(const Block &block, const Begin &begin, const End &end, const unsigned int i,
                              const std::array<double, 4> &force, FacePointState<3> &state) const
  {
    state.index          = block.first + i;
    state.position       = dealii::Point<3>(end.place.x[i], end.place.y[i], end.place.z[i]);
    state.gap            = end.gap[i];
    state.trial_pressure = begin.multiplier[i] - of.law.normal.stiffness * state.gap;
    if (!end.takes_part[i])
      return;
    const auto &friction = end.friction;
    const bool is_static = of.law.balance == ForceBalance::end;
    state.pressure       = end.pressure[i];
    state.mu             = friction.mu[i];
    state.slipping       = friction.slipping[i] != 0;
    dealii::Tensor<1, 2> remembered_traction;
    for (unsigned int d = 0; d < 2; ++d)
    {
      state.traction[d]          = friction.traction[d][i];
      state.memory.slip_speed[d] = friction.slip_speed[d][i];
      state.slip_change[d]       = end.slip_change[d][i];
      if (of.augmented)
        remembered_traction[d] = begin.traction[d][i];
    }
    state.memory.traction = state.traction;
    state.memory.point    = state.index;
    state.elastic_slip    = (state.traction - remembered_traction).norm() / of.law.tangential;
    if (is_static)
    {
      state.slip_change[0] += end.shift[i];
      state.slip_change *= of.speed_ratio;
    }
    else
      state.memory.step = of.law.weights.dt;
    const double c = of.end.cosine, s = of.end.sine;
    state.end_force =
        dealii::Tensor<1, 5>({ s * force[1] - c * force[0], s * force[0] + c * force[1], force[2], force[3], -force[0] });
  }
} // namespace sprag
