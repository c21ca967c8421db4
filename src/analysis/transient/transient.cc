// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/transient/transient.h"

#include "analytic/step_clock.h"
#include "base/errors.h"
#include "base/text.h"
#include "levers/dynamics.h"
#include "model/step/force_history.h"
#include "model/step/generalised_alpha.h"
#include "model/step/state_archive.h"
#include "model/structure/eigenvalues.h"
#include "scene/contact_estimates.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace sprag
{
  namespace
  {
    constexpr unsigned int largest_halvings = 12;       ///< of Time/Step
    constexpr double small_error            = 1. / 24.; ///< of the tolerance: doubling the step makes it eight times as large
    constexpr unsigned int small_errors     = 8;        ///< in a row before the step is doubled

    [[noreturn]] void give_up(const DrivePoint &at, const double dt, const std::string &failure)
    {
      throw AnalysisError("no step beyond t = " + rounded_text(at.time) + " s (x = " + mm(at.x) + ", v = " + rounded_text(at.v) +
                          " mm/s): " + failure + " even in a step of " + rounded_text(dt) +
                          " s. Try a larger Time/Tolerance, a smaller Contact/Stiffness or Contact/Penalty, or a smaller "
                          "Time/Spectral radius.");
    }

    Row observe(const DynamicModel &model, const Motion &motion, const EnergyLedger &ledger)
    {
      Row row(motion.drive);
      model.observe(motion, row);
      ledger.fill(row);
      return row;
    }

    /// Steady sliding without inertia along the drive, computed where x or v has changed enough and joined by lines; a jump where
    /// it turns.
    struct QuasiStaticCurve
    {
      static constexpr double speed_change = 0.05; ///< between samples, over the drive's peak speed

      DynamicModel &model;
      const Drive &drive;
      const double spacing; ///< of x [mm]

      struct Sample
      {
        double time;
        std::array<SlidingForces, 2> forces; ///< of each lever; NaN without an equilibrium
      };
      std::vector<Sample> samples = {};

      // Both evaluate the model.

      void begin()
      {
        samples = { sample(drive.at(0., Drive::Side::after)) };
      }

      /// To be called before the step to that time.
      void extend(const double time)
      {
        while (samples.back().time < time)
        {
          const double end  = drive.step(samples.back().time, spacing, speed_change).time;
          const auto before = drive.at(end, Drive::Side::before);
          const auto after  = drive.at(end, Drive::Side::after);
          samples.push_back(sample(before));
          if (drive_direction(after.v) != drive_direction(before.v))
            samples.push_back(sample(after));
        }
      }

      void fill(Row &row) const
      {
        const double time           = row[Column::time];
        const auto after            = std::lower_bound(samples.begin(), samples.end(), time,
                                                       [](const Sample &sample, const double value) { return sample.time < value; });
        const auto &end             = *after;
        const auto &begin           = after == samples.begin() ? end : *(after - 1);
        const double share          = end.time > begin.time ? (time - begin.time) / (end.time - begin.time) : 0.;
        const auto between          = [=](const double from, const double to) { return from + share * (to - from); };
        row[Column::P_quasi_static] = between(begin.forces[0].P, end.forces[0].P);
        row[Column::Q_quasi_static] = between(begin.forces[0].Q, end.forces[0].Q);
        if (row.second_lever().empty())
          return;
        row.set_second_value(Column::P_quasi_static, between(begin.forces[1].P, end.forces[1].P));
        row.set_second_value(Column::Q_quasi_static, between(begin.forces[1].Q, end.forces[1].Q));
      }

      Sample sample(const DrivePoint &point) const
      {
        constexpr SlidingForces none{ unknown, unknown };
        Sample result{ point.time, { { none, none } } };
        const auto forces = model.sliding_forces(point);
        std::copy(forces.begin(), forces.end(), result.forces.begin());
        return result;
      }
    };

    /// Decides on steps by their local error.
    struct StepControl
    {
      const TransientSettings &settings;
      double error       = 0.;
      unsigned int small = 0; ///< errors in a row

      bool accepts(const StepOutcome &outcome, const bool shortest)
      {
        if (!outcome.motion)
          return false;
        if (settings.time.tolerance == 0.)
          return true;
        error = outcome.error * settings.contact_stiffness / (settings.force_scale * settings.local_tolerance());
        small = error < small_error ? small + 1 : 0;
        return error <= 1. || shortest;
      }

      bool wants_longer() const
      {
        return settings.time.tolerance > 0. && small >= small_errors;
      }
    };

    StepClock make_clock(const Drive &drive, const TransientSettings &settings)
    {
      if (settings.time.tolerance == 0.)
        return StepClock(drive, settings.time.step, 0);
      const double first     = std::min(settings.time.step, settings.longest_step);
      unsigned int doublings = 0;
      while (doublings < largest_doublings && std::ldexp(first, static_cast<int>(doublings) + 1) <= settings.longest_step)
        ++doublings;
      return StepClock(drive, first, doublings);
    }

    struct Attempt
    {
      StepOutcome outcome;
      unsigned int rejected   = 0;
      unsigned int iterations = 0;
      double dt               = 0.;
    };

    /// An accepted step; on the way the clock's step is halved as often as needed. Sets the forces in the accepted motion from
    /// which the step is sought.
    Attempt advance(DynamicModel &model, const Drive &drive, Motion &accepted, const ForceHistory &forces,
                    const TransientSettings &settings, StepControl &control, StepClock &clock)
    {
      const double least  = std::ldexp(settings.time.step, -static_cast<int>(largest_halvings));
      std::string failure = "Newton's method does not converge";
      for (Attempt attempt;; ++attempt.rejected)
      {
        const bool shortest = clock.duration() < 2. * least;
        attempt.dt          = clock.duration();
        try
        {
          const auto to       = drive.at(clock.step_end());
          auto weights        = generalised_alpha(settings.time.spectral_radius, attempt.dt);
          weights.wants_error = settings.time.tolerance > 0.;
          accepted.forces     = forces.guess(attempt.dt);
          attempt.outcome     = model.step(accepted, to, weights);
        }
        catch (const AnalysisError &error)
        {
          failure         = error.what();
          attempt.outcome = {};
        }
        attempt.iterations += attempt.outcome.iterations;
        if (control.accepts(attempt.outcome, shortest))
          return attempt;
        if (shortest)
          give_up(accepted.drive, attempt.dt, failure);
        clock.halve();
      }
    }

    /// The state from which a run resumes, beside the history of the model.
    struct SolverState
    {
      Motion motion;
      ForceHistory forces;
      EnergyLedger ledger;
      StepControl control;
      StepClock clock;
      QuasiStaticCurve quasi_static;
      TransientReport report;
    };

    void serialise(Archive &archive, SolverState &solver)
    {
      auto &[motion, forces, ledger, control, clock, quasi_static, report] = solver;
      archive(motion, forces, ledger, control.error, control.small, clock, quasi_static.samples, report.steps, report.ledger);
    }

    Row begin(DynamicModel &model, const Drive &drive, SolverState &solver)
    {
      solver.quasi_static.begin();
      solver.motion = model.initial_motion(drive.at(0., Drive::Side::after));
      solver.forces.begin(solver.motion.forces);
      solver.ledger = EnergyLedger(model.stored_energy(solver.motion));
      Row row       = observe(model, solver.motion, solver.ledger);
      solver.quasi_static.fill(row);
      return row;
    }

    /// Takes a step and returns its row.
    Row take_step(DynamicModel &model, const Drive &drive, const TransientSettings &settings, SolverState &solver)
    {
      auto &[motion, forces, ledger, control, clock, quasi_static, report] = solver;
      quasi_static.extend(clock.step_end());
      auto attempt    = advance(model, drive, motion, forces, settings, control, clock);
      const double dx = attempt.outcome.motion->drive.x - motion.drive.x;
      motion          = std::move(*attempt.outcome.motion);
      forces.accept(motion.forces, attempt.dt);
      ledger.add(motion.drive.time, model.stored_energy(motion), attempt.outcome.work);
      Row row                     = observe(model, motion, ledger);
      row[Column::step]           = dx;
      row[Column::time_step]      = attempt.dt;
      row[Column::iterations]     = attempt.iterations;
      row[Column::rejected_steps] = attempt.rejected;
      quasi_static.fill(row);

      ++report.steps;
      report.ledger = ledger.report();
      clock.advance();
      const bool recovers = settings.time.tolerance == 0. && attempt.rejected == 0;
      if ((control.wants_longer() || recovers) && clock.grow())
        control.small = 0;
      return row;
    }

    const double least_growth           = std::log(1000.); ///< of the logarithm of an amplitude within a stroke
    constexpr double tolerated_damping  = 0.1;             ///< over the growth
    constexpr double largest_angle      = 1.;              ///< of a step [rad]
    constexpr unsigned int even_samples = 4;               ///< of a cycle
    constexpr double beyond_reversal    = 0.75;            ///< of its duration, from the turning point

    double first_cycle_end(const Drive &drive)
    {
      return drive.reversals().size() > 1 ? drive.reversals()[1] : drive.duration();
    }

    /// Evenly over the first cycle and on both sides of its reversal.
    std::vector<double> sample_times(const Drive &drive)
    {
      const double end = first_cycle_end(drive);
      std::vector<double> times;
      for (unsigned int i = 0; i < even_samples; ++i)
        times.push_back((i + 0.5) / even_samples * end);
      if (!drive.reversals().empty())
      {
        const double aside = std::max(beyond_reversal * drive.reversal_duration(), 1e-3 * end);
        for (const double time : { drive.reversals().front() - aside, drive.reversals().front() + aside })
          if (time > 0. && time < end)
            times.push_back(time);
      }
      return times;
    }

    std::optional<GrowingMode> fastest_growing(DynamicModel &model, const DrivePoint &drive)
    {
      try
      {
        const auto slide = model.hold(drive, ContactFriction::sliding);
        if (!slide || !(slide->uniqueness > 0.) || !slide->is_pressed())
          return {};
        std::optional<GrowingMode> fastest;
        for (const auto lambda : model.eigenvalues(*slide, 1))
          if (lambda.imag() > 0. && lambda.real() > 0. && (!fastest || lambda.real() > fastest->growth_rate))
            fastest = GrowingMode{ drive.x, drive.v, lambda.real(), lambda.imag() / (2. * M_PI) };
        return fastest;
      }
      catch (const AnalysisError &)
      {
        return {};
      }
    }

    /// One step of generalised-alpha for q'' = -q, in (q, dt q', dt^2 q'').
    dealii::FullMatrix<double> amplification(const StepWeights &w, const double angle)
    {
      const double square             = angle * angle;
      const double share              = 1. / (1. - w.alpha_m + (1. - w.alpha_f) * w.beta * square);
      const double acceleration_row[] = { -square * share, -(1. - w.alpha_f) * square * share,
                                          -(w.alpha_m + (1. - w.alpha_f) * square * (0.5 - w.beta)) * share };
      const double drift[2][3]        = { { 1., 1., 0.5 - w.beta }, { 0., 1., 1. - w.gamma } };
      const double weight[]           = { w.beta, w.gamma };
      dealii::FullMatrix<double> matrix(3, 3);
      for (unsigned int j = 0; j < 3; ++j)
      {
        for (unsigned int i = 0; i < 2; ++i)
          matrix(i, j) = drift[i][j] + weight[i] * acceleration_row[j];
        matrix(2, j) = acceleration_row[j];
      }
      return matrix;
    }

    /// The eigenvalue of such a step that turns, with the positive imaginary part: of its three roots two are the vibration's.
    std::complex<double> step_root(const double spectral_radius, const double angle)
    {
      std::complex<double> result = 0.;
      for (const auto &root : eigenpairs(amplification(generalised_alpha(spectral_radius, 1.), angle)))
        if (root.value.imag() > 0. && std::abs(root.value) > std::abs(result))
          result = root.value;
      return result;
    }

    double longest_step(const GrowingMode &mode, const double spectral_radius)
    {
      const double omega = 2. * M_PI * mode.frequency;
      const double limit = tolerated_damping * mode.growth_rate / omega;
      double shortest = 0., longest = largest_angle;
      if (algorithmic_damping(spectral_radius, longest) <= limit)
        return longest / omega;
      for (unsigned int i = 0; i < 40; ++i)
      {
        const double middle                                                          = 0.5 * (shortest + longest);
        (algorithmic_damping(spectral_radius, middle) <= limit ? shortest : longest) = middle;
      }
      return longest / omega;
    }
  } // namespace

  TransientReport run_transient(DynamicModel &model, const Drive &drive, const TransientSettings &settings,
                                const MotionSink &sink, ProgressKeeper *const keeper)
  {
    SolverState solver{
      {}, {}, EnergyLedger(), { settings }, make_clock(drive, settings), { model, drive, settings.quasi_static_spacing }, {}
    };
    const auto progress = [&](Archive &archive)
    {
      serialise(archive, solver);
      model.serialise_history(archive);
    };
    const auto hand_on = [&](const Row &row)
    {
      sink(solver.motion, row);
      if (keeper != nullptr)
        keeper->accept_step(progress);
    };
    if (keeper == nullptr || !keeper->take_up(progress))
      hand_on(begin(model, drive, solver));
    while (!solver.clock.finished())
      hand_on(take_step(model, drive, settings, solver));
    if (keeper != nullptr)
      keeper->end_steps(progress);
    return solver.report;
  }

  std::vector<Row> beam_run(Scene scene)
  {
    if (is_meshed(scene.analysis.model))
      scene.analysis.model = ModelType::beam;
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(scene);
    std::vector<Row> rows;
    run_transient(dynamics.model(), scene.drive, transient_settings(scene),
                  [&](const Motion &, const Row &row) { rows.push_back(row); });
    return rows;
  }

  TransientSettings transient_settings(const Scene &scene, const std::vector<GrowingMode> &growing)
  {
    const auto reference = contact_reference(scene);
    return { scene.time, reference.P, reference.stiffness, scene.geometry.cylinder_radius / 200.,
             longest_step(growing, scene.time.spectral_radius) };
  }

  std::vector<GrowingMode> growing_modes(DynamicModel &model, const Drive &drive)
  {
    const double stroke = first_cycle_end(drive) / (drive.reversals().empty() ? 1. : 2.);
    std::vector<GrowingMode> result;
    for (const double time : sample_times(drive))
    {
      const auto point = drive.at(time, Drive::Side::after);
      if (point.v == 0.)
        continue;
      if (const auto mode = fastest_growing(model, point); mode && mode->growth_rate * stroke > least_growth)
        result.push_back(*mode);
    }
    return result;
  }

  double algorithmic_damping(const double spectral_radius, const double angle)
  {
    const double size = std::abs(step_root(spectral_radius, angle));
    return size > 0. ? std::max(0., -std::log(size) / angle) : std::numeric_limits<double>::infinity();
  }

  double algorithmic_frequency_error(const double spectral_radius, const double angle)
  {
    return angle > 0. ? 1. - std::arg(step_root(spectral_radius, angle)) / angle : 0.;
  }

  double longest_step(const std::vector<GrowingMode> &modes, const double spectral_radius)
  {
    double result = std::numeric_limits<double>::infinity();
    for (const auto &mode : modes)
      result = std::min(result, longest_step(mode, spectral_radius));
    return result;
  }

  Warnings hidden_vibration_warnings(const std::vector<GrowingMode> &modes, const TimeSettings &time)
  {
    if (modes.empty() || time.tolerance > 0. || time.step <= longest_step(modes, time.spectral_radius))
      return {};
    const auto worst   = std::min_element(modes.begin(), modes.end(),
                                          [&](const GrowingMode &a, const GrowingMode &b) {
                                          return longest_step(a, time.spectral_radius) < longest_step(b, time.spectral_radius);
                                        });
    const double limit = longest_step(*worst, time.spectral_radius);
    return { make_warning("hidden_vibration", { mm(worst->x), rounded_text(worst->frequency), rounded_text(worst->growth_rate),
                                                rounded_text(time.step), rounded_text(limit),
                                                rounded_text(largest_angle / (2. * M_PI * time.step)), rounded_text(limit) }) };
  }
} // namespace sprag
