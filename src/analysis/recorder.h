#pragma once

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

    /// Peaks of stress for the summary, see StressPeaks; without, they are told as NaN of a model without a mesh.
    void set_stress(std::vector<Entry> peaks);

    /// Writes summary, meta and warnings, to which it adds those that follow from the rows, and prints the table at the end of a
    /// run. `status` is "completed" or what went wrong. Returns the summary.
    std::vector<Entry> finish(const std::string &status, std::vector<Entry> meta, Warnings &warnings);

  private:
    const Scene &scene;
    const bool quiet;
    ResultFile file;
    Progress progress;
    std::vector<Row> rows;
    std::vector<Entry> stress;
    double travel = 0.;
  };

  /// Length of the drive's path [mm].
  double path_length(const Drive &drive);

  /// Throws InputError if the folder could not be made or written to; makes nothing.
  void require_writable(const std::string &folder);

  /// Makes the folder if needed; throws InputError if nothing can be written there.
  void prepare_folder(const std::string &folder);

  /// Program, libraries and what the process has used so far, phases by wall and CPU time [s].
  std::vector<Entry> process_entries(dealii::TimerOutput &timer);
} // namespace sprag
