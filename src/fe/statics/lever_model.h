#pragma once

#include "fe/contact/augmentation.h"
#include "fe/contact/face_contact.h"
#include "fe/statics/full_stiffness.h"
#include "fe/statics/lever_properties.h"
#include "fe/statics/static_structure.h"
#include "model/hub_spring.h"
#include "model/model.h"

#include <deque>
#include <functional>
#include <variant>

namespace sprag
{
  struct Scene;

  /// A meshed lever on its hub, rotational spring and support against a rigid obstacle or, where the body has a cylinder's face,
  /// an elastic one, or the two of a full mirrored pair, each on its side of the cylinder; of an elastic one each presses on a
  /// half of its own, which the shaft holds. Nothing but the joint of their springs and a sprung support connects the levers of a
  /// pair. Everything is in the axes of a lever, which turn with its hub, those of the second lever mirrored.
  ///
  /// Contact memory is that of the first lever and then of the second. Points of the face and their tractions are those of the
  /// first.
  class LeverModel : public Model
  {
  public:
    /// A single lever. `triangulation` must outlive the model. Throws InputError for properties that exclude each other.
    LeverModel(const dealii::Triangulation<2> &triangulation, LeverProperties properties);

    /// The lever of the scene, or both of its full pair, which are alike in body, spring, support and enforcement of contact.
    LeverModel(const dealii::Triangulation<2> &triangulation, const Scene &scene);

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

    const ContactPenalties &penalties() const;

    /// Evaluates with other penalties from now on [N/mm^3], > 0.
    void use_penalties(const ContactPenalties &penalties);

    const ElasticBody<2> &elastic_body() const;

    /// Displacement of all degrees of freedom of each lever in its axes [mm].
    std::vector<dealii::Vector<double>> body_displacements(const State &state) const;

    /// Index of a hub's turn from the spring's rest among the coordinates.
    unsigned int rotation(unsigned int lever = 0) const;

  private:
    struct Lever
    {
      Lever(const ElasticBody<2> &body, const PortLayout &ports, LeverProperties properties);

      const LeverProperties properties;
      FaceContact contact;
      const FaceMultipliers<2> multipliers;
      std::vector<ContactMemory> memory; ///< and multipliers that `found` was evaluated with
      FaceEvaluation found;
    };

    LeverModel(const dealii::Triangulation<2> &triangulation, std::vector<LeverProperties> properties, bool swings);
    dealii::Vector<double> port_displacements(const State &state) const;
    PortSelection reachable(const State &trial);
    void evaluate_contacts(State &trial, FrictionMode mode);
    void widen_reach(State &trial, FrictionMode mode);
    std::vector<ContactMemory> joined(const std::function<std::vector<ContactMemory>(const Lever &)> &memory) const;
    OfLevers turns(const State &state) const;
    double support_displacement(const State &state) const;
    std::string objection(const Lever &lever, const DrivePoint &drive) const;
    void observe(unsigned int lever, const State &trial, Row &row) const;
    double cylinder_energy(const FaceEvaluation &found) const;
    unsigned int n_face_points() const;

    const ElasticBody<2> body;
    const PortLayout ports;
    std::deque<Lever> levers;
    std::variant<StaticStructure, FullStiffness> structure;
    HubSpringExcess excess;
    const bool joint_is_free;

    // The step.
    DrivePoint start;
    dealii::Vector<double> begin; ///< displacements of the ports
    PortLoads begin_forces;

    PortForces forces; ///< of the contacts and of the springs beyond their linear part, at the last evaluation
  };
} // namespace sprag
