#pragma once

#include "fe/circle_surface.h"
#include "fe/face_observation.h"
#include "fe/pair_surface.h"
#include "model/port_step.h"

namespace sprag
{
  /// Contact along the friction face over a step of the time integration, by the penalty method: FaceContact's tractions, with
  /// forces consistent with the scheme. The circle's position counts from the pivot frame's origin, which a sprung support moves.
  /// Surface: what lies below the face, CircleSurface or PairSurface.
  template <class Surface>
  class FaceStep
  {
  public:
    static constexpr bool uses_rates       = false;
    static constexpr bool stands_for_layer = false; ///< its springs are penalties
    static constexpr unsigned int levers   = 1;

    /// The body must outlive the contact.
    FaceStep(const ElasticBody<2> &body, FaceStepProperties properties);

    void evaluate(const PortStep &step);

    void evaluate_sliding(const SlidingState &state);

    const PortForces &forces() const;

    /// Delays of friction at the points in contact, at the last evaluate_sliding(), on the ports of forces().
    std::vector<FrictionDelay> friction_delays() const;

    /// Ports near the cylinder at x from the pivot frame's origin and inclination theta, far beyond the contact's width.
    const PortSelection &reachable_ports(double x, double theta);

    /// Whether the contact of the last evaluation was within them. If not, widen_reach() makes them all.
    bool within_reach() const;
    void widen_reach();

    /// Of the points in contact, increasing. Throws AnalysisError if they go beyond the part of an elastic cylinder that can
    /// touch.
    std::vector<ContactMemory> memory() const;

    /// At rest without force.
    std::vector<ContactMemory> touch(const dealii::Vector<double> &ports, const DrivePoint &drive);

    void add_work(StepWork &work) const;

    /// Of the contact springs [N mm].
    double energy() const;

    /// Largest compression of the contact springs in the step [mm].
    double overlap() const;

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
    void step_patch(unsigned int patch, const std::vector<ContactMemory> &accepted, const StepContactLaw &law);
    void slide_patch(unsigned int patch, const SlidingState &sliding);
    FacePointState &add_state(unsigned int patch, unsigned int point);
    void sum_forces();
    FacePatches::Range clip(const FacePatches::Range &range);
    void reach(const FacePatches::Range &range);
    unsigned int middle_of_contact() const;
    std::vector<FaceContact::PointState> observed_points() const;
    FaceView view(const std::vector<FaceContact::PointState> &points) const;

    const ElasticBody<2> &body;
    const FaceStepProperties properties;
    const FacePatches face;
    mutable Surface surface; ///< looks at one patch after the other

    // Of the last evaluation.
    dealii::Vector<double> displacement; ///< of the ports
    double last_x        = 0.;           ///< of the drive
    double step_duration = 0.;
    double surface_run   = 0.; ///< of the cylinder by turning, in the step [mm]
    FaceStepSums sums;
    std::vector<FacePointState> states;
    FrictionLaw sliding_law;      ///< of evaluate_sliding(), none but then
    double speed_of_sliding = 0.; ///< of the cylinder
    PortForces summed;
    std::vector<unsigned int> place_of_port; ///< among those summed
    unsigned int remembered = 0;             ///< entry of the accepted memory at which the search for a point goes on
    PortSelection reachable;
    FacePatches::Range reached{ 0, 0 }; ///< patches of `reachable`
    bool reaches_everywhere = false;
    bool clipped            = false;
  };

  using FaceStepContact = FaceStep<CircleSurface>;
  using PairStepContact = FaceStep<PairSurface>;
} // namespace sprag
