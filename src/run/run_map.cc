// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/map/map.h"
#include "analysis/stability/stability.h"
#include "base/ranges.h"
#include "program/result_writer.h"
#include "report/summary_lines.h"
#include "report/warnings.h"
#include "run/run.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sprag
{
  namespace
  {
    struct StabilityMap
    {
      MapGrid grid;
      std::vector<BoundaryPoint> boundary = {};
    };

    void check_all(const Scene &scene, MapFarm &farm, FarmProgress &progress, StabilityMap &map)
    {
      for (auto sites = map.grid.next_sites(); !sites.empty(); sites = map.grid.next_sites())
      {
        progress.say("grid: " + std::to_string(sites.size()) + " cells");
        farm.check(sites);
        map.grid.learn(farm.kinds());
      }
      BoundarySearch search(map.grid, scene.map.bisections);
      map.boundary = search.points();
      for (auto sites = search.next_sites(); !sites.empty(); sites = search.next_sites())
      {
        progress.say("boundaries: " + std::to_string(sites.size()) + " cells");
        farm.check(sites);
        search.learn(farm.kinds());
        map.boundary = search.points();
      }
    }

    Dataset axis(const std::string &name, const ParameterRange &range)
    {
      Dataset result{ { name, parameter_unit(range.name), range.name }, {}, {} };
      for (unsigned int i = 0; i < range.points; ++i)
        result.values.push_back(parameter_at(range, i));
      return result;
    }

    Group map_group(const Scene &scene, const MapGrid &grid, const MapCells &cells)
    {
      const auto [n_first, n_second]       = grid.points();
      const std::vector<std::size_t> shape = { n_first, n_second };
      Dataset evaluated{
        { "evaluated", "1", "1 where the cell was judged, 0 where its numbers are interpolated; first x second" }, {}, shape
      };
      std::vector<std::vector<double>> values(n_cell_values);
      for (unsigned int i = 0; i < n_first; ++i)
        for (unsigned int j = 0; j < n_second; ++j)
        {
          const bool known = grid.is_known(i, j);
          evaluated.values.push_back(known ? 1. : 0.);
          for (std::size_t k = 0; k < n_cell_values; ++k)
            values[k].push_back(known ? cells.at({ static_cast<double>(i), static_cast<double>(j) }).values[k] : 0.);
        }
      Group group{ "map", { axis("first", scene.map.first), axis("second", scene.map.second), std::move(evaluated) } };
      for (std::size_t k = 0; k < n_cell_values; ++k)
        group.datasets.push_back({ cell_columns()[k], grid.interpolated(values[k]), shape });
      return group;
    }

    std::vector<ColumnInfo> boundary_columns(const MapSettings &map)
    {
      const auto first = parameter_unit(map.first.name), second = parameter_unit(map.second.name);
      return { { "first", first, map.first.name + " where the kind changes" },
               { "second", second, map.second.name + " there" },
               { "direction", "1", "of motion: 1 forward, -1 backward" },
               { "along", "1", "parameter that was varied to find the point: 1 first, 2 second" },
               { "width", first == second ? first : "1", "of the bracket about the point, in that parameter's unit" },
               { "kind_low", "1", "kind at the bracket's end with the lower number of grid point" },
               { "kind_high", "1", "kind at its other end" } };
    }

    std::vector<double> boundary_row(const MapSettings &map, const BoundaryPoint &point)
    {
      const ParameterRange &varied = point.along == 0 ? map.first : map.second;
      const double width           = point.width * std::abs(varied.to - varied.from) / (varied.points - 1);
      return { parameter_at(map.first, point.site.first),
               parameter_at(map.second, point.site.second),
               point.direction == 0 ? 1. : -1.,
               point.along + 1.,
               width,
               static_cast<double>(point.kinds[0]),
               static_cast<double>(point.kinds[1]) };
    }

    const Dataset &find_dataset(const Group &map, const std::string &name)
    {
      return *find_by(
          map.datasets, [](const Dataset &dataset) { return dataset.info.name; }, name);
    }

    /// Returns for each point of the grid whether its growth rate, by which it grows or dies out, is smaller than its error.
    std::vector<bool> find_undecided(const Group &map, const std::string &direction)
    {
      const auto &rates = find_dataset(map, "growth_rate_" + direction).values;
      const auto &error = find_dataset(map, "growth_error_" + direction).values;
      const auto &hertz = find_dataset(map, "frequency_" + direction).values;
      std::vector<bool> result;
      for (std::size_t i = 0; i < rates.size(); ++i)
        result.push_back(!is_decided({ rates[i], 2. * M_PI * hertz[i] }, error[i]));
      return result;
    }

    /// Returns the share of the grid that is found to be of any of the kinds and not undecided; NaN before the whole grid is
    /// known.
    double find_share(const std::vector<double> &found, const std::vector<bool> &undecided, const std::vector<double> &kinds)
    {
      if (std::any_of(found.begin(), found.end(), [](const double kind) { return std::isnan(kind); }))
        return std::nan("");
      std::size_t counted = 0;
      for (std::size_t i = 0; i < found.size(); ++i)
        counted += contains(kinds, found[i]) && !undecided[i] ? 1 : 0;
      return static_cast<double>(counted) / static_cast<double>(found.size());
    }

    std::vector<Entry> map_summary(const StabilityMap &map, const Group &group, const std::size_t checked)
    {
      const auto [n_first, n_second] = map.grid.points();
      const auto on_grid             = std::count(group.datasets[2].values.begin(), group.datasets[2].values.end(), 1.);
      std::vector<Entry> summary     = { { "grid_points", static_cast<double>(n_first) * n_second },
                                         { "grid_cells_judged", static_cast<double>(on_grid) },
                                         { "cells_judged", static_cast<double>(checked) },
                                         { "boundary_points", static_cast<double>(map.boundary.size()) } };
      for (const std::string direction : { "forward", "backward" })
      {
        const auto &found      = find_dataset(group, "kind_" + direction).values;
        const auto undecided   = find_undecided(group, direction);
        const auto n_undecided = static_cast<double>(std::count(undecided.begin(), undecided.end(), true));
        append<Entry>(summary, { { "unstable_" + direction, find_share(found, undecided, { 1., 2. }) },
                                 { "undecided_" + direction, n_undecided / static_cast<double>(undecided.size()) },
                                 { "jammed_" + direction, find_share(found, undecided, { 3. }) },
                                 { "not_judged_" + direction, find_share(found, undecided, { 4., 5. }) } });
      }
      return summary;
    }

    /// Warns of the mode that grows most among those that the cells leave out.
    Warnings left_out_modes(const Scene &scene, const MapCells &cells)
    {
      const MapSite *site = nullptr;
      std::array<double, 2> most{};
      for (const auto &[place, cell] : cells)
        for (const unsigned int direction : { 0u, 1u })
          if (const auto mode = cell.beyond(direction); mode[1] > most[1])
          {
            site = &place;
            most = mode;
          }
      return site == nullptr ? Warnings{} : beam_warnings(cell_scene(scene, *site), most[0], most[1]);
    }

    void write_map(const Scene &scene, const RunOptions &options, const StabilityMap &map, MapFarm &farm,
                   const std::string &status, const std::vector<Entry> &meta, Warnings &warnings)
    {
      const Group group = map_group(scene, map.grid, farm.cells());
      ResultWriter writer(scene, options, boundary_columns(scene.map), &farm.timer());
      for (const auto &point : map.boundary)
        writer.append(boundary_row(scene.map, point));
      append(warnings, left_out_modes(scene, farm.cells()));
      writer.finish(status, { map_summary(map, group, farm.cells().size()), meta, { group } }, warnings);
    }
  } // namespace

  void run_map(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    FarmProgress progress{ progress_style(options.quiet) };
    MapFarm farm(scene, options, progress);
    StabilityMap map{ MapGrid(scene.map.first.points, scene.map.second.points, scene.map.coarsest) };
    finish_in_any_case([&] { check_all(scene, farm, progress, map); },
                       [&](const std::string &status)
                       {
                         progress.bar.reset();
                         map.grid.learn(farm.kinds());
                         const auto meta = farm.ranks.cost();
                         on_first_rank([&] { write_map(scene, options, map, farm, status, meta, warnings); });
                       });
    farm.ranks.remove_log();
  }
} // namespace sprag
