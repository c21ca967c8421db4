#include "fe/solid/solid_lever.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  /// Half of the moments on it times what it yields.
  double SolidLever::shaft_energy(const State &state) const
  {
    double result = 0.;
    for (unsigned int i = 0; i < state.forces.ports.size(); ++i)
      if (ports.is_slope(state.forces.ports[i]))
        result += 0.5 * state.forces.values[i] * state.coordinates[state.forces.ports[i]];
    return result;
  }

  void SolidLever::observe(const State &trial, Row &row) const
  {
    const double theta         = properties.spring.rest + turn(trial);
    const double u             = support_displacement(trial);
    const double support       = properties.support_stiffness.value_or(0.);
    row[Column::theta]         = theta;
    row[Column::spring_energy] = properties.spring.law.energy(turn(trial));
    view.observe(with_points(), row);
    if (finite)
      row[Column::elastic_energy] = finite->energy(of_body(trial.coordinates));
    row[Column::elastic_energy] += shaft_energy(trial);
    row[Column::centre_offset]        = row[Column::s] - properties.centre(trial.drive.x - u, theta).xi;
    row[Column::indentation]          = indentation(row, trial);
    row[Column::Q]                    = row[Column::P] * std::sin(theta) + row[Column::F] * std::cos(theta);
    row[Column::support_displacement] = u;
    row[Column::Q_support]            = ports.sprung ? support * u : row[Column::Q];
    row[Column::support_energy]       = 0.5 * support * u * u;
    sensors.tell(finite ? sensors.at(of_body(trial.coordinates)) : sensors(trial.forces), row);
  }

  const std::vector<unsigned int> &SolidLever::line_at(const double zeta) const
  {
    const auto &nodes    = body.friction_face().nodes;
    const auto distance  = [&](const auto &line) { return std::abs(nodes[line.front()].position[2] - zeta); };
    const auto is_closer = [&](const auto &a, const auto &b) { return distance(a) < distance(b); };
    return *std::min_element(node_lines.begin(), node_lines.end(), is_closer);
  }

  /// The displacement along eta between the nodes of a line by those of three of them: their ports and shares.
  PortLoads SolidLever::interpolation(const std::vector<unsigned int> &line, const double xi) const
  {
    const auto &nodes    = body.friction_face().nodes;
    const auto xi_of     = [&](const std::size_t i) { return nodes[line[i]].position[0]; };
    const auto is_before = [&](const unsigned int node, const double value) { return nodes[node].position[0] < value; };
    const auto after     = std::lower_bound(line.begin(), line.end(), xi, is_before) - line.begin();
    const auto first     = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, line.size() - 3));
    PortLoads result{ {}, Vector<double>(3) };
    for (std::size_t i = first; i < first + 3; ++i)
    {
      double share = 1.;
      for (std::size_t j = first; j < first + 3; ++j)
        if (j != i)
          share *= (xi - xi_of(j)) / (xi_of(i) - xi_of(j));
      result.ports.push_back(3 * line[i] + 1);
      result.values[static_cast<unsigned int>(i - first)] = share;
    }
    return result;
  }

  /// Where the pressure is largest.
  double SolidLever::indentation(const Row &row, const State &trial) const
  {
    const auto acting = on_face(trial.forces);
    if (properties.layer_thickness == 0. || acting.ports.empty() || node_lines.empty())
      return 0.;
    const auto displacements = [&](const PortSelection &some)
    {
      if (!finite)
        return compliance.displacements(some, acting);
      Vector<double> result(static_cast<unsigned int>(some.size()));
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = trial.coordinates[window.n_coordinates() + finite->dof_of(some[i])];
      return result;
    };
    const auto &line   = line_at(row.across[4]);
    const double s     = row[Column::s];
    const double aside = 0.5 * row[Column::contact_width] + 4. * properties.layer_thickness;
    const auto at      = [&](const double xi)
    {
      const auto shares = interpolation(line, xi);
      return shares.values * displacements(shares.ports);
    };
    return at(s) - 0.5 * (at(s - aside) + at(s + aside));
  }

  FacePoints SolidLever::face_points() const
  {
    return view.points();
  }

  FaceState SolidLever::face_state(const State &trial) const
  {
    return view.state(with_points(), trial.drive);
  }

  Vector<double> SolidLever::body_displacement(const State &state) const
  {
    if (finite)
      return of_body(state.coordinates);
    SparseColumns loads;
    const auto &nodes = body.friction_face().nodes;
    for (unsigned int i = 0; i < state.forces.ports.size(); ++i)
      if (const unsigned int port = state.forces.ports[i]; ports.is_surface(port))
        if (const unsigned int dof = nodes[port / 3].dofs[port % 3]; !body.is_held(dof))
          loads.add(dof, state.forces.values[i]);
    loads.end_column();
    const auto result = body.respond(loads);
    return { result.begin(), result.end() };
  }

  FaceSample SolidLever::sample(const State &state) const
  {
    FaceSample result{ on_face(state.forces), {} };
    auto &[forces_there, displacements] = result;
    displacements.reinit(static_cast<unsigned int>(forces_there.ports.size()));
    for (unsigned int i = 0; i < displacements.size(); ++i)
      displacements[i] = state.coordinates[forces_there.ports[i]];
    return result;
  }

  SolidLever::Exactness SolidLever::exactness(const std::vector<FaceSample> &samples) const
  {
    const auto &nodes = body.friction_face().nodes;
    const auto dof_of = [&](const unsigned int port) { return nodes[port / 3].dofs[port % 3]; };
    SparseColumns loads;
    for (const auto &[acting, displacements] : samples)
    {
      for (unsigned int i = 0; i < acting.ports.size(); ++i)
        if (const unsigned int dof = dof_of(acting.ports[i]); !body.is_held(dof))
          loads.add(dof, acting.values[i]);
      loads.end_column();
    }
    const auto of_whole = body.respond(loads);

    Exactness result{};
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      const auto &[acting, displacements] = samples[k];
      double difference = 0., largest = 0., missed = 0., work = 0.;
      for (unsigned int i = 0; i < acting.ports.size(); ++i)
      {
        const double exact = of_whole[k * body.n_dofs() + dof_of(acting.ports[i])];
        difference         = std::max(difference, std::abs(exact - displacements[i]));
        largest            = std::max(largest, std::abs(exact));
        missed += (exact - displacements[i]) * acting.values[i];
        work += exact * acting.values[i];
      }
      result.displacement = std::max(result.displacement, largest > 0. ? difference / largest : 0.);
      result.work         = std::max(result.work, work > 0. ? std::abs(missed) / work : 0.);
    }
    return result;
  }
} // namespace sprag
