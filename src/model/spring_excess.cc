#include "model/spring_excess.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace sprag
{
  void add_spring_excess(const MomentLaw &law, const unsigned int rotation, const double turn, PortForces &forces)
  {
    const auto found = std::lower_bound(forces.ports.begin(), forces.ports.end(), rotation);
    Assert(found != forces.ports.end() && *found == rotation, dealii::ExcInternalError());
    const auto place = static_cast<unsigned int>(found - forces.ports.begin());
    forces.values[place] -= law.excess(turn);
    forces.tangent(place, place) -= law.excess_stiffness(turn);
  }
} // namespace sprag
