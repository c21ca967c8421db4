#pragma once

#include "analysis/map/map_journal.h"

#include <chrono>
#include <functional>

namespace sprag
{
  /// All ranks of MPI, judging the cells of a map together. Every rank calls what is here and comes to have all cells.
  class MapTeam
  {
  public:
    /// Takes over the cells in the journal, which rank 0 has; it is null on the others. `report` is called on rank 0 now and then
    /// with the cells judged and those asked for.
    MapTeam(const Scene &scene, MapJournal *journal, std::function<void(std::size_t, std::size_t)> report);

    /// Judges what is not known yet. Throws AnalysisError on all ranks when one was asked to end, an input file has changed since
    /// the map began or the journal cannot be written; cells finished until then are kept.
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
    const Scene scene;
    const std::string key; ///< of the scene when the map began
    CellJudge own_judge;
    MapJournal *const journal;
    const std::function<void(std::size_t, std::size_t)> report;
    const std::optional<unsigned int> kept; ///< see CellJudge::mesh_parameter()
    MapCells known;
    KnownKinds known_kinds;
    std::size_t from_journal = 0;

    std::vector<MapSite> own_share(const std::vector<MapSite> &sites) const;
    void learn(const MapCells &cells);
    std::size_t share(const MapCells &batch);
    void keep(const MapCells &cells);
  };

  /// Does `work` on rank 0 and throws its InputError or AnalysisError on all ranks.
  void on_first_rank(const std::function<void()> &work);
} // namespace sprag
