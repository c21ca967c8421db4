// SPDX-License-Identifier: GPL-3.0-only
#include "model/port_forces.h"

#include "base/errors.h"
#include "model/block_product.h"
#include "model/port_factors.h"

#include <algorithm>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  void sum_forces(const std::vector<PortForces> &loaded, std::vector<unsigned int> &port_places, PortForces &sum)
  {
    sum.ports.clear();
    for (const auto &some : loaded)
      sum.ports.insert(sum.ports.end(), some.ports.begin(), some.ports.end());
    std::sort(sum.ports.begin(), sum.ports.end());
    sum.ports.erase(std::unique(sum.ports.begin(), sum.ports.end()), sum.ports.end());
    const auto n = static_cast<unsigned int>(sum.ports.size());
    for (unsigned int a = 0; a < n; ++a)
      port_places[sum.ports[a]] = a;

    sum.values.reinit(n);
    sum.tangent.reinit(n, n);
    sum.has_tangent = true;
    for (const auto &some : loaded)
      for (unsigned int i = 0; i < some.ports.size(); ++i)
      {
        const unsigned int row = port_places[some.ports[i]];
        sum.values[row] += some.values[i];
        for (unsigned int j = 0; j < some.ports.size(); ++j)
          sum.tangent(row, port_places[some.ports[j]]) += some.tangent(i, j);
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
      places.push_back(find_index(port, result.ports));
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
    return PortFactors(compliance, ports, tangent).determinant();
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
      const auto rows          = find_ranges(selected.begin() + begin, selected.begin() + end);
      const double *values     = forces.begin() + first;
      for (const auto &loaded : find_ranges(ports.begin() + first, ports.begin() + last))
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
    try
    {
      const PortFactors factors(compliance, ports, tangent);
      add_response(compliance, ports, factors.reaction(tangent, loaded), selected, result);
      return result;
    }
    catch (const ExceptionBase &)
    {
      throw AnalysisError("the tangent of the contact is singular");
    }
  }
} // namespace sprag
