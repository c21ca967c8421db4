// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/dynamic_model.h"
#include "model/linearisation.h"
#include "model/port_layout.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <memory>
#include <vector>

namespace sprag
{
  /// A linear lever in the coordinates of its free vibration (mass 1 each): all modes of a beam, or some of a mesh together with
  /// the static shapes of what the others would do. A sprung support is one more mode, of which the lever feels nothing but
  /// through the forces on its ports.
  struct ModalData
  {
    PortLayout ports;
    std::vector<double> stiffness;      ///< omega^2 [1/s^2], > 0
    dealii::FullMatrix<double> damping; ///< symmetric [1/s]
    dealii::FullMatrix<double> shapes;  ///< a row a port, a column a mode
    dealii::FullMatrix<double>
        face_compliance;           ///< static shapes: of the ports to the last rotation's [mm/N], symmetric; empty without
    double relaxation       = 0.;  ///< damping of the static shapes, over their stiffness [s]
    double spring_stiffness = 0.;  ///< of the rotation [N mm/rad], part of `stiffness` already
    unsigned int support    = -1u; ///< mode that is the support's, the last; -1u without
  };

  /// Answers of a ModalData to forces on its ports, static or in steps of the generalised-alpha method.
  class ModalStructure
  {
  public:
    static constexpr unsigned int levers = 1;
    static constexpr bool is_small       = true; ///< vibrations of two can be found together

    explicit ModalStructure(ModalData data);

    const PortLayout &ports() const;

    /// The motion at rest without force.
    Motion rest() const;

    /// Makes the compliance that of statics, or of a step.
    void use_statics();
    void use_step(const StepWeights &weights);
    const PortCompliance &compliance() const;

    /// Motion and displacements of the ports at rest under forces, after use_statics().
    Motion deform(const PortForces &forces) const;

    dealii::Vector<double> port_positions(const Motion &motion) const;
    dealii::Vector<double> port_positions(const Motion &motion, const PortSelection &selected) const;

    /// Position and rate of one port, without the static shapes' rate.
    PortState port_state(const Motion &motion, unsigned int port) const;

    /// Positions of the ports, and their rates and accelerations without the static shapes.
    Kinematic port_kinematics(const Motion &motion) const;

    /// Displacements of the selected ports at the end of a step without forces in it.
    dealii::Vector<double> free_ports(const Motion &accepted, const PortSelection &selected) const;

    /// Completes the step that free_ports() began under its forces.
    Motion advance(const Motion &accepted, const PortForces &forces, const DrivePoint &to) const;

    /// Adds the structure's damping and algorithmic work of the step.
    void add_work(const Motion &begin, const Motion &end, StepWork &work) const;

    StoredEnergy stored_energy(const Motion &motion) const;

    /// Displacements by the local error of a step, of the ports that free_ports() was asked for.
    dealii::Vector<double> port_error(const Motion &begin, const Motion &end) const;

    /// Vibrations under linear forces on the ports, all of them.
    std::vector<StructureMode> vibrations(const PortPerturbation &forces, unsigned int number) const;

    /// Vibrations of this and another structure under forces that couple them. The other's ports are counted from the number of
    /// this one's on, and its coordinates and static forces follow this one's.
    std::vector<StructureMode> vibrations_with(const ModalStructure &other, const PortPerturbation &forces) const;

    /// v^T C v with the motion's positions as velocities v: twice the power that damping takes.
    double damping_form(const Motion &velocities) const;

    unsigned int n_modes() const;

    /// There is nothing to visit, as all that it stores follows from the step at hand.
    void visit_history(Archive &)
    {
    }

  private:
    struct Step
    {
      StepWeights weights{};
      dealii::FullMatrix<double> inverse; ///< of the effective matrix
      PortCompliance compliance;
    };

    unsigned int n_ports() const;

    /// Adds the displacements of selected ports by modes.
    void add_positions(const dealii::Vector<double> &coordinates, const PortSelection &selected,
                       dealii::Vector<double> &result) const;

    /// Returns the ports with static forces, which move those of the face; none where no port from `first_selected` on is of it.
    std::vector<unsigned int> loaded_ports(const Motion &motion, unsigned int first_selected) const;
    double port_position(const Motion &motion, const std::vector<unsigned int> &loaded, unsigned int port) const;
    std::unique_ptr<Step> make_step(const StepWeights &weights) const;
    PortCompliance port_compliance(const dealii::FullMatrix<double> &inverse, double static_share) const;
    dealii::Vector<double> modal_forces(const PortForces &forces) const;
    double static_weight(const StepWeights &w) const;

    /// The share of static forces at the beginning of a step that is left of them at its end where no others act.
    double kept_share(const StepWeights &w) const;

    const ModalData data;
    Step statics;
    std::vector<std::unique_ptr<Step>> steps; ///< the latest last
    const Step *current = nullptr;
    mutable dealii::Vector<double> free_motion; ///< modal, of the last free_ports()
    mutable PortSelection looked_at;            ///< by it
  };
} // namespace sprag
