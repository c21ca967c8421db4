#pragma once

#include "model/beam.h"
#include "model/circle.h"
#include "model/contact_step.h"
#include "model/linearisation.h"
#include "model/port_step.h"

namespace sprag
{
  /// Constants of the contact of a reduced lever.
  struct PointContactProperties
  {
    Geometry geometry;
    BeamMesh mesh;
    PortLayout ports;
    double rest_inclination    = 0.; ///< theta without moment [rad]
    double neutral_axis_offset = 0.; ///< e_a [mm]
    NormalLaw normal;                ///< [N/mm^n]
    double damping    = 0.;          ///< [N s/mm]
    double tangential = 0.;          ///< [N/mm]
    FrictionLaw friction;
  };

  /// The circle against a beam: one contact point, which moves along the bent surface
  ///   p(xi) = (xi - (e - e_a) w'(xi), e + w(xi))
  /// to where it is closest to the circle's centre.
  class PointContact
  {
  public:
    static constexpr bool uses_rates       = true;
    static constexpr bool stands_for_layer = true; ///< its springs are physical, not penalties
    static constexpr unsigned int levers   = 1;

    explicit PointContact(PointContactProperties properties);

    void evaluate(const PortStep &step);
    void evaluate_sliding(const SlidingState &state);

    /// Evaluates as well; on the ports of forces().
    PortPerturbation linearise(const SlidingState &state);

    const PortForces &forces() const;

    /// Ports that a contact at that drive position may reach: all.
    const PortSelection &reachable_ports(double x, double theta);
    bool within_reach() const;
    void widen_reach();
    std::vector<ContactMemory> memory() const;
    std::vector<ContactMemory> touch(const dealii::Vector<double> &ports, const DrivePoint &drive);
    void add_work(StepWork &work) const;
    double energy() const;
    double overlap() const;
    double gap_change(const dealii::Vector<double> &change_of_ports) const;
    double mean_slip(const dealii::Vector<double> &from, double from_x, const dealii::Vector<double> &to, double to_x) const;
    void observe(Row &row) const;
    /// Displacements of the ports along the lever.
    SurfaceShape surface_shape(const dealii::Vector<double> &displacements) const;
    FacePoints face_points() const;
    FaceState face_state(const DrivePoint &drive) const;

  private:
    // Local coordinates: deflection and slope of three nodes in a row, theta, x of the circle from the pivot frame's origin.
    static constexpr unsigned int n           = 8;
    static constexpr unsigned int n_nodal     = 6;
    static constexpr unsigned int theta_index = 6;
    static constexpr unsigned int x_index     = 7;
    using Local                               = dealii::Tensor<1, n>;
    using LocalMatrix                         = dealii::Tensor<2, n>;

    /// The closest point at one configuration. Its slip row is that of the material point, of no slip coordinate; the curvature
    /// is that row's derivative as the contact point moves with the configuration.
    struct Configuration : ContactKinematics<n>
    {
      double along = 0.;                 ///< its position along the lever, deformed
      dealii::Tensor<1, 4> gap_at_point; ///< rows in (u_xi, u_eta, theta, x) of the point
      dealii::Tensor<1, 4> slip_at_point;
    };

    /// The bent surface at a material coordinate, with derivatives along it.
    struct Surface;

    Local coordinates(const dealii::Vector<double> &ports, double x) const;
    Local rates(const dealii::Vector<double> &port_rates, double v) const;
    void choose_window(const dealii::Vector<double> &ports, double x);
    Surface surface(const Local &q, double xi) const;
    double closest(const Local &q) const;
    double gap(const Local &q) const;
    Configuration configure(const Local &q) const;
    StepKinematics<n> step_kinematics(const PortStep &step, const Local &end_rates);
    void sum_forces(const Local &force, const LocalMatrix &tangent);
    LocalMatrix pressure_tangent() const;
    LocalMatrix friction_tangent(ContactFriction friction) const;

    /// A local coordinate that is a port, and the sign between them.
    struct LocalPort
    {
      unsigned int local;
      unsigned int port;
      double sign;
    };
    std::vector<LocalPort> local_ports() const;
    std::vector<FrictionDelay> friction_delays(const std::vector<LocalPort> &places, const Local &d_traction_rate) const;
    static dealii::FullMatrix<double> on_ports(const std::vector<LocalPort> &places, const LocalMatrix &matrix);

    const PointContactProperties properties;
    unsigned int window = 0; ///< node before the first local one

    // Of the last evaluation.
    Configuration end;
    StepResponse<n> response;
    StepWork work;
    double slip_rate = 0.;   ///< at the end of the step [mm/s]
    SlidingFriction sliding; ///< of evaluate_sliding()
    Local d_pressure;        ///< dP/dq there
    Local d_pressure_rate;   ///< dP/dq'
    bool sticks = false;     ///< whether stick is resolved there, by a spring
    PortForces summed;
    const PortSelection all;
  };
} // namespace sprag
