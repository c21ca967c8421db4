// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "base/progress.h"
#include "base/system/open_file.h"
#include "program/run_options.h"
#include "results/result_file.h"

#include <boost/algorithm/hex.hpp>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Adds lines, which hold no line break, to the end of a results log that rank 0 has open; `header` is its first line. Throws
  /// AnalysisError if it cannot be written.
  void append_lines(const std::string &path, const std::string &header, const std::vector<std::string> &lines);

  /// A file of finished pieces of a long analysis, so that one that was killed goes on where it was: a line a piece, with a
  /// checksum over the line, the scene and the build of the program. While rank 0 has it open, no other run can have it.
  class ResultsLog
  {
  public:
    /// Opens the results log and reads the lines in it, or begins one. `what` is what it is of, "map"; `scene` says all that the
    /// pieces depend on: lines of another scene, or of another build of the program, are dropped, and so is any line that is not
    /// as it was written. Throws InputError if the file cannot be opened or emptied, or if another run keeps it open for more
    /// than 5 s, and AnalysisError if a line cannot be written.
    ResultsLog(const std::string &path, const std::string &what, const std::string &scene);

    /// Lines found in the file, without checksums.
    const std::vector<std::string> &lines() const
    {
      return found;
    }

    /// Returns whether the file was emptied as its first line was of another scene or build, or damaged.
    bool was_emptied() const
    {
      return other_scene;
    }

    /// Returns the number of lines that were not as they had been written.
    std::size_t damaged_lines() const
    {
      return damaged;
    }

    /// Returns path and header, for append_lines().
    std::pair<std::string, std::string> address() const
    {
      return { path, header };
    }

    /// Removes the file, once the analysis is complete.
    void remove();

  private:
    const std::string path;
    const OpenFile file;
    std::string header;
    std::vector<std::string> found;
    bool other_scene    = false;
    std::size_t damaged = 0;

    void read();
  };

  /// Writes what an archive serialises as a line of a results log, to the last bit.
  template <class... Items>
  std::string to_line(Items... items)
  {
    Archive archive;
    archive(items...);
    return boost::algorithm::hex(archive.bytes());
  }

  /// Reads such a line.
  template <class... Items>
  void read_line(const std::string &line, Items &...items)
  {
    Archive archive(boost::algorithm::unhex(line));
    archive(items...);
  }

  /// Shows on the standard error how far the ranks of the first node have come.
  struct FarmProgress
  {
    const ProgressStyle style;
    std::optional<Progress> bar = {};

    /// Prints a line, with which a bar ends.
    void say(const std::string &text);

    /// Tells pieces done and wanted.
    void update(std::size_t done, std::size_t total);
  };

  /// Pieces by their indices, in groups that one rank does one after the other.
  using PieceGroups = std::vector<std::vector<std::size_t>>;

  /// Deals groups out to ranks in turn and returns those of the ranks on one node. `nodes` names the node of each rank.
  PieceGroups groups_on_node(const PieceGroups &groups, const std::vector<unsigned int> &nodes, unsigned int node);

  /// All ranks of MPI, doing the pieces of a long analysis together. The result of a piece is a line of text, which goes into the
  /// results log. Every rank calls what is here.
  class TaskFarm
  {
  public:
    /// The words by which messages name an analysis.
    struct Words
    {
      std::string analysis; ///< "map"
      std::string pieces;   ///< "cells"
      std::string again;    ///< "judged again", what becomes of lost pieces
    };

    /// Makes the run's folder and opens the results log in it on rank 0, which prints what it holds. Throws as prepare_folder()
    /// and ResultsLog do, on all ranks. Scene and progress must live as long.
    TaskFarm(const Scene &scene, const RunOptions &options, Words words, FarmProgress &progress);

    /// Lines that were in the results log.
    const std::vector<std::string> &taken_over() const
    {
      return from_log;
    }

    /// Does the pieces in `groups`, whose indices `work` takes and whose lines it returns, and hands the lines of all ranks to
    /// `learn`. Groups are dealt out to the nodes; a rank takes one after another of its node's, as soon as it is free. Throws
    /// AnalysisError on all ranks when one is interrupted, `work` throws it, an input file has changed or the log cannot be
    /// written; `learn` gets the lines that are in the log by then. Other nodes than that of such a rank first do the groups that
    /// they have.
    void carry_out(const PieceGroups &groups, const std::function<std::string(std::size_t)> &work,
                   const std::function<void(const std::string &)> &learn);

    /// Sums up the cost of all ranks until now, for /meta.
    std::vector<Entry> cost() const;

    /// Removes the results log, once the analysis is complete.
    void remove_log();

  private:
    class Counters;
    class Batch;

    const Scene &scene;
    const std::string key; ///< of the scene when it began
    const Words words;
    FarmProgress &progress;
    const double begin = monotonic_seconds();
    std::optional<ResultsLog> results_log;       ///< on rank 0
    std::pair<std::string, std::string> address; ///< of the log
    std::vector<std::string> from_log;

    void open_log(const RunOptions &options);
    void check_inputs() const;
    void report(std::size_t done, std::size_t total) const;
    void work_on(const PieceGroups &groups, const std::function<std::string(std::size_t)> &work, std::size_t total,
                 const Counters &counters, Batch &batch) const;
    void wait_for_others(std::size_t total, const Counters &counters) const;
  };

  /// Returns whether this process has rank 0, which prints and writes.
  bool is_first_rank();

  /// Does `work` on rank 0 and throws its InputError or AnalysisError on all ranks.
  void on_first_rank(const std::function<void()> &work);
} // namespace sprag
