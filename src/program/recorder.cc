// SPDX-License-Identifier: GPL-3.0-only
#include "program/recorder.h"

#include "base/ranges.h"
#include "base/system/interrupt.h"
#include "base/text.h"
#include "report/report.h"
#include "report/summary_lines.h"
#include "report/warnings.h"
#include "results/entries.h"
#include "results/result_file.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace sprag
{
  double path_length(const Drive &drive)
  {
    double length = 0.;
    double x      = drive.at(0.).x;
    for (const double time : drive.reversals())
    {
      length += std::abs(drive.at(time).x - x);
      x = drive.at(time).x;
    }
    return length + std::abs(drive.at(drive.duration()).x - x);
  }

  Recorder::Recorder(const Scene &scene_, const RunOptions &options, const PhaseTimer *const timer, const FacePoints &points,
                     Checkpoint *const checkpoint_)
      : stress(no_stress_peaks("the model has no mesh"))
      , scene(scene_)
      , quiet(options.quiet)
      , writer(scene, options, table_columns(scene.plate, scene.pair, scene.analysis.dimension, scene.cylinder), timer, points)
      , progress(std::cerr, progress_style(quiet), path_length(scene.drive))
      , checkpoint(checkpoint_)
  {
    if (checkpoint != nullptr && checkpoint->resumes())
      take_over();
  }

  void Recorder::take_over()
  {
    for (Archive records = checkpoint->recorded(); !records.at_end();)
    {
      bool is_face = false;
      records(is_face);
      if (!is_face)
      {
        Row row;
        records(row);
        add(row);
      }
      else
      {
        FaceState face;
        records(face);
        writer.append(face);
      }
    }
    taken_over = rows.size() - 1;
    progress.begin_at(travel);
    if (!quiet)
      std::cout << "Goes on:      from t = " << rounded_text(rows.back()[Column::time])
                << " s (x = " << mm(rows.back()[Column::x]) << "), step " << taken_over << " of an interrupted run\n"
                << std::flush;
  }

  void Recorder::add(Row row)
  {
    writer.append(row);
    if (!rows.empty())
      travel += std::abs(row[Column::x] - rows.back()[Column::x]);
    rows.push_back(std::move(row));
  }

  void Recorder::record(const Row &incomplete)
  {
    Row row = incomplete;
    add_closed_form(scene, row);
    add(row);
    if (bool is_face = false; checkpoint != nullptr)
      checkpoint->keep(is_face, row);
    const double iterations = row[Column::iterations];
    progress.update(travel, { row[Column::x], row[Column::P], row[Column::Q],
                              std::isnan(iterations) ? 0u : static_cast<unsigned int>(iterations) });
  }

  void Recorder::record(FaceState face)
  {
    writer.append(face);
    if (bool is_face = true; checkpoint != nullptr)
      checkpoint->keep(is_face, face);
  }

  std::vector<Entry> Recorder::finish(const std::string &status, std::vector<Entry> meta, Warnings &warnings)
  {
    progress.finish();
    const auto ending  = status == "completed" && interrupted() ? interruption : status; // behind the last step
    const bool in_time = scene.analysis.type == AnalysisType::transient;
    auto summary       = in_time ? transient_summary(scene, rows) : make_summary(scene, rows);
    add_pair(rows, summary);
    append(summary, stress);
    append(warnings, row_warnings(scene, rows));
    append(warnings, in_time ? transient_warnings(scene, rows) : deviation_warnings(summary));
    if (checkpoint != nullptr)
      meta.push_back({ "steps_taken_over", static_cast<double>(taken_over) });
    const auto end = writer.finish(ending, { summary, meta, {}, accuracy }, warnings);
    if (checkpoint != nullptr)
      checkpoint->finish(ending);
    if (ending != "completed" && !quiet && !rows.empty())
      summary_line(std::cout, "ended early",
                   "at x = " + mm(rows.back()[Column::x]) + ", t = " + rounded_text(rows.back()[Column::time]) + " s, after " +
                       formatted("%.0f", 100. * travel / path_length(scene.drive)) + " % of the way");
    if (ending != status)
      throw AnalysisError(ending);
    return end.summary;
  }

  void record_steps(const Scene &scene, Recorder &recorder, PhaseTimer &timer, Warnings &warnings,
                    const std::vector<Entry> &facts, const std::function<TransientReport()> &steps,
                    const std::function<void()> &complete)
  {
    TransientReport report;
    double seconds = 0.;
    finish_in_any_case(
        [&]
        {
          const PhaseTimer::Scope scope(timer, "steps_and_output");
          const double begin = PhaseTimer::cpu_seconds();
          report             = steps();
          seconds            = PhaseTimer::cpu_seconds() - begin;
          check_ledger(scene, report.ledger);
        },
        [&](const std::string &status)
        {
          complete();
          const double taken = static_cast<double>(report.steps) - static_cast<double>(recorder.steps_taken_over());
          const double rate  = seconds > 0. ? std::max(0., taken) / seconds : 0.;
          recorder.finish(status, joined(facts, { { "steps_per_cpu_second", rate } }), warnings);
        });
  }

  void announce_model(const Scene &scene, const RunOptions &options)
  {
    if (options.quiet)
      return;
    for (const auto &line : modelled(scene))
      std::cout << line << '\n';
    std::cout << std::flush;
  }
} // namespace sprag
