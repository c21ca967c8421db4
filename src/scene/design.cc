// SPDX-License-Identifier: GPL-3.0-only
#include "scene/design.h"

#include "base/pages.h"
#include "base/ranges.h"

namespace sprag
{
  namespace
  {
    std::vector<DesignQuantityInfo> quantities_on_page()
    {
      std::vector<DesignQuantityInfo> all;
      for (const auto &[name, quantity] : enumerator_words<DesignQuantity>())
      {
        if (quantity == DesignQuantity::parameter)
          break;
        const auto &cells = value_for(page_table("quantity").rows, name);
        all.push_back({ quantity, name, cells.at("unit"), cells.at("definition") });
      }
      return all;
    }
  } // namespace

  const std::vector<DesignQuantityInfo> &design_quantities()
  {
    static const auto all = quantities_on_page();
    return all;
  }

  const DesignQuantityInfo &design_quantity_info(const DesignQuantity quantity)
  {
    return design_quantities().at(static_cast<std::size_t>(quantity));
  }

  std::optional<DesignQuantity> find_design_quantity(const std::string &name)
  {
    const auto *const info = find_by(design_quantities(), &DesignQuantityInfo::name, name);
    return info != nullptr ? std::make_optional(info->quantity) : std::nullopt;
  }

  bool asks_for(const DesignSettings &design, const DesignQuantity quantity)
  {
    return asks_for(design, [quantity](const DesignQuantity used) { return used == quantity; });
  }

  bool is_table_quantity(const DesignQuantity quantity)
  {
    return quantity == DesignQuantity::friction_ratio || quantity == DesignQuantity::transmissibility ||
           quantity == DesignQuantity::relative_amplitude || quantity == DesignQuantity::residual_offset;
  }
} // namespace sprag
