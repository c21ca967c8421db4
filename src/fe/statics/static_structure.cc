#include "fe/statics/static_structure.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sprag
{
  using namespace dealii;

  StaticStructure::StaticStructure(const ElasticBody<2> &body_, const PortLayout &ports_, const PortSprings &springs_)
      : body(body_)
      , ports(ports_)
      , springs(springs_)
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

  unsigned int StaticStructure::n_coordinates() const
  {
    return ports.size();
  }

  unsigned int StaticStructure::coordinate(const unsigned int port) const
  {
    return port;
  }

  const Vector<double> &StaticStructure::port_displacements(const Vector<double> &coordinates) const
  {
    return coordinates;
  }

  PortSelection StaticStructure::enter(const PortSelection &wanted)
  {
    PortSelection entered;
    std::set_difference(wanted.begin(), wanted.end(), selected.begin(), selected.end(), std::back_inserter(entered));
    if (!std::includes(window.begin(), window.end(), wanted.begin(), wanted.end()))
      move_window(wanted);
    selected = wanted;
    places   = places_of(wanted);
    return entered;
  }

  void StaticStructure::move_window(const PortSelection &wanted)
  {
    window_for = wanted;
    window.clear();
    compliance            = {};
    const auto add_spring = [&](const unsigned int port, const double stiffness)
    {
      window.push_back(port);
      compliance.append(1. / stiffness);
    };
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
    {
      for (const auto &section : sections_of(lever))
      {
        const auto begin = std::lower_bound(wanted.begin(), wanted.end(), section.begin);
        const auto end   = std::lower_bound(begin, wanted.end(), section.end);
        PortSelection of_face;
        std::transform(begin, end, std::back_inserter(of_face), [&](const unsigned int port) { return port - section.begin; });
        const auto tiles = faces[section.face].whole_tiles(of_face);
        for (const unsigned int place : tiles)
          window.push_back(section.begin + place);
        if (!tiles.empty())
          compliance.append(faces[section.face].among(tiles));
      }
      add_spring(ports.rotation(lever), springs.rotation);
    }
    if (ports.sprung)
      add_spring(ports.support(), ports.levers * springs.support);
    mismatch.reinit(compliance.size());
  }

  void StaticStructure::visit_history(Archive &archive)
  {
    for (auto &face : faces)
      face.visit_history(archive);
    PortSelection wanted = window_for;
    archive(wanted);
    if (archive.reads() && !wanted.empty())
      move_window(wanted);
  }

  std::array<StaticStructure::Section, 2> StaticStructure::sections_of(const unsigned int lever) const
  {
    const unsigned int begin  = ports.first(lever);
    const unsigned int middle = begin + 2 * static_cast<unsigned int>(body.friction_face().nodes.size());
    return { { { 0, begin, middle }, { 1, middle, begin + ports.surface } } };
  }

  PortSelection StaticStructure::places_of(const std::vector<unsigned int> &of_ports) const
  {
    PortSelection result;
    for (const unsigned int port : of_ports)
      result.push_back(place_of(port, window));
    return result;
  }

  void StaticStructure::set_faces(const PortLoads &forces, Vector<double> &coordinates) const
  {
    Vector<double> displacements(mismatch.size());
    add_response(compliance, places_of(forces.ports), forces.values, places, displacements);
    for (const unsigned int place : places)
      if (ports.is_surface(window[place]))
        coordinates[window[place]] = displacements[place];
  }

  double StaticStructure::unbalance(const Vector<double> &coordinates, const PortForces &forces)
  {
    for (const unsigned int place : places)
      mismatch[place] = -coordinates[window[place]];
    add_response(compliance, places_of(forces.ports), forces.values, places, mismatch);
    double result = 0.;
    for (const unsigned int place : places)
      result += mismatch[place] * mismatch[place];
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
    {
      const double turn = mismatch[place_of(ports.rotation(lever), window)];
      result += (springs.arm * springs.arm - 1.) * turn * turn;
    }
    return std::sqrt(result);
  }

  Vector<double> StaticStructure::correction(const PortForces &forces) const
  {
    const auto in_window =
        port_correction(compliance, { places_of(forces.ports), forces.values, forces.tangent }, places, mismatch);
    Vector<double> result(n_coordinates());
    for (const unsigned int place : places)
      result[window[place]] = in_window[place];
    return result;
  }

  double StaticStructure::largest(const Vector<double> &coordinates) const
  {
    double result = 0.;
    for (const unsigned int port : selected)
      result = std::max(result, std::abs(coordinates[port]));
    return result;
  }

  Vector<double> StaticStructure::forces_on_faces(const unsigned int lever, const PortLoads &forces) const
  {
    Vector<double> result(ports.surface);
    for (unsigned int i = 0; i < forces.ports.size(); ++i)
      if (ports.is_surface(forces.ports[i]) && ports.lever_of(forces.ports[i]) == lever)
        result[forces.ports[i] - ports.first(lever)] = forces.values[i];
    return result;
  }

  Vector<double> StaticStructure::body_displacement(const unsigned int lever, const Vector<double> &,
                                                    const PortLoads &forces) const
  {
    const auto on_faces = forces_on_faces(lever, forces);
    Vector<double> loads(body.n_dofs()), result;
    for (unsigned int i = 0; i < ports.surface; ++i)
      loads[surface[i]] = on_faces[i];
    factors.solve(loads, result);
    return result;
  }

  std::vector<double> StaticStructure::sensor_forces(const unsigned int lever, const Vector<double> &,
                                                     const PortLoads &forces) const
  {
    Vector<double> result(static_cast<unsigned int>(sensor_rows.m()));
    if (result.size() > 0)
      sensor_rows.vmult(result, forces_on_faces(lever, forces));
    return { result.begin(), result.end() };
  }
} // namespace sprag
