// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/task_farm/results_log.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// All ranks of MPI, doing the pieces of a long analysis together. The result of a piece is a line of text, which goes into the
  /// results log. Every rank calls what is here.
  class TaskFarm
  {
  public:
    struct Task
    {
      std::string name;                                     ///< of the analysis, "map"
      std::function<void()> check;                          ///< throws AnalysisError where what the pieces depend on has changed
      std::function<void(std::size_t, std::size_t)> report; ///< gets pieces done and wanted, on rank 0 now and then
    };

    /// Rank 0 has the results log; it is null on the others.
    TaskFarm(Task task, const ResultsLog *results_log);

    /// Lines that were in the results log.
    const std::vector<std::string> &taken_over() const
    {
      return from_log;
    }

    /// Does the pieces in `groups`, whose indices `work` takes and whose lines it returns, and hands the lines of all ranks to
    /// `learn`. A rank takes one group after another, as soon as it is free. Throws AnalysisError on all ranks when one was asked
    /// to end, the check fails or the results log cannot be written; what was finished until then is learned.
    void carry_out(const std::vector<std::vector<std::size_t>> &groups, const std::function<std::string(std::size_t)> &work,
                   const std::function<void(const std::string &)> &learn);

  private:
    class Counters;
    class Batch;

    const Task task;
    const bool reports;
    std::pair<std::string, std::string> results_log; ///< see ResultsLog::address()
    std::vector<std::string> from_log;

    void work_on(const std::vector<std::vector<std::size_t>> &groups, const std::function<std::string(std::size_t)> &work,
                 std::size_t total, Counters &counters, Batch &batch) const;
    void wait_for_others(std::size_t total, const Counters &counters) const;
  };

  /// Returns a check that the files which the scene's settings name are as they are now. It throws AnalysisError, which says of
  /// what analysis, "map", the pieces are.
  std::function<void()> unchanged_inputs(const Scene &scene, const std::string &name);

  /// Returns whether this process has rank 0, which prints and writes.
  bool is_first_rank();

  /// Does `work` on rank 0 and throws its InputError or AnalysisError on all ranks.
  void on_first_rank(const std::function<void()> &work);
} // namespace sprag
