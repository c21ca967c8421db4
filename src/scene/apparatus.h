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
  // Parts of the apparatus (Fig. 4 of the paper), each a choice of the scene. Lever axes: xi along the lever from the pivot, eta
  // from the friction interface into the lever.

  /// A spring is one number at the hub (torsional) or a meshed leaf spring.
  SPRAG_ENUMERATION(SpringType, torsional, leaf)

  /// Support of a leaf spring at its far end, the spring joint. Along the spring it is free or held, see LeafSpring::axial.
  enum class LeafEnd
  {
    clamped, ///< neither turns nor moves across the spring
    pinned,  ///< turns, does not move across
    guided,  ///< does not turn, moves across
    loose    ///< nothing does: of a pair's leaf springs where both swing together; no choice of a scene
  };

  SPRAG_ENUMERATION(LeafAxial, free, held)

  /// A leaf spring behind the pivot: clamped in the hub, from there along -xi to the spring joint, which the pivot frame carries.
  struct LeafSpring
  {
    double length         = 100.; ///< between clamp and joint at rest [mm], > 0
    double thickness      = 1.4;  ///< [mm], > 0
    double width          = 40.;
    double young_modulus  = 206000.;
    double poisson_ratio  = 0.3;
    double density        = 7.85e-9; ///< [t/mm^3]
    LeafEnd end           = LeafEnd::clamped;
    LeafAxial axial       = LeafAxial::free;
    double clamp_distance = 0.;                 ///< from the pivot to the clamp [mm], >= 0
    double sagitta        = 0.;                 ///< of the unloaded spring, an arc bent towards +eta [mm], signed
    double room           = 150.;               ///< from the pivot to the end of the pivot frame [mm]
    PlaneState plane      = PlaneState::stress; ///< as a beam
  };

  /// Effects of a leaf spring on a lever besides its stiffness. They are found by finite elements, for levers of every fidelity.
  struct LeafBehaviour
  {
    MomentLaw law;
    double mass    = 0.; ///< [t]
    double inertia = 0.; ///< about the pivot, of the shape it takes when the hub turns [t mm^2]

    /// Momentum along xi and eta, in the axes of the lever at rest, for a unit rate of the hub [t mm].
    std::array<double, 2> momentum{};

    /// Vibrations with the hub held, of mass 1.
    struct Mode
    {
      double stiffness     = 0.;        ///< omega^2 [1/s^2]
      double participation = 0.;        ///< mass that couples it with the hub's rotation [sqrt(t) mm]
      std::array<double, 2> momentum{}; ///< along xi, eta [sqrt(t)]
    };
    std::vector<Mode> modes;
  };

  struct RotationalSpring
  {
    SpringType type  = SpringType::torsional;
    double stiffness = 7.40e4; ///< k [N mm/rad], > 0; of a leaf spring that of its behaviour

    /// Turn of the lever from x = 0 at which the spring has no moment [rad], <= 0: with a preload it presses at x = 0 already.
    double rest_angle = 0.;

    LeafSpring leaf;
    LeafBehaviour behaviour; ///< filled in by prepared_spring(), empty for a torsional spring

    /// The behaviour where both levers of a pair swing together with a joint that is free; filled in there too.
    std::optional<LeafBehaviour> swing;
  };

  /// Returns the moment over the turn of the spring, whatever its type.
  inline MomentLaw moment_law(const RotationalSpring &spring)
  {
    const auto &leaf = spring.behaviour.law;
    return (leaf.is_linear() ? MomentLaw(spring.stiffness) : leaf).at_rest_at(spring.rest_angle);
  }

  /// The outline is a bar of constant depth on a rigid hub or a frame of two parts, see LeverFrameShape.
  SPRAG_ENUMERATION(LeverOutline, bar, frame)

  /// Lever frame of two parts: the arm 2a along the friction face, of flanges and a thinner web between them, and the root 2b
  /// that carries it on the pivot. In the plane a web is a region of smaller width.
  struct LeverFrameShape
  {
    double tip_depth     = 12.; ///< of the arm at its tip; at the root it has Lever/Depth [mm], > 0
    double flange        = 4.;  ///< depth of each flange [mm], > 0
    double web           = 10.; ///< width of the web in the pockets [mm], 0: holes
    unsigned int pockets = 3;
    double rib           = 6.;  ///< length of the full width between pockets and at the ends [mm], > 0
    double root          = 30.; ///< length of the root 2b along xi, in front of the pivot [mm], > 0
  };

  SPRAG_ENUMERATION(PlateType, none, on_sensors)

  /// Friction plate (3) with its cork sheet, held to the lever through spacers by force sensors, which carry normal force alone,
  /// and by a linear guide, which carries the tangential one.
  struct FrictionPlate
  {
    PlateType type       = PlateType::none;
    double begin         = 95.; ///< first xi of the plate [mm]
    double end           = 205.;
    double thickness     = 8.;
    double spacer        = 6.; ///< distance of plate and lever [mm], > 0
    double young_modulus = 70000.;
    double poisson_ratio = 0.33;
    double density       = 2.7e-9;
    std::vector<double> sensors{ 105., 135., 165., 195. }; ///< xi of their middles [mm], increasing, at least two
    double sensor_length    = 6.;                          ///< along xi, over which a sensor presses [mm]
    double sensor_stiffness = 2e5;                         ///< of each, in three dimensions of the two of a place [N/mm]
    std::optional<double> sensors_across;                  ///< see sprag::sensors_across() [mm], > 0
    double sensor_width    = 6.;                           ///< in three dimensions: across the width [mm]
    double guide           = 150.;                         ///< xi of the guide's middle [mm]
    double guide_stiffness = 1e6;                          ///< along the plate [N/mm]
  };

  /// One lever stands for both (half), which the mirror plane y = 0 makes two, or both are there (full).
  SPRAG_ENUMERATION(PairType, half, full)

  /// The spring joint of a mirrored pair is free, carried by the two springs alone, which take up what both levers open and let
  /// them swing together; or held by the pivot frame, so that each lever has a spring of its own.
  SPRAG_ENUMERATION(SpringJoint, free, held)

  /// Two levers that hold the cylinder between them, the second one the mirror image of the first across y = 0.
  struct MirroredPair
  {
    PairType type          = PairType::half;
    SpringJoint joint      = SpringJoint::free;
    double joint_mass      = 0.; ///< of the spring joint between leaf springs [t], >= 0
    double cylinder_offset = 0.; ///< of the cylinder's path from the mirror plane towards the first lever [mm]
    double friction_ratio  = 1.; ///< mu of the second lever over that of the first, > 0
  };

  /// The cylinder is rigid or solid: elastic, on a rigid core or shaft of the inner radius.
  SPRAG_ENUMERATION(CylinderType, rigid, solid)

  struct Cylinder
  {
    CylinderType type    = CylinderType::rigid;
    double inner_radius  = 28.; ///< of the rigid core or shaft [mm], > 0, < R
    double young_modulus = 70000.;
    double poisson_ratio = 0.33;
    double density       = 2.7e-9;
    double face_size     = 0.25;               ///< element length where it touches the lever [mm]
    PlaneState plane     = PlaneState::strain; ///< it is wide

    // In three dimensions.
    double length   = 0.;                 ///< [mm], >= 0; 0: longer than the lever is wide
    double position = 0.;                 ///< of its middle across the width, from the lever's middle [mm]
    double tilt     = 0.;                 ///< slope of its axis towards the lever [rad]
    double skew     = 0.;                 ///< slope of its axis along x [rad]
    std::optional<double> tilt_stiffness; ///< of the shaft against more of these slopes [N mm/rad], > 0; none: fixed
    std::optional<double> skew_stiffness;
    double crown_radius = 0.; ///< of the barrel along the axis [mm], >= 0; 0: straight
    double edge_radius  = 0.; ///< of the rounding at its ends [mm], >= 0; 0: sharp

    /// Returns true if the shaft lets the axis yield to the contact.
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
