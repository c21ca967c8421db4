#pragma once

#include "fe/contact/face_contact.h"
#include "fe/solid/rigid_cylinder.h"

namespace sprag
{
  /// Constants of the contact along a surface.
  struct SurfaceContactProperties
  {
    RigidCylinder cylinder;
    std::function<LeverPoint(double x, double theta)> centre; ///< of the cylinder
    double radius;                                            ///< R [mm]
    PortLayout ports;                                         ///< three a node of the face
    double rest_inclination;                                  ///< theta without moment [rad]
    ContactPenalties penalties;
  };

  using SurfaceMemory = PointMemory<2>;

  /// Ports and drive at one end of a step.
  struct SurfacePlace
  {
    const dealii::Vector<double> &ports;
    double x; ///< of the drive [mm]
  };

  /// The result of an evaluation. The caller keeps it and may use it for the next one.
  struct SurfaceEvaluation
  {
    dealii::Vector<double> displacement;   ///< of the ports
    double duration    = 0.;               ///< of the step; 0: no slip speed [s]
    bool within_reach  = true;             ///< whether the contact was within the ports that it may reach
    bool beyond_face   = false;            ///< whether it reaches the end of the face along xi
    double compression = 0.;               ///< of the contact springs, the largest [mm]
    std::vector<FacePointState<3>> points; ///< of the patches near the cylinder, by increasing point
    PortForces forces;

    /// Returns the memory of the points in contact, by increasing point.
    std::vector<SurfaceMemory> memory() const;
  };

  /// Contact of a rigid cylinder along the friction face of a body in three dimensions, without inertia, by the penalty method:
  /// pressure and, in two directions, friction at the points of the face at the end of a step.
  class SurfaceContact
  {
  public:
    /// The face must outlive the contact.
    SurfaceContact(const FrictionFace<3> &face, SurfaceContactProperties properties);

    /// Sets the accepted state in which the following steps begin.
    void begin_step(const SurfacePlace &begin);

    /// Evaluates the step that ends at `end`. `memory`: of the points in contact where it begins. `surface_run`: of the cylinder
    /// by turning [mm].
    void evaluate(const SurfacePlace &end, const std::vector<SurfaceMemory> &memory, double surface_run, const StaticTerms &terms,
                  SurfaceEvaluation &found);

    /// Returns the ports near the cylinder, see FaceContact::reachable_ports().
    const PortSelection &reachable_ports(double x, double theta, double travel);

    /// Doubles how far these ports reach, from their next call on.
    void widen_reach();

    /// Returns the positions of a point among those that have the same zeta, by increasing xi.
    const std::vector<std::vector<unsigned int>> &lines() const
    {
      return points_of_line;
    }

    const ContactPenalties &penalties() const
    {
      return properties.penalties;
    }

    /// Visits how far it reaches.
    void visit_history(Archive &archive)
    {
      archive(reach_factor);
      patches.visit_history(archive);
    }

  private:
    using Patches                                 = FacePatches<3>;
    static constexpr unsigned int n_displacements = 3 * Patches::max_nodes;
    static constexpr unsigned int n_local         = n_displacements + 2;

    struct Sums;
    struct Step;

    void find_lines();
    RigidCylinder::Pose pose_of(const SurfacePlace &place) const;
    Patches::Indices near(const SurfacePlace &place, const RigidCylinder::Pose &pose) const;
    void evaluate_patch(unsigned int patch, Step &step, SurfaceEvaluation &found) const;
    void evaluate_point(const Step &step, FacePointState<3> &state, Sums &sums, SurfaceEvaluation &found) const;
    SlipShift shift_of(unsigned int point, double slope, const Step &step) const;
    std::array<double, 2> slips_at_begin(unsigned int point) const;
    PortCoordinates coordinates_of(unsigned int patch) const;
    Patches::Indices clip(Patches::Indices near, SurfaceEvaluation &found) const;

    const FrictionFace<3> &face;
    const SurfaceContactProperties properties;
    Patches patches;
    std::vector<std::vector<unsigned int>> points_of_line;
    std::vector<std::pair<unsigned int, unsigned int>> place_in_line; ///< of a point: its line and its place there

    dealii::Vector<double> begin_ports;
    double begin_x = 0.;
    RigidCylinder::Pose begin_pose{};
    mutable std::map<unsigned int, std::vector<std::array<double, 2>>> begin_slips; ///< by patches

    std::vector<unsigned int> place_of_port; ///< among those summed
    PortSelection reachable;
    Patches::Indices reached;
    double reach_factor = 1.;
  };
} // namespace sprag
