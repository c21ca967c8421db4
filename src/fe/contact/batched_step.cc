// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/batched_step.h"

#include "base/ranges.h"
#include "laws/friction_law.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  template <int dim>
  struct alignas(SimdBatch) BatchedStep<dim>::Block : PointBlock<dim>
  {
    using PointBlock<dim>::PointBlock;

    double clear_until = -1.; ///< length of the element's travel until which no point comes to the cylinder [mm]

    bool is_clear;       ///< as the element was pressed last: nothing was computed
    BatchMask is_active; ///< then
  };

  template <int dim>
  struct alignas(SimdBatch) BatchedStep<dim>::Begin
  {
    Triple<Batch> place;
    SimdBatch gap;
    SimdBatch right, upward, along; ///< parts of the place in the cylinder's axes
    BatchMask known;                ///< whether the point was in contact before
    SlipHistory<Batch, slips> history;
    SimdBatch multiplier;                     ///< of the gap [MPa]
    SimdBatch shift, elastic_shift, by_slope; ///< see SlipShift; with a slope of 0
    bool is_placed;                           ///< else the rest is unknown
    bool touches;                             ///< a point does, or was in contact before
  };

  /// Points where the step ends.
  template <int dim>
  template <class N>
  struct alignas(SimdBatch) BatchedStep<dim>::End
  {
    Triple<N> place;
    SeenPoint<N> seen;
    BatchMask is_active;
    N pressure;
    Several<N, slips> slip; ///< in the step
    SimdBatch shift;        ///< of the slip round the cylinder, without its elastic part [mm]
    PointFriction<N, slips> friction;

    // In the step, where forces are balanced.
    N mean_pressure;
    Several<N, slips> mean_traction;
  };

  template <int dim>
  BatchedStep<dim>::BatchedStep(const Elements &grid_, const RigidCylinder &cylinder_)
      : grid(grid_)
      , cylinder(cylinder_)
      , blocks(grid.elements.size())
  {
  }

  template <int dim>
  BatchedStep<dim>::~BatchedStep() = default;

  template <int dim>
  void BatchedStep<dim>::make_blocks(const unsigned int element)
  {
    const auto &range = grid.elements[element];
    double farthest = 0., most_shapes = 0.;
    for (unsigned int q = range.begin; q < range.end; ++q)
    {
      farthest    = std::max(farthest, grid.points[q].position.norm());
      most_shapes = std::max(most_shapes, sum_over(grid.points[q].shapes, [](const double shape) { return std::abs(shape); }));
    }
    blocks[element].travel = ElementTravel<dim>(farthest, most_shapes);
    for (unsigned int first = range.begin; first < range.end; first += n_lanes)
      blocks[element].all.emplace_back(grid, first, range.end);
  }

  template <int dim>
  void BatchedStep<dim>::begin(History history)
  {
    begin_history = std::move(history);
    for (const unsigned int element : placed)
      blocks[element].first = dealii::numbers::invalid_unsigned_int;
    placed.clear();
    n_placed = 0;
  }

  template <int dim>
  void BatchedStep<dim>::set(const Constants &constants)
  {
    data                 = constants;
    data.law.slip.pieces = rising_pieces(data.law.slip.friction);
  }

  template <int dim>
  void BatchedStep<dim>::place(const unsigned int element, const Nodal &nodal, const std::vector<SlipShift> &shifts)
  {
    auto &group = blocks[element];
    if (group.all.empty())
      make_blocks(element);
    placed.push_back(element);
    group.first = n_placed;
    n_placed += static_cast<unsigned int>(group.all.size());
    if (n_placed > begins.size())
      begins.resize(n_placed);
    group.begin               = nodal;
    const bool begins_as_ends = data.kind == Kind::slide || data.kind == Kind::touch;
    if (!begins_as_ends)
      group.travel.go_to(nodal, data.begin, cylinder.shape);
    for (unsigned int b = 0; b < group.all.size(); ++b)
    {
      auto &begin     = begins[group.first + b];
      begin           = Begin();
      begin.is_placed = begins_as_ends;
      if (!shifts.empty() || (!begins_as_ends && !passes_over(group, b)))
        place_block(group.all[b], nodal, begin);
      for (unsigned int i = 0; i < group.all[b].n && !shifts.empty(); ++i)
      {
        const auto &shift      = shifts[n_lanes * b + i];
        begin.shift[i]         = shift.slip;
        begin.elastic_shift[i] = shift.elastic;
        begin.by_slope[i]      = shift.d_slope;
      }
    }
    recall(element);
  }

  /// Without history and shifts. Wherever it is called from it computes with the same round-off.
  template <int dim>
  void BatchedStep<dim>::place_block(const Block &block, const Nodal &nodal, Begin &begin) const
  {
    begin           = Begin();
    begin.place     = block.place(nodal);
    const auto at   = seen(cylinder.shape, to_batch(data.begin), begin.place);
    begin.gap       = at.gap;
    begin.right     = dot(at.from_centre, data.begin.axes.right);
    begin.upward    = dot(at.from_centre, data.begin.axes.upward);
    begin.along     = at.along;
    begin.is_placed = true;
    begin.touches   = any(begin.gap < 0.);
  }

  template <int dim>
  SPRAG_PART bool BatchedStep<dim>::passes_over(const Blocks &group, const unsigned int b) const
  {
    return group.travel.length() < group.all[b].clear_until && !begins[group.first + b].touches;
  }

  template <int dim>
  void BatchedStep<dim>::recall(const unsigned int element)
  {
    auto &group              = blocks[element];
    const unsigned int first = grid.elements[element].begin;
    for (auto entry = find_history(begin_history, first);
         entry != begin_history.end() && entry->point < grid.elements[element].end; ++entry)
    {
      const unsigned int q = entry->point - first, b = q / n_lanes, i = q % n_lanes;
      auto &begin = begins[group.first + b];
      if (!begin.is_placed)
        place_block(group.all[b], group.begin, begin);
      begin.touches         = true;
      begin.known[i]        = -1;
      begin.history.step[i] = entry->step;
      begin.history.mu[i]   = entry->mu;
      begin.multiplier[i]   = entry->normal_multiplier;
      for (unsigned int s = 0; s < slips; ++s)
      {
        begin.history.traction[s][i]   = entry->traction[s];
        begin.history.slip_speed[s][i] = entry->slip_speed[s];
      }
    }
  }

  template <int dim>
  SPRAG_PART auto BatchedStep<dim>::slip_rates(const Block &block) const -> Several<Batch, slips>
  {
    const auto &slide = data.slide;
    Several<Batch, slips> result;
    result[0] = uniform_batch(slide.speed);
    if (slide.rates == nullptr)
      return result;
    const unsigned int element = grid.point_elements[block.first];
    const auto place           = block.place(blocks[element].travel.displacement());
    const auto rate            = block.moved(Elements::nodal(grid.elements[element], *slide.rates));
    for (unsigned int i = 0; i < n_lanes; ++i)
    {
      const auto changes = cylinder.changes(data.end, dealii::Point<3>(place.x[i], place.y[i], place.z[i]),
                                            dealii::Tensor<1, 3>({ rate.x[i], rate.y[i], rate.z[i] }), slide.x_rate,
                                            slide.theta_rate, slide.slope_rates);
      for (unsigned int s = 0; s < slips; ++s)
        result[s][i] += changes[1 + s];
    }
    return result;
  }

  template <int dim>
  template <class N>
  SPRAG_PART void BatchedStep<dim>::slide_on(const Block &block, const Part part, End<N> &end) const
  {
    auto &friction        = end.friction;
    friction.slip_speed   = slip_rates(block);
    const bool rubs       = data.slide.friction == ContactFriction::sliding;
    const bool is_elastic = data.law.slip.friction.regularisation_speed == 0.;
    if (rubs)
    {
      const SizeAndDirection<Batch, slips> w(friction.slip_speed);
      SimdBatch coefficient{}, slope{};
      for_each_lane(~BatchMask{},
                    [&](const unsigned int i)
                    {
                      const auto found = sliding_friction(data.law.slip.friction, w.size[i]);
                      coefficient[i]   = found.coefficient;
                      slope[i]         = found.derivative;
                      friction.mu[i]   = found.mu;
                    });
      const SimdBatch sign = w.is_nothing ? uniform_batch(std::copysign(1., data.slide.speed)) : uniform_batch(1.);
      friction.slipping    = ~BatchMask{};
      if (part == Part::friction_rate)
      {
        // The slips' derivatives by the coordinates are those of their rates by the coordinates' rates.
        Several<N, slips> rates;
        for (unsigned int s = 0; s < slips; ++s)
          rates[s] = end.slip[s] + friction.slip_speed[s];
        const SizeAndDirection<N, slips> rate(rates);
        const N size = chained(coefficient, slope, rate.size);
        for (unsigned int s = 0; s < slips; ++s)
          friction.traction[s] = value(end.pressure) * (size * rate.direction[s]);
      }
      else
        for (unsigned int s = 0; s < slips; ++s)
          friction.traction[s] = SimdBatch(coefficient * sign * w.direction[s]) * end.pressure;
    }
    else if (data.slide.friction == ContactFriction::stuck)
      for (unsigned int s = 0; s < slips; ++s)
        friction.traction[s] = data.law.slip.stiffness * end.slip[s];
    for (unsigned int s = 0; s < slips && is_elastic; ++s)
      friction.energy += 0.5 / data.law.slip.stiffness * value(friction.traction[s]) * value(friction.traction[s]);
  }

  /// Sets pressure and friction of points that are seen at the end of the step.
  template <int dim>
  template <bool in_time, class N, class Pose>
  SPRAG_PART void BatchedStep<dim>::respond(const Block &block, const Begin &begin, const Pose &pose, const Nodal &nodal,
                                            const Part part, End<N> &end) const
  {
    end.shift                = SimdBatch{};
    end.friction             = {};
    const bool begins_here   = !in_time && data.kind == Kind::slide;
    const SimdBatch right    = begins_here ? SimdBatch(value(N(dot(end.seen.from_centre, pose.axes.right)))) : begin.right;
    const SimdBatch upward   = begins_here ? SimdBatch(value(N(dot(end.seen.from_centre, pose.axes.upward)))) : begin.upward;
    const double surface_run = begins_here ? 0. : data.surface_run;
    end.slip[0]              = slip_round(cylinder.shape, right, upward, end.seen.from_centre, pose.axes) + surface_run;
    if constexpr (slips == 2)
      end.slip[1] = end.seen.along - (begins_here ? SimdBatch(value(end.seen.along)) : begin.along);
    if constexpr (in_time)
    {
      const double delay = data.law.weights.delay();
      end.pressure       = spring_force(data.law.normal, end.seen.gap);
      end.friction       = end_friction(data.law.slip, begin.history, end.slip, end.pressure, data.law.weights.dt);
      end.mean_pressure  = mean_spring_force(data.law.normal, begin.gap, end.seen.gap) +
                          delay * (end.pressure - spring_force(data.law.normal, begin.gap));
      for (unsigned int s = 0; s < slips; ++s)
        end.mean_traction[s] = (0.5 + delay) * end.friction.traction[s] + (0.5 - delay) * begin.history.traction[s];
      return;
    }
    const N pressure  = begin.multiplier - data.law.normal.stiffness * end.seen.gap;
    end.pressure      = select(value(pressure) > 0., pressure, N{});
    end.mean_pressure = end.pressure;
    if (data.kind == Kind::slide)
      slide_on(block, part, end);
    else
    {
      // Derivative of the deformed place along the undeformed face, and of the slip round the cylinder.
      const auto direction = block.direction(nodal);
      N slope              = cylinder.shape.radius / end.seen.radius * dot(in_world(pose, direction), end.seen.round);
      if constexpr (!std::is_same_v<N, Batch>)
        slope.d[std::size(slope.d) - 1] = uniform_batch(1.);
      const N shift    = begin.by_slope * slope + begin.shift;
      end.shift        = value(shift);
      const auto trial = stick_traction(data.law.slip, begin.history.traction, end.slip);
      Several<N, slips> shifts;
      shifts[0] = shift + begin.elastic_shift;
      if (data.law.mode == FrictionMode::stick)
        end.friction.traction = trial;
      else
        end.friction = return_to_cone(data.law.slip, trial, end.pressure, uniform_batch(data.law.weights.dt), shifts, end.slip);
    }
    end.mean_traction = end.friction.traction;
    if (part == Part::pressure)
      end.mean_traction = Several<N, slips>{};
    else if (part != Part::all)
      end.mean_pressure = N{};
  }

  template <int dim>
  void BatchedStep<dim>::evaluate(const Block &block, const Begin &begin, const Nodal &nodal, End<Batch> &end) const
  {
    const auto pose     = to_batch(data.end);
    end.place           = block.place(nodal);
    end.seen            = seen(cylinder.shape, pose, end.place);
    const SimdBatch gap = end.seen.gap;
    if (data.kind == Kind::in_time)
      end.is_active = (gap < 0.) | (begin.gap < 0.) | begin.known;
    else
      end.is_active = data.kind == Kind::touch ? BatchMask{} : begin.multiplier - data.law.normal.stiffness * gap > 0.;
    if (!any(end.is_active))
      return;
    if (data.kind == Kind::in_time)
      respond<true>(block, begin, pose, nodal, Part::all, end);
    else
      respond<false>(block, begin, pose, nodal, Part::all, end);
  }

  template <int dim>
  bool BatchedStep<dim>::press(const unsigned int element, const Nodal &to, Forces &forces, double &penetration)
  {
    constexpr double round_off = 1e-9; // of gaps and travels [mm]
    const bool in_time         = data.kind == Kind::in_time;
    const auto balance         = to_batch(data.balance);
    auto &group                = blocks[element];
    bool is_active             = false;
    Batches<n_coordinates> sums{};
    group.travel.go_to(to, data.end, cylinder.shape);
    End<Batch> end;
    for (unsigned int b = 0; b < group.all.size(); ++b)
    {
      auto &block     = group.all[b];
      auto &begin     = begins[group.first + b];
      block.is_clear  = passes_over(group, b);
      block.is_active = BatchMask{};
      if (block.is_clear)
        continue;
      if (!begin.is_placed)
        place_block(block, group.begin, begin);
      evaluate(block, begin, to, end);
      const SimdBatch gap = end.seen.gap;
      block.clear_until   = group.travel.length() - largest(-gap) - round_off;
      block.is_active     = end.is_active;
      if (!any(block.is_active))
        continue;
      is_active            = true;
      const SimdBatch most = in_time ? -smaller(gap, begin.gap) : end.pressure / data.law.normal.stiffness;
      penetration          = std::max(penetration, largest(most));

      const auto at          = in_time ? begin.place + data.share * (end.place - begin.place) : end.place;
      const auto balanced    = in_time ? seen(cylinder.shape, balance, at) : end.seen;
      const auto force       = point_force(cylinder.shape, balanced, balance.axes.axis, end.mean_pressure, end.mean_traction);
      const SimdBatch weight = block.is_active ? block.weight : SimdBatch{};
      const auto along       = generalised<dim>(balance, at, balanced.from_centre, weight * force);
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int a = 0; a < Elements::max_nodes; ++a)
          sums[Elements::max_nodes * d + a] += along[d] * block.shapes[a];
      for (unsigned int k = 0; k < 2 + data.slopes; ++k)
        sums[n_displacements + k] += along[dim + k];
    }
    for (unsigned int i = 0; is_active && i < n_coordinates; ++i)
      forces[i] += sum(sums[i]);
    return is_active;
  }

  /// Sums over the points of an element: derivatives of its forces by its coordinates.
  template <int dim>
  template <int slopes>
  struct alignas(SimdBatch) BatchedStep<dim>::TangentSums
  {
    static constexpr unsigned int n = n_displacements + 2 + slopes;

    SimdBatch sums[n][n];

    /// Adds forces on the coordinates of points. Where there is a variable beyond these it is the slip's slope along the face,
    /// whose derivatives by the face's direction are `by_direction`.
    template <int variables>
    SPRAG_PART void add(const Block &block, const Several<Dual<Batch, variables>, dim + 4> &force,
                        const Triple<Batch> &by_direction)
    {
      const SimdBatch weight   = block.is_active ? block.weight : SimdBatch{};
      const SimdBatch along[3] = { by_direction.x, by_direction.y, by_direction.z };
      for (unsigned int f = 0; f < dim + 2 + slopes; ++f)
      {
        const auto &by = force[f].d;
        SimdBatch row[n];
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int a = 0; a < Elements::max_nodes; ++a)
          {
            row[Elements::max_nodes * d + a] = block.shapes[a] * by[d];
            if constexpr (variables > dim + 2 + slopes)
              row[Elements::max_nodes * d + a] += block.slopes[a] * (along[d] * by[dim + 2 + slopes]);
          }
        for (unsigned int k = 0; k < 2 + slopes; ++k)
          row[n_displacements + k] = by[dim + k];
        const unsigned int first = f < dim ? Elements::max_nodes * f : n_displacements + f - dim;
        for (unsigned int a = 0; a < (f < dim ? Elements::max_nodes : 1); ++a)
        {
          const SimdBatch share = f < dim ? weight * block.shapes[a] : weight;
          for (unsigned int j = 0; j < n; ++j)
            sums[first + a][j] += share * row[j];
        }
      }
    }
  };

  /// Variables are a point's displacement, theta, x and the slopes and, at the end of a step, the slip's slope along the face.
  template <int dim>
  template <int slopes, bool in_time>
  SPRAG_PART void BatchedStep<dim>::find_element_tangents(const Indices &some, const Part part, const TakeTangent &take) const
  {
    constexpr int n          = dim + 2 + slopes + (in_time ? 0 : 1);
    using N                  = Dual<Batch, n>;
    const auto pose          = to_batch(varied_pose<dim, n, slopes>(cylinder, data.end));
    const auto pose_balanced = to_batch(varied_pose<dim, n, slopes>(cylinder, data.balance, data.share));
    for (unsigned int i = 0; i < some.size(); ++i)
    {
      const auto &group = blocks[some[i]];
      const auto &nodal = group.travel.displacement();
      TangentSums<slopes> sums{};
      for (unsigned int b = 0; b < group.all.size(); ++b)
      {
        const auto &block = group.all[b];
        const auto &begin = begins[group.first + b];
        if (!any(block.is_active))
          continue;
        End<N> end;
        end.place = varied_place<dim, N>(block.place(nodal));
        end.seen  = seen(cylinder.shape, pose, end.place);
        respond<in_time>(block, begin, pose, nodal, part, end);
        Triple<N> at = end.place;
        if constexpr (in_time)
        {
          at       = begin.place + data.share * (end.place - begin.place);
          end.seen = seen(cylinder.shape, pose_balanced, at);
        }
        const auto force = point_force(cylinder.shape, end.seen, pose_balanced.axes.axis, end.mean_pressure, end.mean_traction);
        auto along       = generalised<dim>(pose_balanced, at, end.seen.from_centre, force);
        if (part == Part::friction_rate)
          for (unsigned int k = 0; k < dim + 2 + slopes; ++k)
          {
            N &sum = along[k] = N{};
            for (unsigned int s = 0; s < slips; ++s)
              sum = sum - end.slip[s].d[k] * end.mean_traction[s];
          }
        const Triple<Batch> round{ value(end.seen.round.x), value(end.seen.round.y), value(end.seen.round.z) };
        sums.add(block, along, SimdBatch(cylinder.shape.radius / value(end.seen.radius)) * in_lever(to_batch(data.end), round));
      }
      Tangent result{};
      for (unsigned int k = 0; k < sums.n; ++k)
        for (unsigned int l = 0; l < sums.n; ++l)
          result[k][l] = sum(sums.sums[k][l]);
      take(i, result);
    }
  }

  template <int dim>
  void BatchedStep<dim>::find_tangents(const Indices &some, const Part part, const TakeTangent &take) const
  {
    const bool in_time = data.kind == Kind::in_time;
    if (data.slopes == 0)
      in_time ? find_element_tangents<0, true>(some, part, take) : find_element_tangents<0, false>(some, part, take);
    else if constexpr (dim == 3)
      in_time ? find_element_tangents<2, true>(some, part, take) : find_element_tangents<2, false>(some, part, take);
  }

  template <int dim>
  double BatchedStep<dim>::add_sums(const unsigned int element, ContactSums &sums) const
  {
    // Second derivatives along the way of the step.
    using N           = Dual<Dual<Batch, 1>, 1>;
    using Number      = Dual<Dual<double, 1>, 1>;
    const auto moving = [](auto number, const auto &rate)
    {
      number.v.d[0] = number.d[0].v = rate;
      return number;
    };
    const auto slope = [&](const unsigned int i)
    { return moving(Number{} + (cylinder.slopes[i] + data.balance.turned[i]), data.end.turned[i] - data.begin.turned[i]); };
    const auto pose =
        to_batch(cylinder_pose(moving(Number{} + data.balance.x, data.end.x - data.begin.x),
                               moving(Number{} + data.balance.theta, data.end.theta - data.begin.theta), slope(0), slope(1)));
    double pressure = 0.;
    End<Batch> end;
    for (unsigned int b = 0; b < blocks[element].all.size(); ++b)
    {
      const auto &block = blocks[element].all[b];
      const auto &begin = begins[blocks[element].first + b];
      if (!any(block.is_active))
        continue;
      evaluate(block, begin, blocks[element].travel.displacement(), end);
      const auto &friction   = end.friction;
      const SimdBatch weight = block.is_active ? block.weight : SimdBatch{};
      pressure               = std::max(pressure, largest(block.is_active ? end.pressure : SimdBatch{}));
      sums.stored += sum(weight * (0.5 / data.law.normal.stiffness * end.pressure * end.pressure + friction.energy));
      if (data.kind != Kind::in_time)
        continue;
      const auto moved = end.place - begin.place;
      const auto at    = begin.place + data.share * moved;
      const auto place = seen(cylinder.shape, pose,
                              Triple<N>{ moving(N{} + at.x, moved.x), moving(N{} + at.y, moved.y), moving(N{} + at.z, moved.z) });
      const N right = dot(place.from_centre, pose.axes.right), upward = dot(place.from_centre, pose.axes.upward);
      const N slip  = slip_round(cylinder.shape, value(right), value(upward), place.from_centre, pose.axes);
      const auto &t = friction.traction, &t_begin = begin.history.traction;
      SimdBatch work = end.mean_traction[0] * slip.d[0].d[0] -
                       (end.pressure - spring_force(data.law.normal, begin.gap)) * (end.seen.gap - begin.gap) -
                       end.mean_pressure * place.gap.d[0].d[0];
      if constexpr (slips == 2)
        work += end.mean_traction[1] * place.along.d[0].d[0];
      for (unsigned int s = 0; s < slips; ++s)
        work += (t[s] - t_begin[s]) * end.slip[s];
      const auto balanced = seen(cylinder.shape, to_batch(data.balance), at);
      const auto force =
          point_force(cylinder.shape, balanced, to_batch(data.balance).axes.axis, end.mean_pressure, end.mean_traction);
      sums.work.friction += sum(weight * friction.dissipated);
      sums.work.algorithmic += data.law.weights.delay() * sum(weight * work);
      sums.work.drive += sum(weight * (data.surface_run * end.mean_traction[0] + data.advance * force.x));
      sums.work.creep = std::max(sums.work.creep, largest(block.is_active ? friction.creep : SimdBatch{}));
    }
    return pressure;
  }

  template <int dim>
  void BatchedStep<dim>::add_points(const unsigned int element, const bool all, std::vector<FacePointState<dim>> &points) const
  {
    const auto pose = to_batch(data.end);
    const Begin nowhere{};
    End<Batch> end{};
    for (unsigned int b = 0; b < blocks[element].all.size(); ++b)
    {
      const auto &block = blocks[element].all[b];
      if (!all && !any(block.is_active))
        continue;
      const auto &begin = block.is_clear ? nowhere : begins[blocks[element].first + b];
      evaluate(block, begin, blocks[element].travel.displacement(), end);
      const auto force = point_force(cylinder.shape, end.seen, pose.axes.axis, end.pressure, end.friction.traction);
      const auto along = generalised<dim>(pose, end.place, end.seen.from_centre, force);
      for (unsigned int i = 0; i < block.n; ++i)
      {
        auto &state   = points.emplace_back();
        state.element = element;
        set_point(block, begin, end, i, state);
        for (unsigned int k = 0; k < dim + 2 && state.pressure > 0.; ++k)
          state.end_force[k] = along[k][i];
      }
    }
  }

  template <int dim>
  void BatchedStep<dim>::set_point(const Block &block, const Begin &begin, const End<Batch> &end, const unsigned int i,
                                   FacePointState<dim> &state) const
  {
    state.index        = block.first + i;
    const double at[3] = { end.place.x[i], end.place.y[i], end.place.z[i] };
    for (unsigned int d = 0; d < dim; ++d)
      state.position[d] = at[d];
    state.gap            = end.seen.gap[i];
    state.trial_pressure = begin.multiplier[i] - data.law.normal.stiffness * state.gap;
    if (!block.is_active[i])
      return;
    const auto &friction = end.friction;
    state.pressure       = end.pressure[i];
    state.mu             = friction.mu[i];
    state.slipping       = friction.slipping[i] != 0;
    Slip begin_traction;
    for (unsigned int d = 0; d < slips; ++d)
    {
      state.traction[d]           = friction.traction[d][i];
      state.history.slip_speed[d] = friction.slip_speed[d][i];
      state.slip_change[d]        = data.kind == Kind::slide ? friction.slip_speed[d][i] : end.slip[d][i];
      if (data.terms.augmented)
        begin_traction[d] = begin.history.traction[d][i];
    }
    state.history.traction = state.traction;
    state.history.mu       = data.kind == Kind::in_time && state.slipping ? state.mu : 0.;
    state.history.point    = state.index;
    state.history.step     = data.kind == Kind::in_time ? data.law.weights.dt : 0.;
    state.elastic_slip     = (state.traction - begin_traction).norm() / data.law.slip.stiffness;
    if (data.kind == Kind::at_end)
    {
      state.slip_change[0] += end.shift[i];
      state.slip_change *= data.terms.speed_ratio;
    }
  }

  template class BatchedStep<2>;
  template class BatchedStep<3>;
} // namespace sprag
