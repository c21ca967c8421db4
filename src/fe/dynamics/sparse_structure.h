// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "fe/algebra/compressed_rows.h"
#include "fe/dynamics/effective_system.h"
#include "fe/dynamics/lever_modes.h"
#include "model/step/dynamic_model.h"
#include "model/step/linearisation.h"
#include "model/structure/lever_frame.h"

#include <memory>

namespace sprag
{
  /// A meshed linear lever with all its degrees of freedom, answering to forces at its interface as ModalStructure does.
  /// Coordinates: TotalCoordinates and, on a sprung support, its displacement.
  class SparseStructure
  {
  public:
    static constexpr unsigned int levers = 1;
    static constexpr bool is_small       = false; ///< see ModalStructure

    /// `modes` are those of the free lever on its spring; all but the first are damped. The matrices are kept.
    SparseStructure(const ElasticBody<2> &body, std::shared_ptr<const InertialMatrices> matrices, const LeverModes &modes,
                    const LeverDynamics &constants);

    const InterfaceLayout &layout() const
    {
      return lever_interface.layout();
    }

    /// The motion at rest without force.
    Motion rest() const;

    /// Makes the compliance that of statics, or of a step.
    void use_statics();
    void use_step(const StepWeights &weights);

    const InterfaceCompliance &compliance() const
    {
      return current->compliance;
    }

    /// Motion at rest under forces, after use_statics().
    Motion deform(const InterfaceForces &forces) const;

    dealii::Vector<double> positions(const Motion &motion, const DofSelection & = {}) const
    {
      return lever_interface.displacements(motion.coordinates.position);
    }

    DofState dof_state(const Motion &motion, unsigned int dof) const;
    Kinematic kinematics(const Motion &motion) const;

    /// Returns the interface displacements at the end of a step without forces in it.
    dealii::Vector<double> free_displacements(const Motion &accepted, const DofSelection &selected) const;

    /// Completes the step that free_displacements() began under its forces.
    Motion advance(const Motion &accepted, const InterfaceForces &forces, const DrivePoint &to) const;

    /// Adds the structure's damping and algorithmic work of the step.
    void add_work(const Motion &begin, const Motion &end, StepWork &work) const;

    StoredEnergy stored_energy(const Motion &motion) const;

    /// Returns the interface displacements by the local error of a step in the lowest modes.
    dealii::Vector<double> local_error(const Motion &begin, const Motion &end) const;

    /// Returns the vibrations of lowest frequency under linear forces at the interface.
    std::vector<StructureMode> vibrations(const LinearisedForces &forces, unsigned int number, bool shapes = true);

    // Products with all coordinates, the support's included.
    void mass_product(const dealii::Vector<double> &q, dealii::Vector<double> &result) const;
    void damping_product(const dealii::Vector<double> &q, dealii::Vector<double> &result) const;
    void stiffness_product(const dealii::Vector<double> &q, dealii::Vector<double> &result) const;

    /// Solves with the stiffness, after use_statics().
    void solve_statics(const dealii::Vector<double> &load, dealii::Vector<double> &q) const;

    const LeverInterface &interface() const
    {
      return lever_interface;
    }

    unsigned int n_coordinates() const
    {
      return lever_interface.n_coordinates();
    }

    /// Gives the layer another damping over its stiffness [s], for vibrations alone.
    void use_relaxation(const double relaxation)
    {
      constants.relaxation = relaxation;
    }

    /// v^T C v with the motion's positions as velocities v: twice the power that damping takes.
    double damping_form(const Motion &velocities) const;

    /// Serialises the steps whose factors are kept, and what is kept with them.
    void serialise_history(Archive &archive);

  private:
    /// Products of a motion's position, velocity and acceleration (rates of the stiffnesses only where damping needs them).
    struct Products
    {
      dealii::Vector<double> position; ///< whose they are
      dealii::Vector<double> velocity;
      dealii::Vector<double> elastic; ///< the position less its rigid rotation, with which stiffnesses are multiplied
      std::array<dealii::Vector<double>, 3> mass;
      std::array<dealii::Vector<double>, 3> stiffness; ///< of lever and layer
      std::array<dealii::Vector<double>, 3> layer;
      std::array<dealii::Vector<double>, 3> modal; ///< phi^T M times each
    };

    /// Factors and compliance of steps of one duration.
    struct Step
    {
      StepWeights weights{};
      std::unique_ptr<EffectiveSystem> system;
      InterfaceCompliance compliance;
    };

    /// Quantities of the last two motions that were evaluated.
    const Products &products(const Motion &motion) const;
    Products make_products(const Motion &motion) const;
    std::unique_ptr<Step> make_step(const StepWeights &weights) const;
    InterfaceCompliance interface_compliance(const EffectiveSystem &system, double support_stiffness) const;
    double effective_support(const StepWeights &w) const;
    double free_support(const Kinematic &start, const StepWeights &w) const;
    dealii::Vector<double> motion_load(const Kinematic &start, const Products &motion_products, const StepWeights &w) const;

    const std::shared_ptr<const InertialMatrices> matrices;
    LeverDynamics constants;
    const LeverInterface lever_interface;
    const unsigned int n_lever; ///< coordinates without the support's
    const dealii::Vector<double> rigid_rotation;
    const CompressedRows mass;
    const CompressedRows stiffness;
    const CompressedRows layer;
    ModalDamping damping;
    std::vector<dealii::Vector<double>> mode_momenta;       ///< M phi
    std::vector<dealii::Vector<double>> mode_displacements; ///< displacements of the interface

    std::unique_ptr<Step> statics;
    std::vector<std::unique_ptr<Step>> steps; ///< the latest last
    const Step *current = nullptr;
    mutable std::array<Products, 2> known;
    mutable unsigned int latest = 0; ///< of those
    mutable dealii::Vector<double> free_motion;
  };
} // namespace sprag
