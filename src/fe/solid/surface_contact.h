// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/face_contact.h"
#include "fe/solid/step_in_lanes.h"

namespace sprag
{
  /// Constants of the contact along a surface.
  struct SurfaceContactProperties
  {
    RigidCylinder cylinder;
    std::function<LeverPoint(double x, double theta)> centre; ///< of the cylinder
    double radius;                                            ///< R [mm]
    PortLayout ports;                                         ///< three a node of the face; with slopes where these may change
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
    double x           = 0.;               ///< of the drive [mm]
    double duration    = 0.;               ///< of the step; 0: no slip speed [s]
    bool within_reach  = true;             ///< whether the contact was within the ports that it may reach
    bool beyond_face   = false;            ///< whether it reaches the end of the face along xi
    double compression = 0.;               ///< of the contact springs, the largest; with multipliers p / penalty [mm]
    double stored      = 0.;               ///< energy of the contact springs; in time alone [N mm]
    StepWork works;                        ///< of the step; in time alone
    std::vector<FacePointState<3>> points; ///< by increasing point, see complete() and add_points()
    PortForces forces;

    /// Returns the memory of the points in contact, by increasing point. Throws AnalysisError beyond the face.
    std::vector<SurfaceMemory> memory() const;

    const StepWork &work() const
    {
      return works;
    }
    double energy() const
    {
      return stored;
    }
    double overlap() const
    {
      return compression;
    }
  };

  /// Contact of a rigid cylinder along the friction face of a body in three dimensions by the penalty method: pressure and, in
  /// two directions, friction at the points of the face.
  class SurfaceContact
  {
  public:
    /// The face must outlive the contact.
    SurfaceContact(const FrictionFace<3> &face, SurfaceContactProperties properties);

    /// Evaluates a step without inertia, with its points: where it is augmented all near the cylinder, else those of complete().
    void evaluate(const PortStep &step, SurfaceEvaluation &found, const StaticTerms &terms);

    /// Sets the accepted state in which the following steps begin.
    void begin_step(const SurfacePlace &begin);

    /// Evaluates forces, compression and tangent of the step without inertia that ends at `end`. `memory`: of the points in
    /// contact where it begins. `surface_run`: of the cylinder by turning [mm]. Of the terms `travel` and `augmented` belong to
    /// the step: they are the same until the next begin_step().
    void evaluate(const SurfacePlace &end, const std::vector<SurfaceMemory> &memory, double surface_run, const StaticTerms &terms,
                  SurfaceEvaluation &found);

    /// Evaluates forces, compression and, where it is wanted, the tangent of a step in time. Where that of the last one is
    /// wanted, the step has to be the same, or the slide.
    void evaluate(const PortStep &step, const FrictionLaw &friction, SurfaceEvaluation &found);

    /// Finds works, energy and points of the step in time that was evaluated last: those that may take part and, along the lines
    /// where the pressure is largest, all near the cylinder. Where nothing touches those are all.
    void complete(SurfaceEvaluation &found) const;

    /// Finds all points near the cylinder of the last evaluation, in time or without inertia.
    void add_points(SurfaceEvaluation &found) const;

    /// Evaluates steady sliding: the cylinder's surface runs round its axis at the slide's speed. Where the tangent is not
    /// wanted, complete() finds what there is beside forces and compression.
    void slide(const SlidingState &sliding, const FrictionLaw &friction, SurfaceEvaluation &found);

    /// The same, with its forces linearised on their ports. What the spring of stick delays is left out: at a speed v it takes
    /// mu p / (v times its stiffness), microseconds.
    PortPerturbation linearise(const SlidingState &sliding, const FrictionLaw &friction, SurfaceEvaluation &found);

    /// Evaluates the contact at rest without force.
    void touch(const SurfacePlace &place, SurfaceEvaluation &found);

    /// By how much a small change of the ports changes gap and slip round the cylinder at a point of an evaluation [mm].
    std::array<double, 2> change_at(const FacePointState<3> &point, const SurfaceEvaluation &found,
                                    const dealii::Vector<double> &change_of_ports) const;

    /// The slip coordinate round the cylinder of a point of an evaluation, in another configuration [mm].
    double slip_at(const FacePointState<3> &point, const SurfacePlace &place) const;

    /// Returns the ports near the cylinder at the beginning and at the end of a step in which the contact travels along xi [mm];
    /// those that it passes between take no part.
    const PortSelection &reachable_ports(double x, const OfLevers &theta, double travel = 0.);

