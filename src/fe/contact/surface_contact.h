// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/batched_step.h"
#include "fe/contact/face_contact.h"

namespace sprag
{
  /// Contact of a rigid cylinder along the friction face of a body in three dimensions by the penalty method: pressure and, in
  /// two directions, friction at the points of the face. What FaceContact has as well is as there.
  class SurfaceContact : public ContactFace<3>
  {
  public:
    static constexpr bool keeps_tangent = true;

    /// The face must outlive the contact.
    SurfaceContact(const FrictionFace<3> &face, FaceProperties<3> properties);

    /// Evaluates forces and penetration of a step, in time or without inertia, and the tangent or what Request::complete adds.
    /// Without inertia it finds points in any case: where it is augmented all near the cylinder, else those of
    /// Request::complete.
    void evaluate(const InterfaceStep &step, FaceEvaluation<3> &found, const std::optional<StaticTerms> &statics = {});

    /// Finds all points near the cylinder of the last evaluation, in time or without inertia.
    void add_points(FaceEvaluation<3> &found) const;

    /// Evaluates steady sliding: the cylinder's surface runs round its axis at the slide's speed.
    void evaluate_sliding(const SlidingState &sliding, FaceEvaluation<3> &found);

    /// The same of all elements in contact, whether candidates or not, with its interface forces linearised. What the spring of
    /// stick delays is left out: at a speed v it takes mu p / (v times its stiffness), microseconds. The memory of a mu that
    /// falls with speed is a delay.
    LinearisedForces linearise(const SlidingState &sliding, FaceEvaluation<3> &found);

    /// Evaluates the contact at rest without force.
    void touch(const dealii::Vector<double> &z, const DrivePoint &drive, FaceEvaluation<3> &found);

    /// Returns by how much a small change of the displacements changes the gap where that is smallest [mm].
    double gap_change(const FaceEvaluation<3> &found, const dealii::Vector<double> &change, unsigned int lever = 0) const;

    /// Returns the mean slip round the cylinder of the points in contact, weighted with their pressure, from one configuration to
    /// another [mm].
    double mean_slip(const FaceEvaluation<3> &found, const dealii::Vector<double> &from, double from_x,
                     const dealii::Vector<double> &to, double to_x) const;

    /// Returns the dofs near the cylinder at the beginning and at the end of a step in which the contact travels along xi [mm];
    /// those that it passes between take no part.
    const DofSelection &candidate_dofs(double x, const PerLever &theta, double travel = 0.);

    void use_penalties(const ContactPenalties &penalties)
    {
      ContactFace<3>::use_penalties(penalties);
      begin_displacements.reinit(0); // no step has begun with them
    }

  private:
    using Elements = FaceElements<3>;
    using Kind     = BatchedStep::Kind;

    void complete(FaceEvaluation<3> &found) const;
    void add_points_in_contact(const std::optional<unsigned int> &peak, FaceEvaluation<3> &found) const;
    RigidCylinder::Pose pose(const FaceConfiguration &at) const;
    Elements::Indices near(const FaceConfiguration &at, const RigidCylinder::Pose &cylinder_pose) const;
    BatchedStep::Constants constants(Kind kind, const FaceConfiguration &end, StepTerms terms) const;
    void press_slide(const SlidingState &sliding, bool beyond_candidates, FaceEvaluation<3> &found);
    void begin_step(const InterfaceStep &step, const std::optional<StaticTerms> &statics);
    void press(const BatchedStep::Constants &step, const dealii::Vector<double> &displacements, Elements::Indices elements_near,
               FaceEvaluation<3> &found);
    void place_elements(const dealii::Vector<double> &begin, const std::vector<ContactHistory> &history = {},
                        const std::optional<StaticTerms> &statics = {});
    void press_elements(const dealii::Vector<double> &end, FaceEvaluation<3> &found);
    BatchedStep::Constants step_constants(const InterfaceStep &step, const FaceConfiguration &end,
                                          const std::optional<StaticTerms> &statics) const;
    double slip_at(unsigned int point, const dealii::Vector<double> &displacements,
                   const RigidCylinder::Pose &cylinder_pose) const;
    void find_summed(Elements::Indices touched);
    void set_forces(Request request, InterfaceForces &forces) const;
    dealii::FullMatrix<double> tangent(BatchedStep::Part part) const;
    std::vector<FrictionDelay> friction_delays(const FrictionLaw &law, double speed) const;

    std::vector<std::vector<unsigned int>> element_lines; ///< increasing
    std::vector<bool> is_at_end;                          ///< whether an element is at an end of the face along xi

    RigidCylinder::Pose begin_pose{};
    std::optional<std::pair<double, bool>> begin_shifts; ///< travel and augmentation, which shifts of slips follow from

    /// Elements whose forces are summed, and their dofs.
    struct Summed
    {
      Elements::Indices elements;
      std::vector<unsigned int> dofs;                ///< increasing
      std::vector<InterfaceCoordinates> coordinates; ///< of the elements, with places among the dofs in place of these
    };

    BatchedStep batched;
    Elements::Indices near_elements;          ///< by the last evaluation
    std::vector<BatchedStep::Forces> pressed; ///< of the elements that are summed
    std::optional<unsigned int> most_pressed; ///< the one of the largest penetration
    Summed summed;
  };
} // namespace sprag
