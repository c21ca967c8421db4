#pragma once

#include <optional>

namespace sprag
{
  /// Cores that this process may use.
  unsigned int available_cores();

  /// Runs the program anew, with the same arguments, as `processes` ranks under mpirun and waits for its end: its exit status.
  /// None where it is to go on by itself: under MPI already, for one process, and without mpirun on the PATH. SIGINT and SIGTERM
  /// ask the ranks for an end, a second one makes it. To be called before MPI is initialised.
  std::optional<int> run_under_mpi(char **arguments, unsigned int processes);
} // namespace sprag
