#include "analysis/recorder.h"

#include "analysis/row_warnings.h"
#include "analysis/transient_report.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "fe/stress_peaks.h"
#include "scene/read.h"

#include <deal.II/base/utilities.h>

#include <petscversion.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gmsh.h>
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

  std::vector<Entry> process_entries(dealii::TimerOutput &timer)
  {
    std::vector<Entry> entries;
    entries.push_back({ "version", std::string(SPRAG_VERSION), "", "of sprag" });
    entries.push_back({ "deal.II", std::string(DEAL_II_PACKAGE_VERSION), "", "version of the library" });
    entries.push_back({ "PETSc",
                        std::to_string(PETSC_VERSION_MAJOR) + "." + std::to_string(PETSC_VERSION_MINOR) + "." +
                            std::to_string(PETSC_VERSION_SUBMINOR),
                        "", "version of the library" });
    entries.push_back({ "gmsh", std::string(GMSH_API_VERSION), "", "version of the library" });
    for (const auto &[phase, seconds] : timer.get_summary_data(dealii::TimerOutput::total_wall_time))
      entries.push_back({ "wall_time_" + phase, seconds, "s", "wall time in the phase" });
    for (const auto &[phase, seconds] : timer.get_summary_data(dealii::TimerOutput::total_cpu_time))
      entries.push_back({ "cpu_time_" + phase, seconds, "s", "CPU time in the phase" });
    entries.push_back({ "cpu_time", static_cast<double>(std::clock()) / CLOCKS_PER_SEC, "s", "CPU time of the process" });
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    entries.push_back({ "peak_memory", static_cast<double>(memory.VmHWM) / 1024., "MiB", "largest resident memory" });
    return entries;
  }

  Recorder::Recorder(const Scene &scene_, const std::string &folder, const bool quiet_, const FacePoints &points)
      : scene(scene_)
      , quiet(quiet_)
      , file((prepare_folder(folder), folder + "/result.h5"), parameters_text(scene), points,
             table_columns(scene.plate, scene.pair))
      , progress(std::cerr, progress_style(quiet), path_length(scene.drive))
      , stress(no_stress_peaks("the model has no mesh"))
  {
  }

  void Recorder::record(const Row &incomplete)
  {
    Row row = incomplete;
    add_closed_form(scene, row);
    file.append(row);
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
    file.append(face);
  }

  void Recorder::set_stress(std::vector<Entry> peaks)
  {
    stress = std::move(peaks);
  }

  std::vector<Entry> Recorder::finish(const std::string &status, std::vector<Entry> meta, Warnings &warnings)
  {
    progress.finish();
    auto summary = scene.analysis.type == AnalysisType::transient ? transient_summary(scene, rows) : summary_of(scene, rows);
    add_pair(rows, summary);
    summary.insert(summary.end(), stress.begin(), stress.end());
    summary.push_back({ "status", status, "", "how the run ended" });
    append(warnings, row_warnings(scene, rows));
    if (scene.analysis.type == AnalysisType::transient)
      append(warnings, transient_warnings(scene, rows));
    file.finish(summary, meta, warnings);
    if (!quiet)
    {
      const auto cpu = std::find_if(meta.begin(), meta.end(), [](const Entry &e) { return e.name == "cpu_time"; });
      auto shown     = summary;
      if (cpu != meta.end())
        shown.push_back(*cpu);
      print_summary(std::cout, shown);
    }
    return summary;
  }
} // namespace sprag
