// SPDX-License-Identifier: GPL-3.0-only
#include "model/port_forces.h"

#include "base/errors.h"
#include "model/block_product.h"
#include "model/port_matrix.h"
#include "model/reduced_factors.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr std::size_t few_ports  = 12;  ///< up to so many to look for what is zero takes longer than to compute with it
    constexpr std::size_t many_ports = 128; ///< from so many on most of a Newton correction are its factors

    /// Solves (1 - G A) x = b on ports of a single block: x is b before, and the solution after. By factors, not by the inverse,
    /// which is no more accurate than the matrix is well conditioned.
    void solve_whole(const PortCompliance &compliance, const std::vector<unsigned int> &ports, const FullMatrix<double> &tangent,
                     Vector<double> &x)
    {
      const auto n         = static_cast<unsigned int>(ports.size());
      const auto &of_ports = *compliance.blocks().front().matrix;
      LAPACKFullMatrix<double> matrix(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          double yields = i == j ? 1. : 0.;
          for (unsigned int k = 0; k < n; ++k)
            yields -= of_ports(ports[i], ports[k]) * tangent(k, j);
          matrix(i, j) = yields;
        }
      matrix.compute_lu_factorization();
      matrix.solve(x);
    }

    /// Forces of a tangent A that answer to displacements z, f = A (z + G f): by factors of single precision, at half the cost
    /// and less, whose errors are found in turn. What they may leave unbalanced is told by what it would move, as Newton's method
    /// looks at that: forces follow displacements so strongly that a small share of them is a large share of these. None where
    /// that fails: badly conditioned tangents do not let it.
    std::optional<Vector<double>> reaction_by_refinement(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                                                         const FullMatrix<double> &tangent, const Vector<double> &displacements)
    try
    {
      constexpr unsigned int most_refinements = 12;
      constexpr double refined                = 1e-10; // what may be left, of the displacements
      constexpr double aim                    = 1e-3;  // of what is left, by a refinement
      const ReducedFactors factors(compliance, ports, tangent);
      Vector<double> result(displacements.size()), rest(displacements.size()), moved(displacements.size());
      Vector<double> of_all(compliance.size());
      factors.add_forces(displacements, rest);
      for (unsigned int i = 0; i < most_refinements; ++i)
      {
        factors.add_solution(rest, aim, result);
        of_all = 0.;
        add_response(compliance, ports, result, ports, of_all);
        for (unsigned int j = 0; j < moved.size(); ++j)
          moved[j] = displacements[j] + of_all[ports[j]];
        rest.equ(-1., result);
        factors.add_forces(moved, rest);
        if (factors.movement_by(rest) <= refined * factors.movement(displacements))
          return result;
      }
      return {};
    }
    catch (const ExceptionBase &)
    {
      return {};
    }
  } // namespace

  void sum_forces(const std::vector<PortForces> &loaded, std::vector<unsigned int> &place_of_port, PortForces &sum)
  {
    sum.ports.clear();
    for (const auto &some : loaded)
      sum.ports.insert(sum.ports.end(), some.ports.begin(), some.ports.end());
    std::sort(sum.ports.begin(), sum.ports.end());
    sum.ports.erase(std::unique(sum.ports.begin(), sum.ports.end()), sum.ports.end());
    const auto n = static_cast<unsigned int>(sum.ports.size());
    for (unsigned int a = 0; a < n; ++a)
      place_of_port[sum.ports[a]] = a;

    sum.values.reinit(n);
    sum.tangent.reinit(n, n);
    sum.has_tangent = true;
    for (const auto &some : loaded)
      for (unsigned int i = 0; i < some.ports.size(); ++i)
      {
        const unsigned int row = place_of_port[some.ports[i]];
        sum.values[row] += some.values[i];
        for (unsigned int j = 0; j < some.ports.size(); ++j)
          sum.tangent(row, place_of_port[some.ports[j]]) += some.tangent(i, j);
      }
  }

  void add_ports(const std::vector<unsigned int> &others, PortForces &forces)
  {
    if (std::includes(forces.ports.begin(), forces.ports.end(), others.begin(), others.end()))
      return;
    PortForces result;
    std::set_union(forces.ports.begin(), forces.ports.end(), others.begin(), others.end(), std::back_inserter(result.ports));
    const auto n = static_cast<unsigned int>(result.ports.size());
    result.values.reinit(n);
    std::vector<unsigned int> places;
    for (const unsigned int port : forces.ports)
      places.push_back(place_of(port, result.ports));
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

  double port_determinant(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                          const FullMatrix<double> &tangent)
  {
    return PortMatrix(compliance, ports, tangent).determinant();
  }

  Vector<double> port_reaction(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                               const FullMatrix<double> &tangent, const Vector<double> &displacements)
  {
    try
    {
      if (ports.size() >= many_ports)
        if (const auto forces = reaction_by_refinement(compliance, ports, tangent, displacements))
          return *forces;
      Vector<double> change = displacements, forces(displacements.size());
      if (ports.size() <= few_ports && compliance.blocks().size() == 1)
        solve_whole(compliance, ports, tangent, change);
      else
        PortMatrix(compliance, ports, tangent).solve(change);
      tangent.vmult(forces, change);
      return forces;
    }
    catch (const ExceptionBase &)
    {
      throw AnalysisError("the tangent of the contact is singular");
    }
  }

  PortSelection all_ports(const unsigned int number)
  {
    PortSelection result(number);
    std::iota(result.begin(), result.end(), 0u);
    return result;
  }

  void add_response(const PortCompliance &compliance, const std::vector<unsigned int> &ports, const Vector<double> &forces,
                    const PortSelection &selected, Vector<double> &displacements)
  {
    for (const auto &block : compliance.blocks())
    {
      const auto [first, last] = block.places_among(ports);
      const auto [begin, end]  = block.places_among(selected);
      const auto rows          = ranges_of(selected.begin() + begin, selected.begin() + end);
      const double *values     = forces.begin() + first;
      for (const auto &loaded : ranges_of(ports.begin() + first, ports.begin() + last))
      {
        const NumberRange columns{ loaded.begin - block.begin, loaded.end - block.begin };
        for (const auto &row : rows)
          add_block_product(*block.matrix, { row.begin - block.begin, row.end - block.begin }, columns, values,
                            displacements.begin() + row.begin);
        values += loaded.size();
      }
    }
  }

  Vector<double> port_correction(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                                 const FullMatrix<double> &tangent, const PortSelection &selected, const Vector<double> &mismatch)
  {
    // (1 - G df/dz) dz = mismatch on the loaded ports; the others follow from the change of the forces.
    Vector<double> result = mismatch;
    if (ports.empty())
      return result;
    Vector<double> loaded(static_cast<unsigned int>(ports.size()));
    for (unsigned int i = 0; i < loaded.size(); ++i)
      loaded[i] = mismatch[ports[i]];
    add_response(compliance, ports, port_reaction(compliance, ports, tangent, loaded), selected, result);
    return result;
  }
} // namespace sprag
