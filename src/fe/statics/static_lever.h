// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/augmentation.h"
#include "fe/contact/face_contact.h"
#include "fe/statics/full_stiffness.h"
#include "fe/statics/lever_properties.h"
#include "fe/statics/solid_structure.h"
#include "fe/statics/static_structure.h"
#include "model/step/model.h"
#include "model/structure/hub_spring.h"

#include <deque>
#include <functional>
#include <variant>

namespace sprag
{
  struct Device;

  /// Parts of a lever without inertia: the body, from its mesh or from one that is shared with others, its answer to forces, its
  /// contact and how results show that.
  template <int dim>
  struct LeverParts;

  /// Parts in a plane.
  template <>
  struct LeverParts<2>
  {
    using Source    = dealii::Triangulation<2>;
    using Body      = ElasticBody<2>;
    using KeptBody  = const ElasticBody<2>;
    using Structure = std::variant<StaticStructure, FullStiffness>;
  };

  /// Parts in space.
  template <>
  struct LeverParts<3>
  {
    using Source    = SolidBody;
    using Body      = SolidBody;
    using KeptBody  = const SolidBody &;
    using Structure = std::variant<SolidStructure>;
  };

  /// A meshed lever on its hub, rotational spring and support without inertia, or the two of a full mirrored pair, each on its
  /// side of the cylinder. That is rigid or, in a plane, elastic where the body has a cylinder's face; of an elastic one each
  /// lever presses on a half of its own, which the shaft holds. Nothing but the joint of their springs and a sprung support
  /// connects the levers of a pair, which are alike in body, spring, support and enforcement of contact. Everything is in the
  /// axes of a lever, which turn with its hub, those of the second lever mirrored. In three dimensions to be made and used by the
  /// first rank.
  ///
  /// The contact history is that of the first lever and then of the second. Points of the face and their tractions are those of
  /// the first.
  template <int dim>
  class StaticLever : public Model
  {
  public:
    using Parts     = LeverParts<dim>;
    using Structure = typename Parts::Structure;

    /// The scene's lever or pair. `source` must outlive it. Throws InputError for properties that exclude each other.
    StaticLever(const typename Parts::Source &source, const Device &device);

    /// A single lever in a plane.
    StaticLever(const typename Parts::Source &source, LeverProperties properties);

    State initial_state(const DrivePoint &drive) const override;
    Step begin_step(const State &accepted, const DrivePoint &end) override;
    Evaluation evaluate(Step &step, FrictionMode mode) override;
    dealii::Vector<double> correction(const Evaluation &evaluation) override;
    double movement(const dealii::Vector<double> &correction) const override;
    double length_scale() const override
    {
      return springs.arm;
    }

    double penetration(const Evaluation &evaluation) const override;
    std::string check_validity(const State &state, const Evaluation &evaluation) const override;
    void augment(const Evaluation &evaluation, State &trial) const override
    {
      trial.contact = augmented(evaluation);
    }

    void store_history(const Evaluation &evaluation, State &state) const override;
    void observe(const State &state, const Evaluation &evaluation, Row &row) const override;
    FacePoints face_points() const override
    {
      return levers.front().contact.face_points();
    }

    FaceState face_state(const State &state, const Evaluation &evaluation) const override;
    void serialise_history(Archive &archive) override
    {
      for (auto &lever : levers)
        lever.contact.serialise_history(archive);
      std::visit([&](auto &s) { s.serialise_history(archive); }, own_structure);
    }

    const ContactPenalties &penalties() const
    {
      return levers.front().contact.penalties();
    }

    /// Evaluates with other penalties from now on [N/mm^3], > 0.
    void use_penalties(const ContactPenalties &penalties)
    {
      for (auto &lever : levers)
        lever.contact.use_penalties(penalties);
    }

    const typename Parts::Body &body() const
    {
      return own_body;
    }

    /// Returns how the levers answer to forces.
    const Structure &structure() const
    {
      return own_structure;
    }

