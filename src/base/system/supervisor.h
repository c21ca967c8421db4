// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <optional>

namespace sprag
{
  /// End of a supervised process.
  struct WorkEnd
  {
    int status     = 0;     ///< exit status, if it ended by itself
    int signal     = 0;     ///< that ended it, or 0
    bool requested = false; ///< whether the user requested the end
  };

  /// Time between asking a process for its end and making it end [s]: libraries in the middle of a mesh, a factorisation or a
  /// basis cannot notice the question.
  inline constexpr double grace = 2.;

  /// The same time where processes of MPI have to end together: mpirun does not survive being hurried.
  inline constexpr double process_grace = 10.;

  /// Splits the process: none is returned in a child, which goes on with the work, and its end in the parent, which supervises
  /// it. SIGINT, SIGTERM and SIGHUP are handed on as SIGUSR1; after `timeout` [s], or a second one, follows `last_signal`, and
  /// SIGKILL another `timeout` later. The child ends with its parent. Where no process can be made the work is not supervised:
  /// none.
  std::optional<WorkEnd> supervise(int last_signal, double timeout);
} // namespace sprag
