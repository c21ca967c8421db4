// SPDX-License-Identifier: GPL-3.0-only
#include "program/recorder.h"

#include "base/append.h"
#include "base/system/interrupt.h"
#include "base/text.h"
#include "report/report.h"
#include "report/warnings.h"
#include "results/result_file.h"
#include "results/stress_entries.h"
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

  namespace
  {
    enum class RecordKind : std::uint64_t
    {
      row,
      face
    };

    /// In memory until they are in a results log.
    constexpr std::size_t most_face_bytes = 64 * 1024 * 1024;
  } // namespace

  Recorder::Recorder(const Scene &scene_, const RunOptions &options, PhaseTimer &timer, const FacePoints &points,
                     Checkpoint *const checkpoint_)
      : stress(no_stress_peaks("the model has no mesh"))
      , scene(scene_)
      , quiet(options.quiet)
      , writer(scene, options, timer, table_columns(scene.plate, scene.pair, scene.analysis.dimension, scene.cylinder), points)
      , progress(std::cerr, progress_style(quiet), path_length(scene.drive))
      , checkpoint(checkpoint_)
  {
    if (checkpoint == nullptr)
      return;
    if (checkpoint->resumes())
      take_over();
    checkpoint->set_records([this](RowLog &row_log) { add_records(row_log); });
  }

  void Recorder::add_records(RowLog &row_log)
  {
    auto face = RecordKind::face, row = RecordKind::row;
    // Whatever append() throws, it has what it was given.
    for (;;)
      if (faces_kept < faces_to_keep.size() && faces_to_keep[faces_kept].first == rows_kept)
        row_log.append(face, faces_to_keep[faces_kept++].second);
      else if (rows_kept < rows.size())
        row_log.append(row, rows[rows_kept++]);
      else
        break;
    faces_to_keep.clear();
    faces_kept         = 0;
    face_bytes_to_keep = 0;
  }

  void Recorder::take_over()
  {
    for (Archive records = checkpoint->recorded(); !records.at_end();)
    {
      RecordKind kind{};
      records(kind);
      if (kind == RecordKind::row)
      {
        Row row;
        records(row);
        add(row);
      }
      else
      {
        std::string bytes;
        FaceState face;
        records(bytes);
        Archive face_archive(std::move(bytes));
        face_archive(face);
        writer.append(face);
      }
    }
    rows_kept  = rows.size();
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
    const double iterations = row[Column::iterations];
    progress.update(travel, { row[Column::x], row[Column::P], row[Column::Q],
                              std::isnan(iterations) ? 0u : static_cast<unsigned int>(iterations) });
  }

  void Recorder::record(const FaceState &face)
  {
    writer.append(face);
    if (checkpoint == nullptr || !checkpoint->keeps())
      return;
    Archive archive;
    FaceState copy = face;
    archive(copy);
    faces_to_keep.emplace_back(rows.size(), archive.bytes());
    face_bytes_to_keep += archive.bytes().size();
    if (face_bytes_to_keep > most_face_bytes)
      checkpoint->write_records();
  }

  std::vector<Entry> Recorder::finish(const std::string &status, std::vector<Entry> meta, Warnings &warnings)
  {
    progress.finish();
    const bool in_time = scene.analysis.type == AnalysisType::transient;
    auto summary       = in_time ? transient_summary(scene, rows) : make_summary(scene, rows);
    add_pair(rows, summary);
    append(summary, stress);
    append(warnings, row_warnings(scene, rows));
    append(warnings, in_time ? transient_warnings(scene, rows) : deviation_warnings(summary));
    if (checkpoint != nullptr)
      meta.push_back({ "steps_taken_over", static_cast<double>(taken_over) });
    const auto end = writer.finish(status, { summary, meta, {}, accuracy }, warnings);
    if (checkpoint != nullptr)
      checkpoint->finish(status);
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
          const auto ending  = status_at_end(status);
          recorder.finish(ending, joined(facts, { { "steps_per_cpu_second", rate } }), warnings);
          if (ending != status)
            throw AnalysisError(ending);
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
