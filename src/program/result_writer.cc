// SPDX-License-Identifier: GPL-3.0-only
#include "program/result_writer.h"

#include "base/append.h"
#include "base/interrupt.h"
#include "base/peak_memory.h"
#include "base/version.h"
#include "program/in_memory.h"
#include "results/entries.h"
#include "scene/read.h"
#include "scene/scene.h"

#include <petscversion.h>

#include <gmsh.h>

namespace sprag
{
  namespace
  {
    /// Program, libraries and what the process has used so far, phases by wall and CPU time [s].
    std::vector<Entry> process_entries(PhaseTimer &timer)
    {
      std::vector<Entry> entries;
      entries.push_back({ "version", version(), "", "of sprag, with the commit that it was built from" });
      entries.push_back({ "deal.II", std::string(SPRAG_DEAL_II_VERSION), "", "version of the library" });
      entries.push_back({ "PETSc",
                          std::to_string(PETSC_VERSION_MAJOR) + "." + std::to_string(PETSC_VERSION_MINOR) + "." +
                              std::to_string(PETSC_VERSION_SUBMINOR),
                          "", "version of the library" });
      entries.push_back({ "gmsh", std::string(GMSH_API_VERSION), "", "version of the library" });
      for (const auto &[name, phase] : timer.phases())
        entries.push_back({ "wall_time_" + name, phase.wall, "s", "wall time in the phase" });
      for (const auto &[name, phase] : timer.phases())
        entries.push_back({ "cpu_time_" + name, phase.cpu, "s", "CPU time in the phase" });
      entries.push_back({ "cpu_time", PhaseTimer::cpu_seconds(), "s", "CPU time of the process" });
      entries.push_back({ "peak_memory", peak_memory() / (1024. * 1024.), "MiB", "largest resident memory" });
      return entries;
    }
  } // namespace

  std::string status_at_end(const std::string &status)
  {
    return status == "completed" && interrupted() ? interruption : status;
  }

  void require_folder(const RunOptions &options)
  {
    if (options.in_memory == nullptr)
      require_writable(options.folder);
  }

  ResultWriter::ResultWriter(const Scene &scene, const RunOptions &options, PhaseTimer &of_run,
                             const std::vector<ColumnInfo> &columns, const FacePoints &points)
      : timer(of_run)
      , in_memory(options.in_memory)
      , chosen(options.chosen)
      , keeps_curve(scene.analysis.type == AnalysisType::quasi_static)
  {
    if (in_memory != nullptr)
    {
      in_memory->found = {};
      return;
    }
    prepare_folder(scene, options);
    file.emplace(options.folder + "/result.h5", parameters_text(scene), points, columns);
  }

  void ResultWriter::keep(const Row &row)
  {
    if (keeps_curve)
      in_memory->found.curve.push_back({ row[Column::x], row[Column::v], row[Column::P], row.drive_force() });
  }

  RunEnd ResultWriter::finish(const std::string &status, RunEnd end, const Warnings &warnings)
  {
    if (in_memory != nullptr)
    {
      in_memory->found.summary = end.summary;
      return end;
    }
    end.summary.push_back(status_entry(status));
    if (!chosen.empty())
      end.meta.push_back({ "chosen_settings", chosen, "", "that followed from Accuracy" });
    sprag::append(end.meta, process_entries(timer));
    file->finish(end.summary, end.meta, warnings, end.groups, end.accuracy);
    return end;
  }
} // namespace sprag
