#pragma once

#include "model/dynamic_lever.h"

namespace sprag
{
  /// What contacts of verification problems have in common: one point at port 0, always within reach, that never slides steadily.
  class PointAtPort
  {
  public:
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

  protected:
    PortForces at_port;

  private:
    const PortSelection all = { 0 };
  };
} // namespace sprag
