// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact_point.h"

#include <string>

namespace sprag
{
  /// The result of an evaluation of a contact. The caller keeps it and may use it for the next one.
  template <int dim>
  struct FaceEvaluation
  {
    dealii::Vector<double> displacement; ///< of the ports
    double x          = 0.;              ///< of the drive [mm]
    double duration   = 0.;              ///< of the step; 0: no slip speed [s]
    bool within_reach = true;            ///< whether the contact was within the ports that it may reach
    ContactSums sums;
    std::vector<FacePointState<dim>> points; ///< near the obstacle, by increasing point; in three dimensions see SurfaceContact
    PortForces forces;

    /// Forgets what was found and begins another evaluation.
    void begin(const dealii::Vector<double> &ports, double at_x, double of_duration);

    /// Returns the memory of the points in contact, by increasing point. Throws AnalysisError where there is an objection().
    std::vector<PointMemory<dim - 1>> memory() const;

    /// Tells why the contact goes beyond what can touch; empty if it does not.
    std::string objection() const;

    /// Returns the works of the step.
    const StepWork &work() const
    {
      return sums.work;
    }

    /// Returns the energy of the contact springs [N mm].
    double energy() const
    {
      return sums.stored;
    }

    /// Returns the largest compression of the contact springs in the step, with multipliers p / penalty [mm].
    double overlap() const
    {
      return sums.compression;
    }
  };
} // namespace sprag
