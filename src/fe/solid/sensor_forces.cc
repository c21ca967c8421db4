// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/sensor_forces.h"

namespace sprag
{
  using dealii::Vector;

  SensorForces::SensorForces(const SolidBody &body_)
      : body(body_)
      , sensors(body.sensors())
  {
    if (sensors.empty())
      return;
    SparseColumns loads;
    for (const auto &sensor : sensors)
    {
      for (const auto &[dof, weight] : sensor.row)
        loads.add(dof, weight);
      loads.end_column();
    }
    const auto &nodes    = body.friction_face().nodes;
    const auto surface   = static_cast<unsigned int>(3 * nodes.size());
    const auto responses = body.respond(loads);
    rows.reinit(number(), surface + number());
    for (unsigned int i = 0; i < number(); ++i)
    {
      const double *const response = &responses[static_cast<std::size_t>(i) * body.n_dofs()];
      for (unsigned int port = 0; port < surface; ++port)
        rows(i, port) = response[nodes[port / 3].dofs[port % 3]];
      for (unsigned int j = 0; j < number(); ++j)
        rows(i, surface + j) = sensors[j].compression(response);
    }
  }

  std::vector<double> SensorForces::operator()(const PortLoads &forces) const
  {
    const std::size_t surface = 3 * body.friction_face().nodes.size();
    std::vector<double> result(number(), 0.);
    for (unsigned int row = 0; row < number(); ++row)
      for (unsigned int i = 0; i < forces.ports.size(); ++i)
        if (forces.ports[i] < surface)
          result[row] += stiffness() * rows(row, forces.ports[i]) * forces.values[i];
    return result;
  }

  std::vector<double> SensorForces::compressions(const Vector<double> &displacement) const
  {
    std::vector<double> result;
    for (const auto &sensor : sensors)
      result.push_back(sensor.compression(displacement));
    return result;
  }

  /// Adds the forces of the sensors to a row. On a half of a body each sensor stands for both sides.
  void SensorForces::tell(const std::vector<double> forces, Row &row) const
  {
    row.sensor_forces.clear();
    for (std::size_t i = 0; i < forces.size(); i += body.is_half() ? 1 : 2)
    {
      const double left  = body.is_half() ? 0.5 * forces[i] : forces[i];
      const double right = body.is_half() ? left : forces[i + 1];
      row.sensor_forces.push_back(left + right);
      row.across.insert(row.across.end(), { left, right });
    }
  }
} // namespace sprag
