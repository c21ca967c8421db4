// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_layout.h"
#include "model/step/dynamic_model.h"

namespace sprag
{
  /// Inertia that couples a lever, or both of a pair, with the frame its pivot is on: kinetic energy u' h.p' of the support's
  /// speed u' along x and each lever's momentum, h = (sin theta, -cos theta) on the momentum dofs. Without a sprung support it
  /// does nothing.
  class FrameCoupling
  {
  public:
    FrameCoupling(const InterfaceLayout &layout, double rest_inclination);

    /// Adds the forces of a step.
    void add_forces(const Kinematic &begin, const dealii::Vector<double> &end, const StepWeights &weights,
                    InterfaceForces &forces) const;

    /// Adds the coupling's mass at inclinations theta to the matrix of those dofs, which must hold its own.
    void add_inertia(const DofSelection &dofs, const PerLever &theta, dealii::FullMatrix<double> &inertia) const;

    /// Returns the dofs it acts on, increasing; none without a sprung support.
    DofSelection coupled_dofs() const;

    /// Adds the algorithmic dissipation of the step.
    void add_work(const Kinematic &begin, const dealii::Vector<double> &end, const StepWeights &weights, StepWork &work) const;

    double kinetic_energy(const Kinematic &motion) const;

  private:
    double inclination(unsigned int lever, const Kinematic &begin, const Kinematic &end, const StepWeights &weights) const;

    const InterfaceLayout layout;
    const double rest;
  };
} // namespace sprag
