// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/contact/circle.h"
#include "model/contact/contact_step.h"
#include "model/interface/interface_coordinates.h"
#include "model/step/interface_step.h"
#include "model/step/linearisation.h"
#include "model/structure/beam.h"

#include <algorithm>

namespace sprag
{
  /// Constants of the contact of a reduced lever.
  struct PointContactProperties
  {
    Geometry geometry;
    BeamMesh mesh;
    InterfaceLayout layout;
    double rest_inclination    = 0.; ///< theta without moment [rad]
    double neutral_axis_offset = 0.; ///< e_a [mm]
    NormalLaw normal;                ///< [N/mm^n]
    double damping    = 0.;          ///< [N s/mm]
    double tangential = 0.;          ///< [N/mm]
    FrictionLaw friction;
  };

  /// The circle against a beam: one contact point, which moves along the bent surface
  ///   p(xi) = (xi - (e - e_a) w'(xi), e + w(xi))
  /// to where it is closest to the circle's centre.
  class PointContact
  {
  private:
    // Local coordinates: deflection and slope of three nodes in a row, theta, x of the circle from the pivot frame's origin.
    static constexpr unsigned int n           = 8;
    static constexpr unsigned int n_nodal     = 6;
    static constexpr unsigned int theta_index = 6;
    static constexpr unsigned int x_index     = 7;
    using Local                               = dealii::Tensor<1, n>;
    using LocalMatrix                         = dealii::Tensor<2, n>;

    /// The closest point at one configuration. Its slip row is that of the material point, of no slip coordinate; the curvature
    /// is that row's derivative as the contact point moves with the configuration.
    struct Configuration : ContactKinematics<n>
    {
      double along = 0.;                 ///< its position along the lever, deformed
      dealii::Tensor<1, 4> gap_at_point; ///< rows in (u_xi, u_eta, theta, x) of the point
      dealii::Tensor<1, 4> slip_at_point;
    };

  public:
    static constexpr bool uses_rates       = true;
    static constexpr bool stands_for_layer = true; ///< its springs are physical, not penalties
    static constexpr bool looks_beside     = false;
    static constexpr unsigned int levers   = 1;

    /// The result of an evaluation. The caller keeps it and may use it for the next one.
    class Evaluation
    {
    public:
      static constexpr bool within_candidates = true; ///< all dofs are

      InterfaceForces forces;

      std::vector<ContactHistory> history() const
      {
        return { response.history };
      }
      const StepWork &work() const
      {
        return works;
      }
      double energy() const
      {
        return response.energy;
      }
      double penetration() const
      {
        return std::max(0., -end.gap);
      }

    private:
      friend class PointContact;

      unsigned int node = 0; ///< node before the first local one
      Configuration end;
      StepResponse<n> response;
      StepWork works;
      double slip_rate = 0.;   ///< at the end of the step [mm/s]
      SlidingFriction sliding; ///< in steady sliding
      Local d_pressure;        ///< dP/dq there
      Local d_pressure_rate;   ///< dP/dq'
    };

    explicit PointContact(PointContactProperties properties);

    /// Returns whether forces may be evaluated without a tangent, which steps in time then keep.
    bool keeps_tangent() const
    {
      return false;
    }

    /// Evaluates a step in time.
    void evaluate(const InterfaceStep &step, Evaluation &found) const;

    /// Evaluates steady sliding.
    void evaluate_sliding(const SlidingState &state, Evaluation &found) const;

    /// Evaluates steady sliding and linearises its interface forces.
    LinearisedForces linearise(const SlidingState &state, Evaluation &found) const;

    /// Returns the dofs that the contact may touch: all.
    const DofSelection &candidate_dofs(double x, const PerLever &theta) const;
    void widen_candidates()
    {
    }
    /// Evaluates the contact at rest without force.
    void touch(const dealii::Vector<double> &z, const DrivePoint &drive, Evaluation &found) const;
    /// Returns by how much a small change of the displacements changes the gap [mm].
    double gap_change(const Evaluation &found, const dealii::Vector<double> &change, unsigned int lever = 0) const;

    /// Returns the slip from one configuration to another [mm].
    double mean_slip(const Evaluation &found, const dealii::Vector<double> &from, double from_x, const dealii::Vector<double> &to,
                     double to_x) const;
    /// Fills the columns of a row that follow from the contact.
    void observe(const Evaluation &found, Row &row, unsigned int lever = 0) const;

    /// Returns Q at the end of the step [N].
    double drive_force(const Evaluation &found) const;

    /// Returns the displacements of the lever's surface that go with those of the interface.
    SurfaceShape surface_shape(const dealii::Vector<double> &displacements, unsigned int lever = 0) const;

    /// There is no friction face.
    FacePoints face_points() const
    {
      return {};
    }
    FaceState face_state(const Evaluation &, const DrivePoint &) const
    {
      return {};
    }

    /// There is none.
    void serialise_history(Archive &)
    {
    }

  private:
    template <class N>
    struct Surface;

    /// The place along the lever that is closest to the circle's centre, the derivative of (p - c) . p' there, and the first
    /// coordinate of the element that it is found in, a little beyond whose end it may lie.
    struct Closest
    {
      double xi, d_slope;
      unsigned int first;
    };

    unsigned int find_node(const dealii::Vector<double> &z, double x) const;
    Local coordinates(unsigned int node, const dealii::Vector<double> &z, double x) const;
    Local rates(unsigned int node, const dealii::Vector<double> &interface_rates, double v) const;
    unsigned int first_element_dof(unsigned int node, double xi) const;
    template <class N, class Nodal>
    Surface<N> surface(unsigned int node, unsigned int first, const Nodal &nodal, const N &xi) const;
    Closest closest(unsigned int node, const Local &q) const;
    double gap(unsigned int node, const Local &q) const;
    Configuration configure(unsigned int node, const Local &q) const;
    StepKinematics<n> step_kinematics(const InterfaceStep &step, const Local &end_rates, Evaluation &found) const;
    void sum_forces(Evaluation &found) const;
    static LocalMatrix pressure_tangent(const Evaluation &found);
    LocalMatrix friction_tangent(ContactFriction friction, const Evaluation &found) const;

    InterfaceCoordinates interface_coordinates(unsigned int node) const;
    std::vector<FrictionDelay> friction_delays(const InterfaceCoordinates &places, const FrictionLaw &law,
                                               const Evaluation &found) const;

    const PointContactProperties properties;
    const DofSelection all;
  };
} // namespace sprag
