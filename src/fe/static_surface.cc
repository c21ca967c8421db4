#include "fe/static_surface.h"

#include <algorithm>
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

  SlipShift slip_shift(const FacePatches &face, const unsigned int point, const double slope, const StaticStep &step)
  {
    const auto &points = face.points();
    const double xi    = points[point].position.xi - step.travel;
    if (step.travel == 0. || xi < points.front().position.xi || xi > points.back().position.xi)
      return {};
    const auto after    = std::upper_bound(points.begin() + 1, points.end() - 1, xi,
                                           [](const double value, const FacePatches::Point &at) { return value < at.position.xi; });
    const auto i        = static_cast<unsigned int>(after - points.begin());
    const double before = (after - 1)->position.xi;
    const double share  = (xi - before) / (after->position.xi - before);
    const auto at_start = [&](double ContactMemory::*const value)
    { return (1. - share) * step.start[i - 1].*value + share * step.start[i].*value; };
    const double slip      = step.start[point].slip - at_start(&ContactMemory::slip) - step.travel * slope;
    const double unwinding = at_start(&ContactMemory::traction) - step.start[point].traction;
    return { slip, step.multipliers ? 0. : unwinding / step.law.tangential_penalty, -step.travel };
  }

  void set_slips(const ContactMemory &memory, const StaticStep &step, const double shift, StaticPoint &point)
  {
    point.slip_change  = (point.slip_change + shift) * step.speed_ratio;
    const double held  = step.multipliers ? memory.traction : 0.;
    point.elastic_slip = std::abs(point.response.traction - held) / step.law.tangential_penalty;
  }
} // namespace sprag
