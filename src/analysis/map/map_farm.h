// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/map/map_cell.h"
#include "analysis/task_farm/task_farm.h"

namespace sprag
{
  struct Scene;

  using MapCells = std::map<MapSite, MapCell>;

  /// Writes a cell and its site as a line of a journal, to the last bit.
  std::string to_line(const MapSite &site, const MapCell &cell);

  /// Reads such a line.
  std::pair<MapSite, MapCell> parse_cell(const std::string &line);

  /// All ranks of MPI, judging the cells of a map together. Every rank calls what is here and comes to have all cells.
  class MapFarm
  {
  public:
    /// Takes over the cells in the journal, which rank 0 has; it is null on the others. `report` is called on rank 0 now and then
    /// with the cells judged and those asked for.
    MapFarm(const Scene &scene, const Journal *journal, std::function<void(std::size_t, std::size_t)> report);

    /// Judges what is not known yet. Throws what Team::carry_out() does; cells finished until then are kept.
    void judge(const std::vector<MapSite> &sites);

    const MapCells &cells() const
    {
      return known;
    }
    const KnownKinds &kinds() const
    {
      return known_kinds;
    }

    /// Returns the number of cells that were in the journal.
    std::size_t taken_over() const
    {
      return from_journal;
    }

    CellJudge &cell_judge()
    {
      return own_judge;
    }

  private:
    CellJudge own_judge;
    TaskFarm farm;
    const std::optional<unsigned int> kept; ///< see CellJudge::mesh_parameter()
    MapCells known;
    KnownKinds known_kinds;
    std::size_t from_journal = 0;

    std::vector<std::vector<std::size_t>> site_groups(const std::vector<MapSite> &sites) const;
    void learn(const std::string &line);
  };
} // namespace sprag
