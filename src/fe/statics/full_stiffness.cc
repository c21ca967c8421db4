#include "fe/statics/full_stiffness.h"

#include "base/errors.h"
#include "fe/algebra/matrix_rows.h"
#include "model/state_archive.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <cmath>

namespace sprag
{
  using namespace dealii;

  FullStiffness::FullStiffness(const ElasticBody<2> &body_, const PortLayout &ports_, const PortSprings &springs_)
      : body(body_)
      , ports(ports_)
      , springs(springs_)
      , surface(surface_dofs(body))
  {
    body.reinit(of_body);
    DynamicSparsityPattern pattern(n_coordinates(), n_coordinates());
    const MatrixRows rows(of_body);
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
      for (PetscInt i = 0; i < rows.n; ++i)
        for (PetscInt k = rows.begin[i]; k < rows.begin[i + 1]; ++k)
          pattern.add(first_coordinate(lever) + static_cast<unsigned int>(i),
                      first_coordinate(lever) + static_cast<unsigned int>(rows.column[k]));
    couple_ports(pattern);
    matrix.reinit(pattern);
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
      find_places(lever);
  }

  void FullStiffness::find_places(const unsigned int lever)
  {
    const MatrixRows rows(of_body), all(matrix);
    const auto first = static_cast<PetscInt>(first_coordinate(lever));
    for (PetscInt i = 0; i < rows.n; ++i)
    {
      PetscInt place = all.begin[first + i];
      for (PetscInt k = rows.begin[i]; k < rows.begin[i + 1]; ++k)
      {
        while (all.column[place] < first + rows.column[k])
          ++place;
        places.push_back(static_cast<std::size_t>(place));
      }
    }
  }

  /// Hubs and support with everything that the contact touches, and an elastic cylinder's face with all of both faces: the
  /// material of the lever slides along it.
  void FullStiffness::couple_ports(DynamicSparsityPattern &pattern) const
  {
    const auto couple = [&](const unsigned int port, const unsigned int other)
    {
      pattern.add(coordinate(port), coordinate(other));
      pattern.add(coordinate(other), coordinate(port));
    };
    const auto friction_ports = 2 * static_cast<unsigned int>(body.friction_face().nodes.size());
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
    {
      for (unsigned int i = 0; i < ports.of_a_lever(); ++i)
      {
        couple(ports.first(lever) + i, ports.rotation(lever));
        if (ports.sprung)
          couple(ports.first(lever) + i, ports.support());
        for (unsigned int j = friction_ports; j < ports.surface; ++j)
          couple(ports.first(lever) + i, ports.first(lever) + j);
      }
      couple(ports.rotation(lever), ports.rotation(0));
    }
    if (ports.sprung)
      couple(ports.support(), ports.support());
  }

  unsigned int FullStiffness::first_coordinate(const unsigned int lever) const
  {
    return lever * (body.n_dofs() + 1);
  }

  unsigned int FullStiffness::n_coordinates() const
  {
    return first_coordinate(ports.levers) + (ports.sprung ? 1 : 0);
  }

  unsigned int FullStiffness::coordinate(const unsigned int port) const
  {
    if (port == ports.support())
      return first_coordinate(ports.levers);
    const unsigned int lever = ports.lever_of(port);
    return first_coordinate(lever) + (ports.is_surface(port) ? surface[port - ports.first(lever)] : body.n_dofs());
  }

  Vector<double> FullStiffness::port_displacements(const Vector<double> &coordinates) const
  {
    Vector<double> result(ports.size());
    for (unsigned int port = 0; port < result.size(); ++port)
      result[port] = coordinates[coordinate(port)];
    return result;
  }

  double FullStiffness::unbalance(const Vector<double> &coordinates, const PortForces &forces)
  {
    if (!is_ordered)
      first_coordinates = coordinates;
    matrix = 0.;
    residual.reinit(n_coordinates());
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
      add_body(lever, coordinates);
    const auto add_spring = [&](const unsigned int port, const double stiffness)
    {
      const unsigned int i = coordinate(port);
      matrix.add(i, i, stiffness);
      residual[i] -= stiffness * coordinates[i];
    };
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
      add_spring(ports.rotation(lever), springs.rotation);
    if (ports.sprung)
      add_spring(ports.support(), ports.levers * springs.support);
    matrix.compress(VectorOperation::add);

    for (unsigned int i = 0; i < forces.ports.size(); ++i)
      residual[coordinate(forces.ports[i])] += forces.values[i];
    double result = residual.norm_sqr();
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
    {
      const double moment = residual[coordinate(ports.rotation(lever))];
      result += (1. / (springs.arm * springs.arm) - 1.) * moment * moment;
    }
    return std::sqrt(result);
  }

  void FullStiffness::add_body(const unsigned int lever, const Vector<double> &coordinates)
  {
    const unsigned int first = first_coordinate(lever);
    Vector<double> internal(body.n_dofs());
    of_body = 0.;
    body.assemble(body_displacement(lever, coordinates, {}), of_body, internal);
    for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
      residual[first + dof] -= internal[dof];

    const MatrixRows from(of_body), to(matrix);
    const std::size_t n = places.size() / ports.levers;
    for (std::size_t k = 0; k < n; ++k)
      to[places[lever * n + k]] += from[k];
  }

  void FullStiffness::visit_history(Archive &archive)
  {
    bool known       = is_ordered;
    auto coordinates = first_coordinates;
    auto forces      = first_forces;
    archive(known, coordinates, forces);
    if (!archive.reads() || !known)
      return;
    try
    {
      unbalance(coordinates, forces);
      correction(forces);
    }
    catch (const AnalysisError &)
    {
      // So it was, and the ordering was kept.
    }
  }

  Vector<double> FullStiffness::correction(const PortForces &forces)
  {
    if (!is_ordered)
      first_forces = forces;
    is_ordered = true;
    for (unsigned int i = 0; i < forces.ports.size(); ++i)
      for (unsigned int j = 0; j < forces.ports.size(); ++j)
        if (forces.tangent(i, j) != 0.)
          matrix.add(coordinate(forces.ports[i]), coordinate(forces.ports[j]), -forces.tangent(i, j));
    matrix.compress(VectorOperation::add);
    factors.factorise(matrix);
    Vector<double> result;
    factors.solve(residual, result);
    return result;
  }

  double FullStiffness::largest(const Vector<double> &coordinates) const
  {
    return coordinates.linfty_norm();
  }

  Vector<double> FullStiffness::body_displacement(const unsigned int lever, const Vector<double> &coordinates,
                                                  const PortLoads &) const
  {
    const auto begin = coordinates.begin() + first_coordinate(lever);
    return Vector<double>(begin, begin + body.n_dofs());
  }

  std::vector<double> FullStiffness::sensor_forces(const unsigned int lever, const Vector<double> &coordinates,
                                                   const PortLoads &forces) const
  {
    return sprag::sensor_forces(body, body_displacement(lever, coordinates, forces));
  }
} // namespace sprag
