// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/lever_ports.h"

namespace sprag
{
  using namespace dealii;

  LeverPorts::LeverPorts(const ElasticBody<2> &body, const InertialMatrices &matrices, const bool sprung)
      : ports{ static_cast<unsigned int>(surface_dofs(body).size()), sprung, static_cast<unsigned int>(body.sensors().size()) }
      , n_lever(matrices.coordinates.size())
      , arms(ports.surface)
  {
    for (const unsigned int dof : surface_dofs(body))
    {
      arms[static_cast<unsigned int>(coordinates.size())] = matrices.coordinates.arm(dof);
      coordinates.push_back(matrices.coordinates.mover(dof).coordinate);
    }
    for (const auto &sensor : body.sensors())
      sensors.push_back(matrices.coordinates.row(sensor));
    if (sprung)
      momentum = { { matrices.momentum[1], matrices.momentum[0] } };
  }

  unsigned int LeverPorts::n_coordinates() const
  {
    return n_lever + (ports.sprung ? 1 : 0);
  }

  Vector<double> LeverPorts::displacements(const Vector<double> &q) const
  {
    Vector<double> result(ports.size());
    const double rotation = q[n_lever - 1];
    for (unsigned int i = 0; i < ports.surface; ++i)
      result[i] = q[coordinates[i]] - rotation * arms[i];
    for (unsigned int s = 0; s < ports.sensors; ++s)
      for (const auto &[i, weight] : sensors[s])
        result[ports.sensor(s)] += weight * q[i];
    result[ports.rotation()] = rotation;
    if (ports.sprung)
    {
      const unsigned int momentum_ports[] = { ports.momentum_eta(), ports.momentum_xi() };
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int i = 0; i < n_lever; ++i)
          result[momentum_ports[d]] += momentum[d][i] * q[i];
      result[ports.support()] = q[n_lever];
    }
    return result;
  }

  void LeverPorts::add_force(const unsigned int port, const double force, Vector<double> &forces) const
  {
    if (port < ports.surface)
    {
      forces[coordinates[port]] += force;
      forces[n_lever - 1] -= arms[port] * force;
    }
    else if (port < ports.rotation())
      for (const auto &[i, weight] : sensors[port - ports.surface])
        forces[i] += weight * force;
    else if (port == ports.rotation())
      forces[n_lever - 1] += force;
    else if (port == ports.support())
      forces[n_lever] += force;
    else
      for (unsigned int i = 0; i < n_lever; ++i)
        forces[i] += momentum[port - ports.momentum_eta()][i] * force;
  }

  std::vector<unsigned int> LeverPorts::face_coordinates() const
  {
    std::vector<unsigned int> result = coordinates;
    result.push_back(n_lever - 1);
    return result;
  }

  unsigned int LeverPorts::face_port(const unsigned int i) const
  {
    return i < ports.surface ? i : ports.rotation();
  }

  void LeverPorts::transform(FullMatrix<double> &compliance) const
  {
    const unsigned int rotation = ports.surface;
    for (unsigned int j = 0; j <= rotation; ++j)
      for (unsigned int i = 0; i < rotation; ++i)
        compliance(i, j) -= arms[i] * compliance(rotation, j);
    for (unsigned int i = 0; i <= rotation; ++i)
      for (unsigned int j = 0; j < rotation; ++j)
        compliance(i, j) -= arms[j] * compliance(i, rotation);
  }
} // namespace sprag
