#pragma once

#include <mpi.h>

namespace sprag
{
  /// What the first rank of a run in three dimensions asks the others to do with it. It alone follows the drive, looks at the
  /// contact and writes files.
  enum class SharedTask
  {
    end,                 ///< the run is over
    build,               ///< the body
    release,             ///< it
    solve_whole,         ///< with the factors of the whole body
    solve_near,          ///< with those of its skin
    factorise_precisely, ///< again, in double precision
    release_factors      ///< of a body that is still looked at
  };

  /// Calls the others to a task. To be called by the first rank.
  void call_others(SharedTask task, MPI_Comm ranks);

  /// Waits for the first rank's next call, without taking the processor meanwhile. To be called by the others.
  SharedTask next_call(MPI_Comm ranks);
} // namespace sprag
