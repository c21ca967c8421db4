// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "model/interface/interface_forces.h"

#include <vector>

namespace sprag
{
  struct ForcesAtPlace
  {
    DofLoads forces;
    double place;
  };

  void serialise(Archive &archive, ForcesAtPlace &forces);

  /// Forces at the last few places of a way, or in the middle of the last steps in time, which tell where the search for the next
  /// ones best starts.
  class ForceHistory
  {
  public:
    /// Forgets what was before, and begins at the forces of a motion that no step led to.
    void begin(const DofLoads &forces);

    /// Takes the mean forces of an accepted step of some duration > 0 [s].
    void accept(const DofLoads &forces, double duration);

    /// Writes what they lead to in the next step, which has some duration > 0 [s].
    void guess(double duration, DofLoads &result) const;

    /// Takes the forces at a place beyond the last one. Forgets all others where `goes_on` is false.
    void accept_at(const DofLoads &forces, double place, bool goes_on = true);

    /// Returns the forces at a place, on the dofs of the last: each along the polynomial through its forces as far back as it has
    /// any. There must be some.
    DofLoads guess_at(double place) const;

    std::size_t size() const
    {
      return places.size();
    }

    const ForcesAtPlace &last() const
    {
      return places.front();
    }

    friend void serialise(Archive &archive, ForceHistory &history);

  private:
    std::vector<ForcesAtPlace> places; ///< the last one first
    double time = 0.;                  ///< at the end of the last step
  };
} // namespace sprag
