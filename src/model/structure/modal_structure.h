// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_layout.h"
#include "model/step/dynamic_model.h"
#include "model/step/linearisation.h"
#include "model/structure/lever_frame.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <memory>
#include <vector>

namespace sprag
{
  /// A linear lever in the coordinates of its free vibration (mass 1 each): all modes of a beam, or some of a mesh together with
  /// the static shapes of what the others would do. A sprung support is one more mode, of which the lever feels nothing but
  /// through the forces at its interface.
  struct ModalData
  {
    InterfaceLayout layout;
    std::vector<double> stiffness;      ///< omega^2 [1/s^2], > 0
    dealii::FullMatrix<double> damping; ///< symmetric [1/s]
    dealii::FullMatrix<double> shapes;  ///< a row a dof, a column a mode
    dealii::FullMatrix<double>
        face_compliance;    ///< static shapes: of the dofs to the last rotation's [mm/N], symmetric; empty without
    double relaxation = 0.; ///< damping of the static shapes, over their stiffness [s]
    dealii::FullMatrix<double> layer_stiffness; ///< whose product with `relaxation` is in `damping`; empty: nothing is
    double spring_stiffness = 0.;               ///< of the rotation [N mm/rad], part of `stiffness` already
    unsigned int support    = -1u;              ///< mode that is the support's, the last; -1u without
  };

  /// Adds damping, spring and support to data of a lever's modes, whose layout and whose shapes have room for the support.
  void add_damping_and_support(const LeverDynamics &constants, ModalData &data);

  /// Response of a ModalData to interface forces f, static or in steps of the generalised-alpha method. With modal coordinates q,
  /// shapes S and static shapes u of compliance G_r
  ///   q'' + C q' + omega^2 q = S^T f,   u + relaxation u' = G_r f,   z = S q + u.
  class ModalStructure
  {
  public:
    static constexpr unsigned int levers = 1;
    static constexpr bool is_small       = true; ///< vibrations of two can be found together

    explicit ModalStructure(ModalData data);

    const InterfaceLayout &layout() const
    {
      return data.layout;
    }

    /// The motion at rest without force.
    Motion rest() const;

    /// Selects statics for the functions that follow.
    void use_statics()
    {
      current = &statics;
    }

    /// Selects steps with these weights.
    void use_step(const StepWeights &weights);

    const InterfaceCompliance &compliance() const
    {
      return current->compliance;
    }

    /// Motion and interface displacements at rest under forces, after use_statics().
    Motion deform(const InterfaceForces &forces) const;

    dealii::Vector<double> positions(const Motion &motion, const DofSelection &selected = {}) const; ///< none selected: all

    /// Returns position and rate of one dof, without the static shapes' rate.
    DofState dof_state(const Motion &motion, unsigned int dof) const;

    /// Returns positions of the interface, and their rates and accelerations without the static shapes.
    Kinematic kinematics(const Motion &motion) const;

    /// Returns the displacements of the selected dofs at the end of a step without forces in it.
    dealii::Vector<double> free_displacements(const Motion &accepted, const DofSelection &selected) const;

    /// Completes the step that free_displacements() began under its forces.
    Motion advance(const Motion &accepted, const InterfaceForces &forces, const DrivePoint &to) const;

    /// Adds the structure's damping and algorithmic work of the step.
    void add_work(const Motion &begin, const Motion &end, StepWork &work) const;

    StoredEnergy stored_energy(const Motion &motion) const;

    /// Returns the displacements by the local error of a step, of the dofs selected in free_displacements().
    dealii::Vector<double> local_error(const Motion &begin, const Motion &end) const;

    /// Returns all vibrations under linear forces at the interface; without `shapes` their eigenvalues alone, in half the time.
    std::vector<StructureMode> vibrations(const LinearisedForces &forces, unsigned int number, bool shapes = true) const;

    /// Returns the vibrations of this and another structure under forces that couple them. The other's dofs are counted from the
    /// number of this one's on, and its coordinates and static forces follow this one's.
    std::vector<StructureMode> vibrations_with(const ModalStructure &other, const LinearisedForces &forces) const;

    /// Gives the layer another damping over its stiffness [s], for vibrations alone.
    void use_relaxation(double relaxation);

    /// v^T C v with the motion's positions as velocities v: twice the power that damping takes.
    double damping_form(const Motion &velocities) const;

    unsigned int n_modes() const
    {
      return static_cast<unsigned int>(data.stiffness.size());
    }

    /// Does nothing, as all data follow from the present step.
    void serialise_history(Archive &)
    {
    }

  private:
    /// Inverse and compliance for steps of one duration.
    struct Step
    {
      StepWeights weights{};
      dealii::FullMatrix<double> inverse; ///< of the effective matrix
      InterfaceCompliance compliance;
    };

    unsigned int n_interface() const
    {
      return data.layout.size();
    }

    /// Adds the displacements of selected dofs by modes.
    void add_positions(const dealii::Vector<double> &coordinates, const DofSelection &selected,
                       dealii::Vector<double> &result) const;

    std::unique_ptr<Step> make_step(const StepWeights &weights) const;
    InterfaceCompliance interface_compliance(const dealii::FullMatrix<double> &inverse, double static_share) const;
    dealii::Vector<double> modal_forces(const InterfaceForces &forces) const;

    /// Returns the weight of u_1 in f = K (u_f + relaxation (u_1 - u_0)/dt) of the static shapes, K their stiffness.
    double static_weight(const StepWeights &w) const
    {
      return w.stiffness() + data.relaxation / w.dt;
    }

    /// Returns the share of the static forces at the beginning of a step that remains at its end without interface forces.
    double kept_share(const StepWeights &w) const
    {
      return -(w.alpha_f - data.relaxation / w.dt) / static_weight(w);
    }

    ModalData data;
    Step statics;
    std::vector<std::unique_ptr<Step>> steps; ///< the latest last
    const Step *current = nullptr;
    mutable dealii::Vector<double> free_motion; ///< modal, of the last free_displacements()
    mutable DofSelection selected_dofs;         ///< by it
  };
} // namespace sprag
