// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_structure.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Ports in a row of a tile. Smaller ones make more calls of the solver, larger ones more entries that nobody asks for.
    constexpr unsigned int tile_size = 128;
  } // namespace

  SurfaceCompliance::SurfaceCompliance(const Mumps &stiffness, std::vector<unsigned int> dofs)
      : factors(stiffness)
      , dof_of_port(std::move(dofs))
  {
    for (unsigned int port = 0; port < dof_of_port.size(); ++port)
      port_of_dof[dof_of_port[port]] = port;
  }

  unsigned int SurfaceCompliance::n_ports_of(const unsigned int tile) const
  {
    return std::min(tile_size, static_cast<unsigned int>(dof_of_port.size()) - tile * tile_size);
  }

  PortSelection SurfaceCompliance::ports_of(const unsigned int tile) const
  {
    PortSelection result(n_ports_of(tile));
    std::iota(result.begin(), result.end(), tile * tile_size);
    return result;
  }

  PortSelection SurfaceCompliance::whole_tiles(const PortSelection &ports) const
  {
    std::set<unsigned int> touched;
    for (const unsigned int port : ports)
      touched.insert(port / tile_size);
    PortSelection result;
    for (const unsigned int tile : touched)
    {
      const auto of_tile = ports_of(tile);
      result.insert(result.end(), of_tile.begin(), of_tile.end());
    }
    return result;
  }

  FullMatrix<double> SurfaceCompliance::among(const PortSelection &whole_tiles)
  {
    std::vector<unsigned int> begins; // of the tiles among the ports
    for (unsigned int i = 0; i < whole_tiles.size(); i += n_ports_of(whole_tiles[i] / tile_size))
      begins.push_back(i);
    const auto tile_at = [&](const unsigned int begin) { return whole_tiles[begin] / tile_size; };
    std::vector<Tile> missing;
    for (const unsigned int row : begins)
      for (const unsigned int column : begins)
        if (column <= row && tiles.count({ tile_at(row), tile_at(column) }) == 0)
          missing.emplace_back(tile_at(row), tile_at(column));
    if (!missing.empty())
      find(missing);
    FullMatrix<double> matrix(static_cast<unsigned int>(whole_tiles.size()));
    for (const unsigned int row : begins)
      for (const unsigned int column : begins)
        if (column <= row)
        {
          const auto &tile = tiles.at({ tile_at(row), tile_at(column) });
          for (unsigned int i = 0; i < tile.m(); ++i)
            for (unsigned int j = 0; j < tile.n(); ++j)
              matrix(row + i, column + j) = matrix(column + j, row + i) = tile(i, j);
        }
    return matrix;
  }

  double &SurfaceCompliance::entry(const unsigned int row, const unsigned int column)
  {
    const Tile tile(row / tile_size, column / tile_size);
    return tile.first < tile.second ? entry(column, row) : tiles.at(tile)(row % tile_size, column % tile_size);
  }

  void SurfaceCompliance::visit_history(Archive &archive)
  {
    auto known = searches;
    archive(known);
    if (!archive.reads())
      return;
    tiles.clear();
    searches.clear();
    for (const auto &together : known)
      find(together);
  }

  void SurfaceCompliance::find(const std::vector<Tile> &wanted)
  {
    searches.push_back(wanted);
    // A row costs much, an entry little: the rows are those of ports that are new.
    std::map<unsigned int, PortSelection> columns; // by the tile of the rows, in the order of the degrees of freedom
    for (const auto &[first, second] : wanted)
    {
      const bool first_is_new = tiles.count({ first, first }) == 0;
      const auto of_columns   = ports_of(first_is_new ? second : first);
      auto &of_rows           = columns[first_is_new ? first : second];
      of_rows.insert(of_rows.end(), of_columns.begin(), of_columns.end());
    }
    for (const auto &[first, second] : wanted)
      tiles[{ first, second }].reinit(n_ports_of(first), n_ports_of(second));

    std::map<unsigned int, std::vector<unsigned int>> entries; // degrees of freedom
    for (auto &[tile, ports] : columns)
    {
      std::sort(ports.begin(), ports.end(),
                [&](const unsigned int a, const unsigned int b) { return dof_of_port[a] < dof_of_port[b]; });
      std::vector<unsigned int> dofs;
      for (const unsigned int port : ports)
        dofs.push_back(dof_of_port[port]);
      for (const unsigned int row : ports_of(tile))
        entries[dof_of_port[row]] = dofs;
    }
    const auto values = factors.entries_of_inverse(entries);
    auto value        = values.begin();
    for (const auto &of_row : entries)
    {
      const unsigned int row = port_of_dof.at(of_row.first);
      for (const unsigned int column : columns.at(row / tile_size))
        entry(row, column) = *value++;
    }
  }

  namespace
  {
    /// The compliances may be made after this.
    FaceResponse response_of(const FrictionFace<2> &of_body, std::array<SurfaceCompliance, 2> *const faces, const unsigned int i)
    {
      return { 2 * static_cast<unsigned int>(of_body.nodes.size()),
               [=](const PortSelection &some) { return (*faces)[i].whole_tiles(some); },
               [=](const PortSelection &tiles) { return std::make_shared<const FullMatrix<double>>((*faces)[i].among(tiles)); } };
    }
  } // namespace

  StaticStructure::StaticStructure(const ElasticBody<2> &body_, const PortLayout &ports_, const PortSprings &springs_)
      : PortWindow(ports_, springs_,
                   { response_of(body_.friction_face(), &faces, 0), response_of(body_.cylinder_face(), &faces, 1) })
      , body(body_)
      , surface(surface_dofs(body))
      , factors(body.factorised())
      , faces{ { SurfaceCompliance(*factors, face_dofs(body.friction_face())),
                 SurfaceCompliance(*factors, face_dofs(body.cylinder_face())) } }
      , sensors(body, response_of(factors))
  {
  }

  void StaticStructure::visit_history(Archive &archive)
  {
    for (auto &face : faces)
      face.visit_history(archive);
    PortWindow::visit_history(archive);
  }

  std::vector<Vector<double>> StaticStructure::body_displacements(const Vector<double> &, const PortLoads &forces) const
  {
    std::vector<Vector<double>> result(ports.levers);
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
    {
      const auto acting = on_surface(forces, lever);
      Vector<double> loads(body.n_dofs());
      for (unsigned int i = 0; i < acting.ports.size(); ++i)
        loads[surface[acting.ports[i]]] = acting.values[i];
      factors->solve(loads, result[lever]);
    }
    return result;
  }

  void StaticStructure::tell_sensors(const unsigned int lever, const Vector<double> &, const PortLoads &forces, Row &row) const
  {
    row.sensor_forces = sensors(on_surface(forces, lever));
  }
} // namespace sprag
