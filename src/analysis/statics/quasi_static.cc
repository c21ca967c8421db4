#include "analysis/statics/quasi_static.h"

#include "base/errors.h"
#include "base/text.h"
#include "model/state_archive.h"
#include "results/row_archive.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

namespace sprag
{
  namespace
  {
    constexpr double round_off            = 5e-15; ///< of positions, over the size of the scene
    constexpr double growth               = 1.5;
    constexpr double cut                  = 0.25;
    constexpr double stalled_overlap      = 100.; ///< admitted after all augmentations, over the tolerance
    constexpr double largest_speed_change = 0.02; ///< in a step, over the drive's peak speed
    constexpr double slow                 = 1e-6; ///< as rest, over the drive's peak speed

    // The passage through stick after a reversal is about (|F+| + |F-|) / k_t long; its steps are these shares of it.
    constexpr double first_share   = 0.02;
    constexpr double largest_share = 0.125;
    constexpr double passages      = 3.; ///< after so many the contact slides fully, whichever way it slid more

    constexpr unsigned int stick_solutions = 4;    ///< linear ones that balance a state in stick
    constexpr double probe_share           = 1e-2; ///< of the overlap, by which the stiffness in stick is probed

    struct StepCost
    {
      unsigned int iterations    = 0;
      unsigned int augmentations = 0;
      std::string failure; ///< of the last attempt
      std::string remedy;
    };

    /// Newton from the predictor; if it fails, once more from the stick predictor.
    bool equilibrate(Model &model, State &trial, const bool stick_first, StepCost &cost)
    {
      const State guess = trial;
      for (const bool predict_stick : { stick_first, !stick_first })
      {
        trial             = guess;
        const auto result = solve_equilibrium(model, trial, predict_stick);
        cost.iterations += result.iterations;
        if (result.converged)
          return true;
      }
      return false;
    }

    /// Augments until no point overlaps by more than the tolerance.
    bool augment(Model &model, State &trial, const ContactSettings &settings, StepCost &cost)
    {
      while (model.penetration() > settings.penetration_tolerance)
      {
        // Where the edge of the contact flips between two nodes the overlap stalls; it is small then, and reported.
        if (++cost.augmentations > settings.maximum_augmentations)
          return model.penetration() <= stalled_overlap * settings.penetration_tolerance;
        model.augment(trial);
        if (!equilibrate(model, trial, false, cost))
          return false;
      }
      return true;
    }

    /// The state at the end of a step, or none where no equilibrium was found.
    std::optional<State> solve_step(Model &model, const State &accepted, const DrivePoint &drive,
                                    const QuasiStaticSettings &settings, const bool stick_first, StepCost &cost)
    {
      State trial = model.begin_step(accepted, drive);
      try
      {
        cost.failure = "Newton's method does not converge";
        cost.remedy  = "Try a smaller friction coefficient or offset; if it is not the mechanics, a smaller Contact/Penalty or a "
                       "finer Mesh/Face size.";
        if (!equilibrate(model, trial, stick_first, cost))
          return {};
        cost.failure =
            "augmentation does not converge to Contact/Penetration tolerance = " + mm(settings.contact.penetration_tolerance) +
            " in " + std::to_string(settings.contact.maximum_augmentations) + " augmentations";
        cost.remedy = "Try a larger Contact/Penalty, Contact/Penetration tolerance or Contact/Maximum augmentations.";
        if (settings.contact.enforcement == Enforcement::augmented_lagrangian && !augment(model, trial, settings.contact, cost))
          return {};
      }
      catch (const AnalysisError &error)
      {
        cost.failure = error.what(); // an element turned inside out or a singular tangent: a shorter step may avoid it
        return {};
      }
      cost.failure = model.objection(trial);
      cost.remedy  = "Try a smaller friction coefficient, Geometry/Interface offset or Drive/Stroke.";
      if (!cost.failure.empty())
        return {};
      return trial;
    }

    /// Trapezoidal rule, but across a reversal the friction power jumps and its value at the end of the step stands for it.
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

    /// A drive that goes back at once from where the cylinder was slid forward.
    bool begins_backward(const DrivePoint &point)
    {
      return point.time == 0. && point.x > 0. && direction_of(point.v) < 0;
    }

    /// Where the contact goes from sliding one way to sliding the other [mm].
    struct Passage
    {
      double begin  = 0.;
      double length = 0.;
    };

