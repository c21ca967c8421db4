// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/map/map_grid.h"
#include "analysis/task_farm/task_farm.h"
#include "levers/dynamics.h"
#include "results/columns.h"
#include "scene/scene.h"

#include <optional>

namespace sprag
{
  constexpr std::size_t n_slide_values = 5;
  constexpr std::size_t n_cell_values  = 1 + 2 * n_slide_values;

  /// The results of a cell: numbers in the order of cell_columns(), NaN where there is none.
  struct MapCell
  {
    std::array<double, n_cell_values> values;

    /// Returns the kinds forward and backward.
    MapKinds kinds() const
    {
      return { { static_cast<unsigned int>(values[1]), static_cast<unsigned int>(values[1 + n_slide_values]) } };
    }
  };

  /// Lists names, units and meaning of a cell's numbers.
  const std::vector<ColumnInfo> &cell_columns();

  /// Returns the parameter's value at a coordinate of the grid: its ends exactly.
  double parameter_at(const ParameterRange &range, double coordinate);

  using MapCells = std::map<MapSite, MapCell>;

  /// All ranks of MPI, checking the slides of a map's scene both ways with other values of its two parameters. A cell depends on
  /// nothing but its site. Every rank calls what is here and comes to have all cells.
  class MapFarm
  {
  public:
    /// Takes over the cells in the results log, see TaskFarm. All must live as long.
    MapFarm(const Scene &scene, const RunOptions &options, FarmProgress &progress);

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

    /// Measures the time that this rank spends on meshes and models.
    PhaseTimer &timer()
    {
      return maker.timer();
    }

    TaskFarm ranks;

  private:
    const Scene &scene;
    DynamicsMaker maker{ false };
    const std::optional<unsigned int> mesh_parameter;
    MapCells known;
    KnownKinds known_kinds;

    MapCell check(const MapSite &site);
    std::vector<std::vector<std::size_t>> site_groups(const std::vector<MapSite> &sites) const;
    void learn(const std::string &line);
  };
} // namespace sprag
