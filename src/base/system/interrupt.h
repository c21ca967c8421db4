// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  /// The status and message of an interrupted analysis.
  inline constexpr char interruption[] = "interrupted; every finished step is kept";

  /// Lets SIGINT, SIGTERM, SIGHUP and SIGUSR1, which mpirun hands on to its processes, ask for an end from now on instead of
  /// making one, so that results can be finished. supervise() kills a process that does not come to its end. A SIGHUP that is
  /// ignored, as under nohup, stays so. Crashes are left to the system, and writing to a pipe that nobody reads is no reason to
  /// end.
  void catch_interrupts();

  /// Returns whether an end was requested.
  bool interrupted();

  /// Throws AnalysisError with the interruption's message if so.
  void end_if_interrupted();

  /// Lets every signal do from now on what it does by default.
  void forget_signal_handlers();
} // namespace sprag
