#include "fe/solid/layered_compliance.h"

#include "base/errors.h"
#include "fe/solid/bond_loads.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Surroundings of a column that must be alike for it to answer alike, over the thickness of the layer.
    constexpr double surroundings_over_thickness = 12.;

    /// Displacements of the near part that count, over its largest.
    constexpr double negligible = 1e-10;

    /// Columns solved for together, which bounds the memory that they take.
    constexpr int chunk = 128;

    long rounded(const double place)
    {
      return std::lround(1e6 * place);
    }
  } // namespace

  LayeredCompliance::LayeredCompliance(const SolidBody &body_, const double begin, const double end, const double thickness)
      : body(body_)
  {
    find_tiles(surroundings_over_thickness * thickness);
    if (body.has_layer())
      find_basis(begin, end, thickness);
  }

  void LayeredCompliance::find_tiles(const double surroundings)
  {
    const auto &nodes = body.friction_face().nodes;
    std::vector<unsigned int> order(nodes.size());
    std::iota(order.begin(), order.end(), 0u);
    for (const auto &node : nodes)
      dofs.insert(dofs.end(), node.dofs.begin(), node.dofs.end());
    for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      const double xi = nodes[i].position[0];
      if (tiles.empty() || rounded(tiles.back().xi) != rounded(xi))
        tiles.push_back({ xi, 3 * i, 3 * i, static_cast<unsigned int>(tiles.size()) });
      tiles.back().end = 3 * (i + 1);
    }

    std::map<std::set<std::vector<long>>, unsigned int> first_alike;
    for (unsigned int t = 0; t < tiles.size(); ++t)
    {
      std::set<std::vector<long>> around;
      const double xi = tiles[t].xi;
      for (const auto &cell : body.dofs().active_cell_iterators())
        if (cell->material_id() == material_id::layer && std::abs(cell->center()[0] - xi) < surroundings)
        {
          std::vector<long> corners;
          for (const unsigned int v : cell->vertex_indices())
            for (unsigned int d = 0; d < 3; ++d)
              corners.push_back(rounded(cell->vertex(v)[d] - (d == 0 ? xi : 0.)));
          around.insert(corners);
        }
      if (body.has_layer())
        tiles[t].like = first_alike.try_emplace(around, t).first->second;
    }
  }

  void LayeredCompliance::find_basis(const double begin, const double end, const double thickness)
  {
    const auto loads   = bond_loads(body, { begin, end, 2. * thickness, 4. * thickness });
    const int n        = loads.size();
    const auto n_ports = static_cast<unsigned int>(dofs.size());
    FullMatrix<double> of_face(n_ports, n);
    LAPACKFullMatrix<double> products(n);
    for (int first = 0; first < n; first += chunk)
    {
      const int last = std::min(n, first + chunk);
      SparseColumns some;
      for (int j = first; j < last; ++j)
      {
        for (int k = loads.begin[j]; k < loads.begin[j + 1]; ++k)
          some.add(loads.row[k - 1] - 1, loads.value[k - 1]);
        some.end_column();
      }
      const auto responses = body.respond(std::move(some));
      for (int j = first; j < last; ++j)
      {
        const double *const response = &responses[static_cast<std::size_t>(j - first) * body.n_dofs()];
        for (unsigned int port = 0; port < n_ports; ++port)
          of_face(port, j) = response[dofs[port]];
        for (int i = 0; i < n; ++i)
          for (int k = loads.begin[i]; k < loads.begin[i + 1]; ++k)
            products(i, j) += loads.value[k - 1] * response[loads.row[k - 1] - 1];
      }
    }

    // B^T K^-1 B = L L^T, Z = (K^-1 B)_face L^-T.
    products.compute_cholesky_factorization();
    LAPACKFullMatrix<double> lower(n), transposed(n, n_ports);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j)
        lower(i, j) = products(i, j);
    for (unsigned int port = 0; port < n_ports; ++port)
      for (int j = 0; j < n; ++j)
        transposed(j, port) = of_face(port, j);
    lower.set_property(LAPACKSupport::lower_triangular);
    lower.solve(transposed);
    basis.reinit(n_ports, n);
    for (unsigned int port = 0; port < n_ports; ++port)
      for (int j = 0; j < n; ++j)
        basis(port, j) = transposed(j, port);
  }

  unsigned int LayeredCompliance::tile_of(const unsigned int port) const
  {
    const auto after = std::upper_bound(tiles.begin(), tiles.end(), port,
                                        [](const unsigned int value, const Tile &tile) { return value < tile.begin; });
    return static_cast<unsigned int>(after - tiles.begin()) - 1;
  }

  PortSelection LayeredCompliance::whole_tiles(const PortSelection &ports) const
  {
    PortSelection result;
    for (const unsigned int port : ports)
      if (result.empty() || port > result.back())
        for (unsigned int i = tiles[tile_of(port)].begin; i < tiles[tile_of(port)].end; ++i)
          result.push_back(i);
    return result;
  }

  LayeredCompliance::NearColumns LayeredCompliance::find_near_columns(const unsigned int tile) const
  {
    SparseColumns loads;
    for (unsigned int port = tiles[tile].begin; port < tiles[tile].end; ++port)
    {
      loads.add(static_cast<unsigned int>(body.number_near(dofs[port])), 1.);
      loads.end_column();
    }
    const int n          = loads.size();
    const auto responses = body.respond_near(std::move(loads));
    const auto of_tile   = [&](const Tile &other)
    {
      FullMatrix<double> result(other.end - other.begin, n);
      for (unsigned int i = 0; i < result.m(); ++i)
        for (unsigned int j = 0; j < result.n(); ++j)
          result(i, j) = responses[j * static_cast<std::size_t>(body.n_near()) + body.number_near(dofs[other.begin + i])];
      return result;
    };
    NearColumns result{ 0, { of_tile(tiles[tile]) } };
    const double least  = body.has_layer() ? negligible * result.of_tiles.front().linfty_norm() : 0.;
    const auto add_side = [&](const int step, const auto &add)
    {
      for (int other = static_cast<int>(tile) + step; other >= 0 && other < static_cast<int>(tiles.size()); other += step)
      {
        auto matrix = of_tile(tiles[other]);
        if (body.has_layer() && matrix.linfty_norm() < least)
          break;
        add(std::move(matrix));
      }
    };
    add_side(1, [&](auto matrix) { result.of_tiles.push_back(std::move(matrix)); });
    std::vector<FullMatrix<double>> before;
    add_side(-1, [&](auto matrix) { before.push_back(std::move(matrix)); });
    result.first = -static_cast<int>(before.size());
    result.of_tiles.insert(result.of_tiles.begin(), std::make_move_iterator(before.rbegin()),
                           std::make_move_iterator(before.rend()));
    return result;
  }

  const LayeredCompliance::NearColumns &LayeredCompliance::near_columns(const unsigned int tile)
  {
    const unsigned int like = tiles[tile].like;
    const auto found        = known.find(like);
    return found != known.end() ? found->second : known.emplace(like, find_near_columns(like)).first->second;
  }

  FullMatrix<double> LayeredCompliance::among(const PortSelection &whole_tiles)
  {
    const auto n = static_cast<unsigned int>(whole_tiles.size());
    FullMatrix<double> result(n, n);
    if (basis.n() > 0)
    {
      FullMatrix<double> rows(n, basis.n());
      for (unsigned int i = 0; i < n; ++i)
        std::copy_n(&basis(whole_tiles[i], 0), basis.n(), &rows(i, 0));
      rows.mTmult(result, rows);
    }
    for (unsigned int place = 0; place < n;)
    {
      const unsigned int tile = tile_of(whole_tiles[place]);
      const auto &columns     = near_columns(tile);
      for (unsigned int row = place; row < n;)
      {
        const unsigned int other = tile_of(whole_tiles[row]);
        const int number         = static_cast<int>(other) - static_cast<int>(tile) - columns.first;
        if (number >= static_cast<int>(columns.of_tiles.size()))
          break;
        const auto &matrix = columns.of_tiles[number];
        for (unsigned int i = 0; i < matrix.m(); ++i)
          for (unsigned int j = 0; j < matrix.n(); ++j)
            if (row + i >= place + j)
            {
              result(row + i, place + j) += matrix(i, j);
              if (row + i != place + j)
                result(place + j, row + i) += matrix(i, j);
            }
        row += static_cast<unsigned int>(matrix.m());
      }
      place += tiles[tile].end - tiles[tile].begin;
    }
    return result;
  }

  double LayeredCompliance::displacement(const unsigned int port, const PortLoads &forces)
  {
    double result         = 0.;
    const unsigned int to = tile_of(port);
    for (unsigned int a = 0; a < forces.ports.size(); ++a)
    {
      const unsigned int from = forces.ports[a];
      for (unsigned int j = 0; j < basis.n(); ++j)
        result += basis(port, j) * basis(from, j) * forces.values[a];
      const unsigned int tile = tile_of(from);
      const auto &columns     = near_columns(tile);
      const int number        = static_cast<int>(to) - static_cast<int>(tile) - columns.first;
      if (number >= 0 && number < static_cast<int>(columns.of_tiles.size()))
        result += columns.of_tiles[number](port - tiles[to].begin, from - tiles[tile].begin) * forces.values[a];
    }
    return result;
  }
} // namespace sprag
