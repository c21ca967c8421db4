// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact_point.h"
#include "fe/contact/face_parts.h"
#include "fe/contact/pressure_recovery.h"
#include "results/columns.h"
#include "results/result_file.h"

namespace sprag
{
  /// The result of an evaluation of a contact. The caller keeps it and may use it for the next one.
  template <int dim>
  struct FaceEvaluation
  {
    dealii::Vector<double> displacement; ///< of the dofs
    double x          = 0.;              ///< of the drive [mm]
    double duration   = 0.;              ///< of the step; 0: no slip speed [s]
    bool within_reach = true;            ///< whether the contact was within the candidate dofs
    ContactSums sums;
    std::vector<FacePointState<dim>>
        points; ///< near the counterface, by increasing point; in three dimensions see SurfaceContact
    InterfaceForces forces;

    /// Forgets what was found and begins another evaluation.
    void begin(const dealii::Vector<double> &displacements, double at_x, double duration_);

    /// Returns the history of the points in contact, by increasing point. Throws AnalysisError where
    /// check_validity() objects.
    std::vector<PointHistory<dim - 1>> history() const;

    /// Tells why the contact goes beyond what can touch; empty if it does not.
    std::string check_validity() const;

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

    /// Returns the largest penetration of the contact springs in the step, with multipliers p / penalty [mm].
    double penetration() const
    {
      return sums.penetration;
    }
  };

  /// A friction face as results show it: the means over its FaceParts.
  template <int dim>
  class FaceView
  {
  public:
    /// Face and elements must outlive this. `half`: the face is half of one which is the same on both sides of the middle.
    FaceView(const FrictionFace<dim> &face, const FaceElements<dim> &grid, bool half = false);

    /// Fills the columns that follow from tractions and positions on the face.
    void observe(const FaceEvaluation<dim> &found, Row &row) const;

    /// Fills those of them that are sums over the points under pressure.
    void observe_resultants(const FaceEvaluation<dim> &found, Row &row) const;

    /// Returns the parts of the face.
    const FacePoints &points() const
    {
      return parts.points;
    }

    FaceState state(const FaceEvaluation<dim> &found, const DrivePoint &drive) const;

    /// Returns Q at the end of the step [N].
    double drive_force(const FaceEvaluation<dim> &found) const;

  private:
    void observe_pressure(const FaceEvaluation<dim> &found, Row &row) const;
    PressureSamples pressure_samples(const FaceEvaluation<dim> &found, unsigned int line) const;

    const FrictionFace<dim> &face;
    const FaceElements<dim> &grid;
    const bool is_half;
    const FaceParts parts;
  };

  /// Returns the deflection of a layer's face in a plane at the centre of pressure over that aside of the contact, from the
  /// columns that FaceView fills [mm]; 0 without a layer.
  double indentation(const FrictionFace<2> &face, const FaceEvaluation<2> &found, const Row &row, double layer_thickness);
} // namespace sprag
