// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/joined_interfaces.h"

#include <algorithm>

namespace sprag
{
  using dealii::Vector;

  Vector<double> extract_lever(const InterfaceLayout &layout, const unsigned int lever, const Vector<double> &all_displacements)
  {
    if (all_displacements.size() == 0)
      return {};
    const unsigned int n = layout.dofs_per_lever();
    Vector<double> result(n + (layout.sprung ? 1 : 0));
    std::copy_n(all_displacements.begin() + layout.first(lever), n, result.begin());
    if (layout.sprung)
      result[n] = all_displacements[layout.support()];
    return result;
  }

  unsigned int joined_dof(const InterfaceLayout &layout, const unsigned int lever, const unsigned int dof)
  {
    return dof < layout.dofs_per_lever() ? layout.first(lever) + dof : layout.support();
  }

  void join_forces(const InterfaceLayout &layout, const std::vector<const InterfaceForces *> &per_lever, InterfaceForces &result)
  {
    result.dofs.clear();
    for (unsigned int lever = 0; lever < per_lever.size(); ++lever)
      for (const unsigned int dof : per_lever[lever]->dofs)
        if (dof < layout.dofs_per_lever())
          result.dofs.push_back(joined_dof(layout, lever, dof));
    const auto support = static_cast<unsigned int>(result.dofs.size());
    if (std::any_of(per_lever.begin(), per_lever.end(),
                    [&](const auto &forces) { return !forces->dofs.empty() && forces->dofs.back() == layout.dofs_per_lever(); }))
      result.dofs.push_back(layout.support());

    result.has_tangent = std::all_of(per_lever.begin(), per_lever.end(), [](const auto &forces) { return forces->has_tangent; });
    result.values.reinit(static_cast<unsigned int>(result.dofs.size()));
    const auto tangent_size = result.has_tangent ? result.dofs.size() : 0;
    result.tangent.reinit(tangent_size, tangent_size);
    unsigned int first = 0; // place of the lever's first dof
    for (const auto &forces : per_lever)
    {
      const auto n   = static_cast<unsigned int>(forces->dofs.size());
      const auto own = n > 0 && forces->dofs.back() == layout.dofs_per_lever() ? n - 1 : n;
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
