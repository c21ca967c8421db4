// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/statics/quasi_static.h"

#include "analytic/closed_form.h"
#include "base/errors.h"
#include "base/text.h"
#include "model/step/state_archive.h"
#include "results/result_file.h"
#include "results/row_statistics.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

namespace sprag
{
  namespace
  {
    constexpr double round_off           = 5e-15; ///< of positions, over the size of the scene
    constexpr double growth              = 1.5;
    constexpr double cut                 = 0.25;
    constexpr double stalled_penetration = 100.; ///< accepted after all augmentations, over the tolerance
    constexpr double slow                = 1e-6; ///< least speed of the approach to Start, over the peak speed

    /// Equilibria that only give multipliers leave out more than left_out_in_statics: 1e-6 of the penetration.
    constexpr double left_out_before_augmentation = 10.;

    // The passage through stick after a reversal is about (|F+| + |F-|) / k_t long; its steps are these shares of it, times
    // stick_step_share().
    constexpr double first_share   = 0.02;
    constexpr double largest_share = 0.125;
    constexpr double passages      = 3.; ///< lengths of passage with short steps

    constexpr unsigned int stick_solutions = 4;    ///< Newton corrections for an equilibrium in stick
    constexpr double displacement_share    = 1e-2; ///< dx of the difference quotient in stick, over the penetration

    /// Returns whether an initial state is an equilibrium up to round-off.
    bool is_balanced(Model &model, const State &state)
    {
      Step step        = model.begin_step(state, state.drive);
      const auto found = model.evaluate(step, FrictionMode::cone);
      return model.movement(model.correction(found)) <= round_off * model.length_scale();
    }

    /// Effort of a step, and why it failed.
    struct StepCost
    {
      unsigned int iterations    = 0;
      unsigned int augmentations = 0;
      std::string failure; ///< of the last attempt
      std::string remedy;
      double shortest = 0.; ///< step after which the last attempt's failure ends the run [mm]
    };

    /// Newton from the predictor; if it fails, once more from the stick predictor.
    std::optional<NewtonSolution<Evaluation>> equilibrate(Model &model, Step &step, const bool stick_first, const double left_out,
                                                          StepCost &cost)
    {
      const State guess = step.trial;
      for (const bool predict_stick : { stick_first, !stick_first })
      {
        step.trial  = guess;
        auto result = solve_equilibrium(model, step, predict_stick, left_out);
        cost.iterations += result.iterations;
        if (result.converged)
          return result;
      }
      return {};
    }

    /// Solves the equilibrium of a step and augments it until no penetration exceeds the tolerance. The equilibria before the
    /// last one only give multipliers, and are found less exactly.
    std::optional<Evaluation> balance(Model &model, Step &step, const bool stick_first, const ContactSettings &settings,
                                      StepCost &cost)
    {
      const bool augments = settings.enforcement == Enforcement::augmented_lagrangian;
      const double loose  = augments ? left_out_before_augmentation : left_out_in_statics;
      cost.failure        = "Newton's method does not converge";
      cost.remedy = "Try a smaller friction coefficient or offset; if it is not the mechanics, a smaller Contact/Penalty or a "
                    "finer Mesh/Face size.";
      auto solved = equilibrate(model, step, stick_first, loose, cost);
      if (!augments || !solved)
        return solved ? std::optional(std::move(solved->found)) : std::nullopt;
      cost.failure = "augmentation does not converge to Contact/Penetration tolerance = " + mm(settings.penetration_tolerance) +
                     " in " + std::to_string(settings.maximum_augmentations) + " augmentations";
      cost.remedy = "Try a larger Contact/Penalty, Contact/Penetration tolerance or Contact/Maximum augmentations.";
      while (solved && model.penetration(solved->found) > settings.penetration_tolerance)
      {
        // The penetration stalls if the contact's edge alternates between two nodes; a small one is accepted and reported.
        if (++cost.augmentations > settings.maximum_augmentations)
        {
          if (model.penetration(solved->found) > stalled_penetration * settings.penetration_tolerance)
            return {};
          break;
        }
        model.augment(solved->found, step.trial);
        solved = equilibrate(model, step, false, loose, cost);
      }
      if (solved && solved->remaining > left_out_in_statics)
        solved = equilibrate(model, step, false, left_out_in_statics, cost);
      return solved ? std::optional(std::move(solved->found)) : std::nullopt;
    }

    /// Returns the equilibrium at the end of a step; none if there is none, with the reason in `cost`.
    std::optional<Equilibrium> solve_step(Model &model, const State &accepted, const DrivePoint &drive,
                                          const QuasiStaticSettings &settings, const bool stick_first, StepCost &cost)
    {
      Step step = model.begin_step(accepted, drive);
      std::optional<Evaluation> found;
      try
      {
        cost.shortest = settings.minimum_step;
        found         = balance(model, step, stick_first, settings.contact, cost);
        if (!found)
          return {};
      }
      catch (const AnalysisError &error)
      {
        cost.failure = error.what(); // an element turned inside out or a singular tangent: a shorter step may avoid it
        return {};
      }
      // An equilibrium beyond the model's validity is no matter of convergence.
      cost.shortest = std::max(settings.minimum_step, 1e-2 * settings.step);
      cost.failure  = model.check_validity(step.trial, *found);
      cost.remedy   = "Try a smaller friction coefficient, Geometry/Interface offset or Drive/Stroke.";
      if (!cost.failure.empty())
        return {};
      model.store_history(*found, step.trial);
      return Equilibrium{ std::move(step.trial), std::move(*found) };
    }

