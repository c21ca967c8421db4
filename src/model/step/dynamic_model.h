// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/works.h"
#include "base/archive.h"
#include "model/interface/interface_forces.h"
#include "model/step/contact_point.h"
#include "model/step/generalised_alpha.h"
#include "model/step/vibration.h"
#include "results/columns.h"
#include "results/result_file.h"
#include "scene/drive.h"

#include <memory>
#include <optional>
#include <vector>

namespace sprag
{
  struct StoredJacobian;

  /// The state of a model in time. The analysis owns it: a step makes a new one, which is kept only when it is accepted.
  struct Motion
  {
    DrivePoint drive;
    Kinematic coordinates;             ///< of the structure
    dealii::Vector<double> face_force; ///< elastic forces in the static face shapes [N]; empty without such shapes
    std::vector<ContactHistory> contact;
    DofLoads forces;                               ///< of the step that led here: where the search for the next ones starts
    std::shared_ptr<const StoredJacobian> tangent; ///< of a step on the way here; null without
  };

  /// Returns a motion at rest without force, of so many coordinates and static face shapes.
  inline Motion at_rest(const unsigned int n_coordinates, const unsigned int n_shapes = 0)
  {
    const dealii::Vector<double> zero(n_coordinates);
    Motion motion;
    motion.coordinates = { zero, zero, zero };
    motion.face_force.reinit(n_shapes);
    return motion;
  }

  /// Displacement [mm or rad] and velocity of a dof.
  struct DofState
  {
    double position;
    double velocity;
  };

  /// Result of a step in time.
  struct StepOutcome
  {
    std::optional<Motion> motion; ///< none: no solution found
    StepWork work;
    double error            = 0.; ///< local error of the gap at the contact [mm]
    unsigned int iterations = 0;
  };

  /// Forces of steady sliding without inertia, of one lever.
  struct SlidingForces
  {
    double P; ///< [N]
    double Q; ///< [N]
  };

  /// A slide held at one x: the cylinder's centre stays there and the cylinder turns, so that its surface passes the lever at the
  /// speed of the steady slide. An equilibrium, also called frozen steady sliding, about which vibrations can be linearised.
  struct HeldSlide
  {
    Motion motion;    ///< at rest, with the drive at rest
    DrivePoint drive; ///< whose slide it is
    dealii::Vector<double> displacements;
    ContactFriction friction = ContactFriction::sliding;
    double speed             = 0.; ///< of the surface along the lever, signed [mm/s]
    double mu                = 0.;
    double penetration       = 0.; ///< of the contact's spring, the largest: P follows from it [mm]
    double indentation       = 0.; ///< physical, that of the column of this name [mm]
    SlidingForces forces{};
    std::optional<SlidingForces> second; ///< forces of a pair's second lever
    double margin = 0.; ///< to jamming: P without friction over P, (s + mu e)/s of a rigid lever with mu signed as the motion;
                        ///< of a pair the smaller one
    double own_speed_share = 0.; ///< by which P with the rigid lever's slip speed differs, over P
    double uniqueness      = 0.; ///< det(1 - G df/dz) over that without friction's part; <= 0 beyond where equilibria are unique

    /// Returns whether a lever presses on the cylinder.
    bool is_pressed() const
    {
      return forces.P > 0. || (second && second->P > 0.);
    }
  };

  /// Mechanics of a scene in time at one fidelity. Analyses know nothing of beams, meshes and dimensions.
  class DynamicModel
  {
  public:
    virtual ~DynamicModel() = default;

    /// The motion that a run begins with. If the drive moves, the lever slides steadily at its x and v, with velocities and
    /// accelerations. If it rests, the lever touches it without force at x = 0; further on it is in equilibrium with the friction
    /// that sliding there forward, slowly, has left. Throws AnalysisError if there is no such equilibrium.
    virtual Motion initial_motion(const DrivePoint &drive) = 0;

    /// One step of the time integration from an accepted motion. Throws AnalysisError if a factorisation fails.
    virtual StepOutcome step(const Motion &accepted, const DrivePoint &to, const StepWeights &weights) = 0;

    /// Forces of each lever in steady sliding with the drive at x and v, of a zero its sign; empty without an equilibrium.
    virtual std::vector<SlidingForces> sliding_forces(const DrivePoint &drive) = 0;

    /// The slide held at the drive's x, sliding as it does at its v; none where there is no equilibrium.
    virtual std::optional<HeldSlide> hold(const DrivePoint &drive, ContactFriction friction) = 0;

    /// Largest share of the friction, up to 1, with which the slide can be followed from the one without friction, within
    /// `resolution`, > 0. Throws AnalysisError where a tangent is singular.
    virtual double largest_friction_share(const DrivePoint &drive, double resolution) = 0;

    /// Vibrations about a held slide, by increasing |lambda|: all of a small model, at least the `number` lowest of a large one.
    /// Not in contact: those of the free structure.
    virtual std::vector<Eigenmode> vibrations(const HeldSlide &slide, bool in_contact, unsigned int number) = 0;

    /// The eigenvalues lambda of vibrations() in contact, without explaining their modes [1/s].
    virtual std::vector<std::complex<double>> eigenvalues(const HeldSlide &slide, unsigned int number) = 0;

    /// The held slide displaced along a mode so that the gap moves by `amplitude` [mm] at first, with the velocities of the mode.
    virtual Motion perturbed(const HeldSlide &slide, const Eigenmode &mode, double amplitude) = 0;

    virtual ModeShape mode_shape(const Eigenmode &mode) const = 0;

    virtual StoredEnergy stored_energy(const Motion &motion) const = 0;

    /// Fills the columns of mechanics at `motion`, the outcome of the last initial_motion() or step().
    virtual void observe(const Motion &motion, Row &row) const = 0;

    /// Returns Q of all levers together there [N], as observe() finds it.
    virtual double drive_force(const Motion &motion) const = 0;

    /// Points of the friction face and their tractions at the last motion; empty where there is no mesh.
    virtual FacePoints face_points() const                   = 0;
    virtual FaceState face_state(const Motion &motion) const = 0;

    /// Serialises what later steps and slides depend on, to the last bit, beside the motion that they begin with: what was found
    /// on the way and is kept. A model that reads it from an archive continues as the one that wrote it.
    virtual void serialise_history(Archive &archive) = 0;
  };
} // namespace sprag
