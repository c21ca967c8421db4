#pragma once

#include "fe/contact/augmentation.h"
#include "fe/solid/finite_strain.h"
#include "fe/solid/layered_compliance.h"
#include "fe/solid/sensor_forces.h"
#include "fe/solid/surface_observation.h"
#include "fe/statics/lever_properties.h"
#include "fe/statics/port_window.h"
#include "model/hub_spring.h"
#include "model/model.h"

namespace sprag
{
  /// Forces on the ports of the face, and the displacements of these ports.
  using FaceSample = std::pair<PortLoads, dealii::Vector<double>>;

  /// A lever in three dimensions on its hub, rotational spring and support against the rigid cylinder, without inertia. It
  /// follows the steps of LeverModel; all that differs is the body, its compliance, and that the contact slips in two directions.
  /// Coordinates: displacements of the ports; at finite strain those of all degrees of freedom of the body follow.
  /// To be made and used by the first rank.
  class SolidLever : public Model
  {
  public:
    /// The body must outlive this.
    SolidLever(const SolidBody &body, const Scene &scene);

    State initial_state(const DrivePoint &drive) const override;
    State begin_step(const State &accepted, const DrivePoint &end) override;
    Unbalance evaluate(State &trial, FrictionMode mode) override;
    dealii::Vector<double> correction() override;
    double movement(const dealii::Vector<double> &correction) const override;
    double length_scale() const override;
    double penetration() const override;
    std::string objection(const State &trial) const override;
    void augment(State &trial) const override;
    void remember(State &state) const override;
    void observe(const State &trial, Row &row) const override;
    FacePoints face_points() const override;
    FaceState face_state(const State &trial) const override;
    void visit_history(Archive &archive) override;

    const ContactPenalties &penalties() const
    {
      return contact.penalties();
    }

    /// Evaluates with other penalties from now on [N/mm^3], > 0.
    void use_penalties(const ContactPenalties &penalties)
    {
      contact.use_penalties(penalties);
    }

    bool is_linear() const
    {
      return !finite;
    }

    const LayeredCompliance &face_compliance() const
    {
      return compliance;
    }

    /// Displacement of all degrees of freedom of the body in its axes [mm]; of a linear one by a back-substitution with the
    /// whole.
    dealii::Vector<double> body_displacement(const State &state) const;

    /// Returns a state's forces on the face and the displacements where they act.
    FaceSample sample(const State &state) const;

    /// What the compliance of the face of a linear body leaves out, against a solve with the whole body, the worst of some
    /// states.
    struct Exactness
    {
      double displacement; ///< largest difference over the largest displacement [-]
      double work;         ///< of the forces on the differences over that on the displacements [-]
    };
    Exactness exactness(const std::vector<FaceSample> &samples) const;

  private:
    dealii::Vector<double> of_body(const dealii::Vector<double> &coordinates) const;
    void set_face(const PortLoads &forces, const dealii::Vector<double> &displacement, dealii::Vector<double> &coordinates) const;
    PortLoads on_face(const PortLoads &forces) const;
    PortSelection reachable(const State &trial);
    void evaluate_contact(State &trial, FrictionMode mode);
    void widen_reach(State &trial, FrictionMode mode);
    double turn(const State &state) const;
    double support_displacement(const State &state) const;
    double shaft_energy(const State &state) const;
    const std::vector<unsigned int> &line_at(double zeta) const;
    PortLoads interpolation(const std::vector<unsigned int> &line, double xi) const;
    double indentation(const Row &row, const State &trial) const;
    bool augments() const;
    const SurfaceEvaluation &with_points() const;

    const SolidBody &body;
    const LeverProperties properties;
    const PortLayout ports;
    mutable LayeredCompliance compliance;              ///< remembers what it found
    std::vector<std::vector<unsigned int>> node_lines; ///< nodes of the face with the same zeta, along xi; three and more
    const PortSprings springs;
    PortWindow window;
    SurfaceContact contact;
    const FaceMultipliers<3> multipliers;
    const SurfaceView view;
    HubSpringExcess excess;
    const SensorForces sensors;
    mutable std::optional<FiniteStrain> finite; ///< of a body that is not linear

    // The step.
    DrivePoint start;
    dealii::Vector<double> begin; ///< displacements of the ports
    PortLoads begin_forces;

    mutable SurfaceEvaluation found;   ///< its points where with_points() was called for them
    std::vector<SurfaceMemory> memory; ///< and multipliers that it was evaluated with
    PortForces forces;                 ///< of the contact and of the spring beyond its linear part, at the last evaluation
  };
} // namespace sprag
