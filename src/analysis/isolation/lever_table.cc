// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/isolation/lever_table.h"

#include "analytic/isolation.h"
#include "base/errors.h"
#include "base/text.h"
#include "model/step/state_archive.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr unsigned int most_iterations = 25;
    constexpr unsigned int most_halvings   = 12; ///< of Time/Step
    constexpr double steps_per_period      = 200.;
    constexpr double longest_step_ratio    = 20.; ///< the longest step over Time/Step
    constexpr double error_aimed_at        = 0.4;
    constexpr double largest_growth        = 2.;   ///< of a step over the last
    constexpr double travel_share          = 0.1;  ///< accuracy of the table's travel, of the error that a step may have
    constexpr double balanced              = 1e-8; ///< least tolerance of the residual, over the sum of the forces

    /// Behind its rest no lever follows the cylinder so far, over the cylinder's radius: there its place does not matter.
    constexpr double separated = -5. / 28.;

    constexpr double same_place = 1e-7; ///< of the cylinder for a lever that touches nothing [mm]

    double rounded(const double duration)
    {
      int exponent          = 0;
      const double mantissa = std::frexp(duration, &exponent);
      return std::ldexp(std::round(std::ldexp(mantissa, 28)), exponent - 28);
    }
  } // namespace

  void serialise(Archive &archive, LeverTable &table)
  {
    archive(table.now, table.peak_acceleration, table.peak_displacement, table.peak_base, table.energy_at_start, table.solver);
    for (auto &[model, sign, motion, forces, stored] : table.sides)
    {
      archive(motion, forces, stored);
      model.serialise_history(archive);
    }
  }

  LeverTable::LeverTable(const Scene &scene_, DynamicModel &outward, DynamicModel &inward, const TransientSettings &settings_)
      : scene(scene_)
      , m(scene.isolation.mass)
      , K(scene.isolation.stiffness)
      , levers(scene.isolation.levers)
      , settings(settings_)
      , base_excitation(base_motion(scene.isolation))
      , largest_z(scene.drive.maximum())
      , longest_step(adapts()
                         ? std::min(longest_step_ratio * settings.time.step,
                                    std::min(2. * M_PI * std::sqrt(m / K), base_excitation.shortest_period) / steps_per_period)
                         : settings.time.step)
      , travel_tolerance(travel_share * settings.force_scale / settings.contact_stiffness * settings.local_tolerance())
      , sides{ { { outward, 1, {}, {}, {} }, { inward, -1, {}, {}, {} } } }
  {
    if (scene.analysis.model == ModelType::finite_element || scene.analysis.dimension == 3)
      solver.grid.use_halves_alone();
    solver.requested_step = settings.time.step;
    solver.tangent        = settings.contact_stiffness;
    now.z                 = scene.isolation.initial_displacement;
    now.rate              = scene.isolation.initial_velocity;
    for (auto &side : sides)
    {
      const auto at = drive_point(side, 0., now.z, now.rate);
      side.motion   = side.model.initial_motion({ 0., std::max(0., at.x), 0., 0. });
      side.stored   = side.model.stored_energy(side.motion);
      solver.force += side_force(side, side.motion);
      side.motion.drive = at;
      side.forces.begin(side.motion.forces);
    }
    solver.step_force = solver.previous_step_force = solver.force;
    begin();
  }

  /// The force at the end of a motion, the outcome of the model's last step [N].
  double LeverTable::side_force(const Side &side, const Motion &motion) const
  {
    if (motion.contact.empty())
      return 0.;
    return side.sign * levers * side.model.drive_force(motion);
  }

  bool LeverTable::is_free(const Side &side, const StepOutcome &outcome)
  {
    return side.motion.contact.empty() && outcome.motion->contact.empty() && outcome.work.drive == 0.;
  }

  BasePoint LeverTable::base() const
  {
    return base_excitation.at(now.time, solver.piece);
  }

  std::size_t LeverTable::piece_before(const double time) const
  {
    const auto &kinks = base_excitation.kinks;
    std::size_t found = solver.piece;
    while (found < kinks.size() && kinks[found] < time)
      ++found;
    return found;
  }

  BasePoint LeverTable::base_at(const double time) const
  {
    return base_excitation.at(time, piece_before(time));
  }

  DrivePoint LeverTable::drive_point(const Side &side, const double time, const double z, const double rate) const
  {
    const double x = side.sign * z, last = separated * scene.geometry.cylinder_radius;
    return x < last ? DrivePoint{ time, last, 0., 0. } : DrivePoint{ time, x, side.sign * rate, 0. };
  }

  /// Steps both levers to the table's place z + table_travel. A lever out of contact keeps its result of the trial before if
  /// both trials end at the same place.
  std::optional<LeverTable::Trial> LeverTable::tried(const double h, const double table_travel, std::optional<Trial> before)
  {
    auto weights        = generalised_alpha(settings.time.spectral_radius, h);
    weights.wants_error = adapts();
    const double z = now.z + table_travel, rate = 2. * (table_travel - solver.travel_defect) / h - now.rate;
    Trial trial{ z, rate, 0., 0., {} };
    for (unsigned int i = 0; i < sides.size(); ++i)
    {
      auto &side    = sides[i];
      const auto to = drive_point(side, now.time + h, z, rate);
      auto &outcome = trial.levers[i];
      if (before && is_free(side, before->levers[i]) && std::abs(before->z - z) < same_place)
      {
        outcome               = std::move(before->levers[i]);
        outcome.motion->drive = to;
        continue;
      }
      if (before)
        side.motion.forces = before->levers[i].motion->forces;
      else
        side.motion.forces = side.forces.guess(h);
      outcome             = side.model.step(side.motion, to, weights);
      const double travel = to.x - side.motion.drive.x;
      if (!outcome.motion)
        return {};
      trial.force += travel != 0. ? side.sign * levers * outcome.work.drive / travel : side_force(side, *outcome.motion);
    }
    const double base_change = base_at(now.time + h).v - base().v;
    trial.residual           = m * (rate - now.rate + base_change) / h + 0.5 * K * (z + now.z) + trial.force;
    return trial;
  }

  /// Extrapolates the force of the last two steps and returns the travel that it leads to [mm].
  double LeverTable::predicted_travel(const double h) const
  {
    const double share      = solver.last_step > 0. ? (h + solver.last_step) / (solver.last_step + solver.step_before) : 0.;
    const double mean_force = solver.step_force + share * (solver.step_force - solver.previous_step_force);
    const double change     = base_at(now.time + h).v - base().v;
    return (m * (2. * (now.rate + solver.travel_defect / h) - change) / h - K * now.z - mean_force) /
           (2. * m / (h * h) + 0.5 * K);
  }

  /// Applies Newton's method to the table's travel; the levers' tangent comes from the last two tried.
  std::optional<LeverTable::Trial> LeverTable::solved(const double h)
  {
    const double inertia = 2. * m / (h * h);
    double travel        = predicted_travel(h);
    double last_travel = 0., last = 0.;
    std::optional<Trial> trial;
    for (unsigned int i = 0; i < most_iterations; ++i)
    {
      ++solver.iterations;
      trial = tried(h, travel, std::move(trial));
      if (!trial)
        return {};
      const double scale = std::abs(K * trial->z) + std::abs(trial->force) + std::abs(m * base().a) + settings.force_scale;
      if (std::abs(trial->residual) <= std::max(balanced * scale, travel_tolerance * inertia))
        return trial;
      if (i > 0 && travel != last_travel)
        solver.tangent = (trial->residual - last) / (travel - last_travel) - inertia - 0.5 * K;
      last        = trial->residual;
      last_travel = travel;
      travel -= trial->residual / std::max(inertia + 0.5 * K + solver.tangent, 0.5 * inertia);
    }
    return {};
  }

  /// Largest error of the levers in contact, over the tolerance of a step. Levers that swing free of the cylinder do not move
  /// the table.
  double LeverTable::trial_error(const Trial &trial) const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < sides.size(); ++i)
      if (!is_free(sides[i], trial.levers[i]))
        largest = std::max(largest, trial.levers[i].error);
    return largest * settings.contact_stiffness / settings.force_scale / settings.local_tolerance();
  }

  TableEvent LeverTable::advance(const double until)
  {
    const auto &kinks = base_excitation.kinks;
    while (solver.piece < kinks.size() && kinks[solver.piece] <= now.time)
      ++solver.piece;
    const auto &jumps = base_excitation.jumps;
    const auto jump   = std::upper_bound(jumps.begin(), jumps.end(), now.time);
    const double end  = jump != jumps.end() ? std::min(until, *jump) : until;
    // Instants that differ by round-off are one.
    if (end - now.time < 1e-9 * settings.time.step)
    {
      now.time = end;
      return TableEvent::none;
    }
    if (solver.grid.needs_span(end))
      solver.grid.begin(now.time, end, longest_step);
    solver.grid.choose(solver.requested_step);
    return take_step();
  }

  TableEvent LeverTable::take_step()
  {
    const double shortest = std::ldexp(settings.time.step, 1 - static_cast<int>(most_halvings));
    for (;;)
    {
      const double h = solver.grid.duration();
      std::optional<Trial> trial;
      std::string failure = "no balance of table and levers is found";
      try
      {
        trial = solved(h);
      }
      catch (const AnalysisError &error)
      {
        failure = error.what();
      }
      const double error = trial && adapts() ? trial_error(*trial) : 0.;
      const bool is_last = std::min(h, solver.requested_step) < shortest;
      if (trial && (error <= 1. || is_last))
      {
        const TableState before = now;
        accept(h, *trial);
        now.time = solver.grid.step_end();
        solver.grid.advance();
        adapt(h, error);
        if (before.rate * now.rate < 0.)
          return TableEvent::turn;
        return before.z * now.z < 0. ? TableEvent::centre : TableEvent::none;
      }
      if (is_last)
        throw AnalysisError("no step beyond t = " + rounded_text(now.time) + " s (z = " + mm(now.z) + "): " + failure +
                            ". Try a larger Time/Tolerance or a smaller Contact/Stiffness");
      solver.grid.shorten();
      solver.requested_step = solver.grid.duration();
      solver.last_error     = 1.;
    }
  }

  /// Errors go with the third power of the step; the larger of the last two counts, as they vary with the elements that pass. A
  /// step that was wanted longer than there was room for may be as long again.
  void LeverTable::adapt(const double h, const double error)
  {
    const double longest = std::max(solver.requested_step, largest_growth * h);
    if (adapts())
      solver.requested_step = std::min(longest, h * std::cbrt(error_aimed_at / std::max({ error, solver.last_error, 1e-9 })));
    else
      solver.requested_step = std::min(longest, settings.time.step);
    solver.last_error = error;
  }

  void LeverTable::accept(const double h, Trial &trial)
  {
    const auto base_before = base();
    const double a_before = acceleration(), t = now.time;
    accept_levers(trial, h);
    // The travel is accurate to a tolerance. The rate follows from the forces, and the next step adds the missing travel.
    const double mean_force    = 0.5 * K * (trial.z + now.z) + trial.force;
    const double rate          = now.rate - (base_at(t + h).v - base_before.v) - mean_force * h / m;
    solver.travel_defect       = 0.5 * h * (rate - trial.rate);
    solver.previous_step_force = solver.step_force;
    solver.step_force          = trial.force;
    solver.step_before         = solver.steps > 0 ? solver.last_step : h;
    solver.last_step           = h;
    solver.piece               = piece_before(t + h);
    now.z                      = trial.z;
    now.rate                   = rate;
    now.time                   = t + h;
    ++solver.steps;
    const auto base_behind = base();
    now.base_work -= mean_force * h * 0.5 * (base_before.v + base_behind.v);
    add_integrals(h, { a_before, base_before.a }, { acceleration(), base_behind.a });
    if (std::abs(now.z) > largest_z)
      throw AnalysisError(stroke_exceeded());
  }

  void LeverTable::accept_levers(Trial &trial, const double h)
  {
    solver.force = 0.;
    for (unsigned int i = 0; i < sides.size(); ++i)
    {
      auto &side       = sides[i];
      const auto &work = trial.levers[i].work;
      now.dissipated += levers * (work.friction + work.damping + work.algorithmic);
      side.motion = std::move(*trial.levers[i].motion);
      side.forces.accept(side.motion.forces, h);
      side.stored = side.model.stored_energy(side.motion);
      solver.force += side_force(side, side.motion);
    }
  }

  void LeverTable::add_integrals(const double h, const Accelerations &before, const Accelerations &behind)
  {
    const double w = 2. * M_PI * base_excitation.frequency, from = w * (now.time - h), to = w * now.time;
    const auto add = [h](double &sum, const double first, const double last) { sum += 0.5 * h * (first + last); };
    add(now.square, before.table * before.table, behind.table * behind.table);
    add(now.cosine, before.table * std::cos(from), behind.table * std::cos(to));
    add(now.sine, before.table * std::sin(from), behind.table * std::sin(to));
    add(now.base_square, before.base * before.base, behind.base * behind.base);
    peak_acceleration = std::max(peak_acceleration, std::abs(behind.table));
    peak_displacement = std::max(peak_displacement, std::abs(now.z));
    peak_base         = std::max(peak_base, std::abs(behind.base));
  }

  /// Returns a message with the travel of the table on levers of the closed form, which is cheap to compute.
  std::string LeverTable::stroke_exceeded() const
  {
    IsolationFindings by_closed_form;
    try
    {
      run_isolation(scene, by_closed_form, {});
    }
    catch (const AnalysisError &)
    {
      // The run stops at the end of a lever's stroke and fills in the findings until then.
    }
    const double needed = std::ceil(1.1 * std::max(std::abs(now.z), by_closed_form.largest_displacement));
    return "At t = " + rounded_text(now.time) + " s, z = " + mm(now.z) + ": the levers are made for a stroke of " +
           mm(largest_z) + ", the Drive/Stroke; on levers of the closed form the table goes to " +
           mm(by_closed_form.largest_displacement) + ". Try Drive/Stroke = " + rounded_text(needed) +
           ", a smaller initial displacement, a smaller motion of the base or more damping";
  }

  double LeverTable::damper_energy() const
  {
    return levers * (sides[0].stored.total() + sides[1].stored.total());
  }

  double LeverTable::energy() const
  {
    const double speed = now.rate + base().v;
    return 0.5 * m * speed * speed + 0.5 * K * now.z * now.z + damper_energy();
  }

  unsigned long StepGrid::next_parts(const unsigned long present) const
  {
    if (present == 1 || by_halves)
      return 2 * present;
    const bool is_power_of_two = (present & (present - 1)) == 0;
    return is_power_of_two ? present / 2 * 3 : present / 3 * 4;
  }

  void StepGrid::begin(const double from, const double to, const double longest)
  {
    origin = from;
    end    = to;
    units  = static_cast<unsigned long>(std::fmax(1., std::ceil((to - from) / longest - 1e-6)));
    unit = passed = 0;
    parts         = 1;
  }

  void StepGrid::choose(const double target)
  {
    const double least   = length() / target * (1. - 1e-6);
    unsigned long chosen = 1;
    while (static_cast<double>(chosen) < least || passed * chosen % parts != 0)
      chosen = next_parts(chosen);
    passed = passed * chosen / parts;
    parts  = chosen;
  }

  void StepGrid::shorten()
  {
    choose(0.7 * length() / static_cast<double>(parts));
  }

  double StepGrid::duration() const
  {
    return rounded(length() / static_cast<double>(parts));
  }

  double StepGrid::step_end() const
  {
    if (passed + 1 == parts && unit + 1 == units)
      return end;
    return origin + length() * (static_cast<double>(unit) + static_cast<double>(passed + 1) / static_cast<double>(parts));
  }

  void StepGrid::advance()
  {
    if (++passed < parts)
      return;
    passed = 0;
    ++unit;
  }
} // namespace sprag
