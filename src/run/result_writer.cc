#include "run/result_writer.h"

#include "base/append.h"
#include "base/available_memory.h"
#include "results/entries.h"
#include "scene/read.h"

#include <deal.II/base/config.h>

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
      entries.push_back({ "version", std::string(SPRAG_VERSION), "", "of sprag" });
      entries.push_back({ "deal.II", std::string(DEAL_II_PACKAGE_VERSION), "", "version of the library" });
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

  ResultWriter::ResultWriter(const Scene &scene, const RunOptions &options, PhaseTimer &of_run,
                             const std::vector<ColumnInfo> &columns, const FacePoints &points)
      : timer(of_run)
      , file((prepare_folder(options.folder), options.folder + "/result.h5"), parameters_text(scene), points, columns)
  {
  }

  RunEnd ResultWriter::finish(const std::string &status, RunEnd end, const Warnings &warnings)
  {
    end.summary.push_back(status_entry(status));
    sprag::append(end.meta, process_entries(timer));
    file.finish(end.summary, end.meta, warnings, end.groups, end.accuracy);
    return end;
  }
} // namespace sprag
