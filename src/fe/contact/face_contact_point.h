// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_elements.h"
#include "fe/contact/rigid_cylinder.h"
#include "model/contact/contact_step.h"
#include "model/interface/interface_coordinates.h"
#include "model/step/interface_step.h"
#include "model/step/linearisation.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

namespace sprag
{
  /// [N/mm^3], > 0
  struct ContactPenalties
  {
    double normal;
    double tangential;
  };

  /// Constants of the contact of a meshed lever. The layout has `dim` dofs a node of the face, with slopes where the cylinder's
  /// axis may turn.
  struct FaceProperties
  {
    std::function<LeverPoint(double x, double theta)> centre; ///< of the cylinder
    double radius = 0.; ///< R: how far the cylinder's surface runs in its axes as they turn by 1, 0 if it turns with them [mm]
    InterfaceLayout layout;
    double rest_inclination = 0.; ///< theta without moment [rad]
    ContactPenalties penalties{};
    FrictionLaw friction;
    double layer_thickness = 0.;      ///< [mm]
    RigidCylinder cylinder{ {}, {} }; ///< an elastic one as it is without load
    bool half = false;                ///< the face is half of one which is the same on both sides of the middle
  };

  /// Returns the places at interface displacements, which it refers to, and x of the drive [mm].
  FaceConfiguration configuration(const FaceProperties &properties, const dealii::Vector<double> &displacements, double x);

  /// A point of the friction face in an evaluation, with its tractions at the end.
  template <int dim>
  struct FacePointState : PointTraction
  {
    unsigned int index   = 0;    ///< of the point in FrictionFace::points
    unsigned int element = 0;    ///< index in FrictionFace::elements
    dealii::Point<dim> position; ///< deformed, lever axes
    double gap            = 0.;
    double trial_pressure = 0.;           ///< lambda - eps g at the end: the pressure where positive [MPa]
    Slip slip_change;                     ///< in the step; without inertia as far as it would be at the speed of its end [mm]
    double elastic_slip = 0.;             ///< of the tangential penalty [mm]
    dealii::Tensor<1, dim + 2> end_force; ///< on the lever per area along its axes, about the pivot, and along x on the drive
  };

  /// The terms that a step without inertia has beside displacements, drive and contact history. Its forces are those at its end.
  ///
  /// mu is taken at the speed with which a point slides where the step ends, which differs from its mean over the step: most
  /// points were not in contact when it began, and the cylinder has changed its speed. What moves along the lever with the
  /// contact does so almost steadily, so that a point's rate follows from the place that had the same distance from the contact
  /// when the step began, and from the slip's slope along the face where it ends.
  struct StaticTerms
  {
    FrictionLaw friction; ///< of the step
    double duration;      ///< of the step, or as long as its slip would take at the speed of its end [s], > 0
    FrictionMode mode  = FrictionMode::cone;
    bool augmented     = false; ///< whether the traction in the history is a multiplier
    double travel      = 0.;    ///< of the contact along the lever in the step [mm]; 0: speeds are means
    double speed_ratio = 1.;    ///< sliding speed of a rigid lever at the end over its mean; the law's duration is shorter by it
  };

  /// Constants of a step that all points of a contact have in common.
  struct StepTerms
  {
    StepContactLaw law;
    double surface_run = 0.; ///< of the counterface by turning [mm]
    StaticTerms terms{};     ///< without inertia
  };

  /// Returns the law of points that takes neither time nor place.
  StepContactLaw contact_law(const ContactPenalties &penalties, const FrictionLaw &friction);

  StepTerms step_terms(const FaceProperties &properties, const InterfaceStep &step, const std::optional<StaticTerms> &statics);

  /// Returns what the tangential penalty adds to the traction of the history, over the slip; a multiplier needs none.
  inline double unwinding_stiffness(const bool augmented, const double tangential_penalty)
  {
    return augmented ? std::numeric_limits<double>::infinity() : tangential_penalty;
  }

  /// Finds the history of the first point in contact from one on, by indices in the face.
  inline auto find_history(const std::vector<ContactHistory> &history, const unsigned int point)
  {
    const auto is_before = [](const ContactHistory &entry, const unsigned int q) { return entry.point < q; };
    return std::lower_bound(history.begin(), history.end(), point, is_before);
  }

  /// Returns the elements that hold points in contact.
  template <int dim>
  std::vector<unsigned int> touched_elements(const FaceElements<dim> &face, const std::vector<ContactHistory> &history)
  {
    std::vector<unsigned int> result;
    for (const auto &entry : history)
      if (result.empty() || entry.point >= face.elements[result.back()].end)
        result.push_back(face.point_elements[entry.point]);
    return result;
  }

  /// The slip that a point would have more in a step at the speed of its end, the ratio of speeds apart [mm].
  struct SlipShift
  {
    double slip    = 0.;
    double elastic = 0.; ///< what the elastic slip of the tangential penalty would change less
    double d_slope = 0.; ///< derivative by the slope [mm]

    double total() const
    {
      return slip + elastic;
    }
  };

  /// Finds the shift of a point, given by its index in the face. `slope` is that of the slip coordinate along the face at the end
  /// of the step; 0 where its part is added later. `slip_at_begin` tells the slip coordinate of any point, by its index, where
  /// the step begins. `stiffness` is that of the tangential penalty, infinite with multipliers. The place that had the same
  /// distance from the contact when the step began has the same zeta. There is no shift where the contact came from beyond the
  /// face.
  template <int dim>
  SlipShift slip_shift(const FaceElements<dim> &face, unsigned int point, double slope, double travel, double stiffness,
                       const std::vector<ContactHistory> &history, const std::function<double(unsigned int)> &slip_at_begin);

  /// Sums over the points of an evaluation.
  struct ContactSums
  {
    double penetration = 0.;    ///< of the contact springs, the largest in the step [mm]
    double stored      = 0.;    ///< energy
    bool beyond_face   = false; ///< whether the contact reaches the end of what can be touched
    StepWork work;
  };

  /// The beginning of the last step, the same in all its iterations.
  struct StepBegin
  {
    dealii::Vector<double> displacements; ///< of the interface
    double x = 0.;                        ///< of the drive [mm]
    std::vector<unsigned int> near;       ///< elements near the counterface there

    /// Notes another beginning. Returns false if it is the same.
    bool set(const dealii::Vector<double> &at, const double at_x)
    {
      if (at_x == x && at.size() == displacements.size() && at == displacements)
        return false;
      displacements = at;
      x             = at_x;
      return true;
    }
  };
} // namespace sprag
