// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_structure.h"

namespace sprag
{
  using namespace dealii;

  namespace
  {
    FaceResponse response_of(const FrictionFace<2> &of_body, SurfaceCompliance &face)
    {
      return { 2 * static_cast<unsigned int>(of_body.nodes.size()),
               [&face](const PortSelection &some) { return face.whole_tiles(some); },
               [&face](const PortSelection &tiles) { return std::make_shared<const FullMatrix<double>>(face.among(tiles)); } };
    }
  } // namespace

  StaticStructure::StaticStructure(const ElasticBody<2> &body_, const PortLayout &ports_, const PortSprings &springs_)
      : PortWindow(ports_, springs_,
                   { response_of(body_.friction_face(), faces[0]), response_of(body_.cylinder_face(), faces[1]) })
      , body(body_)
      , ports(ports_)
      , surface(surface_dofs(body))
      , factors(MatrixKind::positive_definite)
      , faces{ { SurfaceCompliance(factors, face_dofs(body.friction_face())),
                 SurfaceCompliance(factors, face_dofs(body.cylinder_face())) } }
  {
    PETScWrappers::SparseMatrix stiffness;
    Vector<double> forces(body.n_dofs());
    body.reinit(stiffness);
    body.assemble(Vector<double>(body.n_dofs()), stiffness, forces);
    factors.factorise(stiffness);
    find_sensor_rows();
  }

  void StaticStructure::visit_history(Archive &archive)
  {
    for (auto &face : faces)
      face.visit_history(archive);
    PortWindow::visit_history(archive);
  }

  void StaticStructure::find_sensor_rows()
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

  Vector<double> StaticStructure::forces_on_faces(const unsigned int lever, const PortLoads &forces) const
  {
    Vector<double> result(ports.surface);
    for (unsigned int i = 0; i < forces.ports.size(); ++i)
      if (ports.is_surface(forces.ports[i]) && ports.lever_of(forces.ports[i]) == lever)
        result[forces.ports[i] - ports.first(lever)] = forces.values[i];
    return result;
  }

  std::vector<Vector<double>> StaticStructure::body_displacements(const Vector<double> &, const PortLoads &forces) const
  {
    std::vector<Vector<double>> result(ports.levers);
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
    {
      const auto on_faces = forces_on_faces(lever, forces);
      Vector<double> loads(body.n_dofs());
      for (unsigned int i = 0; i < ports.surface; ++i)
        loads[surface[i]] = on_faces[i];
      factors.solve(loads, result[lever]);
    }
    return result;
  }

  void StaticStructure::tell_sensors(const unsigned int lever, const Vector<double> &, const PortLoads &forces, Row &row) const
  {
    if (body.connectors().empty())
      return;
    Vector<double> of_sensors(static_cast<unsigned int>(sensor_rows.m()));
    if (of_sensors.size() > 0)
      sensor_rows.vmult(of_sensors, forces_on_faces(lever, forces));
    row.sensor_forces.assign(of_sensors.begin(), of_sensors.end());
  }
} // namespace sprag
