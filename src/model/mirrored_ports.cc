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

    FullMatrix<double> of_coupled_levers(const FullMatrix<double> &mirroring, const FullMatrix<double> &opposite)
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

  MirroredPorts::MirroredPorts(const PortLayout &of_lever)
      : pair(of_lever)
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
    return pair.of_a_lever() + (pair.sprung ? 1 : 0);
  }

  bool MirroredPorts::is_support(const unsigned int port_of_pair) const
  {
    return pair.sprung && port_of_pair == pair.support();
  }

  unsigned int MirroredPorts::port_of_structure(const unsigned int port_of_pair) const
  {
    return is_support(port_of_pair) ? pair.of_a_lever() : port_of_pair % pair.of_a_lever();
  }

  PortSelection MirroredPorts::of_structure(const PortSelection &of_pair) const
  {
    const auto second = std::lower_bound(of_pair.begin(), of_pair.end(), pair.first(1));
    const auto beyond = std::lower_bound(second, of_pair.end(), pair.support());
    PortSelection of_second, result;
    std::transform(second, beyond, std::back_inserter(of_second),
                   [&](const unsigned int port) { return port_of_structure(port); });
    std::set_union(of_pair.begin(), second, of_second.begin(), of_second.end(), std::back_inserter(result));
    if (beyond != of_pair.end())
      result.push_back(port_of_structure(*beyond));
    return result;
  }

  Vector<double> MirroredPorts::displacements(const Vector<double> &mirroring, const Vector<double> &opposite) const
  {
    Vector<double> result(pair.size());
    for (unsigned int i = 0; i < pair.of_a_lever(); ++i)
    {
      result[pair.first(0) + i] = share() * (mirroring[i] + opposite[i]);
      result[pair.first(1) + i] = share() * (mirroring[i] - opposite[i]);
    }
    if (pair.sprung)
      result[pair.support()] = share() * mirroring[pair.of_a_lever()];
    return result;
  }

  PortState MirroredPorts::state(const unsigned int port_of_pair, const PortState &mirroring, const PortState &opposite) const
  {
    if (is_support(port_of_pair))
      return { share() * mirroring.position, share() * mirroring.velocity };
    const double side = port_of_pair < pair.first(1) ? share() : -share();
    return { share() * mirroring.position + side * opposite.position, share() * mirroring.velocity + side * opposite.velocity };
  }

  PortForces MirroredPorts::forces(const PortForces &of_pair, const unsigned int motion) const
  {
    PortForces result;
    result.ports = of_structure(of_pair.ports);
    if (motion == 1 && !result.ports.empty() && result.ports.back() == pair.of_a_lever())
      result.ports.pop_back();
    result.values.reinit(static_cast<unsigned int>(result.ports.size()));
    for (unsigned int a = 0; a < of_pair.ports.size(); ++a)
    {
      const unsigned int port = of_pair.ports[a];
      if (is_support(port) && motion == 1)
        continue;
      const bool against = motion == 1 && port >= pair.first(1);
      result.values[place_of(port_of_structure(port), result.ports)] += (against ? -share() : share()) * of_pair.values[a];
    }
    return result;
  }

  PortCompliance MirroredPorts::compliance(const PortCompliance &mirroring, const PortCompliance &opposite,
                                           const bool alike) const
  {
    PortCompliance result;
    const auto &of_lever = mirroring.blocks().front().matrix;
    if (alike)
      for (unsigned int lever = 0; lever < 2; ++lever)
        result.append(of_lever);
    else
      result.append(of_coupled_levers(*of_lever, *opposite.blocks().front().matrix));
    if (pair.sprung)
      result.append(0.5 * mirroring(pair.of_a_lever(), pair.of_a_lever()));
    return result;
  }

  FullMatrix<double> MirroredPorts::displacements_by(const std::vector<unsigned int> &of_both,
                                                     const std::vector<unsigned int> &of_pair) const
  {
    FullMatrix<double> result(of_pair.size(), of_both.size());
    for (unsigned int a = 0; a < of_pair.size(); ++a)
    {
      const unsigned int port            = port_of_structure(of_pair[a]);
      result(a, place_of(port, of_both)) = share();
      if (!is_support(of_pair[a]))
        result(a, place_of(structure_size() + port, of_both)) = of_pair[a] < pair.first(1) ? share() : -share();
    }
    return result;
  }

  PortPerturbation MirroredPorts::on_both(const PortPerturbation &of_pair) const
  {
    if (of_pair.ports.empty())
      return of_pair;
    PortPerturbation result;
    result.ports = of_structure(of_pair.ports);
    for (const unsigned int port : PortSelection(result.ports))
      if (port != pair.of_a_lever())
        result.ports.push_back(structure_size() + port);
    const auto n  = static_cast<unsigned int>(result.ports.size());
    const auto by = displacements_by(result.ports, of_pair.ports);
    for (const auto matrix : matrices)
    {
      (result.*matrix).reinit(n, n);
      (result.*matrix).triple_product(of_pair.*matrix, by, by, true, false);
    }
    const auto transformed = [&](const Vector<double> &row)
    {
      Vector<double> on_structures(n);
      by.Tvmult(on_structures, row);
      return on_structures;
    };
    for (const auto &delay : of_pair.delays)
      result.delays.push_back(
          { delay.time, transformed(delay.force), transformed(delay.stiffness_row), transformed(delay.rate_row) });
    return result;
  }

  /// Places of the ports of a structure: the first, and beyond the last.
  std::pair<unsigned int, unsigned int> MirroredPorts::range(const PortPerturbation &both, const unsigned int motion) const
  {
    const unsigned int of_opposite = place_of(structure_size(), both.ports);
    return motion == 0 ? std::pair(0u, of_opposite) : std::pair(of_opposite, static_cast<unsigned int>(both.ports.size()));
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

  PortPerturbation MirroredPorts::on_structure(const PortPerturbation &of_pair, const PortPerturbation &both,
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
    const auto of_structure = [first = begin, last = end](const Vector<double> &row)
    {
      Vector<double> values(row.begin() + first, row.begin() + last);
      values /= share();
      return values;
    };
    for (unsigned int i = 0; i < of_pair.delays.size(); ++i)
      if (const auto &delay = both.delays[i]; is_of_first_lever(of_pair.ports, of_pair.delays[i]))
        result.delays.push_back(
            { delay.time, of_structure(delay.force), of_structure(delay.stiffness_row), of_structure(delay.rate_row) });
    return result;
  }

  bool MirroredPorts::is_of_first_lever(const std::vector<unsigned int> &ports, const FrictionDelay &delay) const
  {
    for (unsigned int a = 0; a < ports.size(); ++a)
      if (ports[a] < pair.support() && delay.force[a] != 0.)
        return ports[a] < pair.first(1);
    return false;
  }
} // namespace sprag
