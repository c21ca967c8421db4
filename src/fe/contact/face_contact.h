// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/batched_step.h"
#include "fe/contact/contact_face.h"
#include "fe/contact/elastic_counterface.h"

#include <memory>

namespace sprag
{
  /// Contact along the friction face of a body, in a plane or in space, over a step in time, with forces consistent with the
  /// scheme, or without inertia: pressure and friction at points denser than the nodes, by the penalty method and with
  /// multipliers if the history has some. The counterface is a rigid cylinder or, in a plane, an elastic one. Its position counts
  /// from the pivot frame's origin, which a sprung support moves.
  template <int dim>
  class FaceContact : public ContactFace<dim>
  {
  public:
    /// `elastic_cylinder`: the face of an elastic cylinder; without elements it is rigid. Faces must outlive the contact.
    FaceContact(const FrictionFace<dim> &face_, FaceProperties properties_, const FrictionFace<dim> &elastic_cylinder = {});

    /// Returns true if forces may be evaluated without a tangent, which steps in time keep, and Request::complete adds the rest.
    bool keeps_tangent() const
    {
      return elastic == nullptr;
    }

    /// Evaluates forces and penetration of a step, in time or without inertia, and the tangent or what Request::complete adds.
    /// Without inertia it finds points in any case: where it is augmented all near the cylinder, else those of
    /// Request::complete.
    void evaluate(const InterfaceStep &step, FaceEvaluation<dim> &found, const std::optional<StaticTerms> &statics = {});

    /// Finds all points near the cylinder of the last evaluation, in time or without inertia.
    void add_points(FaceEvaluation<dim> &found) const;

    /// Evaluates steady sliding: the cylinder's surface runs round its axis at the slide's speed.
    void evaluate_sliding(const SlidingState &sliding, FaceEvaluation<dim> &found);

    /// The same of all elements in contact, whether candidates or not, with its interface forces linearised. Friction
    /// delays at each point in contact, see friction_lag().
    LinearisedForces linearise(const SlidingState &sliding, FaceEvaluation<dim> &found);

    /// Evaluates the contact at rest without force.
    void touch(const dealii::Vector<double> &z, const DrivePoint &drive, FaceEvaluation<dim> &found);

    /// Returns by how much a small change of the displacements changes the gap in the middle of the contact, or where it is
    /// smallest [mm].
    double gap_change(const FaceEvaluation<dim> &found, const dealii::Vector<double> &change, unsigned int lever = 0) const;

    /// Returns the mean slip round the cylinder of the points in contact, weighted with their pressure, from one configuration to
    /// another [mm].
    double mean_slip(const FaceEvaluation<dim> &found, const dealii::Vector<double> &from, double from_x,
                     const dealii::Vector<double> &to, double to_x) const;

    /// Returns the dofs near the cylinder at x from the pivot frame's origin and inclinations theta, and where it was when the
    /// contact had yet to travel so far along xi [mm]. Evaluations that follow look at those alone.
    const DofSelection &candidate_dofs(double x, const PerLever &theta, double travel = 0.);

    void use_penalties(const ContactPenalties &penalties)
    {
      ContactFace<dim>::use_penalties(penalties);
      begin.displacements.reinit(0); // no step has begun with them
    }

  private:
    using Elements  = FaceElements<dim>;
    using Indices   = typename Elements::Indices;
    using Batched   = BatchedStep<dim>;
    using Kind      = typename Batched::Kind;
    using Part      = typename Batched::Part;
    using Constants = typename Batched::Constants;
    using ContactFace<dim>::candidates, ContactFace<dim>::face, ContactFace<dim>::grid, ContactFace<dim>::properties,
        ContactFace<dim>::axis_turn;

    void complete(FaceEvaluation<dim> &found) const;
    void add_points_in_contact(const std::optional<unsigned int> &peak, FaceEvaluation<dim> &found) const;
    RigidCylinder::Pose pose(const FaceConfiguration &at) const;
    Indices near(const FaceConfiguration &at, const RigidCylinder::Pose &cylinder_pose) const;
    Constants constants(Kind kind, const FaceConfiguration &end, StepTerms terms) const;
    void press_slide(const SlidingState &sliding, bool beyond_candidates, FaceEvaluation<dim> &found);
    void begin_step(const InterfaceStep &step, const std::optional<StaticTerms> &statics);
    void press(const Constants &step, const dealii::Vector<double> &displacements, Indices elements_near,
               FaceEvaluation<dim> &found);
    void place_elements(const dealii::Vector<double> &displacements, const std::vector<ContactHistory> &history = {},
                        const std::optional<StaticTerms> &statics = {});
    void press_elements(const dealii::Vector<double> &end, FaceEvaluation<dim> &found);
    Constants step_constants(const InterfaceStep &step, const FaceConfiguration &end,
                             const std::optional<StaticTerms> &statics) const;
    double slip_at(unsigned int point, const dealii::Vector<double> &displacements,
                   const RigidCylinder::Pose &cylinder_pose) const;
    void find_summed(Indices touched);
    void set_forces(Request request, InterfaceForces &forces) const;
    dealii::FullMatrix<double> tangent(Part part) const;
    std::vector<FrictionDelay> friction_delays(const FrictionLaw &law, const FaceEvaluation<dim> &found) const;

    std::vector<std::vector<unsigned int>> element_lines; ///< increasing
    std::vector<bool> is_at_end;                          ///< whether an element is at an end of the face along xi

    StepBegin begin;
    RigidCylinder::Pose begin_pose{};
    std::optional<std::pair<double, bool>> begin_shifts; ///< travel and augmentation, which shifts of slips follow from

    /// Elements whose forces are summed, and their dofs.
    struct Summed
    {
      Indices elements;
      std::vector<unsigned int> dofs;                ///< increasing
      std::vector<InterfaceCoordinates> coordinates; ///< of the elements, with places among the dofs in place of these
    };

    Batched batched;
    std::unique_ptr<ElasticCounterface> elastic;   ///< in a plane, if the cylinder is
    Indices near_elements;                         ///< by the last evaluation
    std::vector<typename Batched::Forces> pressed; ///< of the elements that are summed
    std::optional<unsigned int> most_pressed;      ///< the one of the largest penetration
    Summed summed;
  };
} // namespace sprag
