// SPDX-License-Identifier: GPL-3.0-only
#include "base/progress.h"
#include "base/text.h"
#include "laws/friction.h"
#include "program/result_writer.h"
#include "report/report.h"
#include "report/transient_report.h"
#include "report/warnings.h"
#include "run/analyses.h"
#include "run/briefs.h"
#include "run/in_memory.h"
#include "run/sprag_slip_report.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <cmath>
#include <deque>
#include <functional>
#include <iostream>

namespace sprag
{
  namespace
  {

    constexpr double most_growth_rows    = 20000.; ///< written of the growth
    constexpr unsigned int approach_rows = 16;     ///< a period, from the growth to the vibration it leads to
    constexpr double shown_periods       = 50.;    ///< of that vibration

    /// Writes some of the rows as they come and keeps the last ones.
    struct Rows
    {
      ResultWriter &writer;
      const HeldSlide &slide;
      unsigned long every = 1, count = 0;
      std::size_t kept     = 0;
      std::deque<Row> last = {};
      Row largest          = {}; ///< the one with the largest P

      /// From now on every n-th row is written; the last `number` are kept.
      void begin(const unsigned long every_nth, const std::size_t number)
      {
        every = every_nth;
        kept  = number;
        count = 0;
        last.clear();
      }

      void operator()(Row row)
      {
        row[Column::P_quasi_static] = slide.forces.P;
        row[Column::Q_quasi_static] = slide.forces.Q;
        if (!(row[Column::P] <= largest[Column::P]))
          largest = row;
        if (kept > 0)
          last.push_back(row);
        if (last.size() > kept)
        {
          if (count++ % every == 0)
            writer.append(last.front());
          last.pop_front();
        }
        else if (kept == 0 && count++ % every == 0)
          writer.append(row);
      }

      /// Writes the rows kept and returns the first one's time, NaN if there are none [s].
      double write_last()
      {
        const double begin = last.empty() ? std::nan("") : last.front()[Column::time];
        for (const auto &row : last)
          writer.append(row);
        last.clear();
        return begin;
      }
    };

    void require_slide(const SpragSlip &found, const double x)
    {
      if (found.slide.kind == SlideKind::jammed)
        throw AnalysisError("no slide in contact that could be perturbed at x = " + mm(x) +
                            ". Try another Stability/Position or a smaller friction coefficient.");
    }

    /// Whether friction at this speed is the same in the eigenvalue and in time, see FrictionDelay.
    bool linearised_exactly(const FrictionLaw &law, const double speed)
    {
      return law.regularisation_speed > 0. || friction_coefficient(law, std::abs(speed)).derivative >= 0.;
    }

    /// Growth, vibration and continuation, one after the other; what is finished stands in `found` whatever happens.
    struct Study
    {
      const Scene &scene;
      DynamicModel &model;
      ResultWriter &writer;
      Progress &progress;
      SpragSlip &found;
      Warnings &warnings;
      const SpragSlipSettings &settings = scene.sprag_slip;
      Rows rows                         = { writer, *found.slide.slide };
      const double dt                   = step_of(watched_mode(found.slide), settings);
      HeldRun run                       = HeldRun(model, dt);
      double done                       = 0.;

      void carry_out()
      {
        try
        {
          measure();
          follow();
          if (settings.continuation > 0)
            continue_along();
        }
        catch (...)
        {
          sum_up();
          throw;
        }
        sum_up();
      }

      void measure()
      {
        const double rate     = std::abs(watched_mode(found.slide).mode.eigenvalue.real());
        const double duration = std::log(settings.final / settings.initial) / rate;
        const double n_rows   = std::min(duration, settings.longest_growth) / dt;
        rows.begin(1 + static_cast<unsigned long>(n_rows / most_growth_rows), 0);
        found.growth = measure_growth(model, found.slide, settings, run, std::ref(rows));
        report();
      }

      /// What a stable slide makes of a large kick, and an unstable one of itself.
      void follow()
      {
        const auto &slide = *found.slide.slide;
        run.use_spectral_radius(scene.time.spectral_radius);
        if (found.slide.kind == SlideKind::stable)
          run.begin(model.perturbed(slide, watched_mode(found.slide), Continuation::large_kick * slide.overlap));
        rows.begin(std::max(1u, settings.steps_per_period / approach_rows),
                   static_cast<std::size_t>(shown_periods * settings.steps_per_period));
        found.settled       = settle(run, slide, { period(), settings.settling, longest() }, std::ref(rows));
        found.settled_begin = rows.write_last();
        report();
      }

      void continue_along()
      {
        Continuation continuation(model, run, held_drive(scene), period(), scene.stability.modes, settings);
        const double turn = settings.turn.value_or(scene.drive.minimum());
        const auto note   = [&]
        {
          found.points = continuation.points();
          report();
        };
        continuation.go(found.slide, *found.settled, turn, note);
        found.points      = continuation.points();
        found.coexistence = continuation.coexistence();
      }

      double period() const
      {
        return dt * settings.steps_per_period;
      }

      double longest() const
      {
        return std::max(settings.settling, settings.longest_growth);
      }

      void report()
      {
        progress.update(++done, { run.drive().x });
      }

      void sum_up()
      {
        found.ledger = run.ledger();
        found.steps  = run.steps();
        append(warnings, row_warnings(scene, { rows.largest }));
      }
    };

    /// Growth, vibration, and every x of the continuation there and back.
    double parts_of(const SpragSlipSettings &settings)
    {
      const unsigned int n = settings.continuation;
      return n == 0 ? 2. : 2. + 2. * (n + Continuation::bisections) + 1.;
    }
  } // namespace

  void run_sprag_slip(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    require_folder(options);
    const auto shared   = dynamics_maker(options);
    auto &maker         = *shared;
    const Scene held    = held_scene(scene);
    const auto dynamics = maker.make(held);
    ResultWriter writer(scene, options, maker.timer(),
                        table_columns(scene.plate, scene.pair, scene.analysis.dimension, scene.cylinder));
    Progress progress(std::cerr, progress_style(options.quiet), parts_of(scene.sprag_slip));
    SpragSlip found;
    finish_in_any_case(
        [&]
        {
          const PhaseTimer::Scope scope(maker.timer(), "steps_and_output");
          const auto drive = held_drive(scene);
          found.slide      = judge(dynamics.model(), drive, scene.stability.modes);
          require_slide(found, drive.x);
          found.exact = linearised_exactly(held.friction, found.slide.slide->speed);
          Study{ scene, dynamics.model(), writer, progress, found, warnings }.carry_out();
          check_ledger(scene, found.ledger);
        },
        [&](const std::string &status)
        {
          progress.finish();
          const auto end =
              writer.finish(status, { sprag_slip_summary(found), {}, sprag_slip_groups(found, scene.sprag_slip) }, warnings);
          if (options.verbose)
            print_summary(std::cout, end.summary);
          else if (!options.quiet)
            print_brief_of_sprag_slip(std::cout, end.summary);
        });
  }
} // namespace sprag
