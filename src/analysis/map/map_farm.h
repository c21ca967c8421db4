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
  /// Kinds of a map's cells: those of SlideKind and two more.
  constexpr unsigned int inadmissible_cell = 4; ///< the scene is refused
  constexpr unsigned int failed_cell       = 5; ///< its analysis fails
  constexpr unsigned int n_cell_kinds      = 6;

  std::string cell_kind_name(unsigned int kind);

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

  /// Checks the slides of a map's scene both ways with other values of its two parameters. A cell depends on nothing but its
  /// site.
  class CellCheck
  {
  public:
    explicit CellCheck(const Scene &scene);

    MapCell check(const MapSite &site);

    /// Measures the time spent on meshes and models.
    PhaseTimer &timer()
    {
      return maker.timer();
    }

    /// Returns the parameter, 0 or 1, that alone changes the mesh, so that cells in the order of it are checked faster; none
    /// where there is no such parameter.
    std::optional<unsigned int> mesh_parameter() const;

  private:
    const Scene scene;
    DynamicsMaker maker;

    Scene scene_at(const MapSite &site) const;
  };

  using MapCells = std::map<MapSite, MapCell>;

  /// All ranks of MPI, checking the cells of a map together. Every rank calls what is here and comes to have all cells.
  class MapFarm
  {
  public:
    /// Takes over the cells in the results log, see TaskFarm.
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

    CellCheck own_check;
    TaskFarm ranks;

  private:
    const std::optional<unsigned int> kept; ///< see CellCheck::mesh_parameter()
    MapCells known;
    KnownKinds known_kinds;

    std::vector<std::vector<std::size_t>> site_groups(const std::vector<MapSite> &sites) const;
    void learn(const std::string &line);
  };
} // namespace sprag
