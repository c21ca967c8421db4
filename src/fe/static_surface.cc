#include "fe/static_surface.h"

#include <cmath>

namespace sprag
{
  bool set_trial(const ContactMemory &memory, const double gap, const double slip_change, const ContactLaw &law,
                 StaticPoint &point)
  {
    point.gap            = gap;
    point.trial_pressure = memory.normal_multiplier - law.normal_penalty * gap;
    point.slip_change    = slip_change;
    point.elastic_slip   = 0.;
    return point.trial_pressure > 0.;
  }

  void set_elastic_slip(const ContactMemory &memory, const StaticStep &step, StaticPoint &point)
  {
    const double held  = step.multipliers ? memory.traction : 0.;
    point.elastic_slip = std::abs(point.response.traction - held) / step.law.tangential_penalty;
  }
} // namespace sprag
