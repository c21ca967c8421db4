// SPDX-License-Identifier: GPL-3.0-only
#include "model/interface/interface_forces.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "model/interface/block_product.h"
#include "model/interface/interface_factors.h"

#include <algorithm>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  void sum_forces(const std::vector<InterfaceForces> &loaded, InterfaceForces &sum)
  {
    sum.dofs.clear();
    for (const auto &some : loaded)
      append(sum.dofs, some.dofs);
    sort_unique(sum.dofs);
    const auto n = static_cast<unsigned int>(sum.dofs.size());
    sum.values.reinit(n);
    sum.tangent.reinit(n, n);
    sum.has_tangent = true;
    for (const auto &some : loaded)
    {
      const auto places = find_indices(some.dofs, sum.dofs);
      for (unsigned int i = 0; i < places.size(); ++i)
      {
        sum.values[places[i]] += some.values[i];
        sum.tangent.add(places[i], places.size(), places.data(), &some.tangent(i, 0));
      }
    }
  }

  void add_dofs(const DofSelection &others, DofLoads &loads)
  {
    if (std::includes(loads.dofs.begin(), loads.dofs.end(), others.begin(), others.end()))
      return;
    DofLoads wider{ united(loads.dofs, others), {} };
    wider.values.reinit(static_cast<unsigned int>(wider.dofs.size()));
    for (unsigned int i = 0; i < loads.dofs.size(); ++i)
      wider.values[find_index(loads.dofs[i], wider.dofs)] = loads.values[i];
    loads = std::move(wider);
  }

  void add_dofs(const DofSelection &others, InterfaceForces &forces)
  {
    const auto before = forces.dofs;
    add_dofs(others, static_cast<DofLoads &>(forces));
    if (!forces.has_tangent || forces.dofs.size() == before.size())
      return;
    const auto places = find_indices(before, forces.dofs);
    FullMatrix<double> wider(forces.dofs.size(), forces.dofs.size());
    forces.tangent.scatter_matrix_to(places, places, wider);
    forces.tangent = std::move(wider);
  }

  DofSelection all_dofs(const unsigned int number)
  {
    DofSelection result(number);
    std::iota(result.begin(), result.end(), 0u);
    return result;
  }

  void add_response(const InterfaceCompliance &compliance, const DofSelection &dofs, const Vector<double> &forces,
                    const DofSelection &selected, Vector<double> &displacements)
  {
    for (const auto &block : compliance.blocks())
    {
      const auto [first, last] = block.places_among(dofs);
      const auto [begin, end]  = block.places_among(selected);
      const auto rows          = find_ranges(selected.begin() + begin, selected.begin() + end);
      const double *values     = forces.begin() + first;
      for (const auto &loaded : find_ranges(dofs.begin() + first, dofs.begin() + last))
      {
        const NumberRange columns{ loaded.begin - block.begin, loaded.end - block.begin };
        for (const auto &row : rows)
          add_block_product(*block.matrix, { row.begin - block.begin, row.end - block.begin }, columns, values,
                            displacements.begin() + row.begin);
        values += loaded.size();
      }
    }
  }

  Vector<double> interface_correction(const InterfaceCompliance &compliance, const DofSelection &dofs,
                                      const FullMatrix<double> &tangent, const DofSelection &selected,
                                      const Vector<double> &mismatch)
  {
    // Solve (1 - G df/dz) dz = mismatch on the loaded dofs; elsewhere dz = mismatch + G df.
    Vector<double> result = mismatch;
    if (dofs.empty())
      return result;
    Vector<double> loaded(static_cast<unsigned int>(dofs.size()));
    mismatch.extract_subvector_to(dofs.begin(), dofs.end(), loaded.begin());
    try
    {
      const InterfaceFactors factors(compliance, dofs, tangent);
      add_response(compliance, dofs, factors.reaction(tangent, loaded), selected, result);
      return result;
    }
    catch (const ExceptionBase &)
    {
      throw AnalysisError("the tangent of the contact is singular");
    }
  }
} // namespace sprag
