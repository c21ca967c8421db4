// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/algebra/mumps.h"
#include "fe/dynamics/lever_interface.h"
#include "model/interface/interface_forces.h"

namespace sprag
{
  /// Damping of single modes as forces against them: the sum of factor (M phi) (M phi)^T.
  struct ModalDamping
  {
    std::vector<dealii::Vector<double>> directions; ///< M phi
    std::vector<double> factors;                    ///< 2 zeta omega [1/s], > 0
  };

  /// Inverse of S + B D B^T without the support: S is a weighted sum of a lever's matrices, kept as factors, and B = M phi, D
  /// diagonal are its modal damping. By the Woodbury formula it is
  ///   S^-1 - S^-1 B (D^-1 + B^T S^-1 B)^-1 B^T S^-1.
  class EffectiveSystem
  {
  public:
    /// `damping_weight` 0: without the modal damping. Arguments must outlive the system.
    EffectiveSystem(const InertialMatrices &matrices, const LeverInterface &interface, const ModalDamping &damping,
                    const InertialMatrices::Weights &weights, double damping_weight);

    /// Compliance of the lever's interface.
    dealii::FullMatrix<double> interface_compliance() const;

    /// Right-hand side and solution without the support.
    dealii::Vector<double> solve(const dealii::Vector<double> &right_hand_side) const;

    /// Returns the displacements by forces on the interface dofs, the support's excepted, without the support.
    dealii::Vector<double> response(const DofLoads &forces) const;

  private:
    void subtract_low_rank(dealii::FullMatrix<double> &compliance) const;

    /// Sets row and column of a dof that is not a coordinate.
    void append(unsigned int dof, dealii::FullMatrix<double> &compliance) const;

    const InertialMatrices &matrices;
    const LeverInterface &interface;
    const ModalDamping &damping;
    const InertialMatrices::Weights weights;
    Mumps factors;
    std::vector<dealii::Vector<double>> damped; ///< S^-1 M phi, S without modal damping
    dealii::FullMatrix<double> low_rank;        ///< (D^-1 + (M phi)^T S^-1 M phi)^-1
  };
} // namespace sprag
