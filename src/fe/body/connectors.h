// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/body_properties.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <utility>
#include <vector>

namespace sprag
{
  /// A spring between a friction plate and its lever: a force of `stiffness` times its compression, the sum of weights times
  /// displacements, which no rigid movement changes.
  struct Connector
  {
    ConnectorType type = ConnectorType::sensor;
    double stiffness   = 0.;                          ///< [N/mm]
    std::vector<std::pair<unsigned int, double>> row; ///< free degrees of freedom, increasing, and their weights

    /// Returns the compression [mm], positive where plate and lever approach (sensor) or the plate moves towards the tip (guide).
    template <class Vector>
    double compression(const Vector &displacement) const
    {
      double sum = 0.;
      for (const auto &[dof, weight] : row)
        sum += weight * displacement[dof];
      return sum;
    }
  };

  /// Finds the connectors of the settings in their order. Each presses on a pad of the sides `sensor_plate` and `sensor_lever`
  /// within the same range of the first axis. Compression of a sensor: mean normal displacement of the plate's pad less that of
  /// the lever's. That of a guide: the mean tangential displacement of the plate's pad less that of a rigid block which stands on
  /// the lever's pad and reaches to the plate, as it turns with the pad: the guide's forces on plate and lever lie in one line.
  /// Means are integrals over the pads, which need not end where cells do. Throws InputError if the sides do not reach as far.
  template <int dim>
  std::vector<Connector> find_connectors(const dealii::Mapping<dim> &mapping, const dealii::DoFHandler<dim> &dof_handler,
                                         const dealii::AffineConstraints<double> &constraints,
                                         const std::vector<ConnectorSettings> &settings);
} // namespace sprag
