// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/map/map.h"

#include "analysis/stability/sweep.h"
#include "base/errors.h"
#include "base/unknown.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "results/page_tables.h"
#include "scene/closed_form.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace sprag
{
  namespace
  {
    // Kinds of cells beside those of SlideKind.
    constexpr unsigned int inadmissible_cell = 4; ///< the scene is refused
    constexpr unsigned int failed_cell       = 5; ///< its analysis fails
    static_assert(static_cast<unsigned int>(SlideKind::jammed) + 1 == inadmissible_cell);

    /// A cell without slides.
    MapCell empty_cell(const unsigned int kind)
    {
      MapCell cell;
      cell.values.fill(unknown);
      cell.values[1] = cell.values[1 + n_slide_values] = kind;
      return cell;
    }

    /// Sets the values of a direction; they stay those of a failed cell if the analysis fails.
    void set_slide(const SweptSlides &slides, const Direction direction, MapCell &cell)
    {
      // One NaN for all, so that maps compare bit by bit.
      const auto number = [](const double value) { return std::isnan(value) ? unknown : value; };
      const auto place  = cell.values.begin() + 1 + (direction == Direction::forward ? 0 : n_slide_values);
      try
      {
        const auto &worst                               = slides.worst(direction);
        const std::array<double, n_slide_values> values = {
          { static_cast<double>(worst.kind), number(worst.growth_rate), number(worst.frequency), number(worst.uniqueness),
            number(worst.P), worst.error, number(worst.beyond_frequency), number(worst.beyond_growth_rate) }
        };
        std::copy(values.begin(), values.end(), place);
      }
      catch (const AnalysisError &)
      {
      }
    }

    /// Returns the parameter, 0 or 1, that alone changes the mesh: cells sorted by it share meshes. None if both or neither do.
    std::optional<unsigned int> find_mesh_parameter(const Scene &scene)
    {
      const bool first = changes_mesh(scene, scene.map.first), second = changes_mesh(scene, scene.map.second);
      if (!is_meshed(scene.analysis.model) || first == second)
        return {};
      return first ? 0 : 1;
    }

    /// Returns a + share (b - a), exactly a for a = b.
    double between_ends(const double a, const double b, const double share)
    {
      return a + share * (b - a);
    }

    template <class Site>
    auto &coordinate(Site &site, const unsigned int along)
    {
      return along == 0 ? site.first : site.second;
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
      std::string names = "theta_0";
      for (const std::string direction : { "_forward", "_backward" })
        for (const std::string name :
             { "kind", "growth_rate", "frequency", "uniqueness", "P", "growth_error", "beyond_frequency", "beyond_growth_rate" })
          names += " " + name + direction;
      return page_columns("map", names);
    }();
    return columns;
  }

  Scene cell_scene(const Scene &map, const MapSite &site)
  {
    const auto &[first, second, coarsest, bisections] = map.map;
    return prepared(variant(map, { override_text(first.name, parameter_at(first, site.first)),
                                   override_text(second.name, parameter_at(second, site.second)) }));
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

  MapGrid::MapGrid(const unsigned int first_points, const unsigned int second_points, const unsigned int coarsest)
      : n{ { first_points, second_points } }
      , known(std::size_t{ first_points } * second_points, 0)
      , kind(known.size())
  {
    for (unsigned int spacing = coarsest; spacing > 0; spacing /= 2)
    {
      const auto quads = [&](const unsigned int points) { return (points - 2) / spacing + 1; };
      Level level{ spacing, { { quads(n[0]), quads(n[1]) } }, {} };
      level.split.assign(std::size_t{ level.quads[0] } * level.quads[1], 0);
      levels.push_back(level);
    }
  }

  MapGrid::Corners MapGrid::corners(const Level &level, const unsigned int a, const unsigned int b) const
  {
    const auto end = [&](const unsigned int quad, const unsigned int points)
    { return std::min((quad + 1) * level.spacing, points - 1); };
    return { { { a * level.spacing, b * level.spacing } }, { { end(a, n[0]), end(b, n[1]) } } };
  }

  bool MapGrid::is_active(const std::size_t level, const unsigned int a, const unsigned int b) const
  {
    if (level == 0)
      return true;
    const Level &parents = levels[level - 1];
    return parents.split[parents.index(a / 2, b / 2)] != 0;
  }

  bool MapGrid::is_mixed(const Corners &quad) const
  {
    const MapKinds *met = nullptr;
    for (unsigned int i = quad.low[0]; i <= quad.high[0]; ++i)
      for (unsigned int j = quad.low[1]; j <= quad.high[1]; ++j)
      {
        if (!is_known(i, j))
          continue;
        if (met != nullptr && *met != kinds(i, j))
          return true;
        met = &kinds(i, j);
      }
    return false;
  }

  void MapGrid::split_level(const std::size_t number)
  {
    Level &level = levels[number];
    std::vector<char> mixed(level.split.size(), 0);
    for (unsigned int a = 0; a < level.quads[0]; ++a)
      for (unsigned int b = 0; b < level.quads[1]; ++b)
        mixed[level.index(a, b)] = is_active(number, a, b) && is_mixed(corners(level, a, b));
    const auto beside_mixed = [&](const unsigned int a, const unsigned int b)
    {
      return (a > 0 && mixed[level.index(a - 1, b)]) || (a + 1 < level.quads[0] && mixed[level.index(a + 1, b)]) ||
             (b > 0 && mixed[level.index(a, b - 1)]) || (b + 1 < level.quads[1] && mixed[level.index(a, b + 1)]);
    };
    for (unsigned int a = 0; a < level.quads[0]; ++a)
      for (unsigned int b = 0; b < level.quads[1]; ++b)
      {
        char &split = level.split[level.index(a, b)];
        if (split || !is_active(number, a, b))
          continue;
        split = mixed[level.index(a, b)] || (level.spacing > 2 && beside_mixed(a, b));
      }
  }

  std::vector<MapSite> MapGrid::next_sites()
  {
    for (std::size_t level = 0; level + 1 < levels.size(); ++level)
      split_level(level);
    std::set<MapSite> missing;
    for (const auto &[low, high] : active_quads())
      for (const unsigned int i : { low[0], high[0] })
        for (const unsigned int j : { low[1], high[1] })
          if (!is_known(i, j))
            missing.insert({ static_cast<double>(i), static_cast<double>(j) });
    return { missing.begin(), missing.end() };
  }

  std::vector<MapGrid::Corners> MapGrid::active_quads() const
  {
    std::vector<Corners> result;
    for (std::size_t level = 0; level < levels.size(); ++level)
      for (unsigned int a = 0; a < levels[level].quads[0]; ++a)
        for (unsigned int b = 0; b < levels[level].quads[1]; ++b)
          if (is_active(level, a, b))
            result.push_back(corners(levels[level], a, b));
    return result;
  }

  void MapGrid::learn(const KnownKinds &sites)
  {
    for (unsigned int i = 0; i < n[0]; ++i)
      for (unsigned int j = 0; j < n[1]; ++j)
        if (!is_known(i, j))
          if (const auto found = sites.find({ static_cast<double>(i), static_cast<double>(j) }); found != sites.end())
          {
            known[index(i, j)] = 1;
            kind[index(i, j)]  = found->second;
          }
  }

  std::vector<double> MapGrid::interpolated(const std::vector<double> &values) const
  {
    std::vector<double> result(values.size(), unknown);
    // Smaller quads come later and overwrite.
    for (const auto &quad : active_quads())
      interpolate(quad, values, result);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (known[i])
        result[i] = values[i];
    return result;
  }

  void MapGrid::interpolate(const Corners &quad, const std::vector<double> &values, std::vector<double> &result) const
  {
    const auto &[low, high] = quad;
    const auto value = [&](const unsigned int i, const unsigned int j) { return is_known(i, j) ? values[index(i, j)] : unknown; };
    for (unsigned int i = low[0]; i <= high[0]; ++i)
      for (unsigned int j = low[1]; j <= high[1]; ++j)
      {
        const double s      = static_cast<double>(i - low[0]) / (high[0] - low[0]);
        const double t      = static_cast<double>(j - low[1]) / (high[1] - low[1]);
        result[index(i, j)] = between_ends(between_ends(value(low[0], low[1]), value(low[0], high[1]), t),
                                           between_ends(value(high[0], low[1]), value(high[0], high[1]), t), s);
      }
  }

  BoundarySearch::BoundarySearch(const MapGrid &grid, const unsigned int bisections)
      : left(bisections)
  {
    const auto n = grid.points();
    for (unsigned int i = 0; i < n[0]; ++i)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int along = 0; along < 2; ++along)
        {
          const unsigned int next_i = i + (along == 0);
          const unsigned int next_j = j + (along == 1);
          if (next_i == n[0] || next_j == n[1] || !grid.is_known(i, j) || !grid.is_known(next_i, next_j))
            continue;
          const MapSite middle{ 0.5 * (i + next_i), 0.5 * (j + next_j) };
          for (unsigned int direction = 0; direction < 2; ++direction)
          {
            const unsigned int low  = grid.kinds(i, j)[direction];
            const unsigned int high = grid.kinds(next_i, next_j)[direction];
            if (low != high)
              brackets.push_back({ middle, direction, along, 1., { { low, high } } });
          }
        }
  }

  std::vector<MapSite> BoundarySearch::next_sites() const
  {
    std::set<MapSite> middles;
    if (left > 0)
      for (const BoundaryPoint &bracket : brackets)
        middles.insert(bracket.site);
    return { middles.begin(), middles.end() };
  }

  void BoundarySearch::learn(const KnownKinds &known)
  {
    for (BoundaryPoint &bracket : brackets)
    {
      const unsigned int middle          = known.at(bracket.site)[bracket.direction];
      const bool in_low_half             = middle != bracket.kinds[0];
      bracket.kinds[in_low_half ? 1 : 0] = middle;
      bracket.width *= 0.5;
      coordinate(bracket.site, bracket.along) += (in_low_half ? -0.5 : 0.5) * bracket.width;
    }
    --left;
  }
} // namespace sprag
