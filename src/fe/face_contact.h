#pragma once

#include "fe/elastic_body.h"
#include "fe/static_ports.h"
#include "model/circle.h"
#include "model/model.h"
#include "model/port_forces.h"

#include <functional>

namespace sprag
{
  /// What the lever rubs against, a convex body: kinematics of a point of the lever at the obstacle's position x from the pivot
  /// frame's origin and hub rotation theta, in the coordinates (displacement along xi, along eta, theta, x).
  using Obstacle = std::function<ContactKinematics<4>(const LeverPoint &point, double x, double theta)>;

  /// [N/mm^3], > 0
  struct ContactPenalties
  {
    double normal;
    double tangential;
  };

  struct FaceContactProperties
  {
    Obstacle obstacle;
    FrictionLaw friction;
    Enforcement enforcement = Enforcement::penalty;
    ContactPenalties penalties{};
    StaticPorts ports;
    double rest_inclination = 0.; ///< theta where the hub has not turned [rad]
  };

  /// Contact along the friction face, integrated over points denser than the nodes. In the augmented Lagrangian method the
  /// multiplier is a finite-element function on the face, so that it meets as many conditions as the face can fulfil: the overlap
  /// weighted with each node's shape function vanishes.
  class FaceContact
  {
  public:
    /// The body must outlive the contact.
    FaceContact(const ElasticBody<2> &body, FaceContactProperties properties);

    /// Tractions at the displacements of the ports, in a step that began at `accepted`.
    void evaluate(const dealii::Vector<double> &ports, const State &trial, const State &accepted, FrictionMode mode);

    /// On the nodes that points under pressure move, hub and support.
    const PortForces &forces() const;

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
      ContactResponse<4> response;
    };

    /// The points of all patches near the obstacle, increasing; those elsewhere are open.
    const std::vector<PointState> &points() const;

    /// Displacements of the ports at the last evaluation.
    const dealii::Vector<double> &displacements() const;

    /// Duration of the step of the last evaluation [s].
    double duration() const;

    const ElasticBody<2> &elastic_body() const;

  private:
    dealii::Tensor<1, 2> displacement(unsigned int point) const;
    LeverPoint position(unsigned int point) const;
    bool is_near(const FacePatch &patch) const;
    PointState evaluate_point(unsigned int q, const ContactLaw &law, FrictionMode mode) const;
    void find_loaded();
    void sum_forces();
    void add_forces(const PointState &state);
    double largest_weighted_overlap() const;
    std::vector<double> projected(double ContactResponse<4>::*traction) const;

    const ElasticBody<2> &body;
    const FaceContactProperties properties;

    // Of the last evaluation.
    std::vector<ContactMemory> start; ///< memory and multipliers it used
    dealii::Vector<double> ports;
    double theta         = 0.;
    double x             = 0.; ///< of the obstacle from the pivot frame's origin
    double step_duration = 0.;
    std::vector<PointState> states;
    std::vector<unsigned int> loaded; ///< nodes under pressure, increasing
    PortForces summed;
  };
} // namespace sprag
