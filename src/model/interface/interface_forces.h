// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_compliance.h"

#include <deal.II/lac/vector.h>

namespace sprag
{
  // Forces act on a linear structure at its interface, whose degrees of freedom are called dofs. Their displacements are
  //   z = z_free + G f(z),   G its compliance.

  /// Forces on some dofs and their derivatives by the displacements of the same dofs, unsymmetric.
  struct InterfaceForces
  {
    std::vector<unsigned int> dofs; ///< increasing
    dealii::Vector<double> values;
    dealii::FullMatrix<double> tangent;
    bool has_tangent = true; ///< else it was not wanted and is empty
  };

  /// Gives forces further dofs, increasing, where they are 0 so far.
  void add_dofs(const std::vector<unsigned int> &others, InterfaceForces &forces);

  /// Sums up forces that share dofs, which may come in any order. `dof_places` is room for a number a dof.
  void sum_forces(const std::vector<InterfaceForces> &loaded, std::vector<unsigned int> &dof_places, InterfaceForces &sum);

  /// Output requested of a contact. One that does not keep its tangent always finds all of it.
  enum class Request
  {
    forces,
    with_tangent,
    complete ///< forces, works, energy and points: those that may take part and, along the lines where the pressure is largest,
             ///< all near the cylinder; all of these where nothing touches
  };

  /// Forces on some dofs.
  struct DofLoads
  {
    std::vector<unsigned int> dofs; ///< increasing
    dealii::Vector<double> values;
  };

  DofSelection all_dofs(unsigned int number);

  /// Returns det(1 - G df/dz) on some dofs.
  double interface_determinant(const InterfaceCompliance &compliance, const DofSelection &dofs,
                               const dealii::FullMatrix<double> &tangent);

  /// Adds G f to the displacements of the selected dofs.
  void add_response(const InterfaceCompliance &compliance, const DofSelection &dofs, const dealii::Vector<double> &forces,
                    const DofSelection &selected, dealii::Vector<double> &displacements);

  /// Returns Newton's correction of z on the selected dofs where mismatch = z_free + G f - z there, by the tangent of the forces
  /// on `dofs`, which are among them. Throws AnalysisError if the tangent is singular.
  dealii::Vector<double> interface_correction(const InterfaceCompliance &compliance, const DofSelection &dofs,
                                              const dealii::FullMatrix<double> &tangent, const DofSelection &selected,
                                              const dealii::Vector<double> &mismatch);
} // namespace sprag