    /// Adds the works of a step by the trapezoidal rule. Friction power jumps at a reversal, after which its end value is used.
    void add_work(const Row &before, const bool reversed, Row &row)
    {
      const double dt             = row[Column::time] - before[Column::time];
      const double dx             = row[Column::x] - before[Column::x];
      const double power_at_start = reversed ? row[Column::friction_power] : before[Column::friction_power];
      row[Column::friction_work]  = before[Column::friction_work] + 0.5 * dt * (power_at_start + row[Column::friction_power]);
      row[Column::drive_work]     = before[Column::drive_work] + 0.5 * dx * (before.drive_force() + row.drive_force());
      row[Column::step]           = dx;
    }

    [[noreturn]] void give_up(const Row &last, const double dx, const StepCost &cost)
    {
      throw AnalysisError("no equilibrium beyond x = " + mm(last[Column::x]) + " (v = " + rounded_text(last[Column::v]) +
                          " mm/s, P = " + rounded_text(last[Column::P]) + " N): " + cost.failure + " even in a step of " +
                          mm(dx) + ". " + cost.remedy);
    }

    /// Returns whether the drive starts backward: the state at Start was reached by sliding forward.
    bool begins_backward(const DrivePoint &point)
    {
      return point.time == 0. && point.x > 0. && drive_direction(point.v) < 0;
    }

    /// Part of the path after a reversal on which the contact changes from sliding in one direction to the other [mm].
    struct Passage
    {
      double begin  = 0.;
      double length = 0.;
    };

    /// Estimates the length by 2 |F|/k_t: the friction force F after the passage is taken as that before it.
    Passage passage_after(const Row &row, const double stick_stiffness)
    {
      if (!(stick_stiffness > 0.))
        return {};
      return { row[Column::x], 2. * std::abs(row.friction_force()) / stick_stiffness };
    }

    /// An accepted step.
    struct Progression
    {
      State state;
      Row row;
      Evaluation found{};
    };

    /// Makes one step of at most dx and reduces dx until there is an equilibrium.
    Progression advance(Model &model, const Drive &drive, const QuasiStaticSettings &settings, const Progression &from,
                        const bool reversed, double &dx)
    {
      StepCost cost;
      const bool sticking = reversed || sticks(from.row); // a lever that jams sticks long behind a reversal
      const double time   = from.state.drive.time;
      const auto attempt  = [&]
      { return solve_step(model, from.state, drive.step(time, dx, largest_speed_change), settings, sticking, cost); };
      auto next = attempt();
      while (!next)
      {
        if (dx * cut < cost.shortest)
          give_up(from.row, dx, cost);
        dx *= cut;
        next = attempt();
      }
      auto &[state, found] = *next;
      Row row              = observed(model, state, found);
      add_work(from.row, reversed, row);
      row[Column::iterations]    = cost.iterations;
      row[Column::augmentations] = cost.augmentations;
      return { std::move(state), row, std::move(found) };
    }

    /// Returns settled() and, if the cylinder already opens the lever, its evaluation.
    std::pair<State, std::optional<Evaluation>> settle(Model &model, const DrivePoint &start, const QuasiStaticSettings &settings)
    {
      State state = model.initial_state(start);
      StepCost cost;
      if (!is_balanced(model, state))
        if (auto settled = solve_step(model, state, state.drive, settings, false, cost)) // if not, the first step reports why
          return { std::move(settled->state), std::move(settled->found) };
      return { std::move(state), std::nullopt };
    }

    /// Returns the state at the start of the drive and the length of the first step [mm]. A start at x > 0 is reached by sliding
    /// from x = 0 at the drive's initial speed.
    std::pair<Progression, double> begin(Model &model, const Drive &drive, const QuasiStaticSettings &settings)
    {
      const DrivePoint start = drive.at(0., Drive::Side::after);
      auto [state, pressed]  = settle(model, { 0., 0., drive.peak_speed() }, settings);
      Progression now{ std::move(state), {} };
      if (start.x > 0.)
      {
        const double speed = std::max(std::abs(start.v), slow * drive.peak_speed());
        const Drive approach(DriveProfile::triangle, 0., start.x, speed, 0.5);
        double dx = settings.step;
        for (now.state.drive = approach.at(0.); now.state.drive.time < approach.duration();
             dx              = std::min(settings.step, growth * dx))
          now = advance(model, approach, settings, now, false, dx);
      }
      else if (pressed)
        now.found = std::move(*pressed);
      else
      {
        Step step = model.begin_step(now.state, now.state.drive);
        now.found = model.evaluate(step, FrictionMode::stick);
        now.state = std::move(step.trial);
      }
      now.state.drive = start;
      now.row         = observed(model, now.state, now.found);
      const bool rubs = pressed && start.x == 0.; // friction then builds up within the first step
      return { std::move(now), rubs ? std::max(first_share * settings.step, settings.minimum_step) : settings.step };
    }

