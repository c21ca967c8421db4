#pragma once

#include "fe/contact/elastic_obstacle.h"
#include "fe/contact/face_observation.h"
#include "fe/contact/rigid_obstacle.h"
#include "model/port_step.h"

#include <optional>
#include <variant>

namespace sprag
{
  /// What a step without inertia has beside ports, drive and memory. Its forces are those at its end.
  struct StaticTerms
  {
    FrictionLaw friction; ///< of the step
    double duration;      ///< of the step, or as long as its slip would take at the speed of its end [s], > 0
    FrictionMode mode  = FrictionMode::cone;
    bool augmented     = false; ///< see FaceStep
    double travel      = 0.;
    double speed_ratio = 1.;
  };

  /// Contact along the friction face over a step in time, with forces consistent with the scheme, or without inertia, integrated
  /// over points denser than the nodes, by the penalty method and with multipliers if the memory has some. The obstacle is
  /// elastic where the body has a cylinder's face. Its position counts from the pivot frame's origin, which a sprung support
  /// moves.
  class FaceContact
  {
  public:
    static constexpr bool uses_rates       = false;
    static constexpr bool stands_for_layer = false; ///< its springs are penalties
    static constexpr unsigned int levers   = 1;

    /// The body must outlive the contact.
    FaceContact(const ElasticBody<2> &body, FaceContactProperties properties);

    /// Without inertia the step's rates do not count.
    void evaluate(const PortStep &step, const std::optional<StaticTerms> &statics = {});

    void evaluate_sliding(const SlidingState &state);

    /// Evaluates as well; on the ports of forces(). Friction delays at each point in contact.
    PortPerturbation linearise(const SlidingState &state);

    const PortForces &forces() const;

    /// Ports near the cylinder at x from the pivot frame's origin and inclination theta, far beyond the contact's width and where
    /// it may have been `travel` before [mm].
    const PortSelection &reachable_ports(double x, double theta, double travel = 0.);

    /// Whether the contact of the last evaluation was within them. If not, widen_reach() doubles how far they reach from the next
    /// call on.
    bool within_reach() const;
    void widen_reach();

    /// Of the points in contact, increasing. Throws AnalysisError where there is an objection().
    std::vector<ContactMemory> memory() const;

    /// Why the contact of the last evaluation goes beyond what can touch; empty if it does not.
    std::string objection() const;

    /// At rest without force.
    std::vector<ContactMemory> touch(const dealii::Vector<double> &ports, const DrivePoint &drive);

    void add_work(StepWork &work) const;

    /// Of the contact springs [N mm].
    double energy() const;

    /// Largest compression of the contact springs in the step, with multipliers p / penalty [mm].
    double overlap() const;

    /// Largest overlap of a point and the obstacle [mm].
    double penetration() const;

    /// Of the patches near the obstacle, by increasing point; those elsewhere are open.
    const std::vector<FacePointState<2>> &points() const;

    /// Displacements of the ports at the last evaluation.
    const dealii::Vector<double> &displacements() const;

    const ContactPenalties &penalties() const;

    /// The last evaluation as it is observed, valid until the next.
    FaceView view() const;

    /// Change of the gap in the middle of the contact, or where it is smallest, by a small change of the ports.
    double gap_change(const dealii::Vector<double> &change_of_ports) const;

    /// Mean slip of the points in contact, weighted with their pressure, from one configuration to another [mm].
    double mean_slip(const dealii::Vector<double> &from, double from_x, const dealii::Vector<double> &to, double to_x) const;

    void observe(Row &row) const;
    /// Displacements of the face's nodes.
    SurfaceShape surface_shape(const dealii::Vector<double> &displacements) const;
    FacePoints face_points() const;
    FaceState face_state(const DrivePoint &drive) const;

  private:
    FaceConfiguration configuration(const dealii::Vector<double> &ports, double x) const;
    void clear(const dealii::Vector<double> &ports, double x, double duration);
    FacePatches<2>::Indices near_step(const std::vector<ContactMemory> &memory, ForceBalance balance);
    template <class ObstacleBelow>
    void step_patch(ObstacleBelow &below, unsigned int patch, const FaceStep &step);
    template <class ObstacleBelow>
    void slide_patch(ObstacleBelow &below, unsigned int patch, const SlidingState &sliding, const FrictionLaw &law);
    void slide(const SlidingState &sliding, bool in_parts);
    void enter(const StepPlaces &places) const;
    FacePatches<2>::Indices near() const;
    FacePointState<2> &add_state(unsigned int patch, unsigned int point);
    void sum_forces();
    FacePatches<2>::Indices clip(FacePatches<2>::Indices near);
    unsigned int middle_of_contact() const;

    const ElasticBody<2> &body;
    const FaceContactProperties properties;
    const FacePatches<2> face;
    mutable std::variant<RigidObstacle, ElasticObstacle> obstacle; ///< looks at one patch after the other

    // Of the last evaluation.
    dealii::Vector<double> displacement; ///< of the ports
    double last_x        = 0.;           ///< of the drive
    double step_duration = 0.;
    ContactSums sums;
    std::vector<FacePointState<2>> states;
    PortForces summed;
    std::vector<unsigned int> place_of_port; ///< among those summed
    PortSelection reachable;
    FacePatches<2>::Indices reached;   ///< patches that the contact may touch
    FacePatches<2>::Indices looked_at; ///< patches of `reachable`
    double reach_factor = 1.;
    bool clipped        = false;
  };
} // namespace sprag
