// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "base/errors.h"
#include "base/progress_keeper.h"
#include "base/system/open_file.h"
#include "program/run_options.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Results log of a run's records: a file to which blocks with checksums are appended, so that a checkpoint need not hold them.
  class RowLog
  {
  public:
    /// Nothing is read or written yet.
    explicit RowLog(std::string path);

    /// Begins with the first `size` bytes of the file, drops what follows and returns the records in them; none where they are
    /// not as they were written.
    std::optional<std::string> take_up(std::size_t size);

    /// Adds a record, written with the next block. Throws as write() does, where it writes one.
    template <class... Items>
    void append(Items &...items)
    {
      pending(items...);
      if (pending.bytes().size() > block_size)
        write_block();
    }

    /// Hands what was added to the system's disk. Throws AnalysisError where it cannot; it is then still to be written.
    void write();

    /// Returns the size of the file [bytes].
    std::size_t size() const
    {
      return written;
    }

  private:
    static constexpr std::size_t block_size = 1024 * 1024; ///< what a processor's cache holds

    const std::string path;
    OpenFile file;
    std::size_t written = 0;
    Archive pending; ///< the next block

    void write_block();
    void fail();
  };

  /// Seconds between two checkpoints, in place of default_checkpoint_seconds; 0: each step.
  inline constexpr const char *checkpoint_variable = "SPRAG_CHECKPOINT_SECONDS";

  inline constexpr double default_checkpoint_seconds = 30.;

  /// Returns whether a folder has the checkpoint of a run with this scene's parameters that is as it was written.
  bool has_checkpoint(const std::string &folder, const Scene &scene);

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

    /// Returns whether the run resumes an interrupted one.
    bool resumes() const
    {
      return is_resumed;
    }

    /// Hands over what the interrupted run has recorded.
    Archive recorded()
    {
      return Archive(std::move(rows_found));
    }

    /// Keeps a record of the run, to be handed over by recorded() in the order of the calls.
    template <class... Items>
    void keep(Items &...items)
    {
      if (is_kept)
        try_to([&] { row_log.append(items...); });
    }

    /// Adds something to the progress, to be serialised after that of the analysis. To be called before the analysis begins.
    void add_part(ProgressSerialiser part)
    {
      parts.push_back(std::move(part));
    }

    bool take_up(const ProgressSerialiser &progress) override;
    void accept_step(const ProgressSerialiser &progress) override;
    void end_steps(const ProgressSerialiser &progress) override;

    /// Hands a step on. Where that fails, as on a full disk, the run is worth going on with once there is space.
    template <class Work>
    void hand_on(const Work &work)
    {
      try
      {
        work();
      }
      catch (const AnalysisError &)
      {
        is_needed = true;
        throw;
      }
    }

    /// Removes it from the folder when the run has ended, completed or failed, but not where it was interrupted or could not hand
    /// a step on.
    void finish(const std::string &status) const;

  private:
    using Clock = std::chrono::steady_clock;

    const bool is_kept;
    const bool quiet;
    const std::string folder;
    const std::string parameters, own_scene_key;
    const std::chrono::duration<double> interval;
    RowLog row_log;
    std::vector<ProgressSerialiser> parts;
    bool is_resumed = false;
    std::string progress_found, rows_found;
    Clock::time_point next;
    bool is_written = false; ///< by this run
    bool has_failed = false;
    bool is_needed  = false; ///< even if the run fails

    std::string key() const;
    void find();
    void serialise_all(const ProgressSerialiser &progress, Archive &archive) const;
    void try_to(const std::function<void()> &write);
    void write(const ProgressSerialiser &progress);
  };
} // namespace sprag
