// SPDX-License-Identifier: GPL-3.0-only
#pragma once

// All that is particular to Open MPI among the implementations of MPI.

namespace sprag
{
  /// Returns the number of cores that this process may use.
  unsigned int available_cores();

  /// Returns whether mpirun has started the process.
  bool under_mpi();

  /// Sets up MPI for one process, as far as the environment does not say otherwise: no daemon beside the program, no folder for
  /// its sessions, no network and no devices looked for. To be called before MPI is initialised.
  void set_up_mpi_for_one();

  /// Returns whether `processes` ranks can be had: not under MPI already, not for one process, not without mpirun on the PATH.
  bool works_on_all_cores(unsigned int processes);

  /// Becomes mpirun with `processes` ranks of this program with the same arguments. Returns only if that fails. SIGUSR1 asks the
  /// ranks for an end, SIGTERM makes it. To be called before MPI is initialised.
  void become_mpirun(char **arguments, unsigned int processes);
} // namespace sprag
