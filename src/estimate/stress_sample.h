// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/fields/body_fields.h"
#include "results/columns.h"

namespace sprag
{
  /// Largest von Mises stress in a state of a run, the cells at the hub left out.
  struct StressSample
  {
    double time  = 0.; ///< of the state [s]
    double lever = 0.; ///< [MPa]
    double layer = 0.; ///< [MPa]

    /// In the layer around the edges of the contact and beyond [MPa]. Behind a sliding contact the stress along the face rises
    /// steeply to a cusp, of which a finer mesh finds more.
    double layer_edge = 0.;
  };

  /// Looks at the fields of the state of a row too.
  void look_at(const BodyFields &fields, const std::vector<NodalField> &nodal, const Row &row, StressSample &sample);
} // namespace sprag
