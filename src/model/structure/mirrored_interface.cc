// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/mirrored_interface.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    FullMatrix<double> coupled_compliance(const FullMatrix<double> &symmetric, const FullMatrix<double> &antisymmetric)
    {
      const auto n = symmetric.m();
      FullMatrix<double> result(2 * n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          result(i, j) = result(n + i, n + j) = 0.5 * (symmetric(i, j) + antisymmetric(i, j));
          result(i, n + j) = result(n + i, j) = 0.5 * (symmetric(i, j) - antisymmetric(i, j));
        }
      return result;
    }
  } // namespace

  MirroredInterface::MirroredInterface(const InterfaceLayout &lever_layout)
      : pair(lever_layout)
  {
    pair.levers = 2;
  }

  DofSelection MirroredInterface::structure_dofs(const DofSelection &paired) const
  {
    const auto second = std::lower_bound(paired.begin(), paired.end(), pair.first(1));
    const auto beyond = std::lower_bound(second, paired.end(), pair.support());
    DofSelection second_dofs, result;
    std::transform(second, beyond, std::back_inserter(second_dofs), [&](const unsigned int dof) { return structure_dof(dof); });
    std::set_union(paired.begin(), second, second_dofs.begin(), second_dofs.end(), std::back_inserter(result));
    if (beyond != paired.end())
      result.push_back(structure_dof(*beyond));
    return result;
  }

  Vector<double> MirroredInterface::displacements(const Vector<double> &symmetric, const Vector<double> &antisymmetric) const
  {
    Vector<double> result(pair.size());
    for (unsigned int i = 0; i < pair.dofs_per_lever(); ++i)
    {
      result[pair.first(0) + i] = share() * (symmetric[i] + antisymmetric[i]);
      result[pair.first(1) + i] = share() * (symmetric[i] - antisymmetric[i]);
    }
    if (pair.sprung)
      result[pair.support()] = share() * symmetric[pair.dofs_per_lever()];
    return result;
  }

  DofState MirroredInterface::state(const unsigned int pair_dof, const DofState &symmetric, const DofState &antisymmetric) const
  {
    if (is_support(pair_dof))
      return { share() * symmetric.position, share() * symmetric.velocity };
    const double side = pair_dof < pair.first(1) ? share() : -share();
    return { share() * symmetric.position + side * antisymmetric.position,
             share() * symmetric.velocity + side * antisymmetric.velocity };
  }

  InterfaceForces MirroredInterface::forces(const InterfaceForces &paired, const unsigned int motion) const
  {
    InterfaceForces result;
    result.dofs = structure_dofs(paired.dofs);
    if (motion == 1 && !result.dofs.empty() && result.dofs.back() == pair.dofs_per_lever())
      result.dofs.pop_back();
    result.values.reinit(static_cast<unsigned int>(result.dofs.size()));
    for (unsigned int a = 0; a < paired.dofs.size(); ++a)
    {
      const unsigned int dof = paired.dofs[a];
      if (is_support(dof) && motion == 1)
        continue;
      const bool against = motion == 1 && dof >= pair.first(1);
      result.values[find_index(structure_dof(dof), result.dofs)] += (against ? -share() : share()) * paired.values[a];
    }
    return result;
  }

  InterfaceCompliance MirroredInterface::compliance(const InterfaceCompliance &symmetric,
                                                    const InterfaceCompliance &antisymmetric, const bool identical) const
  {
    InterfaceCompliance result;
    const auto &lever_compliance = symmetric.blocks().front().matrix;
    if (identical)
      for (unsigned int lever = 0; lever < 2; ++lever)
        result.append(lever_compliance);
    else
      result.append(coupled_compliance(*lever_compliance, *antisymmetric.blocks().front().matrix));
    if (pair.sprung)
      result.append(0.5 * symmetric(pair.dofs_per_lever(), pair.dofs_per_lever()));
    return result;
  }

  LinearisedForces MirroredInterface::on_both(const LinearisedForces &paired) const
  {
    if (paired.dofs.empty())
      return paired;
    LinearisedForces result;
    result.dofs = structure_dofs(paired.dofs);
    for (const unsigned int dof : DofSelection(result.dofs))
      if (dof != pair.dofs_per_lever())
        result.dofs.push_back(structure_size() + dof);
    const auto n = static_cast<unsigned int>(result.dofs.size());
    FullMatrix<double> T(paired.dofs.size(), n);
    for (unsigned int a = 0; a < paired.dofs.size(); ++a)
    {
      const unsigned int dof             = structure_dof(paired.dofs[a]);
      T(a, find_index(dof, result.dofs)) = share();
      if (!is_support(paired.dofs[a]))
        T(a, find_index(structure_size() + dof, result.dofs)) = paired.dofs[a] < pair.first(1) ? share() : -share();
    }
    for (const auto matrix : force_matrices)
    {
      (result.*matrix).reinit(n, n);
      (result.*matrix).triple_product(paired.*matrix, T, T, true, false);
    }
    const auto transformed = [&](const Vector<double> &row)
    {
      Vector<double> on_structures(n);
      T.Tvmult(on_structures, row);
      return on_structures;
    };
    for (const auto &delay : paired.delays)
      result.delays.push_back(
          { delay.time, transformed(delay.force), transformed(delay.stiffness_row), transformed(delay.rate_row) });
    return result;
  }

  /// Returns the range of indices of a structure's dofs in `both`: first and one past the last.
  std::pair<unsigned int, unsigned int> MirroredInterface::range(const LinearisedForces &both, const unsigned int motion) const
  {
    const unsigned int second_begin = find_index(structure_size(), both.dofs);
    return motion == 0 ? std::pair(0u, second_begin) : std::pair(second_begin, static_cast<unsigned int>(both.dofs.size()));
  }

  bool MirroredInterface::couples(const LinearisedForces &both) const
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

  LinearisedForces MirroredInterface::on_structure(const LinearisedForces &paired, const LinearisedForces &both,
                                                   const unsigned int motion) const
  {
    const auto [begin, end] = range(both, motion);
    LinearisedForces result;
    for (unsigned int a = begin; a < end; ++a)
      result.dofs.push_back(both.dofs[a] % structure_size());
    if (result.dofs.empty())
      return result;
    for (const auto matrix : force_matrices)
    {
      (result.*matrix).reinit(end - begin, end - begin);
      (result.*matrix).fill(both.*matrix, 0, 0, begin, begin);
    }
    // The delay of the first lever represents those of both levers, which are symmetric.
    const auto structure_row = [first = begin, last = end](const Vector<double> &row)
    {
      Vector<double> values(row.begin() + first, row.begin() + last);
      values /= share();
      return values;
    };
    for (unsigned int i = 0; i < paired.delays.size(); ++i)
      if (const auto &delay = both.delays[i]; acts_on_first_lever(paired.dofs, paired.delays[i]))
        result.delays.push_back(
            { delay.time, structure_row(delay.force), structure_row(delay.stiffness_row), structure_row(delay.rate_row) });
    return result;
  }

  bool MirroredInterface::acts_on_first_lever(const DofSelection &dofs, const FrictionDelay &delay) const
  {
    for (unsigned int a = 0; a < dofs.size(); ++a)
      if (dofs[a] < pair.support() && delay.force[a] != 0.)
        return dofs[a] < pair.first(1);
    return false;
  }
} // namespace sprag
