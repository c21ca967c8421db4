// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  /// The status and message of an interrupted analysis.
  inline constexpr char interruption[] = "interrupted; every finished step is kept";

  /// From now on SIGINT, SIGTERM, SIGHUP and SIGUSR1, which mpirun hands on to its processes, request an end instead of killing
  /// the process, so that results can be finished. supervise() kills a process that does not end. A SIGHUP that is ignored, as
  /// under nohup, stays ignored. Crashes are left to the system. Writing to a pipe that nobody reads does not end the process.
  void catch_interrupts();

  /// Returns whether an end was requested.
  bool interrupted();

  /// Throws AnalysisError with the interruption's message if an end was requested.
  void end_if_interrupted();

  /// Restores the default action of every signal.
  void forget_signal_handlers();
} // namespace sprag
