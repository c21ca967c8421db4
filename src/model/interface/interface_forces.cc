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

  void sum_forces(const std::vector<InterfaceForces> &loaded, std::vector<unsigned int> &dof_places, InterfaceForces &sum)
  {
    sum.dofs.clear();
    for (const auto &some : loaded)
      sum.dofs.insert(sum.dofs.end(), some.dofs.begin(), some.dofs.end());
    std::sort(sum.dofs.begin(), sum.dofs.end());
    sum.dofs.erase(std::unique(sum.dofs.begin(), sum.dofs.end()), sum.dofs.end());
    const auto n = static_cast<unsigned int>(sum.dofs.size());
    for (unsigned int a = 0; a < n; ++a)
      dof_places[sum.dofs[a]] = a;

    sum.values.reinit(n);
    sum.tangent.reinit(n, n);
    sum.has_tangent = true;
    for (const auto &some : loaded)
      for (unsigned int i = 0; i < some.dofs.size(); ++i)
      {
        const unsigned int row = dof_places[some.dofs[i]];
        sum.values[row] += some.values[i];
        for (unsigned int j = 0; j < some.dofs.size(); ++j)
          sum.tangent(row, dof_places[some.dofs[j]]) += some.tangent(i, j);
      }
  }

  void add_dofs(const std::vector<unsigned int> &others, InterfaceForces &forces)
  {
    if (std::includes(forces.dofs.begin(), forces.dofs.end(), others.begin(), others.end()))
      return;
    InterfaceForces result;
    std::set_union(forces.dofs.begin(), forces.dofs.end(), others.begin(), others.end(), std::back_inserter(result.dofs));
    const auto n = static_cast<unsigned int>(result.dofs.size());
    result.values.reinit(n);
    const auto places = mapped(forces.dofs, [&](const unsigned int dof) { return find_index(dof, result.dofs); });
    for (unsigned int i = 0; i < places.size(); ++i)
      result.values[places[i]] = forces.values[i];
    result.has_tangent = forces.has_tangent;
    if (forces.has_tangent)
    {
      result.tangent.reinit(n, n);
      forces.tangent.scatter_matrix_to(places, places, result.tangent);
    }
    forces = std::move(result);
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
    for (unsigned int i = 0; i < loaded.size(); ++i)
      loaded[i] = mismatch[dofs[i]];
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