    /// State from which an interrupted run resumes, beside the history in the model.
    struct SolverState
    {
      Progression now;
      double dx = 0.; ///< of the next step [mm]
      Passage passage;
      double reported_stiffness = 0.; ///< see run_quasi_static()
    };

    void serialise(Archive &archive, SolverState &solver)
    {
      auto &[now, dx, passage, reported_stiffness] = solver;
      auto &[state, row, found]                    = now;
      archive(state, row, dx, passage, reported_stiffness);
    }

    /// Solves a step with every point in contact stuck at its place in the accepted state.
    Evaluation balance_in_stick(Model &model, Step &step)
    {
      auto found = model.evaluate(step, FrictionMode::stick);
      for (unsigned int i = 0; i < stick_solutions && found.penetration > 0.; ++i)
      {
        step.trial.coordinates += model.correction(found);
        found = model.evaluate(step, FrictionMode::stick);
      }
      return found;
    }

    void take_step(Model &model, const Drive &drive, const QuasiStaticSettings &settings, SolverState &solver)
    {
      auto &[now, dx, passage, reported_stiffness] = solver;
      const bool reversed                          = drive.turns_at(now.state.drive.time) || begins_backward(now.state.drive);
      const double shortened                       = stick_step_share(settings.step);
      if (reversed)
      {
        const double stiffness = stick_stiffness(model, now.state);
        passage                = passage_after(now.row, stiffness);
        dx                     = std::clamp(shortened * first_share * passage.length, settings.minimum_step, settings.step);
        if (reported_stiffness == 0.)
          reported_stiffness = stiffness;
      }
      if (std::abs(now.row[Column::x] - passage.begin) < passages * passage.length)
        dx = std::clamp(shortened * largest_share * passage.length, settings.minimum_step, dx);
      now = advance(model, drive, settings, now, reversed, dx);
      dx  = std::min(settings.step, (1. + (growth - 1.) * std::sqrt(shortened)) * dx); // P is largest behind the passage
    }
  } // namespace

  Row observed(const Model &model, const State &state, const Evaluation &found)
  {
    Row row(state.drive);
    row[Column::friction_work] = 0.;
    row[Column::drive_work]    = 0.;
    model.observe(state, found, row);
    return row;
  }

  std::optional<Equilibrium> solve_step(Model &model, const State &accepted, const DrivePoint &end,
                                        const QuasiStaticSettings &settings)
  {
    StepCost cost;
    return solve_step(model, accepted, end, settings, false, cost);
  }

  State settled(Model &model, const DrivePoint &start, const QuasiStaticSettings &settings)
  {
    return settle(model, start, settings).first;
  }

  NewtonSolution<Evaluation> solve_equilibrium(Model &model, Step &step, const bool stick_first, const double left_out)
  {
    if (stick_first)
    {
      const auto found = model.evaluate(step, FrictionMode::stick);
      step.trial.coordinates += model.correction(found);
    }
    return solve_by_newton(
        step.trial.coordinates, round_off * model.length_scale(),
        [&](const dealii::Vector<double> & /*coordinates of the trial state*/)
        { return model.evaluate(step, FrictionMode::cone); },
        [&](const Evaluation &found) { return model.correction(found); },
        [&](const dealii::Vector<double> &change) { return model.movement(change); }, left_out);
  }

  double stick_stiffness(Model &model, const State &accepted)
  {
    // With multipliers of the augmented Lagrangian the accepted state is no equilibrium in stick: balance it first.
    Step step         = model.begin_step(accepted, accepted.drive);
    const auto before = balance_in_stick(model, step);
    if (before.penetration == 0.)
      return 0.;
    const auto friction = [&](const Evaluation &found)
    {
      Row row;
      model.observe(step.trial, found, row);
      return row.friction_force();
    };
    const double at_first = friction(before), dx = displacement_share * before.penetration;
    step.trial.drive.x += dx;
    return (friction(balance_in_stick(model, step)) - at_first) / dx;
  }

  double run_quasi_static(Model &model, const Drive &drive, const QuasiStaticSettings &settings, const StepSink &sink,
                          ProgressKeeper *const keeper)
  {
    SolverState solver;
    const auto progress = [&](Archive &archive)
    {
      serialise(archive, solver);
      model.serialise_history(archive);
    };
    const auto hand_on = [&]
    {
      sink(solver.now.state, solver.now.row, solver.now.found);
      if (keeper != nullptr)
        keeper->accept_step(progress);
    };
    if (keeper == nullptr || !keeper->take_up(progress))
    {
      std::tie(solver.now, solver.dx) = begin(model, drive, settings);
      hand_on();
    }
    while (solver.now.state.drive.time < drive.duration())
    {
      take_step(model, drive, settings, solver);
      hand_on();
    }
    if (keeper != nullptr)
      keeper->end_steps(progress);
    return solver.reported_stiffness;
  }
} // namespace sprag
