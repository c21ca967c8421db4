// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/stress_peaks.h"

#include "base/unknown.h"
#include "results/entries.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  std::optional<unsigned int> stress_region(const BodyFields::Node &node)
  {
    const bool lever = node.part == material_id::lever || node.part == material_id::web;
    if (!lever && node.part != material_id::layer)
      return {};
    if (node.at_hub)
      return 2;
    return lever ? 0 : 1;
  }

  double largest_surface_stress(const std::vector<double> &pressure, const std::vector<double> &traction)
  {
    double result = 0.;
    for (std::size_t q = 0; q < pressure.size(); ++q)
      result = std::max(result, pressure[q] * pressure[q] + 3. * traction[q] * traction[q]);
    return std::sqrt(result);
  }

  StressPeaks::StressPeaks(const BodyFields &fields_)
      : fields(fields_)
  {
    for (const auto &node : fields.nodes)
      if (const auto node_region = stress_region(node))
        there[*node_region] = true;
  }

  void StressPeaks::look_at(const std::vector<NodalField> &nodal, const double x, const int direction, const unsigned int lever)
  {
    for (unsigned int i = 0; i < nodal.size(); ++i)
    {
      const auto &node       = fields.nodes[i];
      const auto node_region = stress_region(node);
      if (!node_region)
        continue;
      const double stress = von_mises(nodal[i]);
      auto &peak          = peaks[*node_region];
      if (!peak || stress > peak->stress)
        peak = { stress, x, direction, lever, node.position };
    }
  }

  void StressPeaks::serialise_progress(Archive &archive)
  {
    archive(peaks);
  }

  std::vector<Entry> StressPeaks::entries(const unsigned int levers) const
  {
    std::vector<Entry> result;
    for (unsigned int i = 0; i < stress_names.size(); ++i)
      if (there[i])
      {
        const std::string name = stress_names[i];
        const Peak peak        = peaks[i].value_or(Peak{ unknown, unknown, 0, 0, { unknown, unknown, unknown } });
        result.push_back({ name, peak.stress });
        result.push_back({ name + "_x", peak.x });
        result.push_back({ name + "_direction", std::string(peak.direction == 0  ? "none"
                                                            : peak.direction > 0 ? "forward"
                                                                                 : "backward") });
        result.push_back({ name + "_xi", peak.place[0] });
        result.push_back({ name + "_eta", peak.place[1] });
        if (fields.is_in_space)
          result.push_back({ name + "_zeta", peak.place[2] });
        if (levers == 2)
          result.push_back({ name + "_lever", peak.lever + 1. });
      }
    return result;
  }
} // namespace sprag
