#include "model/hub_spring.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    unsigned int place_of(const unsigned int port, const std::vector<unsigned int> &ports)
    {
      return static_cast<unsigned int>(std::lower_bound(ports.begin(), ports.end(), port) - ports.begin());
    }

    /// Mean of the excess over a turn, and its derivative by the end.
    struct MeanExcess
    {
      double value;
      double derivative;
    };

    MeanExcess mean_excess(const MomentLaw &law, const double begin, const double end)
    {
      // Below this the difference of energies is round-off; the law is smooth enough for the middle.
      constexpr double smallest_turn = 1e-6;
      const double turn              = end - begin;
      if (std::abs(turn) < smallest_turn)
      {
        const double middle = 0.5 * (begin + end);
        return { law.excess(middle), 0.5 * law.excess_stiffness(middle) };
      }
      const double mean = (law.excess_energy(end) - law.excess_energy(begin)) / turn;
      return { mean, (law.excess(end) - mean) / turn };
    }
  } // namespace

  HubSpringExcess::HubSpringExcess(const PortLayout &ports, MomentLaw moment_law)
      : layout(ports)
      , law(std::move(moment_law))
  {
  }

  const PortForces &HubSpringExcess::with(const PortForces &others, const double force, const double tangent)
  {
    const unsigned int hub  = layout.rotation();
    const unsigned int here = place_of(hub, others.ports);
    const auto n_others     = static_cast<unsigned int>(others.ports.size());
    const bool is_there     = here < n_others && others.ports[here] == hub;
    const unsigned int gap  = is_there ? 0 : 1;
    const auto moved        = [&](const unsigned int i) { return i < here ? i : i + gap; };

    sum.ports = others.ports;
    if (!is_there)
      sum.ports.insert(sum.ports.begin() + here, hub);
    sum.values.reinit(n_others + gap);
    sum.tangent.reinit(n_others + gap, n_others + gap);
    for (unsigned int i = 0; i < n_others; ++i)
    {
      sum.values[moved(i)] = others.values[i];
      for (unsigned int j = 0; j < n_others; ++j)
        sum.tangent(moved(i), moved(j)) = others.tangent(i, j);
    }
    sum.values[here] += force;
    sum.tangent(here, here) += tangent;
    return sum;
  }

  const PortForces &HubSpringExcess::add_forces(const PortForces &others, const double begin, const double end,
                                                const StepWeights &weights)
  {
    if (law.is_linear())
      return others;
    const auto mean    = mean_excess(law, begin, end);
    const double delay = weights.delay();
    return with(others, -mean.value - delay * (law.excess(end) - law.excess(begin)),
                -mean.derivative - delay * law.excess_stiffness(end));
  }

  const PortForces &HubSpringExcess::add_forces(const PortForces &others, const double turn)
  {
    return law.is_linear() ? others : with(others, -law.excess(turn), -law.excess_stiffness(turn));
  }

  void HubSpringExcess::add_work(const double begin, const double end, const StepWeights &weights, StepWork &work) const
  {
    work.algorithmic += weights.delay() * (law.excess(end) - law.excess(begin)) * (end - begin);
  }

  double HubSpringExcess::energy(const double turn) const
  {
    return law.excess_energy(turn);
  }

  void HubSpringExcess::add_stiffness(const std::vector<unsigned int> &ports, const double turn,
                                      dealii::FullMatrix<double> &stiffness) const
  {
    if (law.is_linear())
      return;
    const unsigned int hub = place_of(layout.rotation(), ports);
    stiffness(hub, hub) -= law.excess_stiffness(turn);
  }

  std::vector<unsigned int> HubSpringExcess::loaded_ports() const
  {
    return law.is_linear() ? std::vector<unsigned int>{} : std::vector<unsigned int>{ layout.rotation() };
  }
} // namespace sprag
