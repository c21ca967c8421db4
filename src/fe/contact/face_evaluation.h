#pragma once

#include "fe/contact/face_contact_point.h"
#include <string>

namespace sprag
{
  /// What an evaluation of a FaceContact found.
  struct FaceEvaluation
  {
    dealii::Vector<double> displacement; ///< of the ports
    double x          = 0.;              ///< of the drive
    double duration   = 0.;              ///< of the step; 0: no slip speed [s]
    bool within_reach = true;            ///< whether the contact was within the ports that it may reach
    ContactSums sums;
    std::vector<FacePointState<2>> points; ///< of the patches near the obstacle, by increasing point; those elsewhere are open
    PortForces forces;

    /// Memory of the points in contact, increasing. Throws AnalysisError where there is an objection().
    std::vector<ContactMemory> memory() const;

    /// Why the contact goes beyond what can touch; empty if it does not.
    std::string objection() const;

    const StepWork &work() const
    {
      return sums.work;
    }

    /// Energy of the contact springs [N mm].
    double energy() const
    {
      return sums.stored;
    }

    /// Largest compression of the contact springs in the step, with multipliers p / penalty [mm].
    double overlap() const
    {
      return sums.compression;
    }

    /// Largest overlap of a point and the obstacle [mm].
    double penetration() const;
  };
} // namespace sprag
