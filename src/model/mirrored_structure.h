#pragma once

#include "model/dynamic_model.h"
#include "model/linearisation.h"
#include "model/port_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
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
        , layout(parts[0]->ports())
    {
      layout.levers = 2;
    }

    const PortLayout &ports() const
    {
      return layout;
    }

    Motion rest() const
    {
      return joined(parts[0]->rest(), parts[1]->rest());
    }

    void use_statics()
    {
      for (const auto &part : parts)
        part->use_statics();
      joined_for = {};
      join_compliance();
    }

    void use_step(const StepWeights &weights)
    {
      for (const auto &part : parts)
        part->use_step(weights);
      if (joined_for.dt == weights.dt && joined_for.alpha_f == weights.alpha_f)
        return;
      joined_for = weights;
      join_compliance();
    }

    const PortCompliance &compliance() const
    {
      return joined_compliance;
    }

    Motion deform(const PortForces &forces) const
    {
      return joined(parts[0]->deform(of_part(forces, 0)), parts[1]->deform(of_part(forces, 1)));
    }

    dealii::Vector<double> port_positions(const Motion &motion) const
    {
      return joined(parts[0]->port_positions(part_of(motion, 0)), parts[1]->port_positions(part_of(motion, 1)));
    }

    dealii::Vector<double> port_positions(const Motion &motion, const PortSelection &selected) const
    {
      const auto local = of_a_lever(selected);
      return joined(parts[0]->port_positions(part_of(motion, 0), local), parts[1]->port_positions(part_of(motion, 1), local));
    }

    PortState port_state(const Motion &motion, const unsigned int port) const
    {
      const bool on_support = layout.sprung && port == layout.support();
      const auto of_lever   = on_support ? layout.of_a_lever() : port % layout.of_a_lever();
      const auto mirroring  = parts[0]->port_state(part_of(motion, 0), of_lever);
      if (on_support)
        return { half_root() * mirroring.position, half_root() * mirroring.velocity };
      const auto opposite = parts[1]->port_state(part_of(motion, 1), of_lever);
      const double side   = port < layout.first(1) ? half_root() : -half_root();
      return { half_root() * mirroring.position + side * opposite.position,
               half_root() * mirroring.velocity + side * opposite.velocity };
    }

    Kinematic port_kinematics(const Motion &motion) const
    {
      const auto mirroring = parts[0]->port_kinematics(part_of(motion, 0));
      const auto opposite  = parts[1]->port_kinematics(part_of(motion, 1));
      return { joined(mirroring.position, opposite.position), joined(mirroring.velocity, opposite.velocity),
               joined(mirroring.acceleration, opposite.acceleration) };
    }

    dealii::Vector<double> free_ports(const Motion &accepted, const PortSelection &selected) const
    {
      const auto local = of_a_lever(selected);
      return joined(parts[0]->free_ports(part_of(accepted, 0), local), parts[1]->free_ports(part_of(accepted, 1), local));
    }

    Motion advance(const Motion &accepted, const PortForces &forces, const DrivePoint &to) const
    {
      Motion result = joined(parts[0]->advance(part_of(accepted, 0), of_part(forces, 0), to),
                             parts[1]->advance(part_of(accepted, 1), of_part(forces, 1), to));
      result.drive  = to;
      return result;
    }

    void add_work(const Motion &begin, const Motion &end, StepWork &work) const
    {
      for (unsigned int part = 0; part < 2; ++part)
        parts[part]->add_work(part_of(begin, part), part_of(end, part), work);
    }

    StoredEnergy stored_energy(const Motion &motion) const
    {
      StoredEnergy sum     = parts[0]->stored_energy(part_of(motion, 0));
      const auto of_second = parts[1]->stored_energy(part_of(motion, 1));
      sum.kinetic += of_second.kinetic;
      sum.spring += of_second.spring;
      sum.elastic += of_second.elastic;
      sum.layer += of_second.layer;
      sum.support += of_second.support;
      return sum;
    }

    dealii::Vector<double> port_error(const Motion &begin, const Motion &end) const
    {
      return joined(parts[0]->port_error(part_of(begin, 0), part_of(end, 0)),
                    parts[1]->port_error(part_of(begin, 1), part_of(end, 1)));
    }

    /// Those of both motions. Forces that do not mirror as the levers do couple them, which must be small structures then.
    std::vector<StructureMode> vibrations(const PortPerturbation &forces, const unsigned int number)
    {
      const auto [of_both, n_first] = of_motions(forces);
      std::vector<StructureMode> result;
      if (Structure::is_small && couples(of_both, n_first))
        result = vibrations_of_both(of_both);
      else
        for (unsigned int part = 0; part < 2; ++part)
          for (auto &mode : parts[part]->vibrations(of_motion(forces, of_both, n_first, part), number))
            result.push_back(of_pair(std::move(mode), part));
      result.erase(std::remove_if(result.begin(), result.end(), [&](const auto &mode) { return is_of_idle_support(mode); }),
                   result.end());
      std::sort(result.begin(), result.end(),
                [](const auto &a, const auto &b) { return std::abs(a.eigenvalue) < std::abs(b.eigenvalue); });
      return result;
    }

    double damping_form(const Motion &velocities) const
    {
      return parts[0]->damping_form(part_of(velocities, 0)) + parts[1]->damping_form(part_of(velocities, 1));
    }

    /// A lever's part of what a function finds for a motion of either structure.
    template <class Find>
    dealii::Vector<double> of_lever(const Motion &motion, const unsigned int lever, const Find &find) const
    {
      auto result = find(0, part_of(motion, 0));
      result.add(lever == 0 ? 1. : -1., find(1, part_of(motion, 1)));
      result *= half_root();
      return result;
    }

    dealii::Vector<double> elastic_displacement(const Motion &motion, const unsigned int lever) const
    {
      return of_lever(motion, lever,
                      [&](const unsigned int part, const Motion &of) { return parts[part]->elastic_displacement(of); });
    }

  private:
    const std::array<std::unique_ptr<Structure>, 2> parts;
    const bool alike;
    PortLayout layout;
    StepWeights joined_for{}; ///< step of the compliance; of dt = 0 in statics
    PortCompliance joined_compliance;

    static double half_root()
    {
      return std::sqrt(0.5);
    }

    /// Ports of a lever that stand for some of the pair's.
    PortSelection of_a_lever(const PortSelection &selected) const
    {
      const auto second = std::lower_bound(selected.begin(), selected.end(), layout.first(1));
      const auto beyond = std::lower_bound(second, selected.end(), layout.support());
      PortSelection of_second, result;
      std::transform(second, beyond, std::back_inserter(of_second),
                     [&](const unsigned int port) { return port - layout.first(1); });
      std::set_union(selected.begin(), second, of_second.begin(), of_second.end(), std::back_inserter(result));
      if (beyond != selected.end())
        result.push_back(local_support());
      return result;
    }

    unsigned int local_support() const
    {
      return layout.of_a_lever();
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

    static Motion part_of(const Motion &motion, const unsigned int part)
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

    /// Displacements of the pair's ports.
    dealii::Vector<double> joined(const dealii::Vector<double> &mirroring, const dealii::Vector<double> &opposite) const
    {
      dealii::Vector<double> result(layout.size());
      for (unsigned int i = 0; i < layout.of_a_lever(); ++i)
      {
        result[layout.first(0) + i] = half_root() * (mirroring[i] + opposite[i]);
        result[layout.first(1) + i] = half_root() * (mirroring[i] - opposite[i]);
      }
      if (layout.sprung)
        result[layout.support()] = half_root() * mirroring[local_support()];
      return result;
    }

    PortForces of_part(const PortForces &forces, const unsigned int part) const
    {
      PortForces result;
      result.ports = of_a_lever(forces.ports);
      if (part == 1 && !result.ports.empty() && result.ports.back() == local_support())
        result.ports.pop_back();
      result.values.reinit(static_cast<unsigned int>(result.ports.size()));
      for (unsigned int a = 0; a < forces.ports.size(); ++a)
      {
        const unsigned int port  = forces.ports[a];
        const bool is_support    = port == layout.support();
        const bool of_second     = !is_support && port >= layout.first(1);
        const unsigned int local = is_support ? local_support() : port % layout.of_a_lever();
        if (!is_support || part == 0)
          result.values[place_of(local, result.ports)] +=
              (of_second && part == 1 ? -half_root() : half_root()) * forces.values[a];
      }
      return result;
    }

    void join_compliance()
    {
      const auto &mirroring = parts[0]->compliance();
      joined_compliance     = {};
      if (alike)
        for (unsigned int lever = 0; lever < 2; ++lever)
          joined_compliance.append(mirroring.blocks().front().matrix);
      else
        joined_compliance.append(of_coupled_levers(mirroring, parts[1]->compliance()));
      if (layout.sprung)
        joined_compliance.append(0.5 * mirroring(local_support(), local_support()));
    }

    dealii::FullMatrix<double> of_coupled_levers(const PortCompliance &mirroring, const PortCompliance &opposite) const
    {
      const unsigned int n = layout.of_a_lever();
      const auto &a        = *mirroring.blocks().front().matrix;
      const auto &b        = *opposite.blocks().front().matrix;
      dealii::FullMatrix<double> result(2 * n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          result(i, j) = result(n + i, n + j) = 0.5 * (a(i, j) + b(i, j));
          result(i, n + j) = result(n + i, j) = 0.5 * (a(i, j) - b(i, j));
        }
      return result;
    }

    /// Forces on the ports of both structures, those of the second counted on from the first's, and how many are on the first.
    std::pair<PortPerturbation, unsigned int> of_motions(const PortPerturbation &forces) const
    {
      if (forces.ports.empty())
        return { forces, 0 };
      const auto local           = of_a_lever(forces.ports);
      const auto n_first         = static_cast<unsigned int>(local.size());
      const bool on_support      = layout.sprung && n_first > 0 && local.back() == local_support();
      const unsigned int n_ports = parts[0]->ports().size();
      PortPerturbation result;
      result.ports = local;
      for (const unsigned int port : local)
        if (!on_support || port != local_support())
          result.ports.push_back(n_ports + port);

      dealii::FullMatrix<double> from(forces.ports.size(), result.ports.size()); // displacements of the ports by the structures'
      for (unsigned int a = 0; a < forces.ports.size(); ++a)
      {
        const bool is_support = forces.ports[a] == layout.support();
        const unsigned int at = place_of(is_support ? local_support() : forces.ports[a] % layout.of_a_lever(), local);
        from(a, at)           = half_root();
        if (!is_support)
          from(a, n_first + at) = forces.ports[a] < layout.first(1) ? half_root() : -half_root();
      }
      const auto n = static_cast<unsigned int>(result.ports.size());
      for (const auto matrix : { &PortPerturbation::pressure, &PortPerturbation::friction, &PortPerturbation::pressure_rate,
                                 &PortPerturbation::friction_rate, &PortPerturbation::inertia })
      {
        (result.*matrix).reinit(n, n);
        (result.*matrix).triple_product(forces.*matrix, from, from, true, false);
      }
      const auto transformed = [&](const dealii::Vector<double> &row)
      {
        dealii::Vector<double> of_structures(n);
        from.Tvmult(of_structures, row);
        return of_structures;
      };
      for (const auto &delay : forces.delays)
        result.delays.push_back(
            { delay.time, transformed(delay.force), transformed(delay.stiffness_row), transformed(delay.rate_row) });
      return { result, n_first };
    }

    /// Whether forces on one structure follow displacements of the other, by more than round-off.
    static bool couples(const PortPerturbation &of_both, const unsigned int n_first)
    {
      constexpr double round_off = 1e-7;
      double within = 0., between = 0.;
      const auto stiffness = of_both.stiffness();
      for (unsigned int a = 0; a < stiffness.m(); ++a)
        for (unsigned int b = 0; b < stiffness.n(); ++b)
        {
          double &largest = (a < n_first) == (b < n_first) ? within : between;
          largest         = std::max(largest, std::abs(stiffness(a, b)));
        }
      return between > round_off * within;
    }

    /// Forces on one of the structures, where they mirror as the levers do.
    PortPerturbation of_motion(const PortPerturbation &forces, const PortPerturbation &of_both, const unsigned int n_first,
                               const unsigned int part) const
    {
      const unsigned int begin   = part == 0 ? 0 : n_first;
      const unsigned int end     = part == 0 ? n_first : static_cast<unsigned int>(of_both.ports.size());
      const unsigned int n_ports = parts[0]->ports().size();
      PortPerturbation result;
      for (unsigned int a = begin; a < end; ++a)
        result.ports.push_back(of_both.ports[a] % n_ports);
      if (result.ports.empty())
        return result;
      for (const auto matrix : { &PortPerturbation::pressure, &PortPerturbation::friction, &PortPerturbation::pressure_rate,
                                 &PortPerturbation::friction_rate, &PortPerturbation::inertia })
      {
        (result.*matrix).reinit(end - begin, end - begin);
        (result.*matrix).fill(of_both.*matrix, 0, 0, begin, begin);
      }
      // A delay of the first lever stands for that and the second lever's, each at 1/sqrt(2).
      const auto of_part = [&](const dealii::Vector<double> &row)
      {
        dealii::Vector<double> values(row.begin() + begin, row.begin() + end);
        values /= half_root();
        return values;
      };
      for (unsigned int i = 0; i < forces.delays.size(); ++i)
        if (const auto &delay = of_both.delays[i]; is_of_first(forces.ports, forces.delays[i]))
          result.delays.push_back({ delay.time, of_part(delay.force), of_part(delay.stiffness_row), of_part(delay.rate_row) });
      return result;
    }

    bool is_of_first(const std::vector<unsigned int> &ports, const FrictionDelay &delay) const
    {
      for (unsigned int a = 0; a < ports.size(); ++a)
        if (ports[a] < layout.support() && delay.force[a] != 0.)
          return ports[a] < layout.first(1);
      return false;
    }

    std::vector<StructureMode> vibrations_of_both([[maybe_unused]] const PortPerturbation &of_both) const
    {
      if constexpr (Structure::is_small)
        return parts[0]->vibrations_with(*parts[1], of_both);
      return {};
    }

    /// Whether a mode is that of the support's coordinate in the second structure, which nothing moves.
    bool is_of_idle_support(const StructureMode &mode) const
    {
      if (!layout.sprung)
        return false;
      double size = 0., of_support = 0.;
      for (const auto &part : mode.coordinates)
      {
        size += part.norm_sqr();
        of_support += part[part.size() - 1] * part[part.size() - 1];
      }
      return of_support > 0.999 * size;
    }

    static StructureMode of_pair(StructureMode mode, const unsigned int part)
    {
      const auto in_place = [&](dealii::Vector<double> &values)
      {
        const dealii::Vector<double> nothing(values.size());
        values = part == 0 ? stacked(values, nothing) : stacked(nothing, values);
      };
      for (unsigned int i = 0; i < 2; ++i)
      {
        in_place(mode.coordinates[i]);
        in_place(mode.face_force[i]);
      }
      return mode;
    }
  };
} // namespace sprag
