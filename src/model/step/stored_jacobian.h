// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "model/interface/interface_factors.h"
#include "model/interface/interface_forces.h"
#include "model/step/generalised_alpha.h"

#include <memory>
#include <optional>

namespace sprag
{
  /// Derivative of the contact's forces by interface displacements, kept over several steps in time, in each of which the contact
  /// changes little.
  struct StoredJacobian
  {
    std::vector<unsigned int> dofs; ///< increasing
    dealii::FullMatrix<double> matrix;
  };

  void serialise(Archive &archive, StoredJacobian &jacobian);

  /// Factors of 1 - G A, with the stored Jacobian A and the compliance G of steps of one duration.
  class JacobianFactors
  {
  public:
    /// Factorises with the compliance of a step with these weights, unless that was done last. Returns false where the matrix
    /// is singular.
    bool use(std::shared_ptr<const StoredJacobian> jacobian, const InterfaceCompliance &compliance, const StepWeights &weights);

    const StoredJacobian &jacobian() const
    {
      return *stored;
    }

    /// Returns InterfaceFactors::reaction() of the stored Jacobian.
    dealii::Vector<double> reaction(const dealii::Vector<double> &displacements) const
    {
      return factors->reaction(stored->matrix, displacements);
    }

  private:
    std::shared_ptr<const StoredJacobian> stored;
    double dt      = 0.;
    double alpha_f = 0.;
    std::optional<InterfaceFactors> factors;
  };
} // namespace sprag
