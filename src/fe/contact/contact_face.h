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
    double x               = 0.;         ///< of the drive [mm]
    double duration        = 0.;         ///< of the step; 0: no slip speed [s]
    bool within_candidates = true;       ///< whether the contact was within the candidate dofs
    ContactSums sums;
    std::vector<FacePointState<dim>> points; ///< near the counterface, by increasing point, see FaceContact::evaluate()
    InterfaceForces forces;

    /// Resets the results and begins another evaluation.
    void begin(const dealii::Vector<double> &displacements, double at_x, double duration_);

    /// Returns the history of the points in contact, by increasing point. Throws AnalysisError where
    /// check_validity() objects.
    std::vector<ContactHistory> history() const;

    /// Returns why the contact leaves the range where the model is valid; empty if it does not.
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

  /// Returns the mean of `value`(point) over the points in contact, weighted with their pressure; 0 without any.
  template <int dim, class Value>
  double pressure_mean(const FrictionFace<dim> &face, const FaceEvaluation<dim> &found, const Value &value)
  {
    double weighted = 0., weights = 0.;
    for (const auto &point : found.points)
      if (point.pressure > 0.)
      {
        const double weight = face.points[point.index].weight * point.pressure;
        weighted += weight * value(point);
        weights += weight;
      }
    return weights > 0. ? weighted / weights : 0.;
  }

  /// A friction face in contact, of a plane or in space: its elements, how far contact is sought on it, and its FaceParts, which
  /// results show.
  template <int dim>
  class ContactFace
  {
  public:
    static constexpr bool uses_rates       = false;
    static constexpr bool stands_for_layer = false; ///< its springs are penalties
    static constexpr unsigned int levers   = 1;
    static constexpr bool looks_beside     = dim == 3; ///< the indentation follows from dofs beside the contact
    using Evaluation                       = FaceEvaluation<dim>;

    /// The face must outlive this.
    ContactFace(const FrictionFace<dim> &face, FaceProperties properties);

    const ContactPenalties &penalties() const
    {
      return properties.penalties;
    }

    /// Evaluates with other penalties from now on [N/mm^3], > 0.
    void use_penalties(const ContactPenalties &penalties)
    {
      properties.penalties = penalties;
    }

    /// Doubles how far candidate dofs reach, from the next call on. To be called where an evaluation was not within them.
    void widen_candidates()
    {
      candidates.factor *= 2.;
    }

    /// Fills the columns of a row that follow from the contact, in space without the indentation.
    void observe(const Evaluation &found, Row &row, unsigned int lever = 0) const;

    /// Fills all of them but the indentation.
    void observe_contact(const Evaluation &found, Row &row) const;

    /// Fills those of them that are sums over the points under pressure.
    void observe_resultants(const Evaluation &found, Row &row) const;

    /// Returns the shares of the displacements of the face's dofs in space, by increasing dof, whose sum is the indentation of
    /// its layer, from columns of a row that are filled: the deflection at the centre of pressure over that aside of the contact,
    /// along the line of nodes that lies closest to the largest pressure. None without a layer, lines or contact.
    DofLoads indentation_shares(const Row &row, unsigned int lever = 0) const;

    /// Returns the slopes of the cylinder's axis in space.
    AxisSlopes slopes_in(const Evaluation &found) const;

    /// Returns the displacements of the nodes in the middle of the width, in a plane of all.
    SurfaceShape surface_shape(const dealii::Vector<double> &displacements, unsigned int lever = 0) const;

    /// Returns the parts of the face.
    const FacePoints &face_points() const
    {
      return parts.points;
    }

    FaceState face_state(const Evaluation &found, const DrivePoint &drive) const;

    /// Returns Q at the end of the step [N].
    double drive_force(const Evaluation &found) const;

    /// Serialises how far contact is sought.
    void serialise_history(Archive &archive)
    {
      archive(candidates.factor);
    }

  protected:
    /// Returns by how much displacements or their rates turn the cylinder's axis in space.
    AxisSlopes axis_turn(const dealii::Vector<double> &displacements) const;

    const FrictionFace<dim> &face;
    FaceElements<dim> grid;
    FaceProperties properties;
    FaceCandidates<dim> candidates;

  private:
    void observe_pressure(const Evaluation &found, Row &row) const;
    PressureSamples pressure_samples(const Evaluation &found, unsigned int line) const;

    const FaceParts parts;
    std::vector<std::vector<unsigned int>> lines; ///< of nodes along xi, in space
  };
} // namespace sprag
