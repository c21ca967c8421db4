#pragma once

namespace sprag
{
  /// The status and message of an interrupted analysis.
  inline constexpr char interruption[] = "interrupted; every finished step is kept";

  /// From now on SIGINT, SIGTERM, SIGHUP and SIGUSR1, which mpirun hands on to its processes, ask for an end instead of making
  /// one, so that results can be finished; who does not wait for it kills, see look_after(). A SIGHUP that is ignored, as under
  /// nohup, stays so. Crashes are left to the system, and writing to a pipe that nobody reads is no reason to end.
  void catch_interrupts();

  /// Returns whether an end was asked for.
  bool interrupted();

  /// From now on every signal does what it does by default.
  void forget_signal_handlers();
} // namespace sprag
