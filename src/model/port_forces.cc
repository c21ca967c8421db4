#include "model/port_forces.h"

#include "base/errors.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// 1 - G df/dz.
    LAPACKFullMatrix<double> port_matrix(const FullMatrix<double> &compliance, const std::vector<unsigned int> &ports,
                                         const FullMatrix<double> &tangent)
    {
      const auto n = static_cast<unsigned int>(ports.size());
      FullMatrix<double> loaded(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          loaded(i, j) = compliance(ports[i], ports[j]);
      FullMatrix<double> product(n, n);
      loaded.mmult(product, tangent);
      LAPACKFullMatrix<double> matrix(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          matrix(i, j) = (i == j ? 1. : 0.) - product(i, j);
      return matrix;
    }
  } // namespace

  unsigned int place_of(const unsigned int port, const std::vector<unsigned int> &ports)
  {
    return static_cast<unsigned int>(std::lower_bound(ports.begin(), ports.end(), port) - ports.begin());
  }

  void extend(const PortForces &forces, const std::vector<unsigned int> &others, PortForces &result)
  {
    result.ports.clear();
    std::set_union(forces.ports.begin(), forces.ports.end(), others.begin(), others.end(), std::back_inserter(result.ports));
    const auto n = static_cast<unsigned int>(result.ports.size());
    result.values.reinit(n);
    result.tangent.reinit(n, n);
    std::vector<unsigned int> places;
    for (const unsigned int port : forces.ports)
      places.push_back(place_of(port, result.ports));
    for (unsigned int i = 0; i < places.size(); ++i)
    {
      result.values[places[i]] = forces.values[i];
      for (unsigned int j = 0; j < places.size(); ++j)
        result.tangent(places[i], places[j]) = forces.tangent(i, j);
    }
  }

  double port_determinant(const FullMatrix<double> &compliance, const std::vector<unsigned int> &ports,
                          const FullMatrix<double> &tangent)
  {
    if (ports.empty())
      return 1.;
    auto matrix = port_matrix(compliance, ports, tangent);
    matrix.compute_lu_factorization();
    return matrix.determinant();
  }

  Vector<double> port_reaction(const FullMatrix<double> &compliance, const std::vector<unsigned int> &ports,
                               const FullMatrix<double> &tangent, const Vector<double> &displacements)
  {
    auto matrix           = port_matrix(compliance, ports, tangent);
    Vector<double> change = displacements;
    try
    {
      matrix.compute_lu_factorization();
    }
    catch (const ExceptionBase &)
    {
      throw AnalysisError("the tangent of the contact is singular");
    }
    matrix.solve(change);
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

  void add_response(const FullMatrix<double> &compliance, const std::vector<unsigned int> &ports, const Vector<double> &forces,
                    const PortSelection &selected, Vector<double> &displacements)
  {
    for (unsigned int a = 0; a < ports.size(); ++a)
    {
      const double force  = forces[a];
      const double *row   = &compliance(ports[a], 0);
      double *const begin = displacements.begin();
      for (const unsigned int i : selected)
        begin[i] += row[i] * force;
    }
  }

  Vector<double> port_correction(const FullMatrix<double> &compliance, const PortForces &forces, const PortSelection &selected,
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
