#pragma once

#include "analysis/output_folder.h"
#include "analysis/report.h"
#include "base/progress.h"

#include <deal.II/base/timer.h>

namespace sprag
{
  /// Takes the rows of a run as they come: completes them, writes them, shows the progress and sums up at the end.
  class Recorder
  {
  public:
    /// Makes the folder and result file. Throws InputError if they cannot be written.
    Recorder(const Scene &scene, const std::string &folder, bool quiet, const FacePoints &points);

    void record(const Row &row);

    void record(const FaceState &face);

    /// Writes summary and meta and prints the table at the end of a run. `status` is "completed" or what went wrong.
    /// Returns the summary.
    std::vector<Entry> finish(const std::string &status, std::vector<Entry> meta);

  private:
    const Scene &scene;
    const bool quiet;
    ResultFile file;
    Progress progress;
    std::vector<Row> rows;
    double travel = 0.;
  };

  /// Whether the fields at a point of the drive are asked for; `last` is the path at the last frame [mm].
  bool wants_fields(const Scene &scene, const DrivePoint &drive, double travelled, double &last);

  /// Length of the drive's path [mm].
  double path_length(const Drive &drive);

  /// Program, libraries and what the process has used so far, phases by wall and CPU time [s].
  std::vector<Entry> process_entries(dealii::TimerOutput &timer);
} // namespace sprag
