// SPDX-License-Identifier: GPL-3.0-only
#include "model/joined_ports.h"

#include <algorithm>

namespace sprag
{
  using dealii::Vector;

  Vector<double> ports_of_lever(const PortLayout &layout, const unsigned int lever, const Vector<double> &of_all)
  {
    if (of_all.size() == 0)
      return {};
    const unsigned int n = layout.of_a_lever();
    Vector<double> result(n + (layout.sprung ? 1 : 0));
    std::copy_n(of_all.begin() + layout.first(lever), n, result.begin());
    if (layout.sprung)
      result[n] = of_all[layout.support()];
    return result;
  }

  unsigned int joined_port(const PortLayout &layout, const unsigned int lever, const unsigned int port)
  {
    return port < layout.of_a_lever() ? layout.first(lever) + port : layout.support();
  }

  void join_forces(const PortLayout &layout, const std::vector<const PortForces *> &of_levers, PortForces &result)
  {
    if (of_levers.size() == 1)
    {
      result = *of_levers.front();
      return;
    }
    result.ports.clear();
    for (unsigned int lever = 0; lever < of_levers.size(); ++lever)
      for (const unsigned int port : of_levers[lever]->ports)
        if (port < layout.of_a_lever())
          result.ports.push_back(joined_port(layout, lever, port));
    const auto support = static_cast<unsigned int>(result.ports.size());
    if (std::any_of(of_levers.begin(), of_levers.end(),
                    [&](const auto &forces) { return !forces->ports.empty() && forces->ports.back() == layout.of_a_lever(); }))
      result.ports.push_back(layout.support());

    result.has_tangent = std::all_of(of_levers.begin(), of_levers.end(), [](const auto &forces) { return forces->has_tangent; });
    result.values.reinit(static_cast<unsigned int>(result.ports.size()));
    const auto n_of_tangent = result.has_tangent ? result.ports.size() : 0;
    result.tangent.reinit(n_of_tangent, n_of_tangent);
    unsigned int first = 0; // place of the lever's first port
    for (const auto &forces : of_levers)
    {
      const auto n   = static_cast<unsigned int>(forces->ports.size());
      const auto own = n > 0 && forces->ports.back() == layout.of_a_lever() ? n - 1 : n;
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
