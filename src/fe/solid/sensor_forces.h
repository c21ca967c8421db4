#pragma once

#include "fe/solid/solid_body.h"
#include "model/port_forces.h"

#include <deal.II/lac/full_matrix.h>

namespace sprag
{
  /// Forces of the force sensors of a body's friction plate, from those on its friction face.
  class SensorForces
  {
  public:
    explicit SensorForces(const SolidBody &body);

    /// A place along the lever has a sensor at either side of the plate.
    struct Sides
    {
      double left;  ///< zeta < 0 [N], positive in compression
      double right; ///< zeta > 0 [N]
    };

    /// Returns those of each place from the pivot on. `forces`: on the ports of the face, three a node.
    std::vector<Sides> operator()(const PortLoads &forces) const;

  private:
    const bool is_half;              ///< each row stands for both sides
    dealii::FullMatrix<double> rows; ///< force of a sensor by unit forces on the ports
  };
} // namespace sprag
