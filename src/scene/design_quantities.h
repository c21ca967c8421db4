// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/design.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  // The quantities that a design can demand or aim at. Forces and slopes are of one lever.

  struct DesignQuantityInfo
  {
    DesignQuantity quantity;
    std::string name;
    std::string unit; ///< "1" where dimensionless
    std::string definition;
  };

  /// Lists all quantities but those of free parameters, in the order in which they are reported.
  const std::vector<DesignQuantityInfo> &design_quantities();

  const DesignQuantityInfo &design_quantity_info(DesignQuantity quantity);

  std::optional<DesignQuantity> find_design_quantity(const std::string &name);

  /// Returns whether a design demands or aims at a quantity that `is_meant` accepts.
  template <class Condition>
  bool asks_for(const DesignSettings &design, const Condition &is_meant)
  {
    const auto is_it = [&](const auto &asked) { return is_meant(asked.term.quantity); };
    return std::any_of(design.demanded.begin(), design.demanded.end(), is_it) ||
           std::any_of(design.aims.begin(), design.aims.end(), is_it);
  }

  /// Returns whether a quantity is of the table on its levers, not of a lever alone.
  bool is_table_quantity(DesignQuantity quantity);
} // namespace sprag
