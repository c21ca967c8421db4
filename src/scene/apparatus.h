// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "laws/moment_law.h"
#include "scene/plane_state.h"

#include <array>
#include <optional>
#include <vector>

namespace sprag
{
  // Optional parts of the apparatus (Fig. 4 of the paper). Lever axes: xi along the lever from the pivot, eta
  // from the friction interface into the lever.

  /// Selects the rotational spring: a torsional stiffness at the hub or a meshed leaf spring.
  SPRAG_ENUMERATION(SpringType, torsional, leaf)

  /// Selects the support of a leaf spring at its far end, the spring joint. LeafSpring::axial says whether it moves along the
  /// spring.
  enum class LeafEnd
  {
    clamped, ///< neither turns nor moves across the spring
    pinned,  ///< turns, does not move across
    guided,  ///< does not turn, moves across
    loose    ///< turns and moves: for the motion in which both levers of a pair swing together; no choice of a scene
  };

  /// Says whether the far end of a leaf spring moves along the spring.
  SPRAG_ENUMERATION(LeafAxial, free, held)

  /// A leaf spring behind the pivot: clamped in the hub, from there along -xi to the spring joint, which the pivot frame carries.
  struct LeafSpring
  {
    double length         = 100.;    ///< between clamp and joint at rest [mm], > 0
    double thickness      = 1.4;     ///< [mm], > 0
    double width          = 40.;     ///< [mm], > 0
    double young_modulus  = 206000.; ///< [MPa]
    double poisson_ratio  = 0.3;
    double density        = 7.85e-9; ///< [t/mm^3]
    LeafEnd end           = LeafEnd::clamped;
    LeafAxial axial       = LeafAxial::free;
    double clamp_distance = 0.;                 ///< from the pivot to the clamp [mm], >= 0
    double sagitta        = 0.;                 ///< sagitta of the unloaded spring, an arc bent towards +eta [mm], signed
    double room           = 150.;               ///< from the pivot to the end of the pivot frame [mm]
    PlaneState plane      = PlaneState::stress; ///< as a beam
  };

  /// Effects of a leaf spring on a lever besides its stiffness. They are found by finite elements, for levers of every fidelity.
  struct LeafBehaviour
  {
    MomentLaw law;
    double mass    = 0.; ///< [t]
    double inertia = 0.; ///< about the pivot, for the deformed shape when the hub turns [t mm^2]

    /// Momentum along xi and eta, in the axes of the lever at rest, for a unit rate of the hub [t mm].
    std::array<double, 2> momentum{};

    /// Vibration mode with the hub fixed, of modal mass 1.
    struct Mode
    {
      double stiffness     = 0.;        ///< omega^2 [1/s^2]
      double participation = 0.;        ///< mass coupling to the rotation of the hub [sqrt(t) mm]
      std::array<double, 2> momentum{}; ///< along xi, eta [sqrt(t)]
    };
    std::vector<Mode> modes;
  };

  /// Describes the spring that turns the lever towards the cylinder.
  struct RotationalSpring
  {
    SpringType type  = SpringType::torsional;
    double stiffness = 7.40e4; ///< k [N mm/rad], > 0; of a leaf spring that of its behaviour

    /// Rotation of the lever from x = 0 at which the spring has no moment [rad], <= 0; below 0 it is preloaded at x = 0.
    double rest_angle = 0.;

    double ratio = 1.; ///< of its moment to that of k; filled in by lever_spring()

    LeafSpring leaf;
    LeafBehaviour behaviour; ///< filled in by prepared_spring(), empty for a torsional spring

    /// Behaviour while both levers of a pair swing together on a free joint; filled in by prepared_spring().
    std::optional<LeafBehaviour> swing;
  };

  /// Returns the moment over the turn of the spring, whatever its type.
  inline MomentLaw moment_law(const RotationalSpring &spring)
  {
    const auto &leaf = spring.behaviour.law;
    return (leaf.is_linear() ? MomentLaw(spring.stiffness) : leaf).times(spring.ratio).at_rest_at(spring.rest_angle);
  }

  /// Selects the outline of the lever: a bar of constant depth on a rigid hub, or a frame of two parts (LeverFrameShape).
  SPRAG_ENUMERATION(LeverOutline, bar, frame)

  /// Lever frame of two parts: the arm 2a along the friction face, of flanges and a thinner web between them, and the root 2b
  /// that carries it on the pivot. In the plane a web is a region of smaller width.
  struct LeverFrameShape
  {
    double tip_depth     = 12.; ///< of the arm at its tip; at the root it has Lever/Depth [mm], > 0
    double flange        = 4.;  ///< depth of each flange [mm], > 0
    double web           = 10.; ///< width of the web in the pockets [mm], 0: holes
    unsigned int pockets = 3;   ///< number of pockets along the arm
    double rib           = 6.;  ///< length of the full-width ribs between pockets and at the ends [mm], > 0
    double root          = 30.; ///< length of the root 2b along xi, in front of the pivot [mm], > 0
  };

