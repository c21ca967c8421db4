// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/task_farm/task_farm.h"
#include "levers/dynamics.h"
#include "results/columns.h"
#include "scene/scene.h"

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sprag
{
  // Refinement of a map over two parameters near the places where the kind of the result changes. The kinds are numbers without
  // order; each point has one for each direction of motion.

  using MapKinds = std::array<unsigned int, 2>;

  /// A place in a map, first and second coordinate in intervals of its grid: 0 ... points - 1, exact in binary.
  using MapSite = std::pair<double, double>;

  using KnownKinds = std::map<MapSite, MapKinds>;

  /// A grid checked at every `coarsest`-th point and at its ends first, then closer and closer wherever kinds differ.
  ///
  /// A quad is split when not all points known in it and on its sides have the same kinds, so that a boundary is followed
  /// wherever it leaves; and, while its parts are wider than an interval, when a quad beside it is split for that reason.
  /// Features narrower than the coarsest quads are seen only where one of the points meets them.
  class MapGrid
  {
  public:
    /// Makes a grid of at least two points each way; `coarsest` is a power of 2.
    MapGrid(unsigned int first_points, unsigned int second_points, unsigned int coarsest);

    /// Returns the grid points to be checked next, by increasing site; none once nothing is left to refine.
    std::vector<MapSite> next_sites();

    /// Adds the kinds at points of the grid.
    void learn(const KnownKinds &known);

    bool is_known(const unsigned int i, const unsigned int j) const
    {
      return known[index(i, j)] != 0;
    }

    /// Returns the kinds at a point of the grid, forward and backward; the point must be known.
    const MapKinds &kinds(const unsigned int i, const unsigned int j) const
    {
      return kind[index(i, j)];
    }

    std::array<unsigned int, 2> points() const
    {
      return n;
    }

    /// Returns values at all points, the second parameter running fastest, from `values` at the known ones: bilinear over the
    /// smallest quad around. They are NaN where a corner of that quad is NaN or not known.
    std::vector<double> interpolated(const std::vector<double> &values) const;

  private:
    /// The quads of one spacing and which of them are split.
    struct Level
    {
      unsigned int spacing;
      std::array<unsigned int, 2> quads;
      std::vector<char> split;

      std::size_t index(unsigned int a, unsigned int b) const
      {
        return std::size_t{ a } * quads[1] + b;
      }
    };

    /// First and last grid line of a quad each way.
    struct Corners
    {
      std::array<unsigned int, 2> low;
      std::array<unsigned int, 2> high;
    };

    const std::array<unsigned int, 2> n;
    std::vector<Level> levels; ///< coarsest first
    std::vector<char> known;
    std::vector<MapKinds> kind;

    std::size_t index(const unsigned int i, const unsigned int j) const
    {
      return std::size_t{ i } * n[1] + j;
    }

    Corners corners(const Level &level, unsigned int a, unsigned int b) const;
    bool is_active(std::size_t level, unsigned int a, unsigned int b) const;
    std::vector<Corners> active_quads() const; ///< of all levels, coarsest first
    bool is_mixed(const Corners &quad) const;
    void split_level(std::size_t level);
    void interpolate(const Corners &quad, const std::vector<double> &values, std::vector<double> &result) const;
  };

  /// A place where the kind changes along one line of the grid.
  struct BoundaryPoint
  {
    MapSite site;                      ///< middle of the bracket
    unsigned int direction;            ///< of motion, index of MapKinds
    unsigned int along;                ///< the parameter that varies: 0 or 1
    double width;                      ///< of the bracket, in intervals
    std::array<unsigned int, 2> kinds; ///< at its low and its high end
  };

  /// Narrows each edge between neighbouring known points that differ in kind.
  class BoundarySearch
  {
  public:
    BoundarySearch(const MapGrid &grid, unsigned int bisections);

    /// Returns the middles of the brackets, by increasing site; none after the last bisection.
    std::vector<MapSite> next_sites() const;

    /// Takes one bisection; all wanted sites must be known.
    void learn(const KnownKinds &known);

    std::vector<BoundaryPoint> points() const
    {
      return brackets;
    }

  private:
    std::vector<BoundaryPoint> brackets;
    unsigned int left;
  };

  constexpr std::size_t n_slide_values = 8;
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

    /// Returns the frequency and growth rate of a mode beyond what a beam can have, which the verdict leaves out [Hz, 1/s];
    /// NaN: none grows.
    std::array<double, 2> beyond(const unsigned int direction) const
    {
      const std::size_t end = 1 + (direction + 1) * n_slide_values;
      return { { values[end - 2], values[end - 1] } };
    }
  };

  /// Lists names, units and meaning of a cell's numbers.
  const std::vector<ColumnInfo> &cell_columns();

  /// Returns the parameter's value at a coordinate of the grid: its ends exactly.
  double parameter_at(const ParameterRange &range, double coordinate);

  /// Returns the scene that a cell judges.
  Scene cell_scene(const Scene &map, const MapSite &site);

  using MapCells = std::map<MapSite, MapCell>;

  /// Checks the slides of a map's scene in both directions at other values of its two parameters, on all ranks of MPI. A cell
  /// depends on its site alone. Every rank calls these functions and holds all cells.
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
