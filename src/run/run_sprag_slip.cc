// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/limit_cycle/limit_cycle.h"
#include "base/progress.h"
#include "base/ranges.h"
#include "base/text.h"
#include "base/unknown.h"
#include "program/result_writer.h"
#include "report/report.h"
#include "report/warnings.h"
#include "results/page_tables.h"
#include "results/result_file.h"
#include "run/in_memory.h"
#include "run/run.h"
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
    /// Results of a sprag-slip analysis; a part is empty while the run has not come to it.
    struct SpragSlip
    {
      SlideStability slide;
      std::optional<Growth> growth;
      std::optional<Settled> settled;
      std::vector<ErrorEstimate> errors;     ///< of that
      double settled_begin = 0.;             ///< of the rows written of the vibration [s]
      std::vector<ContinuationPoint> points; ///< of the continuation
      std::optional<Coexistence> coexistence;
      LedgerReport ledger;
      unsigned long steps = 0;
    };

    void add_branch(const std::vector<ContinuationPoint> &points, const std::string &direction,
                    const Settled ContinuationPoint::*branch, std::vector<Dataset> &datasets)
    {
      const auto add = [&](const std::string &name, const std::function<double(const Settled &)> &value)
      {
        datasets.push_back(make_dataset(points, page_column("continuation", name + '_' + direction),
                                        [&](const ContinuationPoint &point)
                                        { return point.holds() ? value(point.*branch) : unknown; }));
      };
      add("kind", [](const Settled &settled) { return static_cast<double>(settled.kind); });
      add("amplitude_P", [](const Settled &settled) { return settled.window.amplitude_P; });
      add("amplitude_indentation", [](const Settled &settled) { return settled.window.amplitude_indentation; });
      add("open_share", [](const Settled &settled) { return settled.window.open_share; });
      add("stick_share", [](const Settled &settled) { return settled.window.stick_share; });
      add("frequency", [](const Settled &settled) { return settled.window.frequency; });
    }

    Group continuation_group(const std::vector<ContinuationPoint> &points)
    {
      Group group{ "continuation", {} };
      const auto add = [&](const std::string &name, const auto &value)
      { group.datasets.push_back(make_dataset(points, page_column("continuation", name), value)); };
      add("x", [](const ContinuationPoint &point) { return point.x; });
      add("stable", [](const ContinuationPoint &point) { return point.slide.kind == SlideKind::stable ? 1. : 0.; });
      add("growth_rate", [](const ContinuationPoint &point) { return point.slide.growth_rate(); });
      add("mode_frequency", [](const ContinuationPoint &point) { return point.slide.frequency(); });
      add("P", [](const ContinuationPoint &point) { return point.holds() ? point.slide.slide->forces.P : unknown; });
      add("indentation", [](const ContinuationPoint &point) { return point.holds() ? point.slide.slide->indentation : unknown; });
      add_branch(points, "away", &ContinuationPoint::away, group.datasets);
      add_branch(points, "back", &ContinuationPoint::back, group.datasets);
      return group;
    }

    Group growth_group(const Growth &growth, const double at_start)
    {
      const auto column = [&](const ColumnInfo &info, const auto &value) { return make_dataset(growth.sizes, info, value); };
      return { "growth",
               { column({ "time", "s", "from the perturbation on" }, [](const Sample &sample) { return sample.time; }),
                 column({ "amplitude", "1", "of the overlap over its mean, from the envelope of P" },
                        [](const Sample &sample) { return sample.value; }),
                 column({ "predicted", "1", "the same by the eigenvalue" },
                        [&](const Sample &sample) { return at_start * std::exp(growth.eigenvalue.real() * sample.time); }) } };
    }

    std::vector<Entry> sprag_slip_summary(const SpragSlip &found)
    {
      std::vector<Entry> entries = { { "slide", kind_name(found.slide.kind) } };
      if (const auto &slide = found.slide.slide)
        append<Entry>(entries, { { "x", slide->drive.x },
                                 { "P", slide->forces.P },
                                 { "indentation", slide->indentation },
                                 { "slip_speed", slide->speed } });
      if (const auto &growth = found.growth)
        append<Entry>(entries, { { "linear_growth_rate", growth->eigenvalue.real() },
                                 { "measured_growth_rate", growth->envelope.rate },
                                 { "growth_difference", growth->growth_difference() },
                                 { "linear_frequency", growth->predicted_frequency() },
                                 { "measured_frequency", growth->frequency },
                                 { "frequency_difference", growth->frequency_difference() },
                                 { "growth_scatter", growth->envelope.scatter },
                                 { "growth_slid", growth->slid ? 1. : 0. },
                                 { "growth_reached", growth->reached ? 1. : 0. } });
      if (found.settled)
      {
        const auto &window = found.settled->window;
        append<Entry>(entries, { { "cycle", enumerator_name(found.settled->kind) },
                                 { "cycle_begin", found.settled_begin },
                                 { "cycle_amplitude_P", window.amplitude_P },
                                 { "cycle_amplitude_indentation", window.amplitude_indentation },
                                 { "cycle_relative_amplitude", window.amplitude_P / window.slide_P },
                                 { "cycle_open_share", window.open_share },
                                 { "cycle_stick_share", window.stick_share },
                                 { "cycle_frequency", window.frequency },
                                 { "cycle_period", window.period },
                                 { "cycle_vibrations", window.vibrations() },
                                 { "cycle_agreement", found.settled->agreement } });
      }
      const auto range = found.coexistence.value_or(Coexistence{ unknown, unknown });
      if (!found.points.empty())
        append<Entry>(entries, { { "coexistence_from", range.from }, { "coexistence_to", range.to } });
      append<Entry>(entries,
                    { { "energy_residual_share", found.ledger.share() }, { "steps", static_cast<double>(found.steps) } });
      return entries;
    }

    /// Returns the groups /growth and /continuation of the result file.
    std::vector<Group> sprag_slip_groups(const SpragSlip &found, const SpragSlipSettings &settings)
    {
      std::vector<Group> groups;
      if (found.growth)
        groups.push_back(growth_group(*found.growth, found.slide.kind == SlideKind::stable ? settings.final : settings.initial));
      if (!found.points.empty())
        groups.push_back(continuation_group(found.points));
      return groups;
    }

    constexpr double most_growth_rows    = 20000.; ///< written of the growth
    constexpr unsigned int approach_rows = 16;     ///< a period, from the growth to the vibration it leads to
    constexpr double written_periods     = 50.;    ///< of that vibration

    /// Writes some of the rows as they come and keeps the last ones.
    struct Rows
    {
      ResultWriter &writer;
      const HeldSlide &slide;
      unsigned long every = 1, count = 0;
      std::size_t kept         = 0;
      std::deque<Row> last     = {};
      std::vector<Row> largest = std::vector<Row>(slide.second ? 2 : 1); ///< those with the largest P of each lever

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
        if (slide.second)
        {
          row.set_second_value(Column::P_quasi_static, slide.second->P);
          row.set_second_value(Column::Q_quasi_static, slide.second->Q);
        }
        for (unsigned int lever = 0; lever < largest.size(); ++lever)
          if (!(row.lever_value(Column::P, lever) <= largest[lever].lever_value(Column::P, lever)))
            largest[lever] = row;
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

    /// Runs growth, vibration and continuation one after the other; `found` holds the finished parts even after a failure.
    struct Study
    {
      const Scene &scene;
      DynamicModel &model;
      ResultWriter &writer;
      Progress &progress;
      SpragSlip &found;
      Warnings &warnings;
      const bool has_errors;
      const SpragSlipSettings &settings = scene.sprag_slip;
      Rows rows                         = { writer, *found.slide.slide };
      const CycleSteps cycle            = choose_cycle_steps(found.slide, settings);
      const SettlingTimes times = { cycle.period, settings.settling, std::max(settings.settling, settings.longest_growth) };
      HeldRun run               = HeldRun(model, choose_step(watched_mode(found.slide), settings));
      double done               = 0.;

      void carry_out()
      {
        finish_in_any_case(
            [&]
            {
              measure();
              follow();
              if (has_errors)
                found.errors = estimate_cycle_errors(model, run, *found.slide.slide, *found.settled, times.period);
              if (settings.continuation > 0)
                continue_along();
            },
            [&](const std::string &)
            {
              found.ledger = run.ledger();
              found.steps  = run.steps();
              append(warnings, row_warnings(scene, rows.largest));
            });
      }

      void measure()
      {
        const double rate     = std::abs(watched_mode(found.slide).mode.eigenvalue.real());
        const double duration = std::log(settings.final / settings.initial) / rate;
        const double n_rows   = std::min(duration, settings.longest_growth) / run.dt;
        rows.begin(1 + static_cast<unsigned long>(n_rows / most_growth_rows), 0);
        found.growth = measure_growth(model, found.slide, settings, run, std::ref(rows));
        report();
      }

      /// Follows the vibration to its settled state: after a large kick if the slide is stable, from the perturbation if it is
      /// not.
      void follow()
      {
        const auto &slide   = *found.slide.slide;
        run.spectral_radius = scene.time.spectral_radius;
        run.dt              = cycle.dt;
        if (found.slide.kind == SlideKind::stable)
          run.begin(model.perturbed(slide, watched_mode(found.slide), Continuation::large_kick * slide.penetration));
        rows.begin(std::max(1u, settings.steps_per_period / approach_rows),
                   static_cast<std::size_t>(std::lround(written_periods * cycle.period / cycle.dt)));
        found.settled       = settle(run, slide, times, std::ref(rows));
        found.settled_begin = rows.write_last();
        report();
      }

      void continue_along()
      {
        Continuation continuation(model, run, held_drive(scene), times, with_shapes(checked_modes(scene)), settings);
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

      void report()
      {
        progress.update(++done, { run.drive().x });
      }
    };

    /// Growth, vibration, and every x of the continuation there and back.
    double count_parts(const SpragSlipSettings &settings)
    {
      const unsigned int n = settings.continuation;
      return n == 0 ? 2. : 2. + 2. * (n + Continuation::bisections) + 1.;
    }
  } // namespace

  void run_sprag_slip(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    const auto maker    = dynamics_maker(options);
    const Scene held    = held_scene(scene);
    const auto dynamics = maker->make(held);
    ResultWriter writer(scene, options, table_columns(scene.plate, scene.pair, scene.analysis.dimension, scene.cylinder),
                        &maker->timer());
    Progress progress(std::cerr, progress_style(options.quiet), count_parts(scene.sprag_slip));
    SpragSlip found;
    finish_in_any_case(
        [&]
        {
          const PhaseTimer::Scope scope(maker->timer(), "steps_and_output");
          const auto drive = held_drive(scene);
          found.slide      = check_slide(dynamics.model(), drive, with_shapes(checked_modes(scene)));
          require_slide(found, drive.x);
          Study{ scene, dynamics.model(), writer, progress, found, warnings, estimates_errors(scene, options) }.carry_out();
          check_ledger(scene, found.ledger);
        },
        [&](const std::string &status)
        {
          progress.finish();
          writer.finish(status, { sprag_slip_summary(found), {}, sprag_slip_groups(found, scene.sprag_slip), found.errors },
                        warnings);
        });
  }
} // namespace sprag