    /// The friction force on the far side is not known beforehand; that of the near side stands for it.
    Passage passage_after(const Row &row, const double stick_stiffness)
    {
      if (!(stick_stiffness > 0.))
        return {};
      return { row[Column::x], 2. * std::abs(row.friction_force()) / stick_stiffness };
    }

    struct Progression
    {
      State state;
      Row row;
    };

    /// A step of at most dx that also resolves how the speed changes, on which mu depends: the slip speed of a step is its mean.
    DrivePoint end_of_step(const Drive &drive, const double time, double dx)
    {
      const double v = drive.at(time, Drive::Side::after).v;
      auto point     = drive.step(time, dx);
      while (std::abs(point.v - v) > largest_speed_change * drive.peak_speed())
      {
        dx *= 0.5;
        point = drive.step(time, dx);
      }
      return point;
    }

    /// One accepted step of at most dx, which is cut back where no equilibrium is found.
    Progression advance(Model &model, const Drive &drive, const QuasiStaticSettings &settings, const Progression &from,
                        const bool reversed, const bool sticking, double &dx)
    {
      StepCost cost;
      const double time = from.state.drive.time;
      auto next         = solve_step(model, from.state, end_of_step(drive, time, dx), settings, sticking, cost);
      while (!next)
      {
        if (dx * cut < settings.minimum_step)
          give_up(from.row, dx, cost);
        dx *= cut;
        next = solve_step(model, from.state, end_of_step(drive, time, dx), settings, sticking, cost);
      }
      model.remember(*next);
      Row row = observed(model, *next);
      add_work(from.row, reversed, row);
      row[Column::iterations]    = cost.iterations;
      row[Column::augmentations] = cost.augmentations;
      return { std::move(*next), row };
    }

    /// A lever that the cylinder opens at x = 0 already, off the middle of a pair, is put on it without friction. Whether there
    /// is one.
    bool settle(Model &model, State &state, const QuasiStaticSettings &settings)
    {
      if (is_balanced(model, state))
        return false;
      StepCost cost;
      auto settled = solve_step(model, state, state.drive, settings, false, cost);
      if (!settled)
        return false; // the first step tells why
      model.remember(*settled);
      state = std::move(*settled);
      return true;
    }

    /// The state in which the drive begins and the first step [mm]: just touching at x = 0, further on as reached by sliding
    /// there from x = 0 at the drive's own speed.
    std::pair<Progression, double> begin(Model &model, const Drive &drive, const QuasiStaticSettings &settings)
    {
      const DrivePoint start = drive.at(0., Drive::Side::after);
      Progression now{ model.initial_state({ 0., 0., drive.peak_speed() }), {} };
      const bool pressed = settle(model, now.state, settings);
      if (start.x > 0.)
      {
        const double speed = std::max(std::abs(start.v), slow * drive.peak_speed());
        const Drive approach(DriveProfile::triangle, 0., start.x, speed, 0.5);
        double dx = settings.step;
        for (now.state.drive = approach.at(0.); now.state.drive.time < approach.duration();
             dx              = std::min(settings.step, growth * dx))
          now = advance(model, approach, settings, now, false, false, dx);
      }
      else if (!pressed)
      {
        now.state = model.begin_step(now.state, now.state.drive);
        model.evaluate(now.state, FrictionMode::stick);
      }
      now.state.drive = start;
      now.row         = observed(model, now.state);
      const bool rubs = pressed && start.x == 0.; // friction then builds up within the first step
      return { std::move(now), rubs ? std::max(first_share * settings.step, settings.minimum_step) : settings.step };
    }

    /// A run on its way, all that it goes on from beside what the model keeps.
    struct Course
    {
      Progression now;
      double dx = 0.; ///< of the next step [mm]
      Passage passage;
      double reported_stiffness = 0.; ///< see run_quasi_static()
    };

    void visit(Archive &archive, Course &course)
    {
      auto &[now, dx, passage, reported_stiffness] = course;
      auto &[state, row]                           = now;
      archive(state, row, dx, passage, reported_stiffness);
    }

    /// The overlap once every point in contact sticks to where it was in the accepted state [mm].
    double balance_in_stick(Model &model, State &trial)
    {
      double overlap = model.evaluate(trial, FrictionMode::stick).overlap;
      for (unsigned int i = 0; i < stick_solutions && overlap > 0.; ++i)
      {
        trial.coordinates += model.correction();
        overlap = model.evaluate(trial, FrictionMode::stick).overlap;
      }
      return overlap;
    }
  } // namespace

