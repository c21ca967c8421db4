#include "run/recorder.h"

#include "base/append.h"
#include "base/interrupt.h"
#include "results/stress_entries.h"
#include "run/transient_report.h"
#include "run/warnings.h"

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

  Recorder::Recorder(const Scene &scene_, const RunOptions &options, PhaseTimer &timer, const FacePoints &points)
      : scene(scene_)
      , quiet(options.quiet)
      , writer(scene, options, timer, table_columns(scene.plate, scene.pair), points)
      , progress(std::cerr, progress_style(quiet), path_length(scene.drive))
      , stress(no_stress_peaks("the model has no mesh"))
  {
  }

  void Recorder::record(const Row &incomplete)
  {
    Row row = incomplete;
    add_closed_form(scene, row);
    writer.append(row);
    if (!rows.empty())
      travel += std::abs(row[Column::x] - rows.back()[Column::x]);
    rows.push_back(row);
    if (interrupted())
      throw AnalysisError(interruption);
    const double iterations = row[Column::iterations];
    progress.update(travel, { row[Column::x], row[Column::P], row[Column::Q],
                              std::isnan(iterations) ? 0u : static_cast<unsigned int>(iterations) });
  }

  void Recorder::record(const FaceState &face)
  {
    writer.append(face);
  }

  std::vector<Entry> Recorder::finish(const std::string &status, const std::vector<Entry> &meta, Warnings &warnings)
  {
    progress.finish();
    const bool in_time = scene.analysis.type == AnalysisType::transient;
    auto summary       = in_time ? transient_summary(scene, rows) : summary_of(scene, rows);
    add_pair(rows, summary);
    append(summary, stress);
    append(warnings, row_warnings(scene, rows));
    if (in_time)
      append(warnings, transient_warnings(scene, rows));
    auto end = writer.finish(status, { summary, meta, {}, accuracy_entries(accuracy) }, warnings);
    if (!quiet)
    {
      const auto cpu = std::find_if(end.meta.begin(), end.meta.end(), [](const Entry &e) { return e.name == "cpu_time"; });
      print_summary(std::cout, joined(end.summary, { *cpu }));
      print_accuracy(std::cout, accuracy);
    }
    return end.summary;
  }
} // namespace sprag
