// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "model/step/dynamic_model.h"
#include "model/structure/mirrored_interface.h"

#include <algorithm>
#include <array>
#include <memory>

namespace sprag
{
  /// Both levers of a mirrored pair as two structures of one lever each, for the symmetric and the antisymmetric motion, see
  /// MirroredInterface: a pair costs no more than two levers. Coordinates and static forces are those of the first structure,
  /// then those of the second, whose coordinate of a sprung support stays 0. Structure: see ModalStructure.
  template <class Structure>
  class MirroredStructure
  {
  public:
    static constexpr unsigned int levers = 2;

    /// `identical`: both structures have equal matrices, so that the levers are uncoupled.
    MirroredStructure(std::unique_ptr<Structure> symmetric, std::unique_ptr<Structure> antisymmetric, const bool identical_)
        : parts{ { std::move(symmetric), std::move(antisymmetric) } }
        , identical(identical_)
        , mirrored(parts[0]->layout())
    {
    }

    const InterfaceLayout &layout() const
    {
      return mirrored.layout();
    }

    Motion rest() const
    {
      return joined(parts[0]->rest(), parts[1]->rest());
    }

    void use_statics()
    {
      for (const auto &part : parts)
        part->use_statics();
      use_compliance({});
    }

    void use_step(const StepWeights &weights)
    {
      for (const auto &part : parts)
        part->use_step(weights);
      if (joined_for.dt != weights.dt || joined_for.alpha_f != weights.alpha_f)
        use_compliance(weights);
    }

    const InterfaceCompliance &compliance() const
    {
      return joined_compliance;
    }

    Motion deform(const InterfaceForces &forces) const
    {
      return joined(parts[0]->deform(mirrored.forces(forces, 0)), parts[1]->deform(mirrored.forces(forces, 1)));
    }

    dealii::Vector<double> positions(const Motion &motion, const DofSelection &selected = {}) const
    {
      const auto local = mirrored.structure_dofs(selected);
      return mirrored.displacements(parts[0]->positions(motion_part(motion, 0), local),
                                    parts[1]->positions(motion_part(motion, 1), local));
    }

    DofState dof_state(const Motion &motion, const unsigned int dof) const
    {
      const unsigned int local = mirrored.structure_dof(dof);
      return mirrored.state(dof, parts[0]->dof_state(motion_part(motion, 0), local),
                            parts[1]->dof_state(motion_part(motion, 1), local));
    }

    Kinematic kinematics(const Motion &motion) const
    {
      const auto symmetric     = parts[0]->kinematics(motion_part(motion, 0));
      const auto antisymmetric = parts[1]->kinematics(motion_part(motion, 1));
      return { mirrored.displacements(symmetric.position, antisymmetric.position),
               mirrored.displacements(symmetric.velocity, antisymmetric.velocity),
               mirrored.displacements(symmetric.acceleration, antisymmetric.acceleration) };
    }

    dealii::Vector<double> free_displacements(const Motion &accepted, const DofSelection &selected) const
    {
      const auto local = mirrored.structure_dofs(selected);
      return mirrored.displacements(parts[0]->free_displacements(motion_part(accepted, 0), local),
                                    parts[1]->free_displacements(motion_part(accepted, 1), local));
    }

    Motion advance(const Motion &accepted, const InterfaceForces &forces, const DrivePoint &to) const
    {
      Motion result = joined(parts[0]->advance(motion_part(accepted, 0), mirrored.forces(forces, 0), to),
                             parts[1]->advance(motion_part(accepted, 1), mirrored.forces(forces, 1), to));
      result.drive  = to;
      return result;
    }

    void add_work(const Motion &begin, const Motion &end, StepWork &work) const
    {
      for (unsigned int part = 0; part < 2; ++part)
        parts[part]->add_work(motion_part(begin, part), motion_part(end, part), work);
    }

    StoredEnergy stored_energy(const Motion &motion) const
    {
      StoredEnergy sum         = parts[0]->stored_energy(motion_part(motion, 0));
      const auto second_energy = parts[1]->stored_energy(motion_part(motion, 1));
      sum.kinetic += second_energy.kinetic;
      sum.spring += second_energy.spring;
      sum.elastic += second_energy.elastic;
      sum.layer += second_energy.layer;
      sum.support += second_energy.support;
      return sum;
    }

    dealii::Vector<double> local_error(const Motion &begin, const Motion &end) const
    {
      return mirrored.displacements(parts[0]->local_error(motion_part(begin, 0), motion_part(end, 0)),
                                    parts[1]->local_error(motion_part(begin, 1), motion_part(end, 1)));
    }

