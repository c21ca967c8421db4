// SPDX-License-Identifier: GPL-3.0-only
#include "model/mirrored_ports.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr auto matrices = { &PortPerturbation::pressure, &PortPerturbation::friction, &PortPerturbation::pressure_rate,
                                &PortPerturbation::friction_rate, &PortPerturbation::inertia };

    FullMatrix<double> coupled_compliance(const FullMatrix<double> &mirroring, const FullMatrix<double> &opposite)
    {
      const auto n = mirroring.m();
      FullMatrix<double> result(2 * n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          result(i, j) = result(n + i, n + j) = 0.5 * (mirroring(i, j) + opposite(i, j));
          result(i, n + j) = result(n + i, j) = 0.5 * (mirroring(i, j) - opposite(i, j));
        }
      return result;
    }
  } // namespace

  MirroredPorts::MirroredPorts(const PortLayout &lever_layout)
      : pair(lever_layout)
  {
    pair.levers = 2;
  }

  const PortLayout &MirroredPorts::layout() const
  {
    return pair;
  }

  double MirroredPorts::share()
  {
    return std::sqrt(0.5);
  }

  unsigned int MirroredPorts::structure_size() const
  {
    return pair.ports_per_lever() + (pair.sprung ? 1 : 0);
  }

  bool MirroredPorts::is_support(const unsigned int pair_port) const
  {
    return pair.sprung && pair_port == pair.support();
  }

  unsigned int MirroredPorts::structure_port(const unsigned int pair_port) const
  {
    return is_support(pair_port) ? pair.ports_per_lever() : pair_port % pair.ports_per_lever();
  }

  PortSelection MirroredPorts::structure_ports(const PortSelection &paired) const
  {
    const auto second = std::lower_bound(paired.begin(), paired.end(), pair.first(1));
    const auto beyond = std::lower_bound(second, paired.end(), pair.support());
    PortSelection second_ports, result;
    std::transform(second, beyond, std::back_inserter(second_ports),
                   [&](const unsigned int port) { return structure_port(port); });
    std::set_union(paired.begin(), second, second_ports.begin(), second_ports.end(), std::back_inserter(result));
    if (beyond != paired.end())
      result.push_back(structure_port(*beyond));
    return result;
  }

  Vector<double> MirroredPorts::displacements(const Vector<double> &mirroring, const Vector<double> &opposite) const
  {
    Vector<double> result(pair.size());
    for (unsigned int i = 0; i < pair.ports_per_lever(); ++i)
    {
      result[pair.first(0) + i] = share() * (mirroring[i] + opposite[i]);
      result[pair.first(1) + i] = share() * (mirroring[i] - opposite[i]);
    }
    if (pair.sprung)
      result[pair.support()] = share() * mirroring[pair.ports_per_lever()];
    return result;
  }

  PortState MirroredPorts::state(const unsigned int pair_port, const PortState &mirroring, const PortState &opposite) const
  {
    if (is_support(pair_port))
      return { share() * mirroring.position, share() * mirroring.velocity };
    const double side = pair_port < pair.first(1) ? share() : -share();
    return { share() * mirroring.position + side * opposite.position, share() * mirroring.velocity + side * opposite.velocity };
  }

  PortForces MirroredPorts::forces(const PortForces &paired, const unsigned int motion) const
  {
    PortForces result;
    result.ports = structure_ports(paired.ports);
    if (motion == 1 && !result.ports.empty() && result.ports.back() == pair.ports_per_lever())
      result.ports.pop_back();
    result.values.reinit(static_cast<unsigned int>(result.ports.size()));
    for (unsigned int a = 0; a < paired.ports.size(); ++a)
    {
      const unsigned int port = paired.ports[a];
      if (is_support(port) && motion == 1)
        continue;
      const bool against = motion == 1 && port >= pair.first(1);
      result.values[find_index(structure_port(port), result.ports)] += (against ? -share() : share()) * paired.values[a];
    }
    return result;
  }

  PortCompliance MirroredPorts::compliance(const PortCompliance &mirroring, const PortCompliance &opposite,
                                           const bool alike) const
  {
    PortCompliance result;
    const auto &lever_compliance = mirroring.blocks().front().matrix;
    if (alike)
      for (unsigned int lever = 0; lever < 2; ++lever)
        result.append(lever_compliance);
    else
      result.append(coupled_compliance(*lever_compliance, *opposite.blocks().front().matrix));
    if (pair.sprung)
      result.append(0.5 * mirroring(pair.ports_per_lever(), pair.ports_per_lever()));
    return result;
  }

  FullMatrix<double> MirroredPorts::displacements_by(const std::vector<unsigned int> &both_ports,
                                                     const std::vector<unsigned int> &paired) const
  {
    FullMatrix<double> result(paired.size(), both_ports.size());
    for (unsigned int a = 0; a < paired.size(); ++a)
    {
      const unsigned int port                 = structure_port(paired[a]);
      result(a, find_index(port, both_ports)) = share();
      if (!is_support(paired[a]))
        result(a, find_index(structure_size() + port, both_ports)) = paired[a] < pair.first(1) ? share() : -share();
    }
    return result;
  }

  PortPerturbation MirroredPorts::on_both(const PortPerturbation &paired) const
  {
    if (paired.ports.empty())
      return paired;
    PortPerturbation result;
    result.ports = structure_ports(paired.ports);
    for (const unsigned int port : PortSelection(result.ports))
      if (port != pair.ports_per_lever())
        result.ports.push_back(structure_size() + port);
    const auto n  = static_cast<unsigned int>(result.ports.size());
    const auto by = displacements_by(result.ports, paired.ports);
    for (const auto matrix : matrices)
    {
      (result.*matrix).reinit(n, n);
      (result.*matrix).triple_product(paired.*matrix, by, by, true, false);
    }
    const auto transformed = [&](const Vector<double> &row)
    {
      Vector<double> on_structures(n);
      by.Tvmult(on_structures, row);
      return on_structures;
    };
    for (const auto &delay : paired.delays)
      result.delays.push_back(
          { delay.time, transformed(delay.force), transformed(delay.stiffness_row), transformed(delay.rate_row) });
    return result;
  }

  /// Places of the ports of a structure: the first, and beyond the last.
  std::pair<unsigned int, unsigned int> MirroredPorts::range(const PortPerturbation &both, const unsigned int motion) const
  {
    const unsigned int opposite_begin = find_index(structure_size(), both.ports);
    return motion == 0 ? std::pair(0u, opposite_begin) : std::pair(opposite_begin, static_cast<unsigned int>(both.ports.size()));
  }

  bool MirroredPorts::couples(const PortPerturbation &both) const
  {
    constexpr double round_off = 1e-7;
    const unsigned int n       = range(both, 0).second;
    const auto stiffness       = both.stiffness();
    double within = 0., between = 0.;
    for (unsigned int a = 0; a < stiffness.m(); ++a)
      for (unsigned int b = 0; b < stiffness.n(); ++b)
      {
        double &largest = (a < n) == (b < n) ? within : between;
        largest         = std::max(largest, std::abs(stiffness(a, b)));
      }
    return between > round_off * within;
  }

  PortPerturbation MirroredPorts::on_structure(const PortPerturbation &paired, const PortPerturbation &both,
                                               const unsigned int motion) const
  {
    const auto [begin, end] = range(both, motion);
    PortPerturbation result;
    for (unsigned int a = begin; a < end; ++a)
      result.ports.push_back(both.ports[a] % structure_size());
    if (result.ports.empty())
      return result;
    for (const auto matrix : matrices)
    {
      (result.*matrix).reinit(end - begin, end - begin);
      (result.*matrix).fill(both.*matrix, 0, 0, begin, begin);
    }
    // A delay of the first lever stands for that and the second lever's, each at its share.
    const auto structure_row = [first = begin, last = end](const Vector<double> &row)
    {
      Vector<double> values(row.begin() + first, row.begin() + last);
      values /= share();
      return values;
    };
    for (unsigned int i = 0; i < paired.delays.size(); ++i)
      if (const auto &delay = both.delays[i]; acts_on_first_lever(paired.ports, paired.delays[i]))
        result.delays.push_back(
            { delay.time, structure_row(delay.force), structure_row(delay.stiffness_row), structure_row(delay.rate_row) });
    return result;
  }

  bool MirroredPorts::acts_on_first_lever(const std::vector<unsigned int> &ports, const FrictionDelay &delay) const
  {
    for (unsigned int a = 0; a < ports.size(); ++a)
      if (ports[a] < pair.support() && delay.force[a] != 0.)
        return ports[a] < pair.first(1);
    return false;
  }
} // namespace sprag
