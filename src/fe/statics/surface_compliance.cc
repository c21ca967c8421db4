#include "fe/statics/surface_compliance.h"

#include <algorithm>
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

  unsigned int SurfaceCompliance::ports_of(const unsigned int tile) const
  {
    return std::min(tile_size, static_cast<unsigned int>(dof_of_port.size()) - tile * tile_size);
  }

  PortSelection SurfaceCompliance::whole_tiles(const PortSelection &ports) const
  {
    std::set<unsigned int> touched;
    for (const unsigned int port : ports)
      touched.insert(port / tile_size);
    PortSelection result;
    for (const unsigned int tile : touched)
      for (unsigned int i = 0; i < ports_of(tile); ++i)
        result.push_back(tile * tile_size + i);
    return result;
  }

  void SurfaceCompliance::copy(const PortSelection &whole_tiles, const unsigned int first, FullMatrix<double> &matrix)
  {
    std::vector<unsigned int> begins; // of the tiles among the ports
    for (unsigned int i = 0; i < whole_tiles.size(); i += ports_of(whole_tiles[i] / tile_size))
      begins.push_back(i);
    const auto tile_at = [&](const unsigned int begin) { return whole_tiles[begin] / tile_size; };
    std::vector<Tile> missing;
    for (const unsigned int row : begins)
      for (const unsigned int column : begins)
        if (column <= row && tiles.count({ tile_at(row), tile_at(column) }) == 0)
          missing.emplace_back(tile_at(row), tile_at(column));
    if (!missing.empty())
      find(missing);
    for (const unsigned int row : begins)
      for (const unsigned int column : begins)
        if (column <= row)
        {
          const auto &tile = tiles.at({ tile_at(row), tile_at(column) });
          for (unsigned int i = 0; i < tile.m(); ++i)
            for (unsigned int j = 0; j < tile.n(); ++j)
              matrix(first + row + i, first + column + j) = matrix(first + column + j, first + row + i) = tile(i, j);
        }
  }

  void SurfaceCompliance::find(const std::vector<Tile> &wanted)
  {
    std::map<unsigned int, std::vector<unsigned int>> entries; // columns of the rows, degrees of freedom
    for (const auto &[first, second] : wanted)
    {
      // A row costs much, an entry little: the rows are those of ports that are new.
      const bool first_is_new  = tiles.count({ first, first }) == 0;
      const auto [row, column] = first_is_new ? Tile{ first, second } : Tile{ second, first };
      for (unsigned int i = 0; i < ports_of(row); ++i)
        for (unsigned int j = 0; j < ports_of(column); ++j)
          entries[dof_of_port[row * tile_size + i]].push_back(dof_of_port[column * tile_size + j]);
    }
    for (const auto &tile : wanted)
      tiles[tile].reinit(ports_of(tile.first), ports_of(tile.second));
    for (auto &[row, columns] : entries)
      std::sort(columns.begin(), columns.end());
    const auto values = factors.entries_of_inverse(entries);
    auto value        = values.begin();
    for (const auto &[row_dof, columns] : entries)
    {
      const unsigned int row = port_of_dof.at(row_dof);
      for (const unsigned int column_dof : columns)
      {
        const unsigned int column  = port_of_dof.at(column_dof);
        const bool is_kept         = row / tile_size >= column / tile_size;
        const auto [first, second] = is_kept ? std::pair(row, column) : std::pair(column, row);
        tiles.at({ first / tile_size, second / tile_size })(first % tile_size, second % tile_size) = *value++;
      }
    }
  }
} // namespace sprag
