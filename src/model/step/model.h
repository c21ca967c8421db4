// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"
#include "model/interface/interface_forces.h"
#include "model/step/contact_point.h"
#include "results/columns.h"
#include "results/result_file.h"
#include "scene/drive.h"

#include <deal.II/lac/vector.h>

#include <any>
#include <string>
#include <vector>

namespace sprag
{
  /// The state of a model without inertia. The analysis owns it: a step works on a copy that is kept only when it is accepted.
  struct State
  {
    DrivePoint drive;
    dealii::Vector<double> coordinates;  ///< generalised coordinates of the model
    std::vector<ContactHistory> contact; ///< of the contact points, as the model keeps them
    DofLoads forces{};                   ///< at the interface of a meshed lever, which its displacements follow from
  };

  /// A step without inertia from an accepted state.
  struct Step
  {
    State trial;                          ///< at its end; at first a guess
    DrivePoint start;                     ///< of the drive
    DofLoads forces;                      ///< where it begins
    dealii::Vector<double> displacements; ///< interface displacements where it begins
    DofSelection near;                    ///< candidate dofs and those of the forces, of a model that looks at some alone
  };

  /// The equilibrium of a trial state, as one evaluation found it.
  struct Evaluation
  {
    double residual    = 0.; ///< falls to round-off at equilibrium; unit of the model's choice, for the line search alone
    double penetration = 0.; ///< largest p / penalty over the contact points [mm]
    std::any model_data{};   ///< contacts and forces in the model's own terms
  };

  /// Quasi-static mechanics of a scene at one fidelity. Analyses know nothing of bodies, meshes and dimensions.
  class Model
  {
  public:
    virtual ~Model() = default;

    virtual State initial_state(const DrivePoint &drive) const = 0;

    /// Returns the step from an accepted state to `end`, with a first guess of the state there.
    virtual Step begin_step(const State &accepted, const DrivePoint &end) = 0;

    /// Evaluates the equilibrium of the step's trial state and sets the forces of that. Where the contact reaches beyond the dofs
    /// that the step looks at, it looks at more from then on.
    virtual Evaluation evaluate(Step &step, FrictionMode mode) = 0;

    /// Solves the linearised equilibrium for the change of the coordinates. Throws AnalysisError if the factorisation fails.
    virtual dealii::Vector<double> correction(const Evaluation &found) = 0;

    /// Returns the largest movement of a material point that a correction means [mm].
    virtual double movement(const dealii::Vector<double> &correction) const = 0;

    /// Returns the size of the scene, against which positions are rounded off [mm].
    virtual double length_scale() const = 0;

    /// Returns the largest penetration of body and counterface, or what of it the next augmentation removes [mm].
    virtual double penetration(const Evaluation &found) const = 0;

    /// Returns why an equilibrium is outside the validity of the model; empty if it is not.
    virtual std::string check_validity(const State &state, const Evaluation &found) const = 0;

    /// Gives a state the multipliers of the next augmentation.
    virtual void augment(const Evaluation &found, State &trial) const = 0;

    /// Stores in a state the history of the contact points at the end of its step.
    virtual void store_history(const Evaluation &found, State &state) const = 0;

    /// Fills the columns of mechanics.
    virtual void observe(const State &state, const Evaluation &found, Row &row) const = 0;

    /// Returns the points of the friction face.
    virtual FacePoints face_points() const = 0;

    /// Returns the tractions at these points.
    virtual FaceState face_state(const State &state, const Evaluation &found) const = 0;

    /// Serialises what later steps depend on, to the last bit, beside the state that they begin with: what was found on the way
    /// and is kept. A model that reads it from an archive continues as the one that wrote it.
    virtual void serialise_history(Archive &archive) = 0;
  };
} // namespace sprag
