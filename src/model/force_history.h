#pragma once

#include "base/archive.h"
#include "model/port_forces.h"

namespace sprag
{
  /// Forces of the last two steps in a row, which tell where the search for those of the next one best starts.
  class ForceHistory
  {
  public:
    /// Begins at the forces of a motion that no step led to.
    void begin(const PortLoads &forces);

    /// Takes the mean forces of an accepted step of some duration > 0 [s].
    void accept(const PortLoads &forces, double duration);

    /// Writes what they lead to along a line, from the middle of a step to that of the next, which has some duration > 0 [s].
    /// Ports that the last forces do not have are left out.
    void guess(double duration, PortLoads &result) const;

    friend void visit(Archive &archive, ForceHistory &history);

  private:
    PortLoads before, last;
    double duration_before = 0., last_duration = 0.; ///< 0: no step [s]
  };
} // namespace sprag
