#include "fe/solid/sensor_forces.h"

namespace sprag
{
  SensorForces::SensorForces(const SolidBody &body)
      : is_half(body.is_half())
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
    const auto of_row = [&](const unsigned int row)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < forces.ports.size(); ++i)
        if (forces.ports[i] < rows.n())
          sum += rows(row, forces.ports[i]) * forces.values[i];
      return sum;
    };
    std::vector<Sides> result;
    for (unsigned int row = 0; row < rows.m(); row += is_half ? 1 : 2)
    {
      const double first = of_row(row);
      result.push_back(is_half ? Sides{ 0.5 * first, 0.5 * first } : Sides{ first, of_row(row + 1) });
    }
    return result;
  }
} // namespace sprag
