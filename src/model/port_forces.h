#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

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
  };

  /// Adds G f to the displacements of all ports. G is symmetric.
  void add_response(const dealii::FullMatrix<double> &compliance, const std::vector<unsigned int> &ports,
                    const dealii::Vector<double> &forces, dealii::Vector<double> &displacements);

  /// Newton's correction of z where mismatch = z_free + G f - z. Throws AnalysisError if the tangent is singular.
  dealii::Vector<double> port_correction(const dealii::FullMatrix<double> &compliance, const PortForces &forces,
                                         const dealii::Vector<double> &mismatch);
} // namespace sprag