  /// Says whether the lever carries a friction plate.
  SPRAG_ENUMERATION(PlateType, none, on_sensors)

  /// Friction plate (3) with its cork sheet, held to the lever through spacers by force sensors, which carry normal force alone,
  /// and by a linear guide, which carries the tangential one.
  struct FrictionPlate
  {
    PlateType type       = PlateType::none;
    double begin         = 95.;  ///< first xi of the plate [mm]
    double end           = 205.; ///< last xi [mm]
    double thickness     = 8.;   ///< [mm], > 0
    double spacer        = 6.;   ///< distance of plate and lever [mm], > 0
    double young_modulus = 70000.;
    double poisson_ratio = 0.33;
    double density       = 2.7e-9;
    std::vector<double> sensors{ 105., 135., 165.,
                                 195. };  ///< xi of the middles of the force sensors [mm], increasing, at least two
    double sensor_length    = 6.;         ///< along xi, over which a sensor presses [mm]
    double sensor_stiffness = 2e5;        ///< of each sensor, in three dimensions of both sensors at one xi [N/mm]
    std::optional<double> sensors_across; ///< see sprag::sensors_across() [mm], > 0
    double sensor_width    = 6.;          ///< across the width, in three dimensions [mm]
    double guide           = 150.;        ///< xi of the guide's middle [mm]
    double guide_stiffness = 1e6;         ///< along the plate [N/mm]
  };

  /// Says whether one lever represents both by symmetry about y = 0 (half), or both are modelled (full).
  SPRAG_ENUMERATION(PairType, half, full)

  /// Selects the spring joint of a mirrored pair. A free joint is carried by the two springs alone: they resist the opening of
  /// both levers and let them swing together. A held joint is fixed to the pivot frame, so that each lever has its own spring.
  SPRAG_ENUMERATION(SpringJoint, free, held)

  /// Two levers that hold the cylinder between them, the second one the mirror image of the first across y = 0.
  struct MirroredPair
  {
    PairType type          = PairType::half;
    SpringJoint joint      = SpringJoint::free;
    double joint_mass      = 0.; ///< of the spring joint between leaf springs [t], >= 0
    double cylinder_offset = 0.; ///< of the cylinder's path from the mirror plane towards the first lever [mm]
    double friction_ratio  = 1.; ///< mu of the second lever over that of the first, > 0
    double spring_ratio    = 1.; ///< k of the second lever's spring over that of the first, > 0
    double contact_ratio   = 1.; ///< P of the second lever's contact over that of the first at the same indentation, > 0
  };

  /// Selects the cylinder: rigid, or an elastic ring on a rigid shaft of the inner radius.
  SPRAG_ENUMERATION(CylinderType, rigid, solid)

  /// Describes the cylinder; its radius is in Geometry.
  struct Cylinder
  {
    CylinderType type    = CylinderType::rigid;
    double inner_radius  = 28.; ///< of the rigid shaft [mm], > 0, < R
    double young_modulus = 70000.;
    double poisson_ratio = 0.33;
    double density       = 2.7e-9;
    double face_size     = 0.25;               ///< element length where it touches the lever [mm]
    PlaneState plane     = PlaneState::strain; ///< plane strain, as it is wide

    // In three dimensions.
    double length   = 0.;                 ///< [mm], >= 0; 0: longer than the lever is wide
    double position = 0.;                 ///< of its middle across the width, from the middle of the lever [mm]
    double tilt     = 0.;                 ///< slope of its axis towards the lever [rad]
    double skew     = 0.;                 ///< slope of its axis along x [rad]
    std::optional<double> tilt_stiffness; ///< of the shaft against further tilt or skew [N mm/rad], > 0; none: fixed
    std::optional<double> skew_stiffness;
    double crown_radius = 0.; ///< of the barrel along the axis [mm], >= 0; 0: straight
    double edge_radius  = 0.; ///< of the rounding at its ends [mm], >= 0; 0: sharp

    /// Returns whether the shaft is elastic, so that the contact tilts or skews the axis.
    bool has_free_axis() const
    {
      return tilt_stiffness || skew_stiffness;
    }

    /// Returns the compliances of the shaft against tilt and skew, 0 where they are fixed [rad/(N mm)].
    std::array<double, 2> slope_compliances() const
    {
      const auto compliance = [](const std::optional<double> &stiffness) { return stiffness ? 1. / *stiffness : 0.; };
      return { { compliance(tilt_stiffness), compliance(skew_stiffness) } };
    }
  };
} // namespace sprag
