// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/design.h"
#include "scene/design_quantities.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Values of all quantities of a lever; NaN of what is not known.
  class DesignQuantities
  {
  public:
    DesignQuantities()
    {
      values.fill(std::numeric_limits<double>::quiet_NaN());
    }

    double &operator[](const DesignQuantity quantity)
    {
      return values[static_cast<std::size_t>(quantity)];
    }

    double operator[](const DesignQuantity quantity) const
    {
      return values[static_cast<std::size_t>(quantity)];
    }

  private:
    std::array<double, static_cast<std::size_t>(DesignQuantity::parameter)> values;
  };

  /// A rule that every lever keeps, whatever is demanded: it can be built and slides on the whole stroke.
  struct LeverRule
  {
    double violation = 0.; ///< of lengths over the largest of them; <= 0: kept
    std::string text;      ///< "the cylinder must not reach the pivot on the stroke"
  };

  /// Returns the first rule that the lever breaks, or the one that it comes closest to breaking. `has_length`: whether
  /// Lever/Length must reach beyond the contact.
  LeverRule hardest_rule(const Scene &scene, bool has_length);

  /// Returns the largest distance of forces from the best line through 0, over the largest force.
  double nonlinearity_of(const std::vector<double> &x, const std::vector<double> &forces);

  /// Returns the ratio of forces or slopes forward and back; infinite where the way back does not damp.
  double ratio_of_ways(double forward, double backward);

  /// Returns those quantities of a lever that keeps the rules which follow from the closed form on the stroke.
  DesignQuantities lever_quantities(const Scene &scene);

  /// Fills in what the table does on such levers, as far as it is asked for: by one harmonic, and the offset by a run in time. A
  /// table without a motion of one harmonic within the levers' way has an infinite transmissibility, one whose levers end or
  /// lock an infinite offset.
  void add_table_quantities(const Scene &scene, const std::vector<DesignQuantity> &asked, DesignQuantities &quantities);
} // namespace sprag
