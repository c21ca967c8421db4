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
  /// A convex body without deformation, at its place: the kinematics of a point of the lever against it, in the coordinates
  /// (displacement along xi, along eta, theta, x).
  using PlacedCounterface = std::function<ContactKinematics<4>(const LeverPoint &point)>;

  /// The body at its position x from the pivot frame's origin and hub rotation theta.
  using Counterface = std::function<PlacedCounterface(double x, double theta)>;

  /// [N/mm^3], > 0
  struct ContactPenalties
  {
    double normal;
    double tangential;
  };

  /// Constants of the contact of a meshed lever, in a plane or in space.
  struct ContactProperties
  {
    std::function<LeverPoint(double x, double theta)> centre; ///< of the counterface
    double radius = 0.; ///< R: how far the counterface's surface runs in its axes as they turn by 1, 0 if it turns with them [mm]
    InterfaceLayout layout;
    double rest_inclination = 0.; ///< theta without moment [rad]
    ContactPenalties penalties{};
    FrictionLaw friction;
    double layer_thickness = 0.; ///< [mm]
  };

  /// The same of one dimension. In space the layout has three dofs a node of the face, with slopes where these may change.
  template <int dim>
  struct FaceProperties;

  /// In a plane the counterface is any convex rigid body.
  template <>
  struct FaceProperties<2> : ContactProperties
  {
    Counterface counterface; ///< an elastic one as it is without load
  };

  /// In space the counterface is the cylinder.
  template <>
  struct FaceProperties<3> : ContactProperties
  {
    RigidCylinder cylinder;
    bool half = false; ///< the face is half of one which is the same on both sides of the middle
  };

  /// The damper's cylinder.
  Counterface cylinder(const Geometry &geometry);

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

  StepTerms step_terms(const ContactProperties &properties, const InterfaceStep &step, const std::optional<StaticTerms> &statics);

  /// A step of the contact in a plane.
  struct FaceStep : StepTerms
  {
    const std::vector<ContactHistory> &history; ///< of the points in contact where it begins, by increasing point
  };

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

  /// Friction's part of the tangent of an element that slides steadily, where it is wanted apart; see LinearisedForces.
  template <class Matrix>
  struct FrictionParts
  {
    Matrix by_displacement;
    Matrix by_velocity;
    std::vector<FrictionDelay> delays; ///< at the interface of the element
  };

  /// Derivatives by some interface dofs of a point's gap and slip, and of its slip speed at displacements at rest over the
  /// cylinder's.
  struct FacePointRows
  {
    double weight; ///< area [mm^2]
    std::vector<unsigned int> dofs;
    dealii::Vector<double> gap;
    dealii::Vector<double> slip;
    dealii::Vector<double> stretch;
  };

  /// Sums over the points of an evaluation.
  struct ContactSums
  {
    double penetration          = 0.;    ///< of the contact springs, the largest in the step [mm]
    double stored               = 0.;    ///< energy
    double force_on_counterface = 0.;    ///< generalised, of the position x, in the step [N]
    bool beyond_face            = false; ///< whether the contact reaches the end of what can be touched
    StepWork work;
    std::vector<InterfaceForces> loaded; ///< forces of the elements, dofs in any order
    bool in_parts = false;               ///< whether steady sliding gives its tangent in parts
    std::vector<LinearisedForces> parts; ///< of the elements loaded
  };

  /// Adds the forces of an element, from values and tangent over its coordinates: of pressure alone where it is wanted in parts.
  template <class Values, class Matrix>
  void add_element(const InterfaceCoordinates &coordinates, const Values &values, const Matrix &tangent,
                   const FrictionParts<Matrix> &friction, ContactSums &sums)
  {
    InterfaceForces forces{ collect_dofs(coordinates), row_on_dofs(coordinates, values), matrix_on_dofs(coordinates, tangent) };
    if (sums.in_parts)
    {
      auto &parts         = sums.parts.emplace_back(forces.dofs);
      parts.pressure      = forces.tangent;
      parts.friction      = matrix_on_dofs(coordinates, friction.by_displacement);
      parts.friction_rate = matrix_on_dofs(coordinates, friction.by_velocity);
      parts.delays        = friction.delays;
    }
    sums.loaded.push_back(std::move(forces));
  }

  /// The places where a step begins and ends, and the share of it at which forces are balanced.
  struct StepPlaces
  {
    FaceConfiguration begin;
    FaceConfiguration end;
    double balance  = 1.;
    bool static_end = false; ///< without inertia: forces are those of the end, whatever was before

    /// Returns whether beginning and end differ.
    bool moves() const
    {
      return begin.displacement != end.displacement || begin.x != end.x;
    }

    /// Returns whether the end is all that counts for the forces.
    bool balanced_at_end() const
    {
      return static_end || !moves();
    }

    double balanced(const double at_begin, const double at_end) const
    {
      return (1. - balance) * at_begin + balance * at_end;
    }
  };

  /// Records a point's response to a step in its state and the sums, its forces apart. `run` [mm] is how far the counterface's
  /// surface runs at the point.
  template <int n>
  void record(const StepResponse<n> &response, const FaceStep &step, const ContactHistory &begin, const double slip_change,
              const double weight, const double run, FacePointState<2> &state, ContactSums &sums)
  {
    static_cast<PointTraction &>(state) = response;

    state.history.point  = state.index;
    state.slip_change[0] = slip_change * step.terms.speed_ratio;
    state.elastic_slip = (response.traction - (step.terms.augmented ? begin.traction : Slip())).norm() / step.law.slip.stiffness;

    sums.stored += weight * response.energy;
    sums.work.drive += weight * response.mean_traction[0] * run;
    sums.work.friction += weight * response.friction;
    sums.work.algorithmic += weight * response.algorithmic;
    sums.work.creep = std::max(sums.work.creep, response.creep);
  }

  /// Derivatives of the forces per area p G - t S of steady sliding, G and S the rows of gap and slip:
  ///   pressure       normal G G + pressure dG/dq
  ///   friction       S (coupled G + stuck S + by_speed dv/dq) - traction dS/dq
  ///   friction_rate  by_speed S S
  /// v the slip speed at displacements at rest.
  struct SlidingTangent
  {
    double normal   = 0.;
    double coupled  = 0.;
    double stuck    = 0.;
    double by_speed = 0.;
    double by_mu    = 0.; ///< of it what mu has, see SlidingFriction
    FrictionLag lag{ 0., 1. };
  };

  /// Sets tractions from the state's gap < 0 and slip and adds them to the sums.
  SlidingTangent slide(const FaceProperties<2> &properties, const FrictionLaw &law, const SlidingState &sliding, double weight,
                       FacePointState<2> &state, ContactSums &sums);

  /// Returns the delay of friction at a point with these rows.
  FrictionDelay friction_delay(const SlidingTangent &sliding_tangent, double speed, const FacePointRows &rows);
} // namespace sprag
