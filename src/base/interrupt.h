#pragma once

namespace sprag
{
  /// From now on SIGINT, SIGTERM and SIGUSR1, which mpirun hands on to its processes, ask for an end instead of making one, so
  /// that results can be finished. A second one ends at once.
  void catch_interrupts();

  /// Whether an end was asked for.
  bool interrupted();
} // namespace sprag
