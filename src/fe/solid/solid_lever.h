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

#include <deque>
#include <functional>

namespace sprag
{
  struct Scene;

  /// Forces on the ports of the face of a lever, and the displacements of these ports.
  using FaceSample = std::pair<PortLoads, dealii::Vector<double>>;

  /// A lever in three dimensions on its hub, rotational spring and support against the rigid cylinder, without inertia, or the
  /// two of a full mirrored pair, whose bodies are alike. It follows the steps of LeverModel; all that differs is the body, its
  /// compliance, and that the contact slips in two directions. Coordinates: displacements of the ports; at finite strain those of
  /// all degrees of freedom of the body of each lever follow. To be made and used by the first rank.
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
      return levers.front().contact.penalties();
    }

    /// Evaluates with other penalties from now on [N/mm^3], > 0.
    void use_penalties(const ContactPenalties &penalties);

    bool is_linear() const
    {
      return !finite;
    }

    const LayeredCompliance &face_compliance() const
    {
      return compliance;
    }

    /// Displacement of all degrees of freedom of each lever's body in its axes [mm]; of a linear one by a back-substitution with
    /// the whole.
    std::vector<dealii::Vector<double>> body_displacements(const State &state) const;

    /// Returns a state's forces on the face of each lever and the displacements where they act.
    std::vector<FaceSample> samples(const State &state) const;

    /// What the compliance of the face of a linear body leaves out, against a solve with the whole body, the worst of some
    /// states.
    struct Exactness
    {
      double displacement; ///< largest difference over the largest displacement [-]
      double work;         ///< of the forces on the differences over that on the displacements [-]
    };
    Exactness exactness(const std::vector<FaceSample> &samples) const;

  private:
    struct Lever
    {
      Lever(const SolidBody &body, const Scene &own, const PortLayout &ports, LeverProperties properties);

      const LeverProperties properties;
      SurfaceContact contact;
      const SurfaceView view;
      std::vector<SurfaceMemory> memory; ///< and multipliers that `found` was evaluated with
      mutable SurfaceEvaluation found;   ///< its points where with_points() was called for them
      dealii::Vector<double> of_strain;  ///< unbalance of a body that is not linear

      const SurfaceEvaluation &with_points() const;
    };

    dealii::Vector<double> of_body(const dealii::Vector<double> &coordinates, unsigned int lever) const;
    unsigned int of_body_at(unsigned int lever, unsigned int port) const;
    void set_faces(const PortLoads &forces, const dealii::Vector<double> &from, dealii::Vector<double> &coordinates) const;
    PortLoads on_face(const PortLoads &forces, unsigned int lever) const;
    PortSelection reachable(const State &trial);
    void begin_contacts();
    void evaluate_contacts(State &trial, FrictionMode mode);
    void widen_reach(State &trial, FrictionMode mode);
    double unbalance_with_strain(const State &trial);
    OfLevers turns(const State &state) const;
    double support_displacement(const State &state) const;
    double shaft_energy(const State &state) const;
    std::string objection(const Lever &lever, const DrivePoint &drive) const;
    void observe(unsigned int lever, const State &trial, Row &row) const;
    std::vector<SurfaceMemory> joined(const std::function<std::vector<SurfaceMemory>(const Lever &)> &memory) const;
    std::vector<double> responses(const std::vector<PortLoads> &on_faces) const;
    const std::vector<unsigned int> &line_at(double zeta) const;
    PortLoads interpolation(const std::vector<unsigned int> &line, double xi) const;
    double indentation(unsigned int lever, const Row &row, const State &trial) const;
    bool augments() const;
    unsigned int n_face_points() const;

    const SolidBody &body;
    const PortLayout ports;
    std::deque<Lever> levers;
    mutable LayeredCompliance compliance;              ///< of a face; remembers what it found
    std::vector<std::vector<unsigned int>> node_lines; ///< nodes of the face with the same zeta, along xi; three and more
    const PortSprings springs;
    PortWindow window;
    const FaceMultipliers<3> multipliers;
    HubSpringExcess excess;
    const bool joint_is_free;
    const SensorForces sensors;
    mutable std::optional<FiniteStrain> finite; ///< of a body that is not linear

    // The step.
    DrivePoint start;
    dealii::Vector<double> begin; ///< displacements of the ports
    PortLoads begin_forces;

    PortForces forces; ///< of the contacts and of the springs beyond their linear part, at the last evaluation
  };
} // namespace sprag