  Row observed(const Model &model, const State &state)
  {
    Row row;
    row[Column::time]          = state.drive.time;
    row[Column::x]             = state.drive.x;
    row[Column::v]             = state.drive.v;
    row[Column::friction_work] = 0.;
    row[Column::drive_work]    = 0.;
    model.observe(state, row);
    return row;
  }

  std::optional<State> solve_step(Model &model, const State &accepted, const DrivePoint &end, const QuasiStaticSettings &settings)
  {
    StepCost cost;
    return solve_step(model, accepted, end, settings, false, cost);
  }

  State settled(Model &model, const DrivePoint &start, const QuasiStaticSettings &settings)
  {
    State state = model.initial_state(start);
    settle(model, state, settings);
    return state;
  }

  NewtonResult solve_equilibrium(Model &model, State &trial, const bool stick_first)
  {
    if (stick_first)
    {
      model.evaluate(trial, FrictionMode::stick);
      trial.coordinates += model.correction();
    }
    double overlap      = 0.;
    const auto evaluate = [&](const dealii::Vector<double> & /*coordinates of trial*/)
    {
      const auto unbalance = model.evaluate(trial, FrictionMode::cone);
      overlap              = unbalance.overlap;
      return unbalance.norm;
    };
    return solve_by_newton(
        trial.coordinates, round_off * model.length_scale(), evaluate, [&] { return model.correction(); },
        [&](const dealii::Vector<double> &change) { return model.movement(change); }, [&] { return overlap; });
  }

  bool is_balanced(Model &model, const State &state)
  {
    State trial = model.begin_step(state, state.drive);
    model.evaluate(trial, FrictionMode::cone);
    return model.movement(model.correction()) <= round_off * model.length_scale();
  }

  double stick_stiffness(Model &model, const State &accepted)
  {
    // The accepted state itself is not balanced in stick where the multipliers of the augmented Lagrangian are carried over.
    State trial          = model.begin_step(accepted, accepted.drive);
    const double overlap = balance_in_stick(model, trial);
    if (overlap == 0.)
      return 0.;
    Row before, after;
    model.observe(trial, before);
    const double probe = probe_share * overlap;
    trial.drive.x += probe;
    balance_in_stick(model, trial);
    model.observe(trial, after);
    return (after.friction_force() - before.friction_force()) / probe;
  }

  namespace
  {
    void take_step(Model &model, const Drive &drive, const QuasiStaticSettings &settings, Course &course)
    {
      auto &[now, dx, passage, reported_stiffness] = course;
      const bool reversed                          = drive.turns_at(now.state.drive.time) || begins_backward(now.state.drive);
      if (reversed)
      {
        const double stiffness = stick_stiffness(model, now.state);
        passage                = passage_after(now.row, stiffness);
        dx                     = std::clamp(first_share * passage.length, settings.minimum_step, settings.step);
        if (reported_stiffness == 0.)
          reported_stiffness = stiffness;
      }
      const bool sticking = std::abs(now.row[Column::x] - passage.begin) < passages * passage.length;
      if (sticking)
        dx = std::clamp(largest_share * passage.length, settings.minimum_step, dx);
      now = advance(model, drive, settings, now, reversed, sticking, dx);
      dx  = std::min(settings.step, growth * dx);
    }
  } // namespace

  double run_quasi_static(Model &model, const Drive &drive, const QuasiStaticSettings &settings, const StepSink &sink,
                          ProgressKeeper *const keeper)
  {
    Course course;
    const auto progress = [&](Archive &archive)
    {
      visit(archive, course);
      model.visit_history(archive);
    };
    const auto hand_on = [&]
    {
      sink(course.now.state, course.now.row);
      if (keeper != nullptr)
        keeper->accept_step(progress);
    };
    if (keeper == nullptr || !keeper->take_up(progress))
    {
      std::tie(course.now, course.dx) = begin(model, drive, settings);
      hand_on();
    }
    while (course.now.state.drive.time < drive.duration())
    {
      take_step(model, drive, settings, course);
      hand_on();
    }
    if (keeper != nullptr)
      keeper->end_steps(progress);
    return course.reported_stiffness;
  }
} // namespace sprag