    /// Returns the displacements in each of some states.
    std::vector<BodyDisplacements> body_displacements(const std::vector<StaticState> &states) const
    {
      return std::visit([&](const auto &s) { return s.body_displacements(states); }, own_structure);
    }

    /// Returns those in one state.
    BodyDisplacements body_displacements(const dealii::Vector<double> &coordinates, const DofLoads &forces) const
    {
      return body_displacements({ { coordinates, forces } }).front();
    }

    /// Returns the index of a hub's turn from the spring's rest among the coordinates.
    unsigned int rotation(const unsigned int lever = 0) const
    {
      return std::visit([&](const auto &s) { return s.coordinate(layout.rotation(lever)); }, own_structure);
    }

  private:
    using History = std::vector<ContactHistory>;

    /// Properties and contact of one lever.
    struct Lever
    {
      Lever(const typename Parts::Body &body, const InterfaceLayout &layout, LeverProperties properties);

      const LeverProperties properties;
      FaceContact<dim> contact;
    };

    /// The contact of a lever in an evaluation.
    struct Found
    {
      History history; ///< and multipliers that it was evaluated with
      FaceEvaluation<dim> contact;
    };

    /// An evaluation.
    struct Balance
    {
      std::vector<Found> levers;
      InterfaceForces forces; ///< of the contacts and of the springs beyond their linear part
      DofSelection near;
      Residual residual;
    };

    StaticLever(const typename Parts::Source &source, std::vector<LeverProperties> properties, bool swings,
                const std::array<double, 2> &surroundings);

    static const Balance &get_balance(const Evaluation &evaluation)
    {
      return std::any_cast<const Balance &>(evaluation.model_data);
    }

    dealii::Vector<double> interface_displacements(const dealii::Vector<double> &coordinates) const
    {
      return std::visit([&](const auto &s) -> dealii::Vector<double> { return s.interface_displacements(coordinates); },
                        own_structure);
    }

    bool has_candidates() const
    {
      return std::visit([](const auto &s) { return s.has_candidates; }, own_structure);
    }

    void look_at(Step &step);
    void shift_faces(Step &step);
    double travel(unsigned int lever, const Step &step, const dealii::Vector<double> &end) const;
    bool evaluate_levers(const Step &step, FrictionMode mode, Balance &found);
    void evaluate_contacts(Step &step, FrictionMode mode, Balance &found);
    History joined(const std::function<History(std::size_t)> &history) const;
    History augmented(const Evaluation &evaluation) const;

    PerLever turns(const State &state) const
    {
      PerLever result{};
      for (unsigned int i = 0; i < layout.levers; ++i)
        result[i] = state.coordinates[rotation(i)];
      return result;
    }

    /// Returns u along x by the interface displacements [mm].
    double support_displacement(const dealii::Vector<double> &displacements) const
    {
      return layout.sprung ? displacements[layout.support()] : 0.;
    }

    double cylinder_energy(unsigned int lever, const State &state) const;
    std::string check_validity(unsigned int lever, const DrivePoint &drive, const FaceEvaluation<dim> &found) const;
    void observe(unsigned int lever, const State &state, const FaceEvaluation<dim> &found, Row &row) const;

    bool augments() const
    {
      return levers.front().properties.contact.enforcement == Enforcement::augmented_lagrangian;
    }

    unsigned int n_face_points() const
    {
      return static_cast<unsigned int>(own_body.friction_face().points.size());
    }

    typename Parts::KeptBody own_body;
    const InterfaceLayout layout;
    std::deque<Lever> levers;
    const JointSprings springs;
    Structure own_structure;
    const std::vector<std::vector<unsigned int>> face_lines; ///< see lines_along()
    const FaceMultipliers<dim> multipliers;
    HubSpringExcess excess;
    const bool joint_is_free;
    DofSelection candidates; ///< the dofs that the contacts look at
  };
} // namespace sprag
