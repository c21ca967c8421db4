// SPDX-License-Identifier: GPL-3.0-only
#include "scene/design.h"

#include <algorithm>

namespace sprag
{
  const std::vector<DesignQuantityInfo> &design_quantities()
  {
    using Q                                          = DesignQuantity;
    static const std::vector<DesignQuantityInfo> all = {
      { Q::damping_slope, "damping slope", "N/mm", "c = (C_Q forward - C_Q backward)/2 of one lever at x = 0" },
      { Q::restoring_slope, "restoring slope", "N/mm", "k_e = (C_Q forward + C_Q backward)/2 of one lever at x = 0" },
      { Q::forward_slope, "forward slope", "N/mm", "C_Q at x = 0, moving forward" },
      { Q::backward_slope, "backward slope", "N/mm", "C_Q at x = 0, moving back; negative where Q resists" },
      { Q::friction_ratio, "friction ratio", "1", "gamma = n c/K with Isolation/Levers and Isolation/Stiffness" },
      { Q::slope_ratio, "slope ratio", "1", "C_Q forward over -C_Q backward; infinite where that is not positive" },
      { Q::force_ratio, "force ratio", "1", "Q forward over -Q backward at the end of the stroke, likewise" },
      { Q::nonlinearity, "nonlinearity", "1",
        "largest distance of Q from the best line through 0 over the largest Q of that way, the worse of both ways" },
      { Q::largest_force, "largest force", "N", "largest Q on the stroke whatever its sign, both ways" },
      { Q::largest_normal_force, "largest normal force", "N", "largest P on the stroke, both ways" },
      { Q::largest_pressure, "largest pressure", "MPa",
        "on the friction layer under the largest P, as of an elastic foundation between rigid bodies" },
      { Q::loop_area, "loop area", "N mm", "what friction takes in one stroke out and back at the drive's peak speed" },
      { Q::jamming_margin, "jamming margin", "1", "least s - mu e over s on the way back; 0: the lever locks" },
      { Q::reach, "reach", "mm", "x at which the cylinder touches the pivot" },
      { Q::inclination, "inclination", "deg", "theta_0" },
      { Q::lever_length, "lever length", "mm", "from the pivot to the contact at x = 0: s" },
      { Q::transmissibility, "transmissibility", "1",
        "first harmonic of the table over the base at Isolation/Base frequency and Base amplitude, the largest of several" },
      { Q::relative_amplitude, "relative amplitude", "mm", "of the table over the base there" },
      { Q::residual_offset, "residual offset", "mm", "how far from z = 0 the isolated table ends, from a run in time" },
      { Q::growth_rate, "growth rate", "1/s",
        "largest Re lambda of the slides at all x judged, both ways; infinite where there is no unique slide" },
    };
    return all;
  }

  const DesignQuantityInfo &design_quantity_info(const DesignQuantity quantity)
  {
    const auto &all = design_quantities();
    return *std::find_if(all.begin(), all.end(), [&](const auto &info) { return info.quantity == quantity; });
  }

  std::optional<DesignQuantity> find_design_quantity(const std::string &name)
  {
    for (const auto &info : design_quantities())
      if (info.name == name)
        return info.quantity;
    return {};
  }

  bool asks_for(const DesignSettings &design, const DesignQuantity quantity)
  {
    return asks_for(design, [quantity](const DesignQuantity asked) { return asked == quantity; });
  }

  bool is_table_quantity(const DesignQuantity quantity)
  {
    return quantity == DesignQuantity::friction_ratio || quantity == DesignQuantity::transmissibility ||
           quantity == DesignQuantity::relative_amplitude || quantity == DesignQuantity::residual_offset;
  }
} // namespace sprag
