// SPDX-License-Identifier: GPL-3.0-only
#include "model/joined_ports.h"

#include <algorithm>

namespace sprag
{
  using dealii::Vector;

  Vector<double> extract_lever_ports(const PortLayout &layout, const unsigned int lever, const Vector<double> &all_ports)
  {
    if (all_ports.size() == 0)
      return {};
    const unsigned int n = layout.ports_per_lever();
    Vector<double> result(n + (layout.sprung ? 1 : 0));
    std::copy_n(all_ports.begin() + layout.first(lever), n, result.begin());
    if (layout.sprung)
      result[n] = all_ports[layout.support()];
    return result;
  }

  unsigned int joined_port(const PortLayout &layout, const unsigned int lever, const unsigned int port)
  {
    return port < layout.ports_per_lever() ? layout.first(lever) + port : layout.support();
  }

  void join_forces(const PortLayout &layout, const std::vector<const PortForces *> &per_lever, PortForces &result)
  {
    if (per_lever.size() == 1)
    {
      result = *per_lever.front();
      return;
    }
    result.ports.clear();
    for (unsigned int lever = 0; lever < per_lever.size(); ++lever)
      for (const unsigned int port : per_lever[lever]->ports)
        if (port < layout.ports_per_lever())
          result.ports.push_back(joined_port(layout, lever, port));
    const auto support = static_cast<unsigned int>(result.ports.size());
    if (std::any_of(per_lever.begin(), per_lever.end(),
                    [&](const auto &forces)
                    { return !forces->ports.empty() && forces->ports.back() == layout.ports_per_lever(); }))
      result.ports.push_back(layout.support());

    result.has_tangent = std::all_of(per_lever.begin(), per_lever.end(), [](const auto &forces) { return forces->has_tangent; });
    result.values.reinit(static_cast<unsigned int>(result.ports.size()));
    const auto tangent_size = result.has_tangent ? result.ports.size() : 0;
    result.tangent.reinit(tangent_size, tangent_size);
    unsigned int first = 0; // place of the lever's first port
    for (const auto &forces : per_lever)
    {
      const auto n   = static_cast<unsigned int>(forces->ports.size());
      const auto own = n > 0 && forces->ports.back() == layout.ports_per_lever() ? n - 1 : n;
      for (unsigned int a = 0; a < n; ++a)
      {
        const unsigned int row = a < own ? first + a : support;
        result.values[row] += forces->values[a];
        if (!result.has_tangent)
          continue;
        std::copy_n(&forces->tangent(a, 0), own, &result.tangent(row, 0) + first);
        if (own < n)
          result.tangent(row, support) += forces->tangent(a, own);
      }
      first += own;
    }
  }
} // namespace sprag
