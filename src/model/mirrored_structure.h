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
  /// A sprung support moves with the first alone. Motions hold the coordinates of the first structure and then of the second.
  /// Structure: see SparseStructure.
  template <class Structure>
  class MirroredStructure
  {
  public:
    MirroredStructure(std::unique_ptr<Structure> mirroring, std::unique_ptr<Structure> opposite)
        : parts{ { std::move(mirroring), std::move(opposite) } }
        , n_coordinates(parts[0]->rest().coordinates.position.size())
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
      join_compliance(statics);
      current = &statics;
    }

    void use_step(const StepWeights &weights)
    {
      for (const auto &part : parts)
        part->use_step(weights);
      if (joined_for.dt != weights.dt || joined_for.alpha_f != weights.alpha_f)
      {
        join_compliance(of_step);
        joined_for = weights;
      }
      current = &of_step;
    }

    const dealii::FullMatrix<double> &compliance() const
    {
      return *current;
    }

    Motion deform(const PortForces &forces) const
    {
      return joined(parts[0]->deform(of_part(forces, 0)), parts[1]->deform(of_part(forces, 1)));
    }

    dealii::Vector<double> port_positions(const Motion &motion) const
    {
      return port_positions(motion, all_ports(layout.size()));
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

    /// The lowest of both motions. The forces must mirror as the levers do, so that they do not couple them.
    std::vector<StructureMode> vibrations(const PortPerturbation &forces, const unsigned int number)
    {
      std::vector<StructureMode> result;
      for (unsigned int part = 0; part < 2; ++part)
        for (auto &mode : parts[part]->vibrations(perturbation_of_part(forces, part), number))
          if (part == 0 || !is_of_support_alone(mode))
            result.push_back(of_pair(std::move(mode), part));
      std::sort(result.begin(), result.end(),
                [](const auto &a, const auto &b) { return std::abs(a.eigenvalue) < std::abs(b.eigenvalue); });
      return result;
    }

    double damping_form(const Motion &velocities) const
    {
      return parts[0]->damping_form(part_of(velocities, 0)) + parts[1]->damping_form(part_of(velocities, 1));
    }

    dealii::Vector<double> elastic_displacement(const Motion &motion, const unsigned int lever) const
    {
      auto result = parts[0]->elastic_displacement(part_of(motion, 0));
      result.add(lever == 0 ? 1. : -1., parts[1]->elastic_displacement(part_of(motion, 1)));
      result *= half_root();
      return result;
    }

  private:
    const std::array<std::unique_ptr<Structure>, 2> parts;
    const unsigned int n_coordinates; ///< of a part
    PortLayout layout;
    dealii::FullMatrix<double> statics;
    dealii::FullMatrix<double> of_step;
    StepWeights joined_for{}; ///< of which it is
    const dealii::FullMatrix<double> *current = nullptr;

    static double half_root()
    {
      return std::sqrt(0.5);
    }

    /// Ports of a lever that stand for some of the pair's.
    PortSelection of_a_lever(const PortSelection &selected) const
    {
      PortSelection result;
      for (const unsigned int port : selected)
        result.push_back(port == layout.support() ? local_support() : port % layout.of_a_lever());
      std::sort(result.begin(), result.end());
      result.erase(std::unique(result.begin(), result.end()), result.end());
      return result;
    }

    unsigned int local_support() const
    {
      return layout.of_a_lever();
    }

    Motion part_of(const Motion &motion, const unsigned int part) const
    {
      const auto half = [&](const dealii::Vector<double> &whole)
      {
        dealii::Vector<double> result(n_coordinates);
        std::copy_n(whole.begin() + part * n_coordinates, n_coordinates, result.begin());
        return result;
      };
      Motion result;
      result.drive       = motion.drive;
      result.coordinates = { half(motion.coordinates.position), half(motion.coordinates.velocity),
                             half(motion.coordinates.acceleration) };
      return result;
    }

    Motion joined(const Motion &mirroring, const Motion &opposite) const
    {
      const auto whole = [&](const dealii::Vector<double> &first, const dealii::Vector<double> &second)
      {
        dealii::Vector<double> result(2 * n_coordinates);
        std::copy(first.begin(), first.end(), result.begin());
        std::copy(second.begin(), second.end(), result.begin() + n_coordinates);
        return result;
      };
      const auto &a = mirroring.coordinates;
      const auto &b = opposite.coordinates;
      Motion result;
      result.coordinates = { whole(a.position, b.position), whole(a.velocity, b.velocity),
                             whole(a.acceleration, b.acceleration) };
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
      std::vector<unsigned int> ports;
      dealii::Vector<double> dense(local_support() + 1);
      for (unsigned int a = 0; a < forces.ports.size(); ++a)
      {
        const bool on_support = forces.ports[a] == layout.support();
        if (on_support && part == 1)
          continue;
        const unsigned int local = on_support ? local_support() : forces.ports[a] % layout.of_a_lever();
        const bool of_second     = !on_support && forces.ports[a] >= layout.first(1);
        dense[local] += (of_second && part == 1 ? -half_root() : half_root()) * forces.values[a];
        ports.push_back(local);
      }
      std::sort(ports.begin(), ports.end());
      ports.erase(std::unique(ports.begin(), ports.end()), ports.end());
      PortForces result;
      result.values.reinit(static_cast<unsigned int>(ports.size()));
      for (unsigned int a = 0; a < ports.size(); ++a)
        result.values[a] = dense[ports[a]];
      result.ports = std::move(ports);
      return result;
    }

    void join_compliance(dealii::FullMatrix<double> &result) const
    {
      const auto &mirroring = parts[0]->compliance();
      const auto &opposite  = parts[1]->compliance();
      const unsigned int n  = layout.of_a_lever();
      result.reinit(layout.size(), layout.size());
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          result(i, j) = result(n + i, n + j) = 0.5 * (mirroring(i, j) + opposite(i, j));
          result(i, n + j) = result(n + i, j) = 0.5 * (mirroring(i, j) - opposite(i, j));
        }
      if (!layout.sprung)
        return;
      for (unsigned int i = 0; i < n; ++i)
        for (const unsigned int port : { i, n + i })
          result(port, layout.support()) = result(layout.support(), port) = 0.5 * mirroring(i, n);
      result(layout.support(), layout.support()) = 0.5 * mirroring(n, n);
    }

    /// The first lever's rows, its own columns and the second's with the sign it has in the motion.
    PortPerturbation perturbation_of_part(const PortPerturbation &forces, const unsigned int part) const
    {
      std::vector<unsigned int> rows;
      PortPerturbation result;
      for (unsigned int a = 0; a < forces.ports.size(); ++a)
      {
        const bool on_support = forces.ports[a] == layout.support();
        if (forces.ports[a] >= layout.first(1) && !(on_support && part == 0))
          continue;
        rows.push_back(a);
        result.ports.push_back(on_support ? local_support() : forces.ports[a]);
      }
      for (const auto matrix : { &PortPerturbation::pressure, &PortPerturbation::friction, &PortPerturbation::pressure_rate,
                                 &PortPerturbation::friction_rate, &PortPerturbation::inertia })
        result.*matrix = matrix_of_part(forces.ports, rows, forces.*matrix, part == 0 ? 1. : -1.);
      for (const auto &delay : forces.delays)
        if (is_of_first(forces.ports, delay))
          result.delays.push_back(
              { delay.time, entries(rows, delay.force), entries(rows, delay.stiffness_row), entries(rows, delay.rate_row) });
      return result;
    }

    dealii::FullMatrix<double> matrix_of_part(const std::vector<unsigned int> &ports, const std::vector<unsigned int> &rows,
                                              const dealii::FullMatrix<double> &of_pair, const double side) const
    {
      const auto n = static_cast<unsigned int>(rows.size());
      dealii::FullMatrix<double> result(n, n);
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
        {
          const unsigned int port = ports[rows[b]];
          const bool on_support   = port == layout.support();
          result(a, b)            = of_pair(rows[a], rows[b]);
          if (on_support)
            result(a, b) *= ports[rows[a]] == layout.support() ? 0.5 : 1.;
          else if (const unsigned int partner = place_of(layout.first(1) + port, ports);
                   ports[rows[a]] != layout.support() && partner < ports.size() && ports[partner] == layout.first(1) + port)
            result(a, b) += side * of_pair(rows[a], partner);
        }
      return result;
    }

    bool is_of_first(const std::vector<unsigned int> &ports, const FrictionDelay &delay) const
    {
      for (unsigned int a = 0; a < ports.size(); ++a)
        if (ports[a] < layout.support() && delay.force[a] != 0.)
          return ports[a] < layout.first(1);
      return false;
    }

    static dealii::Vector<double> entries(const std::vector<unsigned int> &rows, const dealii::Vector<double> &values)
    {
      dealii::Vector<double> result(static_cast<unsigned int>(rows.size()));
      for (unsigned int a = 0; a < rows.size(); ++a)
        result[a] = values[rows[a]];
      return result;
    }

    /// Of the structure that moves no support, but has its coordinate.
    bool is_of_support_alone(const StructureMode &mode) const
    {
      if (!layout.sprung)
        return false;
      double size = 0., of_support = 0.;
      for (const auto &part : mode.coordinates)
      {
        const double last = part[n_coordinates - 1];
        size += part.norm_sqr();
        of_support += last * last;
      }
      return of_support > 0.999 * size;
    }

    StructureMode of_pair(StructureMode mode, const unsigned int part) const
    {
      for (auto &coordinates : mode.coordinates)
      {
        dealii::Vector<double> whole(2 * n_coordinates);
        std::copy(coordinates.begin(), coordinates.end(), whole.begin() + part * n_coordinates);
        coordinates = whole;
      }
      return mode;
    }
  };
} // namespace sprag
