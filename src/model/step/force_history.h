// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "model/interface/interface_forces.h"

#include <vector>

namespace sprag
{
  /// Interface forces at a place of the drive [mm] or an instant [s].
  struct ForcesAtPlace
  {
    DofLoads forces;
    double place;
  };

  void serialise(Archive &archive, ForcesAtPlace &forces);

  /// Forces at the last few places of the drive, or at the middles of the last steps in time, extrapolated by a polynomial
  /// (Lagrange) as first guess of the next ones.
  class ForceHistory
  {
  public:
    /// Starts anew from the forces of an initial motion.
    void begin(const DofLoads &forces);

    /// Adds the mean forces of an accepted step of duration > 0 [s].
    void accept(const DofLoads &forces, double duration);

    /// Sets the first guess of the mean forces in the next step of duration > 0 [s].
    void guess(double duration, DofLoads &result) const;

    /// Adds the forces at a place beyond the last one; drops all earlier ones if `goes_on` is false.
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
