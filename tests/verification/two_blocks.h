// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "verification/pressed_block.h"

#include <deal.II/grid/manifold.h>

#include <cmath>
#include <memory>

namespace sprag
{
  /// A block on one side of an interface eta = bend xi^2: cell boundaries at `xi` and `eta`, increasing, eta from 0 or up to 0.
  /// Its far side at the height H stays straight.
  struct BentBlock
  {
    std::vector<double> xi;
    std::vector<double> eta;
    double bend = 0.;

    double height() const
    {
      return eta.back() > 0. ? eta.back() : eta.front();
    }
  };

  /// (xi, s) -> (xi, s + bend xi^2 (1 - s / H)): quadratic along each line of the mesh, so that cells of degree 2 follow it
  /// exactly.
  class BentChart : public dealii::ChartManifold<2, 2>
  {
  public:
    BentChart(const double bend_, const double height_)
        : bend(bend_)
        , height(height_)
    {
    }

    dealii::Point<2> push_forward(const dealii::Point<2> &at) const override
    {
      return { at[0], at[1] + bend * at[0] * at[0] * (1. - at[1] / height) };
    }

    dealii::Point<2> pull_back(const dealii::Point<2> &at) const override
    {
      const double rise = bend * at[0] * at[0];
      return { at[0], (at[1] - rise) / (1. - rise / height) };
    }

    std::unique_ptr<dealii::Manifold<2, 2>> clone() const override
    {
      return std::make_unique<BentChart>(bend, height);
    }

  private:
    const double bend;
    const double height;
  };

  /// Parts from -end to 0 of those from 0 to an end.
  inline std::vector<double> downwards(const std::vector<double> &parts)
  {
    std::vector<double> result;
    for (auto part = parts.rbegin(); part != parts.rend(); ++part)
      result.push_back(-*part);
    return result;
  }

  /// Two blocks without a common vertex: the upper one as make_block() marks it, the lower one of the cylinder's material, its
  /// upper side the cylinder's face, its lowest one the core.
  inline void make_two_blocks(const BentBlock &upper, const BentBlock &lower, dealii::Triangulation<2> &triangulation)
  {
    std::vector<dealii::Point<2>> vertices;
    std::vector<dealii::CellData<2>> cells;
    const BentChart charts[] = { { upper.bend, upper.height() }, { lower.bend, lower.height() } };
    for (const unsigned int i : { 0u, 1u })
    {
      const auto &block = i == 0 ? upper : lower;
      const auto first  = static_cast<unsigned int>(vertices.size());
      const auto row    = static_cast<unsigned int>(block.xi.size());
      for (const double eta : block.eta)
        for (const double xi : block.xi)
          vertices.push_back(charts[i].push_forward({ xi, eta }));
      for (unsigned int b = 0; b + 1 < block.eta.size(); ++b)
        for (unsigned int a = 0; a + 1 < row; ++a)
        {
          dealii::CellData<2> cell;
          const unsigned int corner = first + b * row + a;
          cell.vertices             = { corner, corner + 1, corner + row, corner + row + 1 };
          cell.material_id          = i == 0 ? material_id::lever : material_id::cylinder;
          cell.manifold_id          = i + 1;
          cells.push_back(cell);
        }
    }
    triangulation.create_triangulation(vertices, cells, {});
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      const bool above    = cell->material_id() == material_id::lever;
      const auto &chart   = charts[above ? 0 : 1];
      const double height = std::abs((above ? upper : lower).height());
      const auto distance = [&](const auto &face, const unsigned int v) { return std::abs(chart.pull_back(face->vertex(v))[1]); };
      cell->set_all_manifold_ids(above ? 1 : 2);
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
        {
          const double near = std::max(distance(face, 0), distance(face, 1));
          const double far  = std::min(distance(face, 0), distance(face, 1));
          face->set_boundary_id(near < 1e-9 * height         ? (above ? boundary_id::friction_face : boundary_id::cylinder_face)
                                : far > (1. - 1e-9) * height ? (above ? boundary_id::hub : boundary_id::core)
                                                             : 0);
        }
    }
    for (const unsigned int i : { 0u, 1u })
      triangulation.set_manifold(i + 1, charts[i]);
  }

  /// The upper block on the lower one, which moves into it by x.
  inline LeverProperties two_block_properties(const double coefficient)
  {
    auto result        = block_properties(0., coefficient);
    result.spring.law  = MomentLaw(1e15);
    result.body.curved = true;
    return result;
  }
} // namespace sprag
