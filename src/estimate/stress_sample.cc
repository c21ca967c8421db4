// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/stress_sample.h"

#include "fe/fields/stress_peaks.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double contact_middle = 0.4; ///< on both sides of the largest pressure, over the width of the contact
  }

  void look_at(const BodyFields &fields, const std::vector<NodalField> &nodal, const Row &row, StressSample &sample)
  {
    const double middle = row[Column::largest_pressure_xi];
    const double reach  = contact_middle * row[Column::contact_width];
    sample.time         = row[Column::time];
    for (std::size_t i = 0; i < nodal.size(); ++i)
    {
      const auto &node  = fields.nodes[i];
      const auto region = stress_region(node);
      if (region == 0u)
        sample.lever = std::max(sample.lever, von_mises(nodal[i]));
      else if (region == 1u)
      {
        const double stress = von_mises(nodal[i]);
        sample.layer        = std::max(sample.layer, stress);
        if (std::abs(node.position[0] - middle) > reach)
          sample.layer_edge = std::max(sample.layer_edge, stress);
      }
    }
  }
} // namespace sprag
