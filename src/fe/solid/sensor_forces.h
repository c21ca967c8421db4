// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/solid_body.h"
#include "model/port_forces.h"
#include "results/columns.h"

#include <deal.II/lac/full_matrix.h>

namespace sprag
{
  /// The force sensors of a body's friction plate, in the order of its connectors: of each place along the lever the left and the
  /// right one, of a half the right ones alone.
  class SensorForces
  {
  public:
    /// The body must outlive this.
    explicit SensorForces(const SolidBody &body);

    unsigned int number() const
    {
      return static_cast<unsigned int>(sensors.size());
    }

    /// Stiffness of each sensor [N/mm].
    double stiffness() const
    {
      return sensors.empty() ? 0. : sensors.front().stiffness;
    }

    /// Returns their forces by those on a linear body's face, three ports a node [N].
    std::vector<double> operator()(const PortLoads &forces) const;

    /// Tells a row the forces of the places, and their parts on either side of the plate.
    void tell(std::vector<double> forces, Row &row) const;

    /// Returns their compressions by the displacement of all degrees of freedom [mm].
    std::vector<double> compressions(const dealii::Vector<double> &displacement) const;

    /// Compressions by unit forces on the ports of a linear body's face and then on the sensors themselves, a row a sensor
    /// [mm/N].
    const dealii::FullMatrix<double> &compliance() const
    {
      return rows;
    }

  private:
    const SolidBody &body;
    std::vector<Connector> sensors;
    dealii::FullMatrix<double> rows;
  };
} // namespace sprag