    /// Doubles how far these ports reach, from their next call on.
    void widen_reach();

    /// The slopes of the cylinder's axis in an evaluation.
    AxisSlopes slopes_in(const SurfaceEvaluation &found) const;

    const RigidCylinder &cylinder() const
    {
      return properties.cylinder;
    }

    /// Returns the positions of a point among those that have the same zeta, by increasing xi.
    const std::vector<std::vector<unsigned int>> &lines() const
    {
      return points_of_line;
    }

    const ContactPenalties &penalties() const
    {
      return properties.penalties;
    }

    void use_penalties(const ContactPenalties &penalties)
    {
      properties.penalties = penalties;
      begin_ports.reinit(0); // no step has begun with them
    }

    /// Visits how far it reaches.
    void visit_history(Archive &archive)
    {
      archive(reach_factor);
      patches.visit_history(archive);
    }

  private:
    using Patches = FacePatches<3>;
    using Kind    = StepInLanes::Kind;

    void find_lines();
    void find_ends();
    bool share_line(unsigned int patch, unsigned int other) const;
    void add_points_in_contact(const std::optional<unsigned int> &peak, SurfaceEvaluation &found) const;
    RigidCylinder::Pose pose_of(const SurfacePlace &place) const;
    AxisSlopes turned_by(const dealii::Vector<double> &ports) const;
    Patches::Indices near(const SurfacePlace &place, const RigidCylinder::Pose &pose) const;
    StepInLanes::Constants constants(Kind kind, const SurfacePlace &end, const FrictionLaw &friction) const;
    std::vector<SlipShift> shifts_of(unsigned int patch, const std::vector<SurfaceMemory> &memory,
                                     const StaticTerms &terms) const;
    void evaluate_slide(const SlidingState &sliding, const FrictionLaw &friction, SurfaceEvaluation &found);
    void press(const StepInLanes::Constants &step, const SurfacePlace &place, Patches::Indices patches_near,
               SurfaceEvaluation &found);
    void place_patches(const dealii::Vector<double> &begin);
    void press_patches(const dealii::Vector<double> &end, SurfaceEvaluation &found);
    StepInLanes::Constants constants_of(const PortStep &step, const FrictionLaw &friction) const;
    Patches::Indices patches_of(const std::vector<SurfaceMemory> &memory) const;
    void find_summed(Patches::Indices touched);
    void set_forces(Wanted wanted, PortForces &forces) const;
    dealii::FullMatrix<double> tangent(StepInLanes::Part part) const;
    bool reaches_end(const SurfaceEvaluation &found) const;
    double slip_at_begin(unsigned int point) const;
    PortCoordinates coordinates_of(unsigned int patch) const;
    Patches::Indices clip(Patches::Indices near, SurfaceEvaluation &found) const;

    const FrictionFace<3> &face;
    SurfaceContactProperties properties;
    Patches patches;
    std::vector<std::vector<unsigned int>> points_of_line;
    std::vector<std::vector<unsigned int>> lines_of_patch;            ///< increasing
    std::vector<bool> is_at_end;                                      ///< whether a patch is at an end of the face along xi
    std::vector<std::pair<unsigned int, unsigned int>> place_in_line; ///< of a point: its line and its place there

    dealii::Vector<double> begin_ports;
    double begin_x = 0.;
    RigidCylinder::Pose begin_pose{};
    double begin_travel  = 0.; ///< of the terms without inertia
    bool begin_augmented = false;
    mutable std::vector<std::vector<double>> begin_slips; ///< of the points by patches; of those that were looked at

    /// Patches whose forces are summed, and their ports.
    struct Summed
    {
      Patches::Indices patches;
      std::vector<unsigned int> ports;          ///< increasing
      std::vector<PortCoordinates> coordinates; ///< of the patches, with places among the ports in place of these
    };

    StepInLanes in_lanes;
    Patches::Indices looked_at_first;         ///< patches near where a step in time begins, and where it remembers a contact
    Patches::Indices looked_at;               ///< by the last evaluation
    std::vector<StepInLanes::Forces> pressed; ///< of the patches that are summed
    std::optional<unsigned int> most_pressed; ///< the one whose springs are compressed most
    Summed summed;

    std::vector<unsigned int> place_of_port; ///< among those summed
    PortSelection reachable;
    Patches::Indices reached;
    double reach_factor = 1.;
  };
} // namespace sprag
