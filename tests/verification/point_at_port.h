// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/dynamic_lever.h"
#include "model/modal_structure.h"

namespace sprag
{
  /// What contacts of verification problems have in common: one point at port 0, always within reach, that never slides steadily.
  class PointAtPort
  {
  public:
    static constexpr bool uses_rates       = false;
    static constexpr bool keeps_tangent    = false;
    static constexpr bool stands_for_layer = false;
    static constexpr unsigned int levers   = 1;

    /// At the end of the step.
    struct Evaluation
    {
      static constexpr bool within_reach = true;

      PortForces forces{ { 0 }, dealii::Vector<double>(1), dealii::FullMatrix<double>(1, 1) };
      ContactMemory remembered;
      StepWork works;
      double stored     = 0.;
      double compressed = 0.;

      std::vector<ContactMemory> memory() const
      {
        return { remembered };
      }
      const StepWork &work() const
      {
        return works;
      }
      double energy() const
      {
        return stored;
      }
      double overlap() const
      {
        return compressed;
      }
    };

    double gap_change(const Evaluation &, const dealii::Vector<double> &, unsigned int) const
    {
      return 0.;
    }
    const PortSelection &reachable_ports(double, const PerLever &) const
    {
      return all;
    }
    void visit_history(Archive &) const
    {
    }

    void widen_reach()
    {
    }
    void evaluate_sliding(const SlidingState &, Evaluation &) const
    {
    }
    std::vector<ContactMemory> touch(const dealii::Vector<double> &, const DrivePoint &, Evaluation &) const
    {
      return { ContactMemory{} };
    }
    double mean_slip(const Evaluation &, const dealii::Vector<double> &, double, const dealii::Vector<double> &, double) const
    {
      return 0.;
    }
    PortPerturbation linearise(const SlidingState &, Evaluation &) const
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
    const PortSelection all = { 0 };
  };

  /// A structure with that contact at its only port, the one that levers turn at.
  template <class Contact>
  DynamicLever<ModalStructure, Contact> with_point_at_port(ModalData structure, const Contact &contact)
  {
    structure.ports = { 0, false };
    LeverFrame frame{ { Geometry{} }, structure.ports, 0., {}, 0., 0., dealii::Vector<double>(1) };
    frame.lengths = 1.;
    return { std::make_unique<ModalStructure>(structure), std::make_unique<Contact>(contact), frame };
  }
} // namespace sprag
