#include "fe/statics/full_stiffness.h"

#include <cmath>

namespace sprag
{
  using namespace dealii;

  FullStiffness::FullStiffness(const ElasticBody<2> &body_, const PortLayout &ports_, const PortSprings &springs_)
      : body(body_)
      , ports(ports_)
      , springs(springs_)
      , coordinate_of(surface_dofs(body))
  {
    const unsigned int of_hub_and_support = ports.size() - ports.surface;
    for (unsigned int i = 0; i < of_hub_and_support; ++i)
      coordinate_of.push_back(body.n_dofs() + i);
    body.reinit(matrix, of_hub_and_support);
  }

  unsigned int FullStiffness::n_coordinates() const
  {
    return body.n_dofs() + ports.size() - ports.surface;
  }

  Vector<double> FullStiffness::port_displacements(const Vector<double> &coordinates) const
  {
    Vector<double> result(ports.size());
    for (unsigned int port = 0; port < result.size(); ++port)
      result[port] = coordinates[coordinate_of[port]];
    return result;
  }

  double FullStiffness::unbalance(const Vector<double> &coordinates, const PortForces &forces)
  {
    const unsigned int rotation = coordinate_of[ports.rotation()];
    Vector<double> internal(n_coordinates());
    matrix = 0.;
    body.assemble(coordinates, matrix, internal);
    internal[rotation] = springs.rotation * coordinates[rotation];
    if (ports.sprung)
      internal[coordinate_of[ports.support()]] = springs.support * coordinates[coordinate_of[ports.support()]];

    residual.reinit(n_coordinates());
    residual -= internal;
    for (unsigned int i = 0; i < forces.ports.size(); ++i)
      residual[coordinate_of[forces.ports[i]]] += forces.values[i];
    const double moment = residual[rotation];
    return std::sqrt(residual.norm_sqr() + (1. / (springs.arm * springs.arm) - 1.) * moment * moment);
  }

  Vector<double> FullStiffness::correction(const PortForces &forces)
  {
    const auto add_spring = [&](const unsigned int port, const double stiffness)
    { matrix.add(coordinate_of[port], coordinate_of[port], stiffness); };
    add_spring(ports.rotation(), springs.rotation);
    if (ports.sprung)
      add_spring(ports.support(), springs.support);
    for (unsigned int i = 0; i < forces.ports.size(); ++i)
      for (unsigned int j = 0; j < forces.ports.size(); ++j)
        if (forces.tangent(i, j) != 0.)
          matrix.add(coordinate_of[forces.ports[i]], coordinate_of[forces.ports[j]], -forces.tangent(i, j));
    matrix.compress(VectorOperation::add);
    factors.factorise(matrix);
    Vector<double> result;
    factors.solve(residual, result);
    return result;
  }

  Vector<double> FullStiffness::moment_response(const PortForces &) const
  {
    Vector<double> moment(n_coordinates());
    moment[coordinate_of[ports.rotation()]] = 1.;
    Vector<double> result;
    factors.solve(moment, result);
    return result;
  }

  Vector<double> FullStiffness::body_displacement(const Vector<double> &coordinates, const PortForces &) const
  {
    return Vector<double>(coordinates.begin(), coordinates.begin() + body.n_dofs());
  }

  std::vector<double> FullStiffness::sensor_forces(const Vector<double> &coordinates, const PortForces &) const
  {
    return sprag::sensor_forces(body, coordinates);
  }
} // namespace sprag
