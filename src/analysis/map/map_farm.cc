// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/map/map_farm.h"

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

  MapFarm::MapFarm(const Scene &scene, const ResultsLog *results_log, std::function<void(std::size_t, std::size_t)> report)
      : own_check(scene)
      , farm({ "map", unchanged_inputs(scene, "map"), std::move(report) }, results_log)
      , kept(own_check.mesh_parameter())
  {
    for (const auto &line : farm.taken_over())
      learn(line);
    from_log = known.size();
  }

  void MapFarm::check(const std::vector<MapSite> &sites)
  {
    std::vector<MapSite> missing;
    std::copy_if(sites.begin(), sites.end(), std::back_inserter(missing),
                 [this](const MapSite &site) { return known.count(site) == 0; });
    if (kept)
      std::stable_sort(missing.begin(), missing.end(),
                       [this](const MapSite &a, const MapSite &b) { return coordinate(a, *kept) < coordinate(b, *kept); });
    farm.carry_out(
        site_groups(missing), [&](const std::size_t i) { return to_line(missing[i], own_check.check(missing[i])); },
        [this](const std::string &line) { learn(line); });
  }

  /// Lines of cells that share a mesh, or single cells where all do.
  std::vector<std::vector<std::size_t>> MapFarm::site_groups(const std::vector<MapSite> &sites) const
  {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (i > 0 && kept && coordinate(sites[i], *kept) == coordinate(sites[i - 1], *kept))
        groups.back().push_back(i);
      else
        groups.push_back({ i });
    return groups;
  }

  void MapFarm::learn(const std::string &line)
  {
    MapSite site;
    MapCell cell;
    read_line(line, site, cell);
    known.insert({ site, cell });
    known_kinds.insert({ site, cell.kinds() });
  }
} // namespace sprag
