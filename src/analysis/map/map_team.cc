#include "analysis/map/map_team.h"

#include "base/errors.h"
#include "base/interrupt.h"
#include "scene/scene_key.h"

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/utility.hpp>

#include <algorithm>

namespace sprag
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    /// How long a rank works on before all tell each other what they have.
    constexpr std::chrono::milliseconds batch_duration(500);

    double coordinate(const MapSite &site, const unsigned int parameter)
    {
      return parameter == 0 ? site.first : site.second;
    }
  } // namespace

  void on_first_rank(const std::function<void()> &work)
  {
    std::vector<std::string> input, analysis;
    if (MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      try
      {
        work();
      }
      catch (const InputError &error)
      {
        input = error.messages;
      }
      catch (const AnalysisError &error)
      {
        analysis = { error.what() };
      }
    input    = MPI::broadcast(MPI_COMM_WORLD, input);
    analysis = MPI::broadcast(MPI_COMM_WORLD, analysis);
    if (!input.empty())
      throw InputError(input);
    if (!analysis.empty())
      throw AnalysisError(analysis.front());
  }

  MapTeam::MapTeam(const Scene &map_scene, MapJournal *first_ranks_journal,
                   std::function<void(std::size_t, std::size_t)> reporter)
      : scene(map_scene)
      , key(scene_key(scene))
      , own_judge(scene)
      , journal(first_ranks_journal)
      , report(std::move(reporter))
      , kept(own_judge.mesh_parameter())
  {
    learn(MPI::broadcast(MPI_COMM_WORLD, journal != nullptr ? journal->cells() : MapCells()));
    from_journal = known.size();
  }

  void MapTeam::judge(const std::vector<MapSite> &sites)
  {
    const auto mine   = own_share(sites);
    const auto wanted = MPI::sum(mine.size(), MPI_COMM_WORLD);
    std::size_t next  = 0;
    for (std::size_t done = 0; done < wanted;)
    {
      MapCells batch;
      const auto end = std::chrono::steady_clock::now() + batch_duration;
      while (next < mine.size() && !interrupted() && (batch.empty() || std::chrono::steady_clock::now() < end))
      {
        batch.insert({ mine[next], own_judge.judge(mine[next]) });
        ++next;
      }
      done += share(batch);
      if (journal != nullptr)
        report(done, wanted);
      if (MPI::max(interrupted() ? 1 : 0, MPI_COMM_WORLD) != 0)
        throw AnalysisError("interrupted; the cells judged are kept: start the same map again to go on");
    }
  }

  /// Lines of cells that share a mesh go round the ranks, or single cells where all do.
  std::vector<MapSite> MapTeam::own_share(const std::vector<MapSite> &sites) const
  {
    std::vector<MapSite> missing;
    std::copy_if(sites.begin(), sites.end(), std::back_inserter(missing),
                 [this](const MapSite &site) { return known.count(site) == 0; });
    if (kept)
      std::stable_sort(missing.begin(), missing.end(),
                       [this](const MapSite &a, const MapSite &b) { return coordinate(a, *kept) < coordinate(b, *kept); });
    std::vector<MapSite> result;
    unsigned int owner = 0;
    for (std::size_t i = 0; i < missing.size(); ++i)
    {
      if (i > 0 && !(kept && coordinate(missing[i], *kept) == coordinate(missing[i - 1], *kept)))
        owner = (owner + 1) % MPI::n_mpi_processes(MPI_COMM_WORLD);
      if (owner == MPI::this_mpi_process(MPI_COMM_WORLD))
        result.push_back(missing[i]);
    }
    return result;
  }

  /// Returns how many cells all ranks had.
  std::size_t MapTeam::share(const MapCells &batch)
  {
    MapCells all;
    for (auto &cells : MPI::all_gather(MPI_COMM_WORLD, batch))
      all.merge(cells);
    on_first_rank([&] { keep(all); });
    learn(all);
    return all.size();
  }

  /// Cells read their input files anew.
  void MapTeam::keep(const MapCells &cells)
  {
    if (scene_key(scene) != key)
      throw AnalysisError("an input file has changed during the map; the cells judged before are kept for the file as it was: "
                          "start the map again, with that file or the new one");
    journal->append(cells);
  }

  void MapTeam::learn(const MapCells &cells)
  {
    for (const auto &[site, cell] : cells)
    {
      known.insert({ site, cell });
      known_kinds.insert({ site, cell.kinds() });
    }
  }
} // namespace sprag
