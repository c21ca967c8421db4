// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "model/generalised_alpha.h"
#include "model/port_forces.h"
#include "model/reduced_factors.h"

#include <memory>

namespace sprag
{
  /// Derivative of the contact's forces by displacements of their ports that steps in time take from one to the next: a contact
  /// wanders little in a step, so that it serves the corrections of several.
  struct KeptTangent
  {
    std::vector<unsigned int> ports; ///< increasing
    dealii::FullMatrix<double> matrix;
  };

  void visit(Archive &archive, std::shared_ptr<const KeptTangent> &kept);

  /// Factors of 1 - A G of kept tangents A with the compliances G of steps, see ReducedFactors: what a correction of forces
  /// leaves of their unbalance the next one finds.
  class KeptFactors
  {
  public:
    /// Looks for the factors of a tangent and the compliance of a step with these weights, else makes them. Returns whether there
    /// are: none where the matrix is singular.
    bool use(std::shared_ptr<const KeptTangent> kept, const PortCompliance &compliance, const StepWeights &weights);

    /// The ports of the tangent in use.
    const std::vector<unsigned int> &ports() const;

    /// Returns the change of forces on these ports by which they follow displacements, from what they differ by.
    dealii::Vector<double> solve(const dealii::Vector<double> &difference) const;

    /// The size of what forces on these ports move, see ReducedFactors::movement_by().
    double movement_by(const dealii::Vector<double> &forces) const;

  private:
    struct Factors
    {
      std::shared_ptr<const KeptTangent> of;
      double dt;
      double alpha_f;
      std::unique_ptr<const ReducedFactors> factors; ///< none of no ports
    };

    std::vector<Factors> known; ///< the latest in use last
  };
} // namespace sprag
