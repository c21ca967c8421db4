// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "model/interface/interface_forces.h"

#include <vector>

namespace sprag
{
  /// Interface forces at an instant [s].
  struct ForcesAtTime
  {
    DofLoads forces;
    double time;
  };

  void serialise(Archive &archive, ForcesAtTime &forces);

  /// Forces at the middles of the last few steps in time, extrapolated by a polynomial (Lagrange) as first guess of the next
  /// ones.
  class ForceHistory
  {
  public:
    /// Starts anew from the forces of an initial motion.
    void begin(const DofLoads &forces);

    /// Adds the mean forces of an accepted step of duration > 0 [s].
    void accept(const DofLoads &forces, double duration);

    /// Returns the first guess of the mean forces in the next step of duration > 0 [s], on the dofs of the last ones: each along
    /// the polynomial through its forces as far back as it has any.
    DofLoads guess(double duration) const;

    friend void serialise(Archive &archive, ForceHistory &history);

  private:
    std::vector<ForcesAtTime> steps; ///< the last one first
    double time = 0.;                ///< at the end of the last step
  };
} // namespace sprag
