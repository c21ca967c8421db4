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
    static constexpr bool stands_for_layer = false;
    static constexpr unsigned int levers   = 1;

    PointAtPort()
    {
      at_port.ports = all;
      at_port.values.reinit(1);
      at_port.tangent.reinit(1, 1);
    }
    double gap_change(const dealii::Vector<double> &) const
    {
      return 0.;
    }
    const PortForces &forces() const
    {
      return at_port;
    }
    const PortSelection &reachable_ports(double, double) const
    {
      return all;
    }
    bool within_reach() const
    {
      return true;
    }
    void widen_reach()
    {
    }
    void evaluate_sliding(const SlidingState &)
    {
    }
    std::vector<ContactMemory> touch(const dealii::Vector<double> &, const DrivePoint &)
    {
      return { ContactMemory{} };
    }
    double mean_slip(const dealii::Vector<double> &, double, const dealii::Vector<double> &, double) const
    {
      return 0.;
    }
    PortPerturbation linearise(const SlidingState &)
    {
      return {};
    }
    SurfaceShape surface_shape(const dealii::Vector<double> &) const
    {
      return {};
    }
    FacePoints face_points() const
    {
      return {};
    }
    FaceState face_state(const DrivePoint &) const
    {
      return {};
    }
    std::vector<ContactMemory> memory() const
    {
      return { memory_after };
    }
    void add_work(StepWork &sum) const
    {
      sum.friction += work.friction;
      sum.damping += work.damping;
      sum.algorithmic += work.algorithmic;
      sum.creep += work.creep;
    }
    double energy() const
    {
      return stored;
    }
    void observe(Row &) const
    {
    }

  protected:
    // At the end of the step.
    PortForces at_port;
    ContactMemory memory_after;
    StepWork work;
    double stored = 0.;

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
