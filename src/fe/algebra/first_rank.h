// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <mpi.h>

#include <optional>

namespace sprag
{
  // The first rank of a run in three dimensions follows the drive, looks at the contact and writes tables alone. It asks the
  // others to help with bodies and their fields.

  /// Tasks for which the first rank calls the others.
  enum class SharedTask
  {
    end,             ///< the run is over
    build,           ///< a body
    release,         ///< it
    factorise,       ///< it
    solve_whole,     ///< with the factors of the whole body
    solve_near,      ///< with those of its near-surface layer
    release_factors, ///< of a body that is still looked at
    recover_stress,  ///< of a body for its fields
    write_rows       ///< of a file with fields
  };

  /// Call of the first rank to the others. It is made of numbers alone.
  struct SharedCall
  {
    SharedTask task;
    int body; ///< its number, in the order in which they are built
  };

  /// Calls the others to a task. To be called by the first rank.
  void call_others(const SharedCall &call, MPI_Comm ranks);

  /// Waits for the first rank's next call, without taking the processor meanwhile. To be called by the others.
  SharedCall next_call(MPI_Comm ranks);

  /// Shares bodies of this process, the first, with the others during its lifetime; these await its calls.
  class RanksAtHand
  {
  public:
    explicit RanksAtHand(MPI_Comm ranks);
    RanksAtHand &operator=(RanksAtHand &&) = delete;
    ~RanksAtHand();
  };

  /// Returns the ranks that share the bodies of this process: itself alone without RanksAtHand.
  MPI_Comm ranks_at_hand();

  /// One body's part in the calls of the first rank.
  class BodyCalls
  {
  public:
    /// Makes the calls of the first rank.
    BodyCalls();

    /// Makes those of another rank, which was called to a task.
    explicit BodyCalls(MPI_Comm ranks_)
        : ranks(ranks_)
    {
    }

    /// Calls the others to a task where this is the first rank.
    void operator()(SharedTask task) const;

    bool is_first() const
    {
      return number.has_value();
    }

    const MPI_Comm ranks;

  private:
    const std::optional<int> number; ///< none of the others' calls
  };
} // namespace sprag
