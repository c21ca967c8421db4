#include "fe/statics/face_compliance.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <cmath>

namespace sprag
{
  using namespace dealii;

  FaceCompliance::FaceCompliance(const ElasticBody<2> &body_, const PortLayout &ports_, const PortSprings &springs)
      : body(body_)
      , ports(ports_)
      , surface(surface_dofs(body))
      , arm(springs.arm)
      , all(all_ports(ports.size()))
      , compliance(ports.size(), ports.size())
      , mismatch(ports.size())
  {
    PETScWrappers::SparseMatrix stiffness;
    Vector<double> forces(body.n_dofs());
    body.reinit(stiffness, 0);
    body.assemble(Vector<double>(body.n_dofs()), stiffness, forces);
    const auto condensed = factors.factorise_with_schur_complement(stiffness, surface);
    LAPACKFullMatrix<double> schur(ports.surface);
    schur = condensed;
    schur.set_property(LAPACKSupport::symmetric);
    schur.invert();
    for (unsigned int i = 0; i < ports.surface; ++i)
      for (unsigned int j = 0; j < ports.surface; ++j)
        compliance(i, j) = schur(i, j);
    compliance(ports.rotation(), ports.rotation()) = 1. / springs.rotation;
    if (ports.sprung)
      compliance(ports.support(), ports.support()) = 1. / springs.support;
    find_sensor_rows();
  }

  void FaceCompliance::find_sensor_rows()
  {
    const auto sensors = body.sensors();
    sensor_rows.reinit(static_cast<unsigned int>(sensors.size()), sensors.empty() ? 0 : ports.surface);
    for (unsigned int s = 0; s < sensors.size(); ++s)
    {
      Vector<double> row(body.n_dofs()), response;
      for (const auto &[dof, weight] : sensors[s].row)
        row[dof] = sensors[s].stiffness * weight;
      factors.solve(row, response);
      for (unsigned int i = 0; i < ports.surface; ++i)
        sensor_rows(s, i) = response[surface[i]];
    }
  }

  unsigned int FaceCompliance::n_coordinates() const
  {
    return ports.size();
  }

  const Vector<double> &FaceCompliance::port_displacements(const Vector<double> &coordinates) const
  {
    return coordinates;
  }

  double FaceCompliance::unbalance(const Vector<double> &coordinates, const PortForces &forces)
  {
    mismatch = coordinates;
    mismatch *= -1.;
    add_response(compliance, forces.ports, forces.values, all, mismatch);
    const double turn = mismatch[ports.rotation()];
    return std::sqrt(mismatch.norm_sqr() + (arm * arm - 1.) * turn * turn);
  }

  Vector<double> FaceCompliance::correction(const PortForces &forces) const
  {
    return port_correction(compliance, forces, all, mismatch);
  }

  Vector<double> FaceCompliance::moment_response(const PortForces &forces) const
  {
    Vector<double> alone(ports.size());
    for (unsigned int port = 0; port < ports.size(); ++port)
      alone[port] = compliance(port, ports.rotation());
    return port_correction(compliance, forces, all, alone);
  }

  Vector<double> FaceCompliance::body_displacement(const Vector<double> &, const PortForces &forces) const
  {
    Vector<double> loads(body.n_dofs());
    for (unsigned int i = 0; i < forces.ports.size() && forces.ports[i] < ports.surface; ++i)
      loads[surface[forces.ports[i]]] = forces.values[i];
    Vector<double> result;
    factors.solve(loads, result);
    return result;
  }

  std::vector<double> FaceCompliance::sensor_forces(const Vector<double> &, const PortForces &forces) const
  {
    std::vector<double> result(sensor_rows.m());
    for (unsigned int s = 0; s < result.size(); ++s)
      for (unsigned int i = 0; i < forces.ports.size() && forces.ports[i] < ports.surface; ++i)
        result[s] += sensor_rows(s, forces.ports[i]) * forces.values[i];
    return result;
  }
} // namespace sprag
