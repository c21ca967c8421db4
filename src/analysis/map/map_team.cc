// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/map/map_team.h"

#include "scene/scene.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    double coordinate(const MapSite &site, const unsigned int parameter)
    {
      return parameter == 0 ? site.first : site.second;
    }
  } // namespace

  std::string line_of(const MapSite &site, const MapCell &cell)
  {
    std::vector<double> numbers = { site.first, site.second };
    numbers.insert(numbers.end(), cell.values.begin(), cell.values.end());
    return exact_text(numbers);
  }

  std::pair<MapSite, MapCell> cell_of(const std::string &line)
  {
    const auto numbers = exact_numbers(line);
    MapCell cell{};
    std::copy_n(numbers.begin() + 2, cell.values.size(), cell.values.begin());
    return { { numbers.at(0), numbers.at(1) }, cell };
  }

  MapTeam::MapTeam(const Scene &scene, const Journal *journal, std::function<void(std::size_t, std::size_t)> report)
      : own_judge(scene)
      , team({ "map", unchanged_inputs(scene, "map"), std::move(report) }, journal)
      , kept(own_judge.mesh_parameter())
  {
    for (const auto &line : team.taken_over())
      learn(line);
    from_journal = known.size();
  }

  void MapTeam::judge(const std::vector<MapSite> &sites)
  {
    std::vector<MapSite> missing;
    std::copy_if(sites.begin(), sites.end(), std::back_inserter(missing),
                 [this](const MapSite &site) { return known.count(site) == 0; });
    if (kept)
      std::stable_sort(missing.begin(), missing.end(),
                       [this](const MapSite &a, const MapSite &b) { return coordinate(a, *kept) < coordinate(b, *kept); });
    team.carry_out(
        groups_of(missing), [&](const std::size_t i) { return line_of(missing[i], own_judge.judge(missing[i])); },
        [this](const std::string &line) { learn(line); });
  }

  /// Lines of cells that share a mesh, or single cells where all do.
  std::vector<std::vector<std::size_t>> MapTeam::groups_of(const std::vector<MapSite> &sites) const
  {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (i > 0 && kept && coordinate(sites[i], *kept) == coordinate(sites[i - 1], *kept))
        groups.back().push_back(i);
      else
        groups.push_back({ i });
    return groups;
  }

  void MapTeam::learn(const std::string &line)
  {
    const auto [site, cell] = cell_of(line);
    known.insert({ site, cell });
    known_kinds.insert({ site, cell.kinds() });
  }
} // namespace sprag
