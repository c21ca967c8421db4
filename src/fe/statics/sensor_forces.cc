// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/sensor_forces.h"

namespace sprag
{
  using dealii::Vector;

  SensorForces::SensorForces(std::vector<Connector> all, const std::vector<unsigned int> &surface, const unsigned int n_dofs,
                             const Response &response)
      : sensors(std::move(all))
      , n_surface(static_cast<unsigned int>(surface.size()))
  {
    if (sensors.empty())
      return;
    std::vector<double> columns(static_cast<std::size_t>(number()) * n_dofs, 0.);
    for (std::size_t i = 0; i < sensors.size(); ++i)
      for (const auto &[dof, weight] : sensors[i].row)
        columns[i * n_dofs + dof] = weight;
    const auto responses = response(std::move(columns));
    rows.reinit(number(), n_surface + number());
    for (unsigned int i = 0; i < number(); ++i)
    {
      const double *const sensor_response = &responses[static_cast<std::size_t>(i) * n_dofs];
      for (unsigned int port = 0; port < n_surface; ++port)
        rows(i, port) = sensor_response[surface[port]];
      for (unsigned int j = 0; j < number(); ++j)
        rows(i, n_surface + j) = sensors[j].compression(sensor_response);
    }
  }

  std::vector<double> SensorForces::operator()(const PortLoads &forces) const
  {
    std::vector<double> result(number(), 0.);
    for (unsigned int row = 0; row < number(); ++row)
      for (unsigned int i = 0; i < forces.ports.size(); ++i)
        if (forces.ports[i] < n_surface)
          result[row] += sensors[row].stiffness * rows(row, forces.ports[i]) * forces.values[i];
    return result;
  }

  std::vector<double> SensorForces::compressions(const Vector<double> &displacement) const
  {
    std::vector<double> result;
    for (const auto &sensor : sensors)
      result.push_back(sensor.compression(displacement));
    return result;
  }

  void SensorForces::add_compliance(const PortLayout &ports, const unsigned int surface_begin,
                                    dealii::FullMatrix<double> &compliance) const
  {
    for (unsigned int s = 0; s < number(); ++s)
    {
      const unsigned int port = ports.sensor(s);
      for (unsigned int i = 0; i < ports.surface; ++i)
        compliance(port, i) = compliance(i, port) = rows(s, surface_begin + i);
      for (unsigned int other = 0; other < number(); ++other)
        compliance(port, ports.sensor(other)) = rows(s, n_surface + other);
    }
  }

  void tell_sides(const std::vector<double> &forces, const bool is_half, Row &row)
  {
    row.sensor_forces.clear();
    for (std::size_t i = 0; i < forces.size(); i += is_half ? 1 : 2)
    {
      const double left  = is_half ? 0.5 * forces[i] : forces[i];
      const double right = is_half ? left : forces[i + 1];
      row.sensor_forces.push_back(left + right);
      row.across.insert(row.across.end(), { left, right });
    }
  }
} // namespace sprag
