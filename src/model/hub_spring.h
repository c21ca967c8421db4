#pragma once

#include "laws/moment_law.h"
#include "model/dynamic_model.h"
#include "model/port_layout.h"

namespace sprag
{
  /// What the moment of the rotational spring exceeds its linear part by, as a force on the port of the hub's rotation; the
  /// linear part belongs to the structure. A linear spring does nothing and costs nothing.
  class HubSpringExcess
  {
  public:
    HubSpringExcess(const PortLayout &ports, MomentLaw law);

    /// `others` with the force of a step from one turn of the hub to another added: the mean over the turn (discrete gradient)
    /// with generalised-alpha's delay, so that no energy is made. Valid until the next call, as below.
    const PortForces &add_forces(const PortForces &others, double begin, double end, const StepWeights &weights);

    /// `others` with the force at a turn added.
    const PortForces &add_forces(const PortForces &others, double turn);

    /// Adds the algorithmic dissipation of the step.
    void add_work(double begin, double end, const StepWeights &weights, StepWork &work) const;

    /// [N mm]
    double energy(double turn) const;

    /// Adds the derivative of the force to the matrix of those ports, which hold the rotation if the spring is not linear.
    void add_stiffness(const std::vector<unsigned int> &ports, double turn, dealii::FullMatrix<double> &stiffness) const;

    /// The rotation, or none for a linear spring.
    std::vector<unsigned int> loaded_ports() const;

  private:
    const PortForces &with(const PortForces &others, double force, double tangent);

    const PortLayout layout;
    const MomentLaw law;
    PortForces sum;
  };
} // namespace sprag