    /// Vibrations of both motions. Forces that do not mirror as the levers do couple them, which must be small structures then.
    std::vector<StructureMode> vibrations(const LinearisedForces &forces, const unsigned int number, bool /*shapes*/ = true)
    {
      const auto both = mirrored.on_both(forces);
      std::vector<StructureMode> result;
      if (Structure::is_small && mirrored.couples(both))
        result = pair_vibrations(both);
      else
        for (unsigned int part = 0; part < 2; ++part)
          for (auto &mode : parts[part]->vibrations(mirrored.on_structure(forces, both, part), number))
            result.push_back(in_place(std::move(mode), part));
      result.erase(std::remove_if(result.begin(), result.end(), [&](const auto &mode) { return is_idle_support(mode); }),
                   result.end());
      std::sort(result.begin(), result.end(),
                [](const auto &a, const auto &b) { return std::abs(a.eigenvalue) < std::abs(b.eigenvalue); });
      return result;
    }

    void use_relaxation(const double relaxation)
    {
      for (const auto &part : parts)
        part->use_relaxation(relaxation);
    }

    double damping_form(const Motion &velocities) const
    {
      return parts[0]->damping_form(motion_part(velocities, 0)) + parts[1]->damping_form(motion_part(velocities, 1));
    }

    /// A lever's part of what a function finds for a motion of either structure.
    template <class Find>
    dealii::Vector<double> lever_vector(const Motion &motion, const unsigned int lever, const Find &find) const
    {
      auto result = find(0, motion_part(motion, 0));
      result.add(lever == 0 ? 1. : -1., find(1, motion_part(motion, 1)));
      result *= MirroredInterface::share();
      return result;
    }

    void serialise_history(Archive &archive)
    {
      for (const auto &part : parts)
        part->serialise_history(archive);
    }

  private:
    const std::array<std::unique_ptr<Structure>, 2> parts;
    const bool identical;
    const MirroredInterface mirrored;
    StepWeights joined_for{}; ///< step of the compliance; of dt = 0 in statics
    InterfaceCompliance joined_compliance;

    void use_compliance(const StepWeights &weights)
    {
      joined_for        = weights;
      joined_compliance = mirrored.compliance(parts[0]->compliance(), parts[1]->compliance(), identical);
    }

    static dealii::Vector<double> half(const dealii::Vector<double> &whole, const unsigned int part)
    {
      const unsigned int n = whole.size() / 2;
      return dealii::Vector<double>(whole.begin() + part * n, whole.begin() + (part + 1) * n);
    }

    /// Vectors of both structures, one after the other.
    static dealii::Vector<double> stacked(const dealii::Vector<double> &first, const dealii::Vector<double> &second)
    {
      dealii::Vector<double> result(first.size() + second.size());
      std::copy(first.begin(), first.end(), result.begin());
      std::copy(second.begin(), second.end(), result.begin() + first.size());
      return result;
    }

    static Motion motion_part(const Motion &motion, const unsigned int part)
    {
      const auto &q = motion.coordinates;
      Motion result;
      result.drive       = motion.drive;
      result.coordinates = { half(q.position, part), half(q.velocity, part), half(q.acceleration, part) };
      result.face_force  = half(motion.face_force, part);
      return result;
    }

    static Motion joined(const Motion &symmetric, const Motion &antisymmetric)
    {
      const auto &a = symmetric.coordinates;
      const auto &b = antisymmetric.coordinates;
      Motion result;
      result.coordinates = { stacked(a.position, b.position), stacked(a.velocity, b.velocity),
                             stacked(a.acceleration, b.acceleration) };
      result.face_force  = stacked(symmetric.face_force, antisymmetric.face_force);
      return result;
    }

    std::vector<StructureMode> pair_vibrations([[maybe_unused]] const LinearisedForces &pair_perturbation) const
    {
      if constexpr (Structure::is_small)
        return parts[0]->vibrations_with(*parts[1], pair_perturbation);
      return {};
    }

    /// The second structure's coordinate of the support, which nothing moves, is a mode that the pair does not have.
    bool is_idle_support(const StructureMode &mode) const
    {
      if (!layout().sprung)
        return false;
      double size = 0., support_size = 0.;
      for (const auto &part : mode.coordinates)
      {
        size += part.norm_sqr();
        support_size += part[part.size() - 1] * part[part.size() - 1];
      }
      return support_size > 0.999 * size;
    }

    static StructureMode in_place(StructureMode mode, const unsigned int part)
    {
      const auto place = [&](dealii::Vector<double> &values)
      {
        const dealii::Vector<double> nothing(values.size());
        values = part == 0 ? stacked(values, nothing) : stacked(nothing, values);
      };
      for (unsigned int i = 0; i < 2; ++i)
      {
        place(mode.coordinates[i]);
        place(mode.face_force[i]);
      }
      return mode;
    }
  };
} // namespace sprag
