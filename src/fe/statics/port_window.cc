// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/port_window.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sprag
{
  using namespace dealii;

  PortWindow::PortWindow(const PortLayout &ports_, const PortSprings &springs_, std::vector<FaceResponse> faces_)
      : ports(ports_)
      , springs(springs_)
      , faces(std::move(faces_))
  {
  }

  unsigned int PortWindow::n_coordinates() const
  {
    return ports.size();
  }

  unsigned int PortWindow::coordinate(const unsigned int port) const
  {
    return port;
  }

  const Vector<double> &PortWindow::port_displacements(const Vector<double> &coordinates) const
  {
    return coordinates;
  }

  /// Moves the window where it lacks some ports. Returns their places.
  PortSelection PortWindow::look_at(const PortSelection &near)
  {
    if (!std::includes(window.begin(), window.end(), near.begin(), near.end()))
      move_window(near);
    return places_of(near);
  }

  void PortWindow::move_window(const PortSelection &wanted)
  {
    window_for = wanted;
    window.clear();
    compliance            = {};
    const auto add_spring = [&](const unsigned int port, const double own)
    {
      window.push_back(port);
      compliance.append(own);
    };
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
    {
      unsigned int first = ports.first(lever);
      for (const auto &face : faces)
      {
        const auto begin = std::lower_bound(wanted.begin(), wanted.end(), first);
        const auto end   = std::lower_bound(begin, wanted.end(), first + face.n_ports);
        PortSelection of_face;
        std::transform(begin, end, std::back_inserter(of_face), [&](const unsigned int port) { return port - first; });
        const auto tiles = face.whole_tiles(of_face);
        for (const unsigned int place : tiles)
          window.push_back(first + place);
        if (!tiles.empty())
          compliance.append(face.among(tiles));
        first += face.n_ports;
      }
      for (unsigned int slope = 0; slope < ports.slopes; ++slope)
        add_spring(ports.slope(slope), springs.slopes[slope]);
      add_spring(ports.rotation(lever), 1. / springs.rotation);
    }
    if (ports.sprung)
      add_spring(ports.support(), 1. / (ports.levers * springs.support));
  }

  void PortWindow::visit_history(Archive &archive)
  {
    PortSelection wanted = window_for;
    archive(wanted);
    if (archive.reads() && !wanted.empty())
      move_window(wanted);
  }

  PortSelection PortWindow::places_of(const PortSelection &of_ports) const
  {
    PortSelection result;
    unsigned int place = 0;
    for (const unsigned int port : of_ports)
    {
      while (window.at(place) != port) // throws where the window lacks it
        ++place;
      result.push_back(place);
    }
    return result;
  }

  void PortWindow::set_faces(const PortLoads &forces, const PortSelection &near, Vector<double> &coordinates)
  {
    const auto places = look_at(near);
    Vector<double> displacements(compliance.size());
    add_response(compliance, places_of(forces.ports), forces.values, places, displacements);
    for (const unsigned int place : places)
      if (ports.is_surface(window[place]))
        coordinates[window[place]] = displacements[place];
  }

  Residual PortWindow::residual(const Vector<double> &coordinates, const PortForces &forces, const PortSelection &near,
                                const Vector<double> *const of_faces)
  {
    const auto places = look_at(near);
    Vector<double> mismatch(compliance.size());
    for (const unsigned int place : places)
      mismatch[place] = -coordinates[window[place]];
    add_response(compliance, places_of(forces.ports), forces.values, places, mismatch);
    Residual result{ Vector<double>(n_coordinates()), 0. };
    double squares = 0.;
    for (const unsigned int place : places)
    {
      const unsigned int port = window[place];
      const bool is_given     = of_faces != nullptr && ports.is_surface(port);
      result.values[port]     = is_given ? (*of_faces)[port] - coordinates[port] : mismatch[place];
      squares += result.values[port] * result.values[port];
    }
    const auto as_movement = [&](const unsigned int port, const double arm)
    {
      const double turn = result.values[port];
      squares += (arm * arm - 1.) * turn * turn;
    };
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
      as_movement(ports.rotation(lever), springs.arm);
    for (unsigned int slope = 0; slope < ports.slopes; ++slope)
      as_movement(ports.slope(slope), springs.slope_arm);
    result.norm = std::sqrt(squares);
    return result;
  }

  Vector<double> PortWindow::correction(const Residual &residual, const PortForces &forces, const PortSelection &near)
  {
    const auto places = look_at(near);
    Vector<double> mismatch(compliance.size());
    for (const unsigned int place : places)
      mismatch[place] = residual.values[window[place]];
    const auto in_window = port_correction(compliance, places_of(forces.ports), forces.tangent, places, mismatch);
    Vector<double> result(n_coordinates());
    for (const unsigned int place : places)
      result[window[place]] = in_window[place];
    return result;
  }

  PortLoads PortWindow::on_surface(const PortLoads &forces, const unsigned int lever) const
  {
    const auto &all  = forces.ports;
    const auto begin = std::lower_bound(all.begin(), all.end(), ports.first(lever));
    const auto end   = std::lower_bound(begin, all.end(), ports.first(lever) + ports.surface);
    PortLoads result{
      { begin, end }, Vector<double>(forces.values.begin() + (begin - all.begin()), forces.values.begin() + (end - all.begin()))
    };
    for (auto &port : result.ports)
      port -= ports.first(lever);
    return result;
  }
} // namespace sprag
