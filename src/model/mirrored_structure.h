// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/dynamic_model.h"
#include "model/mirrored_ports.h"

#include <algorithm>
#include <array>
#include <memory>

namespace sprag
{
  /// Both levers of a mirrored pair as two structures of one lever each: of the motion in which they mirror each other, and of
  /// that in which the second does the opposite, each at 1/sqrt(2) of its size for both. So a pair costs twice a lever, not more.
  /// A sprung support moves with the first alone. Coordinates and static forces are those of the first structure and then those
  /// of the second, on a sprung support with a coordinate of the second that stays 0. Structure: see ModalStructure.
  template <class Structure>
  class MirroredStructure
  {
  public:
    static constexpr unsigned int levers = 2;

    /// `alike`: whether both structures answer alike, so that levers feel nothing of each other.
    MirroredStructure(std::unique_ptr<Structure> mirroring, std::unique_ptr<Structure> opposite, const bool alike_)
        : parts{ { std::move(mirroring), std::move(opposite) } }
        , alike(alike_)
        , mirrored(parts[0]->ports())
    {
    }

    const PortLayout &ports() const
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

    const PortCompliance &compliance() const
    {
      return joined_compliance;
    }

    Motion deform(const PortForces &forces) const
    {
      return joined(parts[0]->deform(mirrored.forces(forces, 0)), parts[1]->deform(mirrored.forces(forces, 1)));
    }

    dealii::Vector<double> port_positions(const Motion &motion) const
    {
      return mirrored.displacements(parts[0]->port_positions(motion_part(motion, 0)),
                                    parts[1]->port_positions(motion_part(motion, 1)));
    }

    dealii::Vector<double> port_positions(const Motion &motion, const PortSelection &selected) const
    {
      const auto local = mirrored.structure_ports(selected);
      return mirrored.displacements(parts[0]->port_positions(motion_part(motion, 0), local),
                                    parts[1]->port_positions(motion_part(motion, 1), local));
    }

    PortState port_state(const Motion &motion, const unsigned int port) const
    {
      const unsigned int local = mirrored.structure_port(port);
      return mirrored.state(port, parts[0]->port_state(motion_part(motion, 0), local),
                            parts[1]->port_state(motion_part(motion, 1), local));
    }

    Kinematic port_kinematics(const Motion &motion) const
    {
      const auto mirroring = parts[0]->port_kinematics(motion_part(motion, 0));
      const auto opposite  = parts[1]->port_kinematics(motion_part(motion, 1));
      return { mirrored.displacements(mirroring.position, opposite.position),
               mirrored.displacements(mirroring.velocity, opposite.velocity),
               mirrored.displacements(mirroring.acceleration, opposite.acceleration) };
    }

    dealii::Vector<double> free_ports(const Motion &accepted, const PortSelection &selected) const
    {
      const auto local = mirrored.structure_ports(selected);
      return mirrored.displacements(parts[0]->free_ports(motion_part(accepted, 0), local),
                                    parts[1]->free_ports(motion_part(accepted, 1), local));
    }

    Motion advance(const Motion &accepted, const PortForces &forces, const DrivePoint &to) const
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

    dealii::Vector<double> port_error(const Motion &begin, const Motion &end) const
    {
      return mirrored.displacements(parts[0]->port_error(motion_part(begin, 0), motion_part(end, 0)),
                                    parts[1]->port_error(motion_part(begin, 1), motion_part(end, 1)));
    }

    /// Vibrations of both motions. Forces that do not mirror as the levers do couple them, which must be small structures then.
    std::vector<StructureMode> vibrations(const PortPerturbation &forces, const unsigned int number)
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
      result *= MirroredPorts::share();
      return result;
    }

    dealii::Vector<double> elastic_displacement(const Motion &motion, const unsigned int lever) const
    {
      return lever_vector(motion, lever,
                          [&](const unsigned int part, const Motion &part_motion)
                          { return parts[part]->elastic_displacement(part_motion); });
    }

    void visit_history(Archive &archive)
    {
      for (const auto &part : parts)
        part->visit_history(archive);
    }

  private:
    const std::array<std::unique_ptr<Structure>, 2> parts;
    const bool alike;
    const MirroredPorts mirrored;
    StepWeights joined_for{}; ///< step of the compliance; of dt = 0 in statics
    PortCompliance joined_compliance;

    void use_compliance(const StepWeights &weights)
    {
      joined_for        = weights;
      joined_compliance = mirrored.compliance(parts[0]->compliance(), parts[1]->compliance(), alike);
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

    static Motion joined(const Motion &mirroring, const Motion &opposite)
    {
      const auto &a = mirroring.coordinates;
      const auto &b = opposite.coordinates;
      Motion result;
      result.coordinates = { stacked(a.position, b.position), stacked(a.velocity, b.velocity),
                             stacked(a.acceleration, b.acceleration) };
      result.face_force  = stacked(mirroring.face_force, opposite.face_force);
      return result;
    }

    std::vector<StructureMode> pair_vibrations([[maybe_unused]] const PortPerturbation &pair_perturbation) const
    {
      if constexpr (Structure::is_small)
        return parts[0]->vibrations_with(*parts[1], pair_perturbation);
      return {};
    }

    /// The second structure's coordinate of the support, which nothing moves, is a mode that the pair does not have.
    bool is_idle_support(const StructureMode &mode) const
    {
      if (!ports().sprung)
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
