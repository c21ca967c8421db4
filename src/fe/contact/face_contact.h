// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "fe/body/elastic_body.h"
#include "fe/contact/contact_face.h"
#include "fe/contact/elastic_counterface.h"
#include "fe/contact/rigid_counterface.h"
#include "model/step/interface_step.h"

#include <optional>
#include <variant>

namespace sprag
{
  /// Contact along the friction face over a step in time, with forces consistent with the scheme, or without inertia, integrated
  /// over points denser than the nodes, by the penalty method and with multipliers if the history has some. The counterface is
  /// elastic where the body has a cylinder's face. Its position counts from the pivot frame's origin, which a sprung support
  /// moves.
  class FaceContact : public ContactFace<2>
  {
  public:
    static constexpr bool keeps_tangent = false;

    /// The body must outlive the contact.
    FaceContact(const ElasticBody<2> &body, FaceProperties<2> properties);

    /// Evaluates a step: in time, or without inertia, where the rates do not count.
    void evaluate(const InterfaceStep &step, FaceEvaluation<2> &found, const std::optional<StaticTerms> &statics = {}) const;

    /// Evaluates steady sliding.
    void evaluate_sliding(const SlidingState &state, FaceEvaluation<2> &found) const
    {
      slide(state, false, found);
    }

    /// Evaluates steady sliding and linearises its interface forces, of all elements in contact, whether candidates or not.
    /// Friction delays at each point in contact.
    LinearisedForces linearise(const SlidingState &state, FaceEvaluation<2> &found) const;

    /// Returns the dofs near the cylinder at x from the pivot frame's origin and inclination theta. They reach far beyond the
    /// contact's width and to where it may have been `travel` before [mm]. Evaluations that follow look at those alone.
    const DofSelection &candidate_dofs(double x, const PerLever &theta, double travel = 0.);

    /// Evaluates the contact at rest without force.
    void touch(const dealii::Vector<double> &displacements, const DrivePoint &drive, FaceEvaluation<2> &found) const;

    /// Returns by how much a small change of the displacements changes the gap in the middle of the contact, or where it is
    /// smallest [mm].
    double gap_change(const FaceEvaluation<2> &found, const dealii::Vector<double> &moved, unsigned int lever = 0) const;

    /// Returns the mean slip of the points in contact, weighted with their pressure, from one configuration to another [mm].
    double mean_slip(const FaceEvaluation<2> &found, const dealii::Vector<double> &from, double from_x,
                     const dealii::Vector<double> &to, double to_x) const;

  private:
    /// Enters elements of the face one after the other and calls `visit_element`(counterface, element).
    template <class ElementVisitor>
    void visit_elements(const FaceElements<2>::Indices &elements, const ElementVisitor &visit_element) const;

    template <class CounterfaceBelow>
    void step_element(CounterfaceBelow &below, unsigned int element, const FaceStep &step, FaceEvaluation<2> &found) const;
    void slide(const SlidingState &sliding, bool in_parts, FaceEvaluation<2> &found) const;

    void set_places(const StepPlaces &places) const;

    FaceElements<2>::Indices near_end() const
    {
      return std::visit([](const auto &below) { return below.near_end(); }, counterface);
    }

    static FacePointState<2> &add_point(unsigned int element, unsigned int point, FaceEvaluation<2> &found);

    // Workspace of evaluations; nothing of it is a result.
    mutable std::variant<RigidCounterface, ElasticCounterface> counterface; ///< looks at one element after the other
    mutable std::vector<unsigned int> dof_places;                           ///< among those summed
  };
} // namespace sprag
