#pragma once

#include "fe/elastic_body.h"
#include "model/circle.h"
#include "model/model.h"

#include <functional>

namespace sprag
{
  /// What the lever rubs against, a convex body: kinematics of a point of the lever at drive position x and hub rotation theta,
  /// in the coordinates (displacement along xi, along eta, theta).
  using Obstacle = std::function<ContactKinematics<3>(const LeverPoint &point, double x, double theta)>;

  /// [N/mm^3], > 0
  struct ContactPenalties
  {
    double normal;
    double tangential;
  };

  /// Generalised contact forces on the nodes that points under pressure move, and on the hub rotation.
  struct ContactForces
  {
    std::vector<unsigned int> nodes;    ///< increasing
    dealii::Vector<double> values;      ///< two a node: along xi, along eta [N]; last the moment [N mm]
    dealii::FullMatrix<double> tangent; ///< their derivative by displacements of the nodes and theta, unsymmetric
  };

  /// Contact along the friction face, integrated over points denser than the nodes. In the augmented Lagrangian method the
  /// multiplier is a finite-element function on the face, so that it meets as many conditions as the face can fulfil: the overlap
  /// weighted with each node's shape function vanishes.
  class FaceContact
  {
  public:
    /// The body must outlive the contact.
    FaceContact(const ElasticBody<2> &body, Obstacle obstacle, FrictionLaw friction, Enforcement enforcement,
                ContactPenalties penalties);

    /// Tractions at the displacement of the face nodes (two entries a node) and the rotation, in a step that began at `accepted`.
    void evaluate(const dealii::Vector<double> &displacement, double theta, const State &trial, const State &accepted,
                  FrictionMode mode);

    const ContactForces &forces() const;

    /// Largest overlap [mm]: of a point (penalty), or weighted with a node's shape function (augmented Lagrangian).
    double penetration() const;

    /// Largest p / penalty [mm].
    double overlap() const;

    /// Multipliers of the next augmentation.
    void augment(std::vector<ContactMemory> &memory) const;

    /// Memory of the points at the end of the step.
    std::vector<ContactMemory> memory() const;

    const ContactPenalties &penalties() const;

    /// What the last evaluation found at an integration point.
    struct PointState
    {
      unsigned int index;  ///< in FrictionFace::points
      LeverPoint position; ///< deformed, lever axes
      double gap;
      double trial_pressure; ///< lambda - eps g: the pressure where positive [MPa]
      double slip_change;    ///< in the step [mm]
      double elastic_slip;   ///< of the tangential penalty [mm]
      ContactResponse<3> response;
    };

    /// The points of all patches near the obstacle, increasing; those elsewhere are open.
    const std::vector<PointState> &points() const;

    /// Displacements of the face nodes at the last evaluation, two entries a node [mm].
    const dealii::Vector<double> &displacements() const;

    /// Duration of the step of the last evaluation [s].
    double duration() const;

    const ElasticBody<2> &elastic_body() const;

  private:
    dealii::Tensor<1, 2> displacement(unsigned int point) const;
    LeverPoint position(unsigned int point) const;
    bool is_near(const FacePatch &patch) const;
    PointState evaluate_point(unsigned int q, const ContactLaw &law, FrictionMode mode) const;
    void sum_forces();
    double largest_weighted_overlap() const;
    std::vector<double> projected(double ContactResponse<3>::*traction) const;

    const ElasticBody<2> &body;
    const Obstacle obstacle;
    const FrictionLaw friction;
    const Enforcement enforcement;
    const ContactPenalties stiffness;

    // Of the last evaluation.
    std::vector<ContactMemory> start; ///< memory and multipliers it used
    dealii::Vector<double> nodal_displacement;
    double theta         = 0.;
    double x             = 0.;
    double step_duration = 0.;
    std::vector<PointState> states;
    ContactForces summed;
  };
} // namespace sprag
