// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/dynamic_model.h"
#include "model/port_layout.h"

namespace sprag
{
  /// Inertia that couples a lever, or both of a pair, with the frame its pivot is on: kinetic energy u' h.p' of the support's
  /// speed u' along x and each lever's momentum, h = (sin theta, -cos theta) on the momentum ports. Without a sprung support it
  /// does nothing.
  class FrameCoupling
  {
  public:
    FrameCoupling(const PortLayout &ports, double rest_inclination);

    /// Adds the forces of a step.
    void add_forces(const Kinematic &begin, const dealii::Vector<double> &end, const StepWeights &weights,
                    PortForces &forces) const;

    /// Adds the coupling's mass at inclinations theta to the matrix of those ports, which must hold its own.
    void add_inertia(const std::vector<unsigned int> &ports, const PerLever &theta, dealii::FullMatrix<double> &inertia) const;

    /// The ports it acts on, increasing; none without a sprung support.
    std::vector<unsigned int> coupled_ports() const;

    /// Adds the algorithmic dissipation of the step.
    void add_work(const Kinematic &begin, const dealii::Vector<double> &end, const StepWeights &weights, StepWork &work) const;

    double kinetic_energy(const Kinematic &ports) const;

  private:
    const PortLayout layout;
    const double rest;
  };
} // namespace sprag
