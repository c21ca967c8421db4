// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/port_compliance.h"

#include <deal.II/lac/vector.h>

namespace sprag
{
  // A linear structure is seen through ports: displacements on which forces act. It answers with
  //   z = z_free + G f(z),   G its compliance.

  /// Forces on some of the ports and their derivative by the displacements of the same ports, unsymmetric.
  struct PortForces
  {
    std::vector<unsigned int> ports; ///< increasing
    dealii::Vector<double> values;
    dealii::FullMatrix<double> tangent;
    bool has_tangent = true; ///< else it was not wanted and is empty
  };

  /// Gives forces further ports, increasing, where they are 0 so far.
  void add_ports(const std::vector<unsigned int> &others, PortForces &forces);

  /// Sums up forces that share ports, whose own may come in any order. `port_places` is room for a number a port.
  void sum_forces(const std::vector<PortForces> &loaded, std::vector<unsigned int> &port_places, PortForces &sum);

  /// Output requested of a contact. One that does not keep its tangent always finds all of it.
  enum class Request
  {
    forces,
    with_tangent,
    complete ///< forces, works, energy and points: those that may take part and, along the lines where the pressure is largest,
             ///< all near the cylinder; all of these where nothing touches
  };

  /// Forces on some of the ports.
  struct PortLoads
  {
    std::vector<unsigned int> ports; ///< increasing
    dealii::Vector<double> values;
  };

  /// Some of the ports, increasing. A contact that reaches few of many ports looks at those alone; entries of others in vectors
  /// of all ports mean nothing then.
  using PortSelection = std::vector<unsigned int>;

  PortSelection all_ports(unsigned int number);

  /// det(1 - G df/dz) on some of the ports.
  double port_determinant(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                          const dealii::FullMatrix<double> &tangent);

  /// Adds G f to the displacements of the selected ports.
  void add_response(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                    const dealii::Vector<double> &forces, const PortSelection &selected, dealii::Vector<double> &displacements);

  /// Newton's correction of z on the selected ports where mismatch = z_free + G f - z there, by the tangent of the forces on
  /// `ports`, which are among them. Throws AnalysisError if the tangent is singular.
  dealii::Vector<double> port_correction(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                                         const dealii::FullMatrix<double> &tangent, const PortSelection &selected,
                                         const dealii::Vector<double> &mismatch);
} // namespace sprag
