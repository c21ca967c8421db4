// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/sensor_forces.h"

#include "base/ranges.h"

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
      for (unsigned int dof = 0; dof < n_surface; ++dof)
        rows(i, dof) = sensor_response[surface[dof]];
      for (unsigned int j = 0; j < number(); ++j)
        rows(i, n_surface + j) = sensors[j].compression(sensor_response);
    }
  }

  std::vector<double> SensorForces::operator()(const DofLoads &forces) const
  {
    std::vector<double> result(number(), 0.);
    for (unsigned int row = 0; row < number(); ++row)
      for (unsigned int i = 0; i < forces.dofs.size(); ++i)
        if (forces.dofs[i] < n_surface)
          result[row] += sensors[row].stiffness * rows(row, forces.dofs[i]) * forces.values[i];
    return result;
  }

  std::vector<double> SensorForces::compressions(const Vector<double> &displacement) const
  {
    return mapped(sensors, [&](const auto &sensor) { return sensor.compression(displacement); });
  }

  void SensorForces::add_compliance(const InterfaceLayout &layout, const unsigned int surface_begin,
                                    dealii::FullMatrix<double> &compliance) const
  {
    for (unsigned int s = 0; s < number(); ++s)
    {
      const unsigned int dof = layout.sensor(s);
      for (unsigned int i = 0; i < layout.surface; ++i)
        compliance(dof, i) = compliance(i, dof) = rows(s, surface_begin + i);
      for (unsigned int other = 0; other < number(); ++other)
        compliance(dof, layout.sensor(other)) = rows(s, n_surface + other);
    }
  }

  void observe_sensors(const std::vector<double> &forces, const bool is_half, Row &row)
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
