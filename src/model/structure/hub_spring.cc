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

    double symmetric_turn(const PerLever &turns)
    {
      return 0.5 * (turns[0] + turns[1]);
    }

    double antisymmetric_turn(const PerLever &turns)
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

  /// Returns moments by what `excess`(law, turn) finds, turn(turns) being that of a spring: of joined springs the symmetric turn,
  /// with an antisymmetric moment.
  template <class Excess>
  HubSpringExcess::Moments HubSpringExcess::find_moments(const Excess &excess, const double moment,
                                                         const double moment_stiffness) const
  {
    Moments result;
    const auto opened = joined ? excess(laws.front(), symmetric_turn) : MeanExcess{};
    for (unsigned int i = 0; i < layout.levers; ++i)
      if (joined)
      {
        result.values[i] = (i == 0 ? moment : -moment) - opened.value;
        for (unsigned int j = 0; j < 2; ++j)
          result.tangent[i][j] = 0.5 * ((i == j ? moment_stiffness : -moment_stiffness) - opened.derivative);
      }
      else
      {
        const auto own       = excess(laws[i], [i](const PerLever &turns) { return turns[i]; });
        result.values[i]     = -own.value;
        result.tangent[i][i] = -own.derivative;
      }
    return result;
  }

  HubSpringExcess::Moments HubSpringExcess::moments_at(const PerLever &turns, const bool swing_is_held) const
  {
    const auto excess = [&](const MomentLaw &law, const auto &turn) {
      return MeanExcess{ law.excess(turn(turns)), law.excess_stiffness(turn(turns)) };
    };
    return find_moments(excess, coupling_stiffness * antisymmetric_turn(turns), swing_is_held ? coupling_stiffness : 0.);
  }

  void HubSpringExcess::add_forces(const PerLever &begin, const PerLever &end, const StepWeights &weights,
                                   InterfaceForces &forces) const
  {
    const auto excess = [&](const MomentLaw &law, const auto &turn)
    { return delayed_excess(law, turn(begin), turn(end), weights.delay()); };
    if (is_active())
      add(find_moments(excess,
                       coupling_stiffness *
                           (weights.stiffness() * antisymmetric_turn(end) + weights.alpha_f * antisymmetric_turn(begin)),
                       coupling_stiffness * weights.stiffness()),
          forces);
  }

  void HubSpringExcess::add_forces(const PerLever &turns, const bool swing_is_held, InterfaceForces &forces) const
  {
    if (is_active())
      add(moments_at(turns, swing_is_held), forces);
  }

  void HubSpringExcess::add_work(const PerLever &begin, const PerLever &end, const StepWeights &weights, StepWork &work) const
  {
    const auto excess_work = [&](const MomentLaw &law, const double from, const double to)
    { return weights.delay() * (law.excess(to) - law.excess(from)) * (to - from); };
    if (joined)
    {
      const double change = antisymmetric_turn(end) - antisymmetric_turn(begin);
      work.algorithmic += 2. * (excess_work(laws.front(), symmetric_turn(begin), symmetric_turn(end)) -
                                weights.delay() * coupling_stiffness * change * change);
      return;
    }
    for (unsigned int i = 0; i < layout.levers; ++i)
      work.algorithmic += excess_work(laws[i], begin[i], end[i]);
  }

  double HubSpringExcess::energy(const PerLever &turns) const
  {
    if (joined)
      return 2. * laws.front().excess_energy(symmetric_turn(turns)) -
             coupling_stiffness * antisymmetric_turn(turns) * antisymmetric_turn(turns);
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
    const auto excess = moments_at(turns, true);
    for (unsigned int i = 0; i < layout.levers; ++i)
      for (unsigned int j = 0; j < layout.levers; ++j)
        stiffness(find_index(layout.rotation(i), dofs), find_index(layout.rotation(j), dofs)) += excess.tangent[i][j];
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
