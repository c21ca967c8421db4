#pragma once

#include "fe/elastic_body.h"
#include "fe/face_multipliers.h"
#include "fe/static_surface.h"
#include "model/model.h"

#include <functional>
#include <memory>
#include <optional>

namespace sprag
{
  struct FaceContactProperties
  {
    FrictionLaw friction;
    Enforcement enforcement = Enforcement::penalty;
    ContactPenalties penalties{};
    StaticPorts ports;
    double rest_inclination = 0.; ///< theta where the hub has not turned [rad]

    /// Centre of what the lever rubs against over its position x from the pivot frame's origin and theta.
    std::function<LeverPoint(double x, double theta)> centre;

    /// Of the damper: speeds of sliding are then those at the end of a step, see StaticStep. None: its means.
    std::optional<Geometry> geometry;
  };

  /// Contact along the friction face, integrated over points denser than the nodes. In the augmented Lagrangian method the
  /// penalty takes what FaceMultipliers leave: the edge of the contact lies wherever the pressure of a point vanishes.
  class FaceContact
  {
  public:
    /// The body must outlive the contact.
    FaceContact(const ElasticBody<2> &body, std::unique_ptr<StaticSurface> surface, FaceContactProperties properties);

    /// Tractions at the displacements of the ports, in a step that began at `accepted`; frictionless in the cone mode where no
    /// time has passed since.
    void evaluate(const dealii::Vector<double> &ports, const State &trial, const State &accepted, FrictionMode mode);

    /// On the nodes that points under pressure move, hub and support.
    const PortForces &forces() const;

    /// Largest overlap of a point and what lies below the face [mm].
    double penetration() const;

    /// Largest change of a multiplier by the next augmentation, over the penalty [mm].
    double unaugmented_overlap() const;

    /// Largest p / penalty [mm].
    double overlap() const;

    /// Multipliers of the next augmentation.
    void augment(std::vector<ContactMemory> &memory) const;

    /// Memory of the points at the end of the step.
    std::vector<ContactMemory> memory() const;

    /// That of points without traction, at displacements of the ports and a position of the drive.
    std::vector<ContactMemory> untouched(const dealii::Vector<double> &ports, double x) const;

    /// Why the contact of the last evaluation is beyond what can touch; empty if it is not.
    std::string objection() const;

    const ContactPenalties &penalties() const;

    using PointState = StaticPoint;

    /// The points of all patches near the obstacle, increasing; those elsewhere are open.
    const std::vector<PointState> &points() const;

    /// Displacements of the ports at the last evaluation.
    const dealii::Vector<double> &displacements() const;

    /// Duration of the step of the last evaluation [s].
    double duration() const;

    const ElasticBody<2> &elastic_body() const;

  private:
    FaceConfiguration configuration(const dealii::Vector<double> &displacements, double x) const;
    ContactLaw law_of_step(double v, FrictionMode mode) const;
    StaticStep step_to(const DrivePoint &end, const DrivePoint &begin, FrictionMode mode) const;
    void set_slips(const FaceConfiguration &at, std::vector<ContactMemory> &memory) const;
    void list_ports();
    void sum_forces();

    const ElasticBody<2> &body;
    const std::unique_ptr<StaticSurface> surface;
    const FaceContactProperties properties;
    const FaceMultipliers multipliers;

    // Of the last evaluation.
    std::vector<ContactMemory> start; ///< memory and multipliers it used
    dealii::Vector<double> ports;
    double drive_x       = 0.;
    double step_duration = 0.;
    std::vector<PointState> states;
    std::vector<StaticPatch> patches; ///< under pressure
    PortForces summed;
  };
} // namespace sprag
