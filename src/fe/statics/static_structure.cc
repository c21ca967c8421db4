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
    constexpr unsigned int block_size = 128;
  } // namespace

  SurfaceCompliance::SurfaceCompliance(const Mumps &stiffness, std::vector<unsigned int> dofs)
      : factors(stiffness)
      , dofs_by_port(std::move(dofs))
  {
    for (unsigned int port = 0; port < dofs_by_port.size(); ++port)
      ports_by_dof[dofs_by_port[port]] = port;
  }

  unsigned int SurfaceCompliance::n_block_ports(const unsigned int block) const
  {
    return std::min(block_size, static_cast<unsigned int>(dofs_by_port.size()) - block * block_size);
  }

  PortSelection SurfaceCompliance::block_ports(const unsigned int block) const
  {
    PortSelection result(n_block_ports(block));
    std::iota(result.begin(), result.end(), block * block_size);
    return result;
  }

  PortSelection SurfaceCompliance::whole_blocks(const PortSelection &ports) const
  {
    std::set<unsigned int> touched;
    for (const unsigned int port : ports)
      touched.insert(port / block_size);
    PortSelection result;
    for (const unsigned int block : touched)
    {
      const auto own_ports = block_ports(block);
      result.insert(result.end(), own_ports.begin(), own_ports.end());
    }
    return result;
  }

  FullMatrix<double> SurfaceCompliance::among(const PortSelection &whole_blocks)
  {
    std::vector<unsigned int> begins; // of the tiles among the ports
    for (unsigned int i = 0; i < whole_blocks.size(); i += n_block_ports(whole_blocks[i] / block_size))
      begins.push_back(i);
    const auto block_at = [&](const unsigned int begin) { return whole_blocks[begin] / block_size; };
    std::vector<Block> missing;
    for (const unsigned int row : begins)
      for (const unsigned int column : begins)
        if (column <= row && blocks.count({ block_at(row), block_at(column) }) == 0)
          missing.emplace_back(block_at(row), block_at(column));
    if (!missing.empty())
      find(missing);
    FullMatrix<double> matrix(static_cast<unsigned int>(whole_blocks.size()));
    for (const unsigned int row : begins)
      for (const unsigned int column : begins)
        if (column <= row)
        {
          const auto &block = blocks.at({ block_at(row), block_at(column) });
          for (unsigned int i = 0; i < block.m(); ++i)
            for (unsigned int j = 0; j < block.n(); ++j)
              matrix(row + i, column + j) = matrix(column + j, row + i) = block(i, j);
        }
    return matrix;
  }

  double &SurfaceCompliance::entry(const unsigned int row, const unsigned int column)
  {
    const Block block(row / block_size, column / block_size);
    return block.first < block.second ? entry(column, row) : blocks.at(block)(row % block_size, column % block_size);
  }

  void SurfaceCompliance::visit_history(Archive &archive)
  {
    auto known = searches;
    archive(known);
    if (!archive.reads())
      return;
    blocks.clear();
    searches.clear();
    for (const auto &together : known)
      find(together);
  }

  void SurfaceCompliance::find(const std::vector<Block> &needed)
  {
    searches.push_back(needed);
    // A row costs much, an entry little: the rows are those of ports that are new.
    std::map<unsigned int, PortSelection> columns; // by the tile of the rows, in the order of the degrees of freedom
    for (const auto &[first, second] : needed)
    {
      const bool first_is_new = blocks.count({ first, first }) == 0;
      const auto column_ports = block_ports(first_is_new ? second : first);
      auto &row_ports         = columns[first_is_new ? first : second];
      row_ports.insert(row_ports.end(), column_ports.begin(), column_ports.end());
    }
    for (const auto &[first, second] : needed)
      blocks[{ first, second }].reinit(n_block_ports(first), n_block_ports(second));

    std::map<unsigned int, std::vector<unsigned int>> entries; // degrees of freedom
    for (auto &[block, ports] : columns)
    {
      std::sort(ports.begin(), ports.end(),
                [&](const unsigned int a, const unsigned int b) { return dofs_by_port[a] < dofs_by_port[b]; });
      std::vector<unsigned int> dofs;
      for (const unsigned int port : ports)
        dofs.push_back(dofs_by_port[port]);
      for (const unsigned int row : block_ports(block))
        entries[dofs_by_port[row]] = dofs;
    }
    const auto values = factors.compute_inverse_entries(entries);
    auto value        = values.begin();
    for (const auto &row_entries : entries)
    {
      const unsigned int row = ports_by_dof.at(row_entries.first);
      for (const unsigned int column : columns.at(row / block_size))
        entry(row, column) = *value++;
    }
  }

  namespace
  {
    /// The compliances may be made after this.
    FaceResponse face_response(const FrictionFace<2> &mesh_face, std::array<SurfaceCompliance, 2> *const faces,
                               const unsigned int i)
    {
      return { 2 * static_cast<unsigned int>(mesh_face.nodes.size()),
               [=](const PortSelection &some) { return (*faces)[i].whole_blocks(some); },
               [=](const PortSelection &blocks)
               { return std::make_shared<const FullMatrix<double>>((*faces)[i].among(blocks)); } };
    }
  } // namespace

  StaticStructure::StaticStructure(const ElasticBody<2> &body_, const PortLayout &ports_, const PortSprings &springs_)
      : PortWindow(ports_, springs_,
                   { face_response(body_.friction_face(), &faces, 0), face_response(body_.cylinder_face(), &faces, 1) })
      , body(body_)
      , surface(surface_dofs(body))
      , factors(body.factorised())
      , faces{ { SurfaceCompliance(*factors, face_dofs(body.friction_face())),
                 SurfaceCompliance(*factors, face_dofs(body.cylinder_face())) } }
      , sensors(body, make_response(factors))
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
