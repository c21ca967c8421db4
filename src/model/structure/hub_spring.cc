// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/hub_spring.h"

#include <cmath>

namespace sprag
{
  namespace
  {
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

    /// The same with generalised-alpha's delay.
    MeanExcess delayed_excess(const MomentLaw &law, const double begin, const double end, const double delay)
    {
      const auto mean = mean_excess(law, begin, end);
      return { mean.value + delay * (law.excess(end) - law.excess(begin)), mean.derivative + delay * law.excess_stiffness(end) };
    }

    double opening(const PerLever &turns)
    {
      return 0.5 * (turns[0] + turns[1]);
    }

    double swing(const PerLever &turns)
    {
      return 0.5 * (turns[0] - turns[1]);
    }
  } // namespace

  HubSpringExcess::HubSpringExcess(const InterfaceLayout &layout_, std::vector<MomentLaw> lever_laws,
                                   const bool joined_by_free_joint, const double swing_stiffness)
      : layout(layout_)
      , laws(std::move(lever_laws))
      , joined(joined_by_free_joint)
      , coupling_stiffness(joined ? (1. - swing_stiffness) * laws.front().linear_stiffness() : 0.)
  {
  }

  void HubSpringExcess::add(const Moments &moments, InterfaceForces &forces) const
  {
    add_dofs(loaded_dofs(), forces);
    for (unsigned int i = 0; i < layout.levers; ++i)
    {
      const unsigned int row = find_index(layout.rotation(i), forces.dofs);
      forces.values[row] += moments.values[i];
      for (unsigned int j = 0; j < layout.levers && forces.has_tangent; ++j)
        forces.tangent(row, find_index(layout.rotation(j), forces.dofs)) += moments.tangent[i][j];
    }
  }

  /// Moments of joined springs: an excess against opening, and a moment that swings.
  HubSpringExcess::Moments HubSpringExcess::spread(const double excess, const double stiffness, const double moment,
                                                   const double moment_stiffness) const
  {
    Moments result;
    for (unsigned int i = 0; i < 2; ++i)
    {
      const double side = i == 0 ? 1. : -1.;
      result.values[i]  = side * moment - excess;
      for (unsigned int j = 0; j < 2; ++j)
        result.tangent[i][j] = 0.5 * ((i == j ? moment_stiffness : -moment_stiffness) - stiffness);
    }
    return result;
  }

  HubSpringExcess::Moments HubSpringExcess::step_moments(const PerLever &begin, const PerLever &end,
                                                         const StepWeights &weights) const
  {
    const double delay = weights.delay();
    if (joined)
    {
      const auto excess = delayed_excess(laws.front(), opening(begin), opening(end), delay);
      return spread(excess.value, excess.derivative,
                    coupling_stiffness * (weights.stiffness() * swing(end) + weights.alpha_f * swing(begin)),
                    coupling_stiffness * weights.stiffness());
    }
    Moments result;
    for (unsigned int i = 0; i < layout.levers; ++i)
    {
      const auto excess    = delayed_excess(laws[i], begin[i], end[i], delay);
      result.values[i]     = -excess.value;
      result.tangent[i][i] = -excess.derivative;
    }
    return result;
  }

  HubSpringExcess::Moments HubSpringExcess::at(const PerLever &turns, const bool swing_is_held) const
  {
    if (joined)
      return spread(laws.front().excess(opening(turns)), laws.front().excess_stiffness(opening(turns)),
                    coupling_stiffness * swing(turns), swing_is_held ? coupling_stiffness : 0.);
    Moments result;
    for (unsigned int i = 0; i < layout.levers; ++i)
    {
      result.values[i]     = -laws[i].excess(turns[i]);
      result.tangent[i][i] = -laws[i].excess_stiffness(turns[i]);
    }
    return result;
  }

  void HubSpringExcess::add_forces(const PerLever &begin, const PerLever &end, const StepWeights &weights,
                                   InterfaceForces &forces) const
  {
    if (is_active())
      add(step_moments(begin, end, weights), forces);
  }

  void HubSpringExcess::add_forces(const PerLever &turns, const bool swing_is_held, InterfaceForces &forces) const
  {
    if (is_active())
      add(at(turns, swing_is_held), forces);
  }

  void HubSpringExcess::add_work(const PerLever &begin, const PerLever &end, const StepWeights &weights, StepWork &work) const
  {
    const auto excess_work = [&](const MomentLaw &law, const double from, const double to)
    { return weights.delay() * (law.excess(to) - law.excess(from)) * (to - from); };
    if (joined)
    {
      const double change = swing(end) - swing(begin);
      work.algorithmic +=
          2. * (excess_work(laws.front(), opening(begin), opening(end)) - weights.delay() * coupling_stiffness * change * change);
      return;
    }
    for (unsigned int i = 0; i < layout.levers; ++i)
      work.algorithmic += excess_work(laws[i], begin[i], end[i]);
  }

  double HubSpringExcess::energy(const PerLever &turns) const
  {
    if (joined)
      return 2. * laws.front().excess_energy(opening(turns)) - coupling_stiffness * swing(turns) * swing(turns);
    double total = 0.;
    for (unsigned int i = 0; i < layout.levers; ++i)
      total += laws[i].excess_energy(turns[i]);
    return total;
  }

  void HubSpringExcess::add_stiffness(const DofSelection &dofs, const PerLever &turns,
                                      dealii::FullMatrix<double> &stiffness) const
  {
    if (!is_active())
      return;
    const auto moments = at(turns, true);
    for (unsigned int i = 0; i < layout.levers; ++i)
      for (unsigned int j = 0; j < layout.levers; ++j)
        stiffness(find_index(layout.rotation(i), dofs), find_index(layout.rotation(j), dofs)) += moments.tangent[i][j];
  }

  DofSelection HubSpringExcess::loaded_dofs() const
  {
    std::vector<unsigned int> result;
    if (is_active())
      for (unsigned int lever = 0; lever < layout.levers; ++lever)
        result.push_back(layout.rotation(lever));
    return result;
  }
} // namespace sprag
