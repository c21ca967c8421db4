#pragma once

#include "fe/statics/lever_model.h"

#include <array>

namespace sprag
{
  /// Properties of a lever of a full pair, in its own (for the second: mirrored) axes.
  LeverProperties properties_of_lever(const Scene &scene, unsigned int lever);

  /// The two meshed levers of a full mirrored pair, each on its side of the cylinder; of an elastic one each presses on a half of
  /// its own, which the shaft holds. Nothing but the joint of their springs connects them. Held, the springs are one to each
  /// lever. Free, their energy is 2 W((phi_1 + phi_2)/2): the moment M' (phi_1 + phi_2)/2 on both has a tangent of M'/2 times
  /// ((1, 1), (1, 1)), which is a spring M' on each less the rank-one M'/2 (1, -1)^T (1, -1) of swinging together. Newton's
  /// correction is that of each lever alone and, by Sherman and Morrison, a multiple of what a unit moment makes of each.
  ///
  /// Coordinates and contact memory are those of the first lever and then of the second. Points of the face, their tractions and
  /// the fields that a run writes are those of the first.
  class MirroredLevers : public Model
  {
  public:
    /// `triangulation` must outlive the model; both levers have the shape of it. Throws InputError as LeverModel does.
    MirroredLevers(const dealii::Triangulation<2> &triangulation, const Scene &scene);

    State initial_state(const DrivePoint &drive) const override;
    void predict(State &trial, const State &accepted) const override;
    Unbalance evaluate(const State &trial, const State &accepted, FrictionMode mode) override;
    dealii::Vector<double> correction() override;
    double movement(const dealii::Vector<double> &correction) const override;
    double length_scale() const override;
    double penetration() const override;
    std::string objection(const State &trial) const override;
    void augment(State &trial) const override;
    std::vector<ContactMemory> memory() const override;
    void observe(const State &trial, Row &row) const override;
    FacePoints face_points() const override;
    FaceState face_state(const State &trial) const override;

    const LeverModel &lever(unsigned int index) const;

    /// A lever's part of a state.
    State state_of(unsigned int lever, const State &state) const;

  private:
    double mean_turn(const std::array<State, 2> &states) const;
    void free_swing(std::array<dealii::Vector<double>, 2> &corrections);

    const MomentLaw law;
    const bool joint_is_free;
    std::array<LeverModel, 2> levers;

    // Of the last evaluation.
    double stiffness = 0.; ///< M' of the springs at half of both turns [N mm/rad]
    bool touches     = false;
  };
} // namespace sprag
