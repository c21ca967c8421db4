// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/layered_compliance.h"

#include "base/errors.h"
#include "fe/body/end_face.h"
#include "fe/statics/solid_body.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Hat functions: linear between places, 1 at their own and 0 at the others; the first and last stay 1 outside.
    struct Hats
    {
      std::vector<double> places; ///< increasing [mm]

      unsigned int number() const
      {
        return static_cast<unsigned int>(places.size());
      }

      double operator()(const unsigned int hat, const double place) const
      {
        if (place < places[hat])
          return hat == 0 ? 1. : std::max(0., (place - places[hat - 1]) / (places[hat] - places[hat - 1]));
        if (place > places[hat])
          return hat + 1 == number() ? 1. : std::max(0., (places[hat + 1] - place) / (places[hat + 1] - places[hat]));
        return 1.;
      }
    };

    /// Returns hats at edges of the face's cells, at least a spacing apart [mm], so that the loads stay linearly independent.
    Hats hats_between_cells(const FrictionFace<3> &face, const unsigned int axis, const double begin, const double end,
                            const double spacing)
    {
      std::set<long> sides; // in nanometres
      for (const auto &edge : face.edges)
      {
        const auto is_before = [axis](const auto &a, const auto &b) { return a.position[axis] < b.position[axis]; };
        const auto both      = std::minmax_element(edge.nodes.begin(), edge.nodes.end(), is_before);
        sides.insert({ std::lround(1e6 * both.first->position[axis]), std::lround(1e6 * both.second->position[axis]) });
      }
      Hats result;
      double last = begin;
      for (const long side : sides)
        if (const double place = 1e-6 * static_cast<double>(side); place >= begin && place <= end)
        {
          if (result.places.empty() || place >= result.places.back() + 0.999 * spacing)
            result.places.push_back(place);
          last = place;
        }
      if (result.places.empty())
        result.places.push_back(0.5 * (begin + end));
      else if (result.places.size() > 1)
        result.places.back() = last;
      return result;
    }

    /// Returns whether face f of a cell separates the near-surface layer from the body behind.
    bool is_layer_interface(const SolidBody &body, const DoFHandler<3>::active_cell_iterator &cell, const unsigned int f)
    {
      return body.is_near_layer(cell) && !cell->at_boundary(f) && !body.is_near_layer(cell->neighbor(f));
    }

    /// Returns the attachment loads B on the interface between near-surface layer and body behind, as consistent nodal forces:
    ///   B_aj = int N_a h_i(xi) h_k(zeta) e_d dA,  a column j for each pair of hats (i, k) and direction d.
    /// Spacings [mm] are aimed at. It has no columns for a body without near-surface layer.
    SparseColumns attachment_loads(const SolidBody &body, const double begin, const double end, const double spacing_xi,
                                   const double spacing_zeta)
    {
      constexpr double whole = std::numeric_limits<double>::max();
      const auto along       = hats_between_cells(body.friction_face(), 0, begin, end, spacing_xi);
      const auto across      = hats_between_cells(body.friction_face(), 2, -whole, whole, spacing_zeta);

      const auto &fe = body.dofs().get_fe();
      FEFaceValues<3> values(body.cell_mapping(), fe, QGauss<2>(fe.degree + 1),
                             update_values | update_quadrature_points | update_JxW_values);
      std::vector<std::map<unsigned int, double>> columns(3 * along.number() * across.number());
      for (const auto &cell : body.dofs().active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (is_layer_interface(body, cell, f))
          {
            values.reinit(cell, f);
            const auto indices = cell_dofs(cell);
            for (const unsigned int q : values.quadrature_point_indices())
            {
              const auto &place = values.quadrature_point(q);
              for (unsigned int i = 0; i < along.number(); ++i)
                for (unsigned int k = 0; k < across.number(); ++k)
                  if (const double hat = along(i, place[0]) * across(k, place[2]); hat > 0.)
                    for (unsigned int a = 0; a < fe.n_dofs_per_face(); ++a)
                    {
                      const unsigned int in_cell   = fe.face_to_cell_index(a, f);
                      const unsigned int direction = fe.system_to_component_index(in_cell).first;
                      if (!body.is_held(indices[in_cell]))
                        columns[3 * (i * across.number() + k) + direction][indices[in_cell]] +=
                            values.JxW(q) * hat * values.shape_value(in_cell, q);
                    }
            }
          }
      SparseColumns result;
      for (const auto &column : columns)
        if (!column.empty())
        {
          for (const auto &[dof, force] : column)
            result.add(dof, force);
          result.end_column();
        }
      return result;
    }

    /// Distance over the layer's depth within which cells must be equal for two blocks to have equal columns.
    constexpr double surroundings_over_depth = 0.3;

    /// Smallest entries of G_near that are kept, over the largest: below a tenth of what the attachment modes leave out.
    constexpr double negligible = 1e-6;

    /// Number of columns solved together, limited by memory.
    constexpr int chunk = 64;

    /// Returns a length in nanometres, to compare positions [mm].
    long rounded(const double place)
    {
      return std::lround(1e6 * place);
    }

    /// A cell of the near-surface layer.
    struct NearCell
    {
      double begin, end; ///< along xi [mm]
      std::vector<Point<3>> corners;
    };

    std::vector<NearCell> near_cells(const SolidBody &body)
    {
      std::vector<NearCell> result;
      for (const auto &cell : body.dofs().active_cell_iterators())
        if (body.is_near_layer(cell))
        {
          const double middle = cell->center()[0], half = 0.5 * cell->extent_in_direction(0);
          auto &found = result.emplace_back(NearCell{ middle - half, middle + half, {} });
          for (const unsigned int v : cell->vertex_indices())
            found.corners.push_back(cell->vertex(v));
        }
      return result;
    }

    /// Returns the corners of the cells within a distance of xi [mm], relative to xi, in nanometres.
    std::set<std::vector<long>> find_surroundings(const double xi, const double distance, const std::vector<NearCell> &cells)
    {
      std::set<std::vector<long>> result;
      for (const auto &cell : cells)
        if (cell.begin < xi + distance && cell.end > xi - distance)
        {
          std::vector<long> corners;
          for (const auto &corner : cell.corners)
            for (unsigned int d = 0; d < 3; ++d)
              corners.push_back(rounded(corner[d] - (d == 0 ? xi : 0.)));
          result.insert(corners);
        }
      return result;
    }
  } // namespace

  LayeredCompliance::LayeredCompliance(const SolidBody &body_, const double begin, const double end,
                                       const double spacing_over_depth)
      : body(body_)
      , dofs(surface_dofs(body))
  {
    divide(surroundings_over_depth * body.near_layer_depth());
    if (!body.has_near_layer())
      return;
    find_basis(begin, end, spacing_over_depth * body.near_layer_depth());
    find_reach();
  }

  /// Sets the reach of G_near from the columns of the block that serves for most others.
  void LayeredCompliance::find_reach()
  {
    const auto serves_fewer = [](const Block &one, const Block &other) { return one.n_represented < other.n_represented; };
    const int most          = static_cast<int>(std::max_element(blocks.begin(), blocks.end(), serves_fewer)->representative);
    const auto &columns     = near_columns(static_cast<unsigned int>(most));
    const int first         = most + columns.first;
    const int last          = first + static_cast<int>(columns.block_matrices.size()) - 1;
    if (first > 0 || last + 1 < static_cast<int>(blocks.size()))
      reach = std::max(blocks[most].xi - blocks[first].xi, blocks[last].xi - blocks[most].xi);
  }

  void LayeredCompliance::divide(const double surroundings)
  {
    const auto &nodes = body.friction_face().nodes;
    for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      const double xi = nodes[i].position[0];
      if (blocks.empty() || rounded(blocks.back().xi) != rounded(xi))
      {
        ranges.push_back({ 3 * i, 3 * i });
        blocks.push_back({ xi, static_cast<unsigned int>(blocks.size()) });
      }
      ranges.back().end = 3 * (i + 1);
    }

    if (!body.has_near_layer())
      return;
    const auto cells = near_cells(body);
    std::map<std::set<std::vector<long>>, std::vector<unsigned int>> equal_blocks;
    for (unsigned int t = 0; t < blocks.size(); ++t)
      equal_blocks[find_surroundings(blocks[t].xi, surroundings, cells)].push_back(t);
    for (const auto &[corners, equal] : equal_blocks)
      for (const unsigned int t : equal)
      {
        blocks[t].representative = equal[equal.size() / 2];
        blocks[t].n_represented  = static_cast<unsigned int>(equal.size());
      }
  }

  void LayeredCompliance::find_basis(const double begin, const double end, const double spacing)
  {
    constexpr double beyond = 4.; // distance over the layer's depth to which forces spread on the interface
    const double depth      = body.near_layer_depth();
    const auto loads        = attachment_loads(body, begin - beyond * depth, end + beyond * depth, spacing, depth);
    const int n             = loads.size();
    const auto n_surface    = static_cast<unsigned int>(dofs.size());
    LAPACKFullMatrix<double> products(n), lower(n), transposed(n, n_surface);
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
      const auto responses = body.respond(some);
      for (int j = first; j < last; ++j)
      {
        const double *const response = &responses[static_cast<std::size_t>(j - first) * body.n_dofs()];
        for (unsigned int surface_dof = 0; surface_dof < n_surface; ++surface_dof)
          transposed(j, surface_dof) = response[dofs[surface_dof]];
        for (int i = 0; i < n; ++i)
          for (int k = loads.begin[i]; k < loads.begin[i + 1]; ++k)
            products(i, j) += loads.value[k - 1] * response[loads.row[k - 1] - 1];
      }
    }

    // B^T K^-1 B = L L^T, Z = (K^-1 B)_face L^-T.
    products.set_property(LAPACKSupport::symmetric);
    products.compute_cholesky_factorization();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j)
        lower(i, j) = products(i, j);
    lower.set_property(LAPACKSupport::lower_triangular);
    lower.solve(transposed);
    basis.reinit(n_surface, n);
    for (unsigned int surface_dof = 0; surface_dof < n_surface; ++surface_dof)
      for (int j = 0; j < n; ++j)
        basis(surface_dof, j) = transposed(j, surface_dof);
  }

  LayeredCompliance::NearColumns LayeredCompliance::find_near_columns(const unsigned int block_index) const
  {
    SparseColumns loads;
    for (unsigned int surface_dof = ranges[block_index].begin; surface_dof < ranges[block_index].end; ++surface_dof)
    {
      if (const int number = body.number_near(dofs[surface_dof]); number >= 0)
        loads.add(static_cast<unsigned int>(number), 1.);
      loads.end_column();
    }
    const int n            = loads.size();
    const auto responses   = body.respond_near(loads);
    const auto near_matrix = [&](const NumberRange &other)
    {
      FullMatrix<double> result(other.size(), n);
      for (unsigned int i = 0; i < result.m(); ++i)
        if (const int number = body.number_near(dofs[other.begin + i]); number >= 0)
          for (unsigned int j = 0; j < result.n(); ++j)
            result(i, j) = responses[j * static_cast<std::size_t>(body.n_near()) + number];
      return result;
    };
    NearColumns result{ 0, { near_matrix(ranges[block_index]) } };
    const double least  = body.has_near_layer() ? negligible * result.block_matrices.front().linfty_norm() : 0.;
    const auto add_side = [&](const int step, const auto &add)
    {
      for (int other = static_cast<int>(block_index) + step; other >= 0 && other < static_cast<int>(blocks.size()); other += step)
      {
        auto matrix = near_matrix(ranges[other]);
        if (body.has_near_layer() && matrix.linfty_norm() < least)
          break;
        add(std::move(matrix));
      }
    };
    add_side(1, [&](auto matrix) { result.block_matrices.push_back(std::move(matrix)); });
    std::vector<FullMatrix<double>> before;
    add_side(-1, [&](auto matrix) { before.push_back(std::move(matrix)); });
    result.first = -static_cast<int>(before.size());
    result.block_matrices.insert(result.block_matrices.begin(), std::make_move_iterator(before.rbegin()),
                                 std::make_move_iterator(before.rend()));
    return result;
  }

  /// Returns true if the representative's columns hold for this row: it has the same distance to the representative's block.
  bool LayeredCompliance::is_represented(const unsigned int row_block, const unsigned int column_block) const
  {
    const unsigned int representative = blocks[column_block].representative;
    const int other = static_cast<int>(representative) + static_cast<int>(row_block) - static_cast<int>(column_block);
    return other >= 0 && other < static_cast<int>(blocks.size()) &&
           rounded(blocks[other].xi - blocks[representative].xi) == rounded(blocks[row_block].xi - blocks[column_block].xi);
  }

  /// Returns the columns of a block, which are found once.
  const LayeredCompliance::NearColumns &LayeredCompliance::near_columns(const unsigned int block_index)
  {
    auto found = known.find(block_index);
    if (found == known.end())
      found = known.emplace(block_index, find_near_columns(block_index)).first;
    return found->second;
  }

  /// Returns the block of G_near; null if it is negligible.
  const FullMatrix<double> *LayeredCompliance::near_block(const unsigned int row_block, const unsigned int column_block)
  {
    if (std::abs(blocks[row_block].xi - blocks[column_block].xi) > reach)
      return nullptr;
    const auto &columns =
        near_columns(is_represented(row_block, column_block) ? blocks[column_block].representative : column_block);
    const int number       = static_cast<int>(row_block) - static_cast<int>(column_block) - columns.first;
    const bool is_far_away = number < 0 || number >= static_cast<int>(columns.block_matrices.size());
    return is_far_away ? nullptr : &columns.block_matrices[number];
  }

  FullMatrix<double> LayeredCompliance::block(const BlockPair &rows_and_columns)
  {
    const auto [row_block, column_block] = rows_and_columns;
    const auto &rows = ranges[row_block], &columns = ranges[column_block];
    const int n_rows = static_cast<int>(rows.size()), n_columns = static_cast<int>(columns.size()),
              n = static_cast<int>(basis.n());
    FullMatrix<double> result(rows.size(), columns.size());
    if (n > 0)
    {
      const double one = 1., zero = 0.; // row-major matrices are the transposed of BLAS's column-major ones
      gemm("T", "N", &n_columns, &n_rows, &n, &one, &basis(columns.begin, 0), &n, &basis(rows.begin, 0), &n, &zero, &result(0, 0),
           &n_columns);
    }
    // G_near is symmetric: the transposed block serves if it is represented and this one is not. If both must be solved for,
    // the block with the fewer equal ones is.
    const bool by_column =
        is_represented(row_block, column_block) ||
        (!is_represented(column_block, row_block) && blocks[column_block].n_represented <= blocks[row_block].n_represented);
    const auto *const near = by_column ? near_block(row_block, column_block) : near_block(column_block, row_block);
    if (near != nullptr && by_column)
      result.add(1., *near);
    else if (near != nullptr)
      result.Tadd(1., *near);
    return result;
  }

  Vector<double> LayeredCompliance::displacements(const DofSelection &surface_dofs, const DofLoads &forces)
  {
    Vector<double> amplitudes(basis_size()), result(static_cast<unsigned int>(surface_dofs.size()));
    for (unsigned int a = 0; a < forces.dofs.size(); ++a)
      for (unsigned int j = 0; j < basis.n(); ++j)
        amplitudes[j] += basis(forces.dofs[a], j) * forces.values[a];
    for (unsigned int i = 0; i < surface_dofs.size(); ++i)
    {
      for (unsigned int j = 0; j < basis.n(); ++j)
        result[i] += basis(surface_dofs[i], j) * amplitudes[j];
      const unsigned int to = containing_block(surface_dofs[i]);
      double near_part      = 0.;
      for (unsigned int a = 0; a < forces.dofs.size(); ++a)
        if (const unsigned int by = forces.dofs[a], from = containing_block(by); const auto *const near = near_block(to, from))
          near_part += (*near)(surface_dofs[i] - ranges[to].begin, by - ranges[from].begin) * forces.values[a];
      result[i] += near_part;
    }
    return result;
  }
} // namespace sprag
