// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_compliance.h"

#include <deal.II/lac/vector.h>

namespace sprag
{
  // Forces act on a linear structure at its interface, whose degrees of freedom are called dofs. Their displacements are
  //   z = z_free + G f(z),   G its compliance.

  /// Forces on some dofs.
  struct DofLoads
  {
    std::vector<unsigned int> dofs; ///< increasing
    dealii::Vector<double> values;
  };

  /// Forces on some dofs and their derivatives by the displacements of the same dofs, unsymmetric.
  struct InterfaceForces : DofLoads
  {
    dealii::FullMatrix<double> tangent;
    bool has_tangent = true; ///< false: it was not requested and is empty
  };

  // Add dofs (increasing) with zero forces.
  void add_dofs(const DofSelection &others, DofLoads &loads);
  void add_dofs(const DofSelection &others, InterfaceForces &forces);

  /// Sums forces on possibly common dofs in any order.
  void sum_forces(const std::vector<InterfaceForces> &loaded, InterfaceForces &sum);

  /// Output requested of a contact. One that does not keep its tangent always finds all of it.
  enum class Request
  {
    forces,
    with_tangent,
    complete ///< forces, works, energy and points: those that may take part and, along the lines where the pressure is largest,
             ///< all near the cylinder; all of these where nothing touches
  };

  /// Returns 0 ... number - 1.
  DofSelection all_dofs(unsigned int number);

  /// Adds G f to the displacements of the selected dofs.
  void add_response(const InterfaceCompliance &compliance, const DofSelection &dofs, const dealii::Vector<double> &forces,
                    const DofSelection &selected, dealii::Vector<double> &displacements);

  /// Returns Newton's correction dz = (1 - G df/dz)^-1 (z_free + G f - z) on the selected dofs, the last factor as `mismatch`.
  /// `tangent` is df/dz on `dofs`, a subset of the selected. Throws AnalysisError if 1 - G df/dz is singular.
  dealii::Vector<double> interface_correction(const InterfaceCompliance &compliance, const DofSelection &dofs,
                                              const dealii::FullMatrix<double> &tangent, const DofSelection &selected,
                                              const dealii::Vector<double> &mismatch);
} // namespace sprag
