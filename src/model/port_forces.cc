#include "model/port_forces.h"

#include "base/errors.h"
#include "model/port_matrix.h"

#include <algorithm>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// From so many on most of a Newton correction are its factors. A correction that is right to some 1e-4 takes no more
    /// iterations than an exact one: its residual is exact.
    constexpr std::size_t many_ports = 400;
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
    result.tangent.reinit(n, n);
    std::vector<unsigned int> places;
    for (const unsigned int port : forces.ports)
      places.push_back(place_of(port, result.ports));
    for (unsigned int i = 0; i < places.size(); ++i)
      result.values[places[i]] = forces.values[i];
    forces.tangent.scatter_matrix_to(places, places, result.tangent);
    forces = std::move(result);
  }

  double port_determinant(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                          const FullMatrix<double> &tangent)
  {
    return PortMatrix<double>(compliance, ports, tangent).determinant();
  }

  Vector<double> port_reaction(const PortCompliance &compliance, const std::vector<unsigned int> &ports,
                               const FullMatrix<double> &tangent, const Vector<double> &displacements)
  {
    Vector<double> change = displacements;
    try
    {
      if (ports.size() < many_ports)
        PortMatrix<double>(compliance, ports, tangent).solve(change);
      else
        PortMatrix<float>(compliance, ports, tangent).solve(change);
    }
    catch (const ExceptionBase &)
    {
      throw AnalysisError("the tangent of the contact is singular");
    }
    Vector<double> forces(change.size());
    tangent.vmult(forces, change);
    return forces;
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
      double *const of_block   = displacements.begin() + block.begin;
      for (unsigned int a = first; a < last; ++a)
      {
        const double force      = forces[a];
        const double *const row = &(*block.matrix)(ports[a] - block.begin, 0);
        for (unsigned int k = begin; k < end; ++k)
        {
          const unsigned int i = selected[k] - block.begin;
          of_block[i] += row[i] * force;
        }
      }
    }
  }

  Vector<double> port_correction(const PortCompliance &compliance, const PortForces &forces, const PortSelection &selected,
                                 const Vector<double> &mismatch)
  {
    // (1 - G df/dz) dz = mismatch on the loaded ports; the others follow from the change of the forces.
    Vector<double> result = mismatch;
    if (forces.ports.empty())
      return result;
    Vector<double> loaded(static_cast<unsigned int>(forces.ports.size()));
    for (unsigned int i = 0; i < loaded.size(); ++i)
      loaded[i] = mismatch[forces.ports[i]];
    const auto change_of_forces = port_reaction(compliance, forces.ports, forces.tangent, loaded);
    add_response(compliance, forces.ports, change_of_forces, selected, result);
    return result;
  }
} // namespace sprag
