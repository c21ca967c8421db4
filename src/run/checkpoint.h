#pragma once

#include "base/progress_keeper.h"
#include "run/row_journal.h"
#include "run/run.h"

#include <chrono>
#include <vector>

namespace sprag
{
  /// Seconds between two checkpoints, in place of default_checkpoint_seconds; 0: each step.
  inline constexpr const char *checkpoint_variable   = "SPRAG_CHECKPOINT_SECONDS";
  inline constexpr double default_checkpoint_seconds = 30.;

  /// The checkpoint of a run in its folder: its progress, written at most every half minute and when the run is interrupted, and
  /// its rows. A run of the same scene goes on from it, also after a kill at any moment. It belongs to all parameters, the
  /// content of the files that they name and the build of the program; of others it is dropped, and so is one that is not as it
  /// was written, which the standard error tells. A checkpoint that cannot be written is told there, too, and no reason to end.
  /// Runs in memory have none.
  class Checkpoint : public ProgressKeeper
  {
  public:
    /// Reads what an interrupted run has left.
    Checkpoint(const Scene &scene, const RunOptions &options);

    /// Returns whether the run goes on from an interrupted one.
    bool resumes() const
    {
      return !progress_found.empty();
    }

    /// Hands over what the interrupted run has recorded, in the order of record().
    Archive recorded()
    {
      return Archive(std::move(rows_found));
    }

    /// Adds to what the run has recorded.
    template <class... Items>
    void record(Items &...items)
    {
      if (is_kept)
        journal.append(items...);
    }

    /// Adds something to the progress, to be visited behind that of the analysis. To be called before the analysis begins.
    void add_part(ProgressVisit part)
    {
      parts.push_back(std::move(part));
    }

    bool take_up(const ProgressVisit &progress) override;
    void accept_step(const ProgressVisit &progress) override;

    /// Removes it from the folder, once the run is over.
    void remove() const;

  private:
    using Clock = std::chrono::steady_clock;

    const bool is_kept;
    const std::string folder;
    const std::string key;
    const std::chrono::duration<double> interval;
    RowJournal journal;
    std::vector<ProgressVisit> parts;
    std::string progress_found, rows_found;
    Clock::time_point next;
    bool has_failed = false;

    void find();
    void visit_all(const ProgressVisit &progress, Archive &archive) const;
    void write(const ProgressVisit &progress);
  };
} // namespace sprag
