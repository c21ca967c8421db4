// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/lever/dynamic_lever.h"
#include "model/structure/modal_structure.h"

namespace sprag
{
  /// Base of the contacts of verification problems: one point at dof 0, always a candidate, that never slides steadily.
  class PointAtInterface
  {
  public:
    static constexpr bool uses_rates       = false;
    static constexpr bool stands_for_layer = false;
    static constexpr bool looks_beside     = false;
    static constexpr unsigned int levers   = 1;

    /// The contact at the end of the step.
    struct Evaluation
    {
      static constexpr bool within_candidates = true;

      InterfaceForces forces{ { { 0 }, dealii::Vector<double>(1) }, dealii::FullMatrix<double>(1, 1) };
      ContactHistory last_history;
      StepWork works;
      double stored = 0.;
      double depth  = 0.;

      std::vector<ContactHistory> history() const
      {
        return { last_history };
      }
      const StepWork &work() const
      {
        return works;
      }
      double energy() const
      {
        return stored;
      }
      double penetration() const
      {
        return depth;
      }
    };

    bool keeps_tangent() const
    {
      return false;
    }

    double gap_change(const Evaluation &, const dealii::Vector<double> &, unsigned int) const
    {
      return 0.;
    }
    const DofSelection &candidate_dofs(double, const PerLever &) const
    {
      return all;
    }
    void serialise_history(Archive &) const
    {
    }

    void widen_candidates()
    {
    }
    void evaluate_sliding(const SlidingState &, Evaluation &) const
    {
    }
    void touch(const dealii::Vector<double> &, const DrivePoint &, Evaluation &) const
    {
    }
    double mean_slip(const Evaluation &, const dealii::Vector<double> &, double, const dealii::Vector<double> &, double) const
    {
      return 0.;
    }
    LinearisedForces linearise(const SlidingState &, Evaluation &) const
    {
      return {};
    }
    SurfaceShape surface_shape(const dealii::Vector<double> &, unsigned int) const
    {
      return {};
    }
    FacePoints face_points() const
    {
      return {};
    }
    FaceState face_state(const Evaluation &, const DrivePoint &) const
    {
      return {};
    }
    void observe(const Evaluation &, Row &, unsigned int) const
    {
    }
    double drive_force(const Evaluation &) const
    {
      return 0.;
    }

  private:
    const DofSelection all = { 0 };
  };

  /// A structure with that contact at its only dof, the rotation of levers.
  template <class Contact>
  DynamicLever<ModalStructure, Contact> with_point_at_interface(ModalData structure, const Contact &contact)
  {
    structure.layout = { 0, false };
    LeverFrame frame{ { Geometry{} }, structure.layout, 0., { MomentLaw() }, 0., 0., dealii::Vector<double>(1) };
    frame.lengths = 1.;
    return { std::make_unique<ModalStructure>(structure), std::make_unique<Contact>(contact), frame };
  }
} // namespace sprag
