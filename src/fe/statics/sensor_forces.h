// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"
#include "model/interface/interface_forces.h"
#include "model/interface/interface_layout.h"
#include "results/columns.h"

#include <deal.II/lac/full_matrix.h>

namespace sprag
{
  /// The force sensors of a body's friction plate, in the order of its connectors: of each place along the lever one, or in space
  /// the left and the right one, of a half the right ones alone.
  class SensorForces
  {
  public:
    template <int dim>
    SensorForces(const ElasticBody<dim> &body, const Response &response)
        : SensorForces(body.sensors(), surface_dofs(body), body.n_dofs(), response)
    {
    }

    unsigned int number() const
    {
      return static_cast<unsigned int>(sensors.size());
    }

    /// Returns their forces by those on a linear body's surface, by its dofs [N].
    std::vector<double> operator()(const DofLoads &forces) const;

    /// Returns their compressions by the displacement of all degrees of freedom [mm].
    std::vector<double> compressions(const dealii::Vector<double> &displacement) const;

    /// Sets the static compliance of sensors, in a layout whose dofs begin at `surface_begin` of the surface [mm/N].
    void add_compliance(const InterfaceLayout &layout, unsigned int surface_begin, dealii::FullMatrix<double> &compliance) const;

  private:
    SensorForces(std::vector<Connector> sensors, const std::vector<unsigned int> &surface, unsigned int n_dofs,
                 const Response &response);

    const std::vector<Connector> sensors;
    const unsigned int n_surface;
    dealii::FullMatrix<double> rows; ///< compressions by unit forces on the surface's dofs and then on the sensors themselves
  };

  /// Writes into a row the forces of the places in space, and their parts on either side of the plate. Each of a half stands for
  /// both.
  void observe_sensors(const std::vector<double> &forces, bool is_half, Row &row);
} // namespace sprag
