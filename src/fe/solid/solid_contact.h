// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/surface_observation.h"

namespace sprag
{
  /// The contact of a lever in three dimensions in time and in held slides, see DynamicLever, on a face of its own.
  class SolidContact
  {
  public:
    static constexpr bool uses_rates       = false;
    static constexpr bool stands_for_layer = false;
    static constexpr bool keeps_tangent    = true;
    static constexpr unsigned int levers   = 1;

    using Evaluation = SurfaceEvaluation;

    /// `layer_thickness` [mm]; `half`: the face is half of one which is the same on both sides of the middle.
    SolidContact(FrictionFace<3> face, SurfaceContactProperties properties, FrictionLaw friction, double layer_thickness,
                 bool half);

    void evaluate(const PortStep &step, SurfaceEvaluation &found);
    void complete(SurfaceEvaluation &found);
    void evaluate_sliding(const SlidingState &state, SurfaceEvaluation &found);
    PortPerturbation linearise(const SlidingState &state, SurfaceEvaluation &found);
    std::vector<SurfaceMemory> touch(const dealii::Vector<double> &ports, const DrivePoint &drive, SurfaceEvaluation &found);

    const PortSelection &reachable_ports(double x, const OfLevers &theta);

    void widen_reach()
    {
      contact.widen_reach();
    }

    const ContactPenalties &penalties() const
    {
      return contact.penalties();
    }

    /// Where the pressure is largest, or where the gap is smallest.
    double gap_change(const SurfaceEvaluation &found, const dealii::Vector<double> &change_of_ports,
                      unsigned int lever = 0) const;

    /// Mean slip round the cylinder of the points in contact, weighted with their pressure, from one configuration to another.
    double mean_slip(const SurfaceEvaluation &found, const dealii::Vector<double> &from, double from_x,
                     const dealii::Vector<double> &to, double to_x) const;

    void observe(const SurfaceEvaluation &found, Row &row, unsigned int lever = 0) const;

    /// Returns Q at the end of the step [N].
    double drive_force(const SurfaceEvaluation &found) const;

    /// Displacements of the nodes at the middle of the width.
    SurfaceShape surface_shape(const dealii::Vector<double> &displacements, unsigned int lever = 0) const;

    FacePoints face_points() const
    {
      return view.points();
    }

    FaceState face_state(const SurfaceEvaluation &found, const DrivePoint &drive) const
    {
      return view.state(found, drive);
    }

    void visit_history(Archive &archive)
    {
      contact.visit_history(archive);
    }

  private:
    double indentation(const SurfaceEvaluation &found, const Row &row) const;
    std::vector<unsigned int> line_at(double zeta) const;

    const FrictionFace<3> face;
    const FrictionLaw friction;
    const double layer_thickness;
    SurfaceContact contact;
    const SurfaceView view;
  };
} // namespace sprag
