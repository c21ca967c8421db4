// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/map/map_farm.h"

#include "analysis/stability/sweep.h"
#include "base/errors.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "scene/closed_form.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    double coordinate(const MapSite &site, const unsigned int parameter)
    {
      return parameter == 0 ? site.first : site.second;
    }

    // Kinds of cells beside those of SlideKind.
    constexpr unsigned int inadmissible_cell = 4; ///< the scene is refused
    constexpr unsigned int failed_cell       = 5; ///< its analysis fails
    static_assert(static_cast<unsigned int>(SlideKind::jammed) + 1 == inadmissible_cell);

    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

    /// A cell without slides.
    MapCell empty_cell(const unsigned int kind)
    {
      MapCell cell;
      cell.values.fill(no_number);
      cell.values[1] = cell.values[1 + n_slide_values] = kind;
      return cell;
    }

    /// Leaves the direction failed where the analysis fails.
    void set_slide(const SweptSlides &slides, const Direction direction, MapCell &cell)
    {
      // One NaN for all, so that maps compare bit by bit.
      const auto number = [](const double value) { return std::isnan(value) ? no_number : value; };
      const auto place  = cell.values.begin() + 1 + (direction == Direction::forward ? 0 : n_slide_values);
      try
      {
        const auto &worst                               = slides.worst(direction);
        const std::array<double, n_slide_values> values = { { static_cast<double>(worst.kind), number(worst.growth_rate),
                                                              number(worst.frequency), number(worst.uniqueness),
                                                              number(worst.P) } };
        std::copy(values.begin(), values.end(), place);
      }
      catch (const AnalysisError &)
      {
      }
    }

    Scene cell_scene(const Scene &map, const MapSite &site)
    {
      const auto &[first, second, coarsest, bisections] = map.map;
      return prepared(variant(map, { override_text(first.name, parameter_at(first, site.first)),
                                     override_text(second.name, parameter_at(second, site.second)) }));
    }

    /// Returns the parameter, 0 or 1, that alone changes the mesh, so that cells in the order of it are checked faster; none
    /// where there is no such parameter.
    std::optional<unsigned int> find_mesh_parameter(const Scene &scene)
    {
      const bool first = changes_mesh(scene, scene.map.first), second = changes_mesh(scene, scene.map.second);
      if (!is_meshed(scene.analysis.model) || first == second)
        return {};
      return first ? 0 : 1;
    }
  } // namespace

  MapFarm::MapFarm(const Scene &scene_, const RunOptions &options, FarmProgress &progress)
      : ranks(scene_, options, { "map", "cells", "judged again" }, progress)
      , scene(scene_)
      , mesh_parameter(find_mesh_parameter(scene))
  {
    for (const auto &line : ranks.taken_over())
      learn(line);
  }

  void MapFarm::check(const std::vector<MapSite> &sites)
  {
    std::vector<MapSite> missing;
    std::copy_if(sites.begin(), sites.end(), std::back_inserter(missing),
                 [this](const MapSite &site) { return known.count(site) == 0; });
    if (mesh_parameter)
      std::stable_sort(missing.begin(), missing.end(),
                       [this](const MapSite &a, const MapSite &b)
                       { return coordinate(a, *mesh_parameter) < coordinate(b, *mesh_parameter); });
    ranks.carry_out(
        site_groups(missing), [&](const std::size_t i) { return to_line(missing[i], check(missing[i])); },
        [this](const std::string &line) { learn(line); });
  }

  /// Lines of cells that share a mesh, or single cells where all do.
  std::vector<std::vector<std::size_t>> MapFarm::site_groups(const std::vector<MapSite> &sites) const
  {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (i > 0 && mesh_parameter && coordinate(sites[i], *mesh_parameter) == coordinate(sites[i - 1], *mesh_parameter))
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

  const std::vector<ColumnInfo> &cell_columns()
  {
    static const auto columns = []
    {
      const std::string kinds     = "0 stable, 1 flutter, 2 divergence, 3 jammed, 4 inadmissible, 5 failed";
      std::vector<ColumnInfo> all = { { "theta_0", "rad", "inclination of the lever at x = 0" } };
      for (const std::string way : { "forward", "backward" })
      {
        all.push_back({ "kind_" + way, "1", kinds });
        all.push_back({ "growth_rate_" + way, "1/s", "largest Re lambda of the slide " + way });
        all.push_back({ "frequency_" + way, "Hz", "of that vibration, 0: no vibration" });
        all.push_back({ "uniqueness_" + way, "1", "of the equilibrium: 1 without friction, <= 0 where it has lost uniqueness" });
        all.push_back({ "P_" + way, "N", "normal force of the slide" });
      }
      return all;
    }();
    return columns;
  }

  double parameter_at(const ParameterRange &range, const double coordinate)
  {
    const double share = coordinate / (range.points - 1);
    return share == 1. ? range.to : range.from + share * (range.to - range.from);
  }

  MapCell MapFarm::check(const MapSite &site)
  {
    MapCell cell = empty_cell(failed_cell);
    try
    {
      Scene here               = cell_scene(scene, site);
      here.stability.direction = Direction::both;
      cell.values[0]           = kinematics(here.geometry, 0.).theta;
      const auto slides        = sweep(here, maker);
      for (const auto direction : { Direction::forward, Direction::backward })
        set_slide(slides, direction, cell);
    }
    catch (const InputError &)
    {
      return empty_cell(inadmissible_cell);
    }
    catch (const AnalysisError &)
    {
      // No model: both ways stay failed.
    }
    return cell;
  }
} // namespace sprag
