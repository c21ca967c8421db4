#pragma once

#include "fe/solid/solid_body.h"
#include "model/port_forces.h"

#include <deal.II/lac/full_matrix.h>

namespace sprag
{
  /// Forces of the force sensors of a body's friction plate.
  class SensorForces
  {
  public:
    /// The body must outlive this.
    explicit SensorForces(const SolidBody &body);

    /// A place along the lever has a sensor at either side of the plate.
    struct Sides
    {
      double left;  ///< zeta < 0 [N], positive in compression
      double right; ///< zeta > 0 [N]
    };

    /// Returns those of each place from the pivot on by the forces on a linear body's face, three ports a node.
    std::vector<Sides> operator()(const PortLoads &forces) const;

    /// The same by the displacement of all degrees of freedom.
    std::vector<Sides> at(const dealii::Vector<double> &displacement) const;

  private:
    std::vector<Sides> sides_of(const std::vector<double> &forces) const;

    const SolidBody &body;
    dealii::FullMatrix<double> rows; ///< force of a sensor by unit forces on the ports
  };
} // namespace sprag
