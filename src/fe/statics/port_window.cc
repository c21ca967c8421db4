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
    return find_indices(near);
  }

  void PortWindow::move_window(const PortSelection &selected)
  {
    window_for = selected;
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
        const auto begin = std::lower_bound(selected.begin(), selected.end(), first);
        const auto end   = std::lower_bound(begin, selected.end(), first + face.n_ports);
        PortSelection face_ports;
        std::transform(begin, end, std::back_inserter(face_ports), [&](const unsigned int port) { return port - first; });
        const auto blocks = face.whole_blocks(face_ports);
        for (const unsigned int place : blocks)
          window.push_back(first + place);
        if (!blocks.empty())
          compliance.append(face.among(blocks));
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
    PortSelection selected = window_for;
    archive(selected);
    if (archive.reads() && !selected.empty())
      move_window(selected);
  }

  PortSelection PortWindow::find_indices(const PortSelection &selected) const
  {
    PortSelection result;
    unsigned int place = 0;
    for (const unsigned int port : selected)
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
    add_response(compliance, find_indices(forces.ports), forces.values, places, displacements);
    for (const unsigned int place : places)
      if (ports.is_surface(window[place]))
        coordinates[window[place]] = displacements[place];
  }

  Residual PortWindow::residual(const Vector<double> &coordinates, const PortForces &forces, const PortSelection &near,
                                const Vector<double> *const face_displacements)
  {
    const auto places = look_at(near);
    Vector<double> mismatch(compliance.size());
    for (const unsigned int place : places)
      mismatch[place] = -coordinates[window[place]];
    add_response(compliance, find_indices(forces.ports), forces.values, places, mismatch);
    Residual result{ Vector<double>(n_coordinates()), 0. };
    double squares = 0.;
    for (const unsigned int place : places)
    {
      const unsigned int port = window[place];
      const bool is_set       = face_displacements != nullptr && ports.is_surface(port);
      result.values[port]     = is_set ? (*face_displacements)[port] - coordinates[port] : mismatch[place];
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
    const auto in_window = port_correction(compliance, find_indices(forces.ports), forces.tangent, places, mismatch);
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
