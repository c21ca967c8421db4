// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/map/map_cell.h"
#include "analysis/task_farm/task_farm.h"

namespace sprag
{
  struct Scene;

  using MapCells = std::map<MapSite, MapCell>;

  /// All ranks of MPI, checking the cells of a map together. Every rank calls what is here and comes to have all cells.
  class MapFarm
  {
  public:
    /// Takes over the cells in the results log, which rank 0 has; it is null on the others. `report` is called on rank 0 now and
    /// then with the cells checked and those asked for.
    MapFarm(const Scene &scene, const ResultsLog *results_log, std::function<void(std::size_t, std::size_t)> report);

    /// Checks what is not known yet. Throws what TaskFarm::carry_out() does; cells finished until then are kept.
    void check(const std::vector<MapSite> &sites);

    const MapCells &cells() const
    {
      return known;
    }
    const KnownKinds &kinds() const
    {
      return known_kinds;
    }

    /// Returns the number of cells that were in the results log.
    std::size_t taken_over() const
    {
      return from_log;
    }

    CellCheck &cell_check()
    {
      return own_check;
    }

  private:
    CellCheck own_check;
    TaskFarm farm;
    const std::optional<unsigned int> kept; ///< see CellCheck::mesh_parameter()
    MapCells known;
    KnownKinds known_kinds;
    std::size_t from_log = 0;

    std::vector<std::vector<std::size_t>> site_groups(const std::vector<MapSite> &sites) const;
    void learn(const std::string &line);
  };
} // namespace sprag
