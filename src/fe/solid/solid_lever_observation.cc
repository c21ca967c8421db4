#include "fe/solid/solid_lever.h"

#include "fe/statics/observe_levers.h"

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
    observe_levers(
        ports.levers, [&](const unsigned int lever, Row &of_lever) { observe(lever, trial, of_lever); }, row);
    if (joint_is_free)
      row[Column::spring_energy] = 2. * levers[0].properties.spring.law.energy(0.5 * (turns(trial)[0] + turns(trial)[1]));
  }

  void SolidLever::observe(const unsigned int lever, const State &trial, Row &row) const
  {
    const auto &properties     = levers[lever].properties;
    const double turn          = turns(trial)[lever];
    const double theta         = properties.spring.rest + turn;
    const double u             = support_displacement(trial);
    const double support       = properties.support_stiffness.value_or(0.);
    row[Column::theta]         = theta;
    row[Column::spring_energy] = properties.spring.law.energy(turn);
    levers[lever].view.observe(levers[lever].with_points(), row);
    const auto displacement = finite ? of_body(trial.coordinates, lever) : Vector<double>();
    if (finite)
      row[Column::elastic_energy] = finite->energy(displacement);
    row[Column::elastic_energy] += shaft_energy(trial);
    row[Column::centre_offset]        = row[Column::s] - properties.centre(trial.drive.x - u, theta).xi;
    row[Column::indentation]          = indentation(lever, row, trial);
    row[Column::Q]                    = row[Column::P] * std::sin(theta) + row[Column::F] * std::cos(theta);
    row[Column::support_displacement] = u;
    row[Column::Q_support]            = ports.sprung ? support * u : row[Column::Q];
    row[Column::support_energy]       = 0.5 * support * u * u;
    sensors.tell(finite ? sensors.at(displacement) : sensors(on_face(trial.forces, lever)), row);
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
  double SolidLever::indentation(const unsigned int lever, const Row &row, const State &trial) const
  {
    const double thickness = levers[lever].properties.layer_thickness;
    const auto acting      = on_face(trial.forces, lever);
    if (thickness == 0. || acting.ports.empty() || node_lines.empty())
      return 0.;
    const auto displacements = [&](const PortSelection &some)
    {
      if (!finite)
        return compliance.displacements(some, acting);
      Vector<double> result(static_cast<unsigned int>(some.size()));
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = trial.coordinates[of_body_at(lever, some[i])];
      return result;
    };
    const auto &line   = line_at(row.across[4]);
    const double s     = row[Column::s];
    const double aside = 0.5 * row[Column::contact_width] + 4. * thickness;
    const auto at      = [&](const double xi)
    {
      const auto shares = interpolation(line, xi);
      return shares.values * displacements(shares.ports);
    };
    return at(s) - 0.5 * (at(s - aside) + at(s + aside));
  }

  FacePoints SolidLever::face_points() const
  {
    return levers.front().view.points();
  }

  FaceState SolidLever::face_state(const State &trial) const
  {
    const auto of_lever = [&](const Lever &lever) { return lever.view.state(lever.with_points(), trial.drive); };
    return ports.levers == 1 ? of_lever(levers[0]) : joined_faces(of_lever(levers[0]), of_lever(levers[1]));
  }

  std::vector<Vector<double>> SolidLever::body_displacements(const State &state) const
  {
    std::vector<Vector<double>> result;
    if (finite)
    {
      for (unsigned int i = 0; i < ports.levers; ++i)
        result.push_back(of_body(state.coordinates, i));
      return result;
    }
    std::vector<PortLoads> loads;
    for (unsigned int i = 0; i < ports.levers; ++i)
      loads.push_back(on_face(state.forces, i));
    const auto of_levers = responses(loads);
    for (auto column = of_levers.begin(); column != of_levers.end(); column += body.n_dofs())
      result.emplace_back(column, column + body.n_dofs());
    return result;
  }

  /// Displacements of all degrees of freedom of the whole body by forces on the face, one after another.
  std::vector<double> SolidLever::responses(const std::vector<PortLoads> &on_faces) const
  {
    SparseColumns loads;
    for (const auto &acting : on_faces)
    {
      for (unsigned int i = 0; i < acting.ports.size(); ++i)
        if (const unsigned int dof = dof_of_port(body, acting.ports[i]); !body.is_held(dof))
          loads.add(dof, acting.values[i]);
      loads.end_column();
    }
    return body.respond(loads);
  }

  std::vector<FaceSample> SolidLever::samples(const State &state) const
  {
    std::vector<FaceSample> result;
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
    {
      result.push_back({ on_face(state.forces, lever), {} });
      auto &[acting, displacements] = result.back();
      displacements.reinit(static_cast<unsigned int>(acting.ports.size()));
      for (unsigned int i = 0; i < displacements.size(); ++i)
        displacements[i] = state.coordinates[ports.first(lever) + acting.ports[i]];
    }
    return result;
  }

  SolidLever::Exactness SolidLever::exactness(const std::vector<FaceSample> &samples) const
  {
    std::vector<PortLoads> loads;
    for (const auto &sample : samples)
      loads.push_back(sample.first);
    const auto of_whole = responses(loads);

    Exactness result{};
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      const auto &[acting, displacements] = samples[k];
      double difference = 0., largest = 0., missed = 0., work = 0.;
      for (unsigned int i = 0; i < acting.ports.size(); ++i)
      {
        const double exact = of_whole[k * body.n_dofs() + dof_of_port(body, acting.ports[i])];
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
