#include "fe/solid/sensor_forces.h"

namespace sprag
{
  SensorForces::SensorForces(const SolidBody &body_)
      : body(body_)
  {
    SparseColumns loads;
    for (const auto &connector : body.connectors())
      if (connector.type == ConnectorType::sensor)
      {
        for (const auto &[dof, weight] : connector.row)
          loads.add(dof, connector.stiffness * weight);
        loads.end_column();
      }
    const auto n = static_cast<unsigned int>(loads.size());
    if (n == 0)
      return;
    const auto &nodes    = body.friction_face().nodes;
    const auto responses = body.respond(loads);
    rows.reinit(n, 3 * nodes.size());
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int port = 0; port < rows.n(); ++port)
        rows(i, port) = responses[static_cast<std::size_t>(i) * body.n_dofs() + nodes[port / 3].dofs[port % 3]];
  }

  std::vector<SensorForces::Sides> SensorForces::operator()(const PortLoads &forces) const
  {
    std::vector<double> of_sensors(rows.m(), 0.);
    for (unsigned int row = 0; row < rows.m(); ++row)
      for (unsigned int i = 0; i < forces.ports.size(); ++i)
        if (forces.ports[i] < rows.n())
          of_sensors[row] += rows(row, forces.ports[i]) * forces.values[i];
    return sides_of(of_sensors);
  }

  std::vector<SensorForces::Sides> SensorForces::at(const dealii::Vector<double> &displacement) const
  {
    std::vector<double> of_sensors;
    for (const auto &connector : body.connectors())
      if (connector.type == ConnectorType::sensor)
        of_sensors.push_back(connector.stiffness * connector.compression(displacement));
    return sides_of(of_sensors);
  }

  /// Of a half each sensor stands for both sides.
  std::vector<SensorForces::Sides> SensorForces::sides_of(const std::vector<double> &forces) const
  {
    std::vector<Sides> result;
    for (std::size_t i = 0; i < forces.size(); i += body.is_half() ? 1 : 2)
      result.push_back(body.is_half() ? Sides{ 0.5 * forces[i], 0.5 * forces[i] } : Sides{ forces[i], forces[i + 1] });
    return result;
  }
} // namespace sprag
