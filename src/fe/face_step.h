#pragma once

#include "fe/face_observation.h"
#include "fe/face_patches.h"
#include "model/contact_step.h"
#include "model/linearisation.h"
#include "model/port_layout.h"
#include "model/port_step.h"

namespace sprag
{
  /// Constants of the contact of a meshed lever in time.
  struct FaceStepProperties
  {
    Geometry geometry;
    PortLayout ports;
    double rest_inclination = 0.; ///< theta without moment [rad]
    ContactPenalties penalties{};
    FrictionLaw friction;
    double layer_thickness = 0.; ///< [mm]
  };

  /// Contact along the friction face over a step of the time integration, by the penalty method: FaceContact's tractions, with
  /// forces consistent with the scheme. The circle's position counts from the pivot frame's origin, which a sprung support moves.
  class FaceStepContact
  {
  public:
    static constexpr bool uses_rates = false;

    /// The body must outlive the contact.
    FaceStepContact(const ElasticBody<2> &body, FaceStepProperties properties);

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

    /// Of the points in contact, increasing.
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
    /// What the last evaluation found at an integration point.
    struct PointState
    {
      unsigned int index = 0;
      unsigned int patch = 0;
      LeverPoint position{}; ///< deformed
      double gap         = 0.;
      double slip_change = 0.;
      double pressure    = 0.; ///< at the end
      double traction    = 0.;
      double mu          = 0.;
      bool slipping      = false;
      dealii::Tensor<1, 4> end_force; ///< per area, generalised
      ContactMemory memory;
    };

    /// Force and tangent of a patch: two coordinates a node, rotation, position of the circle.
    static constexpr unsigned int n_local = 2 * FacePatches::max_nodes + 2;
    struct PatchForces
    {
      unsigned int patch = 0;
      double values[n_local]{};
      double tangent[n_local][n_local]{};
    };

    FaceConfiguration configuration(const dealii::Vector<double> &ports, double x) const;
    void clear(const dealii::Vector<double> &ports, double duration);
    void step_patch(unsigned int patch, const FaceConfiguration &begin, const FaceConfiguration &end,
                    const std::vector<ContactMemory> &accepted, const StepContactLaw &law);
    void step_point(PointState &state, const LeverPoint &begin_position, double begin_gap, const ContactMemory &memory,
                    const FaceConfiguration &begin, const FaceConfiguration &end, const StepContactLaw &law,
                    PatchForces &of_patch);
    void slide_patch(unsigned int patch, const FaceConfiguration &at, const SlidingState &sliding, const FrictionLaw &law);
    dealii::Tensor<2, 4> sliding_tangent(TangentPart part, ContactFriction friction, const ContactKinematics<4> &contact,
                                         const SlidingFriction &share, double pressure) const;
    void add(const FacePatches::Point &point, unsigned int n_nodes, const dealii::Tensor<1, 4> &force,
             const dealii::Tensor<2, 4> &tangent, PatchForces &of_patch) const;
    void sum_forces();
    dealii::Vector<double> spread(const dealii::Tensor<1, 4> &row, const PointState &state) const;
    FacePatches::Range clip(const FacePatches::Range &range);
    void reach(const FacePatches::Range &range);
    unsigned int middle_of_contact() const;
    dealii::Tensor<1, 4> point_change(const FacePatches::Point &point, const FacePatches::Patch &patch,
                                      const dealii::Vector<double> &change_of_ports) const;
    std::vector<FaceContact::PointState> observed_points() const;
    FaceView view(const std::vector<FaceContact::PointState> &points) const;

    const ElasticBody<2> &body;
    const FaceStepProperties properties;
    const FacePatches face;

    // Of the last evaluation.
    dealii::Vector<double> displacement; ///< of the ports
    double theta         = 0.;
    double relative_x    = 0.; ///< of the circle to the pivot frame [mm]
    double step_duration = 0.;
    double surface_run   = 0.; ///< of the cylinder by turning, in the step [mm]
    double compression   = 0.;
    double stored        = 0.; ///< energy
    StepWork work;
    std::vector<PointState> states;
    std::vector<PatchForces> loaded;
    FrictionLaw sliding_law; ///< of evaluate_sliding(), none but then
    PortForces summed;
    std::vector<unsigned int> place; ///< of the face nodes' forces among those summed
    unsigned int remembered = 0;     ///< entry of the accepted memory at which the search for a point goes on
    PortSelection reachable;
    FacePatches::Range reached{ 0, 0 }; ///< patches of `reachable`
    bool reaches_everywhere = false;
    bool clipped            = false;
  };
} // namespace sprag
