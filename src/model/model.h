#pragma once

#include "base/archive.h"
#include "model/contact_point.h"
#include "model/port_forces.h"
#include "results/columns.h"
#include "results/result_file.h"
#include "scene/drive.h"

#include <deal.II/lac/vector.h>

#include <string>
#include <vector>

namespace sprag
{
  /// The state of a model without inertia. The analysis owns it: a step works on a copy that is kept only when it is accepted.
  struct State
  {
    DrivePoint drive;
    dealii::Vector<double> coordinates;            ///< generalised coordinates of the model
    std::vector<ContactMemory> contact;            ///< of the contact points, as the model keeps them
    PortLoads forces{};                            ///< on the ports of a meshed lever, which its displacements follow from
    std::vector<PointMemory<2>> surface_contact{}; ///< of the contact points of a surface
  };

  /// Size of the unbalance at a trial state, and what a correction must be small against.
  struct Unbalance
  {
    double norm;    ///< falls to round-off at equilibrium; unit of the model's choice, for the line search alone
    double overlap; ///< largest p / penalty over the contact points [mm]
  };

  /// Quasi-static mechanics of a scene at one fidelity. Analyses know nothing of bodies, meshes and dimensions.
  class Model
  {
  public:
    virtual ~Model() = default;

    virtual State initial_state(const DrivePoint &drive) const = 0;

    /// Begins a step from an accepted state, to which all that follows refers until the next. Returns a first guess of the state
    /// at its end.
    virtual State begin_step(const State &accepted, const DrivePoint &end) = 0;

    /// Evaluates the equilibrium of `trial` at the end of the step and sets its forces; correction() and friends refer to the
    /// last call.
    virtual Unbalance evaluate(State &trial, FrictionMode mode) = 0;

    /// Solves the linearised equilibrium. Throws AnalysisError if the factorisation fails.
    virtual dealii::Vector<double> correction() = 0;

    /// Largest movement of a material point that a correction means [mm].
    virtual double movement(const dealii::Vector<double> &correction) const = 0;

    /// Size of the scene, against which positions are rounded off [mm].
    virtual double length_scale() const = 0;

    /// Largest overlap of body and obstacle, or what of it the next augmentation removes [mm].
    virtual double penetration() const = 0;

    /// Tells why the state of the last evaluation, though balanced, is beyond what the model can tell; empty if it is not.
    virtual std::string objection(const State &trial) const = 0;

    /// Multipliers of the next augmentation from the tractions of the last evaluation.
    virtual void augment(State &trial) const = 0;

    /// Gives a state the memory of the contact points at the end of the step that the last evaluation belongs to.
    virtual void remember(State &state) const = 0;

    /// Fills the columns of mechanics from the last evaluation.
    virtual void observe(const State &trial, Row &row) const = 0;

    /// Points of the friction face and their tractions at the last evaluation.
    virtual FacePoints face_points() const = 0;

    virtual FaceState face_state(const State &trial) const = 0;

    /// Visits what later steps depend on, to the last bit, beside the state that they begin with: what was found on the way and
    /// is kept. A model that takes it from an archive goes on as the one it is of.
    virtual void visit_history(Archive &archive) = 0;
  };
} // namespace sprag
